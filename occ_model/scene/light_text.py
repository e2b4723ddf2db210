"""Parameters that describe a light in a text of their own."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from occ_model.errors import SceneFileError, quote
from occ_model.scene.declaration import Declaration
from occ_model.scene.light_samples import canonical_samples, read_samples


@dataclass(frozen=True, slots=True)
class LightText(Declaration):
    """A text that describes a light, kept in one form."""

    default: str
    allowed: str
    canonical: Callable[[str], str]  # Returns that form; ValueError with the problem
    empty: str = ""  # what is sent without a text

    def check(self, value: object) -> str:
        if not isinstance(value, str):
            raise self.refuse(f"is {quote(value)}", self.allowed)
        try:
            return self.canonical(value)
        except SceneFileError as error:
            reason = str(error).rpartition(": ")[2].rstrip(".")
            raise self.refuse(f"is {quote(value)}, a file: {reason}", self.allowed) from None
        except ValueError as problem:
            raise self.refuse(f"is {quote(value)}, which {problem}", self.allowed) from None

    def parse(self, text: str) -> str:
        return self.check(text.strip(" "))

    def format(self, value: str) -> str:
        return value


def canonical_file(text: str) -> str:
    """Return the canonical rows of a CSV file, given as path or rows; an empty text stays empty.

    A scene keeps the rows, so that it stays the same when the file changes or is gone.
    """
    if not text.strip():
        return ""
    return canonical_samples(text) if "\n" in text else read_samples(Path(text))
