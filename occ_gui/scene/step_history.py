"""History: the steps of the scene that can be undone or redone, by what each of them changes."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

State: TypeAlias = tuple[Scene, Mapping[str, bool]]
"""What a step changes: the scene, and the effects forced on (True) or off (False) by hand."""


@dataclass(frozen=True, slots=True)
class StepChange:
    """One step: its title, the new values of what it changes, and the effects forced after it."""

    title: str
    values: Mapping[str, ParameterValue]
    force: Mapping[str, bool]

    @classmethod
    def between(cls, title: str, before: State, after: State) -> "StepChange":
        """Note the step from one state to another."""
        (old, _), (new, force) = before, after
        values = {
            name: new.value(name) for name in PARAMETERS if new.value(name) != old.value(name)
        }
        return cls(title, values, dict(force))


@dataclass(frozen=True, slots=True)
class History:
    """The state before the first step, the steps, and how many of them are done."""

    scene: Scene
    force: Mapping[str, bool]
    steps: tuple[StepChange, ...] = ()
    done: int = 0

    def states(self) -> Iterator[State]:
        """Give the state before each step and that after the last; errors as `Scene.replace`."""
        scene = self.scene
        yield scene, self.force
        for step in self.steps:
            scene = scene.replace(**step.values)
            yield scene, step.force
