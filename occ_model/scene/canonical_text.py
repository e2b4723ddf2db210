"""Parameters with a text of their own syntax, such as the levels of a waveform."""

from collections.abc import Callable
from dataclasses import dataclass

from occ_model.errors import SceneFileError, quote
from occ_model.scene.declaration import Declaration


@dataclass(frozen=True, slots=True)
class CanonicalText(Declaration):
    """A text that is kept in one form, the canonical one."""

    default: str
    allowed: str
    canonical: Callable[[str], str]  # Returns that form; ValueError with the problem
    empty: str = ""  # what is used without a text

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
