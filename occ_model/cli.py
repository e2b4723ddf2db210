"""``occ-model``: the model from the command line."""

import argparse
import os
import sys
from collections.abc import Sequence

from occ_model.commands import (
    accuracy,
    decode,
    figures,
    limits,
    listing,
    match,
    plan,
    render,
    sweep,
)
from occ_model.errors import OccError
from occ_model.exit_codes import EXIT_FAILURE, EXIT_MISUSE
from occ_model.version import __version__

_COMMANDS = (render, plan, accuracy, sweep, limits, decode, match, figures, listing)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the process's exit code."""
    options = _parser().parse_args(arguments)
    try:
        code: int = options.command(options)
        sys.stdout.flush()
    except OccError as error:
        print(f"occ-model: {error}", file=sys.stderr)
        return EXIT_MISUSE
    except BrokenPipeError:
        # Whoever read our output has stopped; nothing is left to say, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="occ-model", description="Simulate and decode rolling-shutter pictures of a panel."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for command in _COMMANDS:
        command.add_to(commands)
    return parser
