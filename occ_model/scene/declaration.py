"""What every declaration of a parameter states."""

from dataclasses import dataclass, field
from typing import Any

from occ_model.errors import ParameterError
from occ_model.scene.units import LONGEST_TEXT


def in_sentence(label: str) -> str:
    """Return a label within a sentence, where ISO, LED and JPEG stay in capitals."""
    return label if label[:2].isupper() else label[:1].lower() + label[1:]


@dataclass(frozen=True, slots=True)
class Declaration:
    name: str  # The identifier, as in a scene file
    label: str  # Its usual name in the field, as on screen
    symbol: str  # Its symbol in the paper's equations, empty if it has none
    meaning: str
    lights: tuple[str, ...] = field(default=(), kw_only=True)
    """Kinds of light that it is for; of every kind if empty."""

    @property
    def in_sentence(self) -> str:
        """The label inside a sentence."""
        return in_sentence(self.label)

    def is_of(self, light: str) -> bool:
        """Whether scenes with a kind of light have this parameter."""
        return not self.lights or light in self.lights

    def format(self, value: Any) -> str:
        """Return a value as one would type it."""
        return str(value)

    def refuse(self, problem: str, allowed: str) -> ParameterError:
        """Return the error for a ``problem``, a verb and the value such as "is 3 m"."""
        verb, _, value = problem.partition(" ")
        return ParameterError.of(self.name, value, allowed, verb=verb, parameters=(self.name,))

    def check_length(self, text: str, allowed: str) -> None:
        """Refuse a text that is too long for a number."""
        if len(text) > LONGEST_TEXT:
            raise self.refuse(
                f"is a text of {len(text):,} characters",
                f"{allowed}, written in up to {LONGEST_TEXT} characters",
            )
