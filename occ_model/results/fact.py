"""Facts: what was found out, as rows that the window, the shell and files print alike."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Fact:
    """What is known of one thing."""

    key: str  # The name by which programs find it: of a scene's parameter its own
    label: str  # What it is, in words
    text: str  # Its value with unit and error, and before it what that rests on
    note: str = ""  # What qualifies it, such as "assumed" or "doubtful"; empty where nothing does
    meaning: str = ""  # What the number means, in a sentence; empty where the label says it

    def __str__(self) -> str:
        return f"{self.text} ({self.note})" if self.note else self.text
