"""Scene store: the current scene, an immutable value, with the steps to undo."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from occ_gui.scene.gesture import NO_GESTURE
from occ_model.errors import OccError, one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

_MOST_STEPS = 500
"""Steps that can be undone; each of them keeps two scenes in memory."""


class SceneStore(QObject):
    """Stores the scene and emits a signal when it changes.

    Parameters
    ----------
    scene
        The first scene.
    """

    changed = Signal(object)
    """The new scene."""

    refused = Signal(str)
    """The reason why a change was not made; the scene is unchanged."""

    def __init__(self, scene: Scene) -> None:
        super().__init__()
        self._scene = scene
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(_MOST_STEPS)

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
            return
        labels = " and ".join(PARAMETERS[name].label.lower() for name in changes)
        self.put(scene, f"change of {labels}", gesture)

    def put(self, scene: Scene, title: str, gesture: int = NO_GESTURE) -> None:
        """Replace the whole scene; ``title`` names the step in the undo menu."""
        if scene == self._scene:
            return
        last, new = self._last_step(), None
        if last is None or gesture == NO_GESTURE or gesture != last.gesture:
            new = _Step(self, self._scene, scene, title, gesture)
        else:
            # Not by QUndoCommand.mergeWith: PySide never frees a command that was merged.
            last.after = scene
            if last.after == last.before:
                last.setObsolete(True)  # a gesture that ends where it began is no step
                self.undo_stack.undo()  # only removes the obsolete step
        self._scene = scene
        self.changed.emit(scene)
        if new is not None:
            self.undo_stack.push(new)

    def _last_step(self) -> "_Step | None":
        """Return the step that led to the current scene, None at a saved state or if none did."""
        index = self.undo_stack.index()
        if index == 0 or index != self.undo_stack.count() or self.undo_stack.isClean():
            return None
        step = self.undo_stack.command(index - 1)
        return step if isinstance(step, _Step) else None

    def _restore(self, scene: Scene) -> None:
        if scene != self._scene:  # equal where a step that was made already is pushed
            self._scene = scene
            self.changed.emit(scene)


class _Step(QUndoCommand):
    """One step from a scene to another."""

    def __init__(
        self, store: SceneStore, before: Scene, after: Scene, title: str, gesture: int
    ) -> None:
        super().__init__(one_line(title).replace("&", "&&"))  # in a menu, & marks a shortcut
        self._store = store
        self.before, self.after = before, after
        self.gesture = gesture

    def redo(self) -> None:
        self._store._restore(self.after)

    def undo(self) -> None:
        self._store._restore(self.before)
