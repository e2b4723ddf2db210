"""The command line of ``occ-model``; the ``add_to`` of each command declares its options.

A command is imported when it is called, as most need only a part of the model.
"""

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module

from occ_model.commands.files import check_files
from occ_model.commands.options import Parser
from occ_model.version import __version__

_MODULES = {  # the module of each command
    "render": "render", "plan": "render", "film": "film", "animate": "film",
    "accuracy": "accuracy", "sweep": "sweep", "limits": "limits",
    "most-bits": "limits", "bench": "bench", "bands": "bands", "decode": "decode", "match": "match",
    "camera": "camera", "figures": "figures", "room": "room", "transmit": "transmit",
    "codes": "listing", "presets": "listing", "parameters": "listing",
}  # fmt: skip


def make_parser(command: str | None = None) -> Parser:
    """Make the parser of one command, or of all commands if there is none of this name."""
    parser = Parser(
        prog="occ-model", description="Simulate and decode rolling-shutter pictures of a panel."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    modules = [_MODULES[command]] if command in _MODULES else dict.fromkeys(_MODULES.values())
    for module in modules:
        import_module(f"occ_model.commands.{module}").add_to(commands)
    return parser


def commands_of(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parsers of a program's commands by name."""
    actions = (each for each in parser._actions if isinstance(each, argparse._SubParsersAction))
    return {name: command for action in actions for name, command in action.choices.items()}


def read_command_line(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Parse a command line for :func:`run_command`."""
    words = sys.argv[1:] if arguments is None else arguments
    return make_parser(next(iter(words), None)).parse_args(arguments)


def run_command(options: argparse.Namespace) -> int:
    check_files(options)
    code: int = options.command(options)
    return code
