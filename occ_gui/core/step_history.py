"""History: the steps that can be undone or redone, by what each of them changes."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from occ_gui.core.workspace import Step
from occ_gui.values.room_choice import RoomChoice
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS


@dataclass(frozen=True, slots=True)
class StepChange:
    """One step: its title, the scene's values that it changes, and the rest of what it led to."""

    title: str
    values: Mapping[str, ParameterValue]
    force: Mapping[str, bool]
    room: RoomChoice = field(default_factory=RoomChoice)
    preset: str = ""

    @classmethod
    def between(cls, title: str, before: Step, after: Step) -> "StepChange":
        old, new = before.scene, after.scene
        values = {
            name: new.value(name) for name in PARAMETERS if new.value(name) != old.value(name)
        }
        return cls(title, values, after.force, after.room, after.preset)


@dataclass(frozen=True, slots=True)
class History:
    """The state before the first step, the steps, and how many of them are done."""

    first: Step
    steps: tuple[StepChange, ...] = ()
    done: int = 0

    def states(self) -> Iterator[Step]:
        """Return the state before each step and that after the last; errors as `Scene.replace`."""
        scene = self.first.scene
        yield self.first
        for step in self.steps:
            scene = scene.replace(**step.values)
            yield Step(scene, dict(step.force), step.room, step.preset)
