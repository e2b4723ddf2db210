"""The options and arguments of both programs."""

import argparse
from collections.abc import Iterator

from occ_gui.app.command_line import make_parser as make_window_parser
from occ_model.commands.command_line import commands_of, make_parser


def all_actions() -> Iterator[argparse.Action]:
    """Yield what both programs and all commands accept."""
    for parser in (make_parser(), make_window_parser()):
        yield from _actions_of(parser)


def _actions_of(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    yield from parser._actions
    for command in commands_of(parser).values():
        yield from _actions_of(command)
