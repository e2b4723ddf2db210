"""The command line of ``occ-model``: each command's ``add_to`` declares its options and action.

The commands import all of the model. The window, which needs some of their options, does not import
them.
"""

import argparse
from collections.abc import Sequence

from occ_model.commands import (
    accuracy,
    animate,
    bands,
    bench,
    codes,
    decode,
    figures,
    film,
    film_study,
    limits,
    listing,
    match,
    most_bits,
    plan,
    render,
    room,
    sweep,
    transmit,
)
from occ_model.commands.files import check_files
from occ_model.commands.options import Parser
from occ_model.version import __version__

_COMMANDS = (
    render, animate, film, film_study, plan, accuracy, sweep, limits, bench, most_bits, bands,
    decode, match, figures, room, transmit, codes, listing,
)  # fmt: skip


def make_parser() -> Parser:
    """Make the parser of all commands."""
    parser = Parser(
        prog="occ-model", description="Simulate and decode rolling-shutter pictures of a panel."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for command in _COMMANDS:
        command.add_to(commands)
    return parser


def read_command_line(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Parse a command line for :func:`run_command`."""
    return make_parser().parse_args(arguments)


def run_command(options: argparse.Namespace) -> int:
    """Run the command of a command line; return the exit code."""
    check_files(options)
    code: int = options.command(options)
    return code
