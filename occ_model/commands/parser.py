"""The parser of the command line, and what the commands are added to."""

import argparse
import sys
from typing import IO, TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:  # argparse's own class cannot be subscripted when it runs
    Commands: TypeAlias = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands: TypeAlias = argparse._SubParsersAction


class Parser(argparse.ArgumentParser):
    """A parser that does not hide it where its help cannot be written."""

    def print_help(self, file: IO[str] | None = None) -> None:  # type: ignore[override]
        """Print the help; what goes wrong is raised, and not passed over as by default."""
        print(self.format_help(), end="", file=file or sys.stdout)
