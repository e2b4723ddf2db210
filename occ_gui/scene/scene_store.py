"""Scene store: the current scene and the effects forced by hand, with the steps to undo."""

from collections.abc import Mapping

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from occ_gui.scene.forced_effects import switch_text
from occ_gui.scene.gesture import NO_GESTURE
from occ_gui.scene.settings_store import SettingsStore
from occ_gui.scene.step_history import History, State, StepChange
from occ_model.errors import OccError, one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

MOST_STEPS = 500
"""Steps that can be undone; each of them keeps two scenes in memory."""


class SceneStore(QObject):
    """Stores the scene and emits a signal when it changes.

    The effects forced by hand are a part of the settings, but they change in steps that can be
    undone, together with the scene.

    Parameters
    ----------
    scene
        The first scene.
    settings
        The store of the settings; by default one of its own.
    """

    changed = Signal(object)
    """The new scene."""

    refused = Signal(str)
    """The reason why a change was not made; the scene is unchanged."""

    refused_for = Signal(str, object)
    """The same, and the names of the parameters that were to be changed."""

    def __init__(self, scene: Scene, settings: SettingsStore | None = None) -> None:
        super().__init__()
        self._scene = scene
        self.settings = SettingsStore() if settings is None else settings
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(MOST_STEPS)
        self._is_resuming = False

    @property
    def scene(self) -> Scene:
        """The current scene."""
        return self._scene

    def change(self, gesture: int = NO_GESTURE, **changes: ParameterValue) -> None:
        """Change parameters; an invalid change is refused with a sentence."""
        try:
            scene = self._scene.replace(**changes)
        except OccError as error:
            self.refused.emit(str(error))
            at_fault = [name for name in changes if name in error.parameters]
            self.refused_for.emit(str(error), tuple(at_fault or changes))
            return
        labels = " and ".join(PARAMETERS[name].label.lower() for name in changes)
        self.put(scene, f"change of {labels}", gesture)

    def force(self, effect: str, included: bool | None) -> None:
        """Switch an effect on or off, or leave it to the plan (None)."""
        force = {name: on for name, on in self._force.items() if name != effect}
        if included is not None:
            force[effect] = included
        self.put(
            self._scene,
            f"switch: {switch_text(effect, included, self.settings.effect_labels)}",
            force=force,
        )

    def release_effects(self) -> None:
        """Leave all effects to the plan, as one step."""
        self.put(self._scene, "return of all effects to the plan", force={})

    @property
    def _force(self) -> Mapping[str, bool]:
        return self.settings.settings.force

    def put(
        self,
        scene: Scene,
        title: str,
        gesture: int = NO_GESTURE,
        force: Mapping[str, bool] | None = None,
    ) -> None:
        """Replace the whole scene, as one step.

        Parameters
        ----------
        scene
            The new scene.
        title
            The name of the step in the undo menu.
        gesture
            The number of the gesture: changes of one gesture are one step.
        force
            The effects forced by hand from now on; by default those of before.
        """
        before: State = (self._scene, self._force)
        after: State = (scene, self._force if force is None else force)
        if after == before:
            return
        last, new = self._last_step(), None
        if last is None or gesture == NO_GESTURE or gesture != last.gesture:
            new = _Step(self, before, after, title, gesture)
        else:
            # Not by QUndoCommand.mergeWith: PySide never frees a command that was merged.
            last.after = after
            if last.after == last.before:
                last.setObsolete(True)  # a gesture that ends where it began is no step
                self.undo_stack.undo()  # only removes the obsolete step
        # As in _restore, which would be one call more on the way of a slider to its picture.
        is_new, self._scene = scene != self._scene, scene
        self.settings.set_force(after[1])
        if is_new:
            self.changed.emit(scene)
        if new is not None:
            self.undo_stack.push(new)

    def history(self, state: State) -> History:
        """Return the steps; where a state is not the present one, those alone that led to it."""
        stack, present = self.undo_stack, self.undo_stack.index()
        commands = (stack.command(place) for place in range(stack.count()))
        steps = [command for command in commands if isinstance(command, _Step)]
        first = steps[0].before if steps else (self._scene, self._force)
        states = [first, *(step.after for step in steps)]
        done = next((place for place in range(present, -1, -1) if states[place] == state), None)
        if done is None:
            return History(*state)
        kept = steps if done == present else steps[:done]
        return History(*first, tuple(step.change for step in kept), done)

    def resume(self, history: History) -> None:
        """Have the steps of an earlier window, if they lead to the present state; else none."""
        try:
            states = [*history.states()]
        except OccError:
            return
        if states[history.done] != (self._scene, self._force):
            return
        self._is_resuming = True
        self.undo_stack.clear()
        for step, before, after in zip(history.steps, states, states[1:], strict=False):
            self.undo_stack.push(_Step(self, before, after, step.title, NO_GESTURE))
        self.undo_stack.setIndex(history.done)
        self._is_resuming = False

    def _last_step(self) -> "_Step | None":
        """Return the step that led to the current scene, None at a saved state or if none did."""
        index = self.undo_stack.index()
        if index == 0 or index != self.undo_stack.count() or self.undo_stack.isClean():
            return None
        step = self.undo_stack.command(index - 1)
        return step if isinstance(step, _Step) else None

    def _restore(self, state: State) -> None:
        if self._is_resuming:
            return
        # Both are equal where a step that was made already is pushed.
        scene, force = state
        is_new = scene != self._scene
        self._scene = scene  # first, so that whoever hears of the settings reads both
        self.settings.set_force(force)
        if is_new:
            self.changed.emit(scene)


class _Step(QUndoCommand):
    """One step from a state to another."""

    def __init__(
        self, store: SceneStore, before: State, after: State, title: str, gesture: int
    ) -> None:
        super().__init__(one_line(title).replace("&", "&&"))  # in a menu, & marks a shortcut
        self._store, self._title = store, title
        self.before, self.after = before, after
        self.gesture = gesture
        self._noted: tuple[State, StepChange] | None = None

    @property
    def change(self) -> StepChange:
        """What the step changes; noted once, as a session is written each second of a drag."""
        if self._noted is None or self._noted[0] is not self.after:
            self._noted = self.after, StepChange.between(self._title, self.before, self.after)
        return self._noted[1]

    def redo(self) -> None:
        self._store._restore(self.after)

    def undo(self) -> None:
        self._store._restore(self.before)
