"""The parser of the command line, and what the commands are added to."""

import argparse
import sys
from typing import IO, TYPE_CHECKING, NoReturn, TypeAlias

from occ_model.errors import one_line

if TYPE_CHECKING:  # argparse's own class cannot be subscripted when it runs
    Commands: TypeAlias = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands: TypeAlias = argparse._SubParsersAction


_LONGEST_MESSAGE = 1000
"""Characters of a refusal: room for all that is allowed, and not for whatever was written."""


class Parser(argparse.ArgumentParser):
    """A parser whose help is written or fails, and whose refusals are short."""

    def print_help(self, file: IO[str] | None = None) -> None:  # type: ignore[override]
        """Print the help; what goes wrong is raised, and not passed over as by default."""
        print(self.format_help(), end="", file=file or sys.stdout)

    def error(self, message: str) -> NoReturn:
        """End with the usage and a message, in which a word of the command line may be long."""
        super().error(one_line(message, _LONGEST_MESSAGE))
