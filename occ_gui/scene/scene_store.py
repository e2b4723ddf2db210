"""The scene that the window shows: one frozen value, changed in one place, with undo."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from occ_gui.scene.gesture import NO_GESTURE
from occ_model.errors import OccError, one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

_MOST_STEPS = 500
"""Steps that can be undone: nobody goes back further, and each holds a scene."""


class SceneStore(QObject):
    """Holds the scene and tells when it changes.

    Parameters
    ----------
    scene
        The scene to begin with.
    """

    changed = Signal(object)
    """The new scene."""

    refused = Signal(str)
    """Why a change was not made; the scene is as it was."""

    def __init__(self, scene: Scene) -> None:
        super().__init__()
        self._scene = scene
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(_MOST_STEPS)

    @property
    def scene(self) -> Scene:
        """The scene as it is now."""
        return self._scene

    def change(self, gesture: int = NO_GESTURE, **changes: ParameterValue) -> None:
        """Change parameters; what cannot be is refused with a sentence."""
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
        last = self._last_step()
        if last is None or gesture == NO_GESTURE or gesture != last.gesture:
            self.undo_stack.push(_Step(self, self._scene, scene, title, gesture))
            return
        # Not by a second step that Qt merges with the first: PySide keeps what was merged for ever.
        last.after = scene
        if last.after == last.before:
            last.setObsolete(True)  # a gesture that ends where it began is no step
            self.undo_stack.undo()  # which takes an obsolete step away, and does nothing else
        self._show(scene)

    def _last_step(self) -> "_Step | None":
        """Give the step that led here, None where it was saved, or there is none."""
        index = self.undo_stack.index()
        if index == 0 or index != self.undo_stack.count() or self.undo_stack.isClean():
            return None
        step = self.undo_stack.command(index - 1)
        return step if isinstance(step, _Step) else None

    def _show(self, scene: Scene) -> None:
        self._scene = scene
        self.changed.emit(scene)


class _Step(QUndoCommand):
    """One step from a scene to another."""

    def __init__(
        self, store: SceneStore, before: Scene, after: Scene, title: str, gesture: int
    ) -> None:
        super().__init__(one_line(title).replace("&", "&&"))  # for the menu, which marks keys by it
        self._store = store
        self.before, self.after = before, after
        self.gesture = gesture

    def redo(self) -> None:
        self._store._show(self.after)

    def undo(self) -> None:
        self._store._show(self.before)
