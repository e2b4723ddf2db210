"""Facts: rows of results with the same words in the window, on the command line and in files."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Fact:
    """One row of a result."""

    key: str  # Identifier; the name of a scene's parameter
    label: str  # Its name in words
    text: str  # Value with unit and error, after its condition
    note: str = ""  # Qualification such as "assumed" or "doubtful"
    meaning: str = ""  # An explanation, if the label is not enough

    def __str__(self) -> str:
        return f"{self.text} ({self.note})" if self.note else self.text
