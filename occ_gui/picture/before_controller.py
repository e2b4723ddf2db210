"""Controller that keeps the results from before the latest step, to compare with them."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene


class BeforeController(QObject):
    """Keeps and shows the results from before the latest undo step."""

    def __init__(self, store: Store, show: Callable[[Snapshot], None]) -> None:
        super().__init__()
        self._store, self._show_before = store, show
        self._awaited_scene: Scene | None = None
        self._shown_snapshot: Snapshot | None = None
        self.before: Snapshot | None = None
        store.step_begun.connect(self._begin_step)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._shown_snapshot = snapshot
        # A gesture can change a scene before the picture of that scene is shown.
        before = self.before
        if snapshot.frame.scene == self._awaited_scene and before is not None:
            if before.frame.scene != self._awaited_scene:
                self._keep(snapshot)
            self._awaited_scene = None

    def _begin_step(self, previous: Workspace) -> None:
        now = self._store.workspace
        if (previous.scene, previous.settings) == (now.scene, now.settings):
            return  # the step does not change the picture
        self._awaited_scene = previous.scene
        if self._shown_snapshot is not None:
            self._keep(self._shown_snapshot)

    def _keep(self, snapshot: Snapshot) -> None:
        self.before = snapshot
        self._show_before(snapshot)
