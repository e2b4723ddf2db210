"""What is tried, what may be wrong in it, and what helps."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@dataclass(frozen=True, slots=True)
class Attempt:
    """A scene that a decoder tries to read from its picture."""

    scene: Scene
    decoder: str
    settings: SimulationSettings

    def changed(self, **changes: ParameterValue) -> "Attempt":
        return replace(self, scene=self.scene.replace(**changes))

    def lit_anew(self, factor: float) -> "Attempt":
        """Multiply the lamp's and all other light."""
        scene = self.scene
        return self.changed(
            luminance=factor * scene.transmitter.luminance,
            illuminance=factor * scene.surroundings.illuminance,
        )


@dataclass(frozen=True, slots=True)
class Step:
    """A remedy: parameters to change, in SI units, or another decoder."""

    label: str
    changes: Mapping[str, ParameterValue] = field(default_factory=dict)
    decoder: str = ""

    def taken(self, attempt: Attempt) -> Attempt:
        changed = attempt.changed(**self.changes)
        return replace(changed, decoder=self.decoder or attempt.decoder)


@dataclass(frozen=True, slots=True)
class Suspect:
    what: str  # In a few words, such as a title ends with
    why: str  # A sentence of facts about the scene
    take_out: Callable[[Attempt], Attempt]  # Leaves all else as it is, as far as that can be
    steps: tuple[Step, ...] = ()  # Remedies, of which the first that helps is offered
    is_overexposed: bool = False
