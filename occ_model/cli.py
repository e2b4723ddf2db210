"""Command line ``occ-model``: its entry point."""

from collections.abc import Callable, Sequence
from functools import partial

from occ_model.program import run_program


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line, by default this process's; return its exit code."""
    is_process = arguments is None
    return run_program("occ-model", partial(_command, arguments), is_process=is_process)


def _command(arguments: Sequence[str] | None) -> Callable[[], int]:
    # Imported here, where Ctrl-C is handled, because the commands import the whole model.
    from occ_model.commands.command_line import read_command_line, run_command

    return partial(run_command, read_command_line(arguments))
