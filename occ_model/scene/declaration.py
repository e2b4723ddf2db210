"""What the declarations of all kinds of parameter have in common."""

from dataclasses import dataclass

from occ_model.errors import ParameterError
from occ_model.scene.units import LONGEST_TEXT


@dataclass(frozen=True, slots=True)
class Declaration:
    """The declaration of a parameter, of whatever kind."""

    name: str  # The identifier, as in a scene file
    label: str  # The field's term for it, as on screen
    symbol: str  # The symbol in the paper's equations, empty where it has none
    meaning: str

    def refuse(self, problem: str, allowed: str) -> ParameterError:
        """Return the error; ``problem``: a verb and the value, such as "is 3 m"."""
        verb, _, value = problem.partition(" ")
        return ParameterError.of(self.name, value, allowed, verb=verb, parameters=(self.name,))

    def check_length(self, text: str, allowed: str) -> None:
        """Refuse a text that is too long to be a number."""
        if len(text) > LONGEST_TEXT:
            raise self.refuse(
                f"is a text of {len(text):,} characters",
                f"{allowed}, written in up to {LONGEST_TEXT} characters",
            )
