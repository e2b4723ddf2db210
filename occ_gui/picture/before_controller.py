"""Keep what was shown before the latest gesture, to compare what is shown now with it."""

from collections.abc import Sequence
from typing import Protocol

from PySide6.QtCore import QObject
from shiboken6 import isValid

from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene


class BeforePane(Protocol):
    """A pane that shows an earlier picture or profile beside that of now."""

    def show_before(self, snapshot: Snapshot) -> None:
        """Show these results as those of before."""


class BeforeController(QObject):
    """Finds out where a step of the scene begins, and shows what was there before it.

    A step is what is undone at once: a drag of a slider as a whole, but also an undo by itself.

    Parameters
    ----------
    scenes
        The scene and its steps.
    panes
        Show what was before.
    """

    def __init__(self, scenes: SceneStore, panes: Sequence[BeforePane]) -> None:
        super().__init__()
        self._stack = scenes.undo_stack
        self._panes = panes
        self._scene = self._left = scenes.scene
        self._wanted: Scene | None = None
        self._shown: Snapshot | None = None
        self.before: Snapshot | None = None
        self._top, self._count = self._stack.command(self._stack.index() - 1), self._stack.count()
        scenes.changed.connect(self._note)
        self._stack.indexChanged.connect(self._settle)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Take in what is shown now."""
        self._shown = snapshot
        # A gesture can begin before the picture that it begins at has been shown.
        before = self.before
        if snapshot.frame.scene == self._wanted and before is not None:
            if before.frame.scene != self._wanted:
                self._show(snapshot)
            self._wanted = None

    def _note(self, scene: Scene) -> None:
        self._left, self._scene = self._scene, scene

    def _settle(self) -> None:
        """Begin a step, unless the change has been added to the one that goes on."""
        if not isValid(self._stack):
            return  # a stack that is taken away is emptied first, and tells of it
        top, count = self._stack.command(self._stack.index() - 1), self._stack.count()
        # A gesture that has come back to where it began takes its step away, yet goes on.
        goes_on = top is self._top or count < self._count
        self._top, self._count = top, count
        if not goes_on:
            self._wanted = self._left
            if self._shown is not None:
                self._show(self._shown)

    def _show(self, snapshot: Snapshot) -> None:
        self.before = snapshot
        for pane in self._panes:
            pane.show_before(snapshot)
