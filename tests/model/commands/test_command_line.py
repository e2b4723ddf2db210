"""A command line imports the module of its command."""

import argparse

import pytest

from occ_model.commands.command_line import _MODULES, make_parser


def _commands(parser: argparse.ArgumentParser) -> list[str]:
    (commands,) = [each for each in parser._actions if each.choices is not None]
    return list(commands.choices or ())


def test_the_table_names_every_command_in_the_order_of_the_help() -> None:
    assert _commands(make_parser()) == list(_MODULES)
    assert _commands(make_parser("no-command")) == list(_MODULES)


@pytest.mark.parametrize("name", _MODULES)
def test_a_command_is_declared_by_its_own_module(name: str) -> None:
    assert name in _commands(make_parser(name))
    assert set(_commands(make_parser(name))) == {
        other for other, module in _MODULES.items() if module == _MODULES[name]
    }
