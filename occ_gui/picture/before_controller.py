"""Controller of the comparison with before: it keeps the results before the latest step."""

from collections.abc import Sequence
from typing import Protocol

from PySide6.QtCore import QObject
from shiboken6 import isValid

from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene


class BeforePane(Protocol):
    """A pane that shows an earlier picture or profile beside the current one."""

    def show_before(self, snapshot: Snapshot) -> None:
        """Show these results as those before the latest step."""


class BeforeController(QObject):
    """Detects the beginning of each step of the scene, and shows the results before it.

    A step is what one undo takes back, such as a whole drag of a slider; an undo is a step too.

    Parameters
    ----------
    scenes
        The scene and its undo steps.
    panes
        The panes that show the results before the step.
    """

    def __init__(self, scenes: SceneStore, panes: Sequence[BeforePane]) -> None:
        super().__init__()
        self._stack = scenes.undo_stack
        self._panes = panes
        self._scene = self._previous = scenes.scene
        self._wanted: Scene | None = None
        self._shown: Snapshot | None = None
        self.before: Snapshot | None = None
        self._top, self._count = self._stack.command(self._stack.index() - 1), self._stack.count()
        scenes.changed.connect(self._follow_scene)
        self._stack.indexChanged.connect(self._begin_step)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Keep the results that are shown now."""
        self._shown = snapshot
        # A gesture can begin before the picture of its first scene is shown.
        before = self.before
        if snapshot.frame.scene == self._wanted and before is not None:
            if before.frame.scene != self._wanted:
                self._show(snapshot)
            self._wanted = None

    def _follow_scene(self, scene: Scene) -> None:
        self._previous, self._scene = self._scene, scene

    def _begin_step(self) -> None:
        """Begin a step, unless the change was merged into the current one."""
        if not isValid(self._stack):
            return  # a stack that is deleted is cleared first, and emits its signal
        top, count = self._stack.command(self._stack.index() - 1), self._stack.count()
        # A gesture that returns to its first scene removes its step, but continues.
        continues = top is self._top or count < self._count
        self._top, self._count = top, count
        if not continues:
            self._wanted = self._previous
            if self._shown is not None:
                self._show(self._shown)

    def _show(self, snapshot: Snapshot) -> None:
        self.before = snapshot
        for pane in self._panes:
            pane.show_before(snapshot)
