"""An attempt to read a picture, what may be wrong with it, and remedies."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from occ_model.results.decoding import Remedy
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene, SimulationSettings


@dataclass(frozen=True, slots=True)
class Attempt:
    """A scene and the decoder that tries to read its picture."""

    scene: Scene
    decoder: str
    settings: SimulationSettings

    def change(self, **changes: ParameterValue) -> "Attempt":
        return replace(self, scene=self.scene.replace(**changes))

    def apply(self, remedy: Remedy) -> "Attempt":
        changed = self.change(**remedy.changes)
        return replace(changed, decoder=remedy.decoder or self.decoder)

    def scale_light(self, factor: float) -> "Attempt":
        """Multiply the light of the lamp and all other light by a factor."""
        scene = self.scene
        return self.change(
            luminance=factor * scene.transmitter.luminance,
            illuminance=factor * scene.surroundings.illuminance,
        )


@dataclass(frozen=True, slots=True)
class Suspect:
    what: str  # A few words that can end a title
    why: str  # A sentence with facts about the scene
    # Removes the suspect, and leaves all else unchanged as far as possible
    remove: Callable[[Attempt], Attempt]
    remedies: tuple[Remedy, ...] = ()  # The first that helps is offered
    is_overexposed: bool = False
