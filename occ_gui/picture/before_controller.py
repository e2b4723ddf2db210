"""Controller of the comparison with before: keeps the results from before the latest step."""

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
        self._store, self._tell = store, show
        self._wanted: Scene | None = None
        self._shown: Snapshot | None = None
        self.before: Snapshot | None = None
        store.step_begun.connect(self._begin_step)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._shown = snapshot
        # A gesture can begin before the picture of the scene that it changes is shown.
        before = self.before
        if snapshot.frame.scene == self._wanted and before is not None:
            if before.frame.scene != self._wanted:
                self._show(snapshot)
            self._wanted = None

    def _begin_step(self, left: Workspace) -> None:
        now = self._store.workspace
        if (left.scene, left.settings) == (now.scene, now.settings):
            return  # the step does not change the picture
        self._wanted = left.scene
        if self._shown is not None:
            self._show(self._shown)

    def _show(self, snapshot: Snapshot) -> None:
        self.before = snapshot
        self._tell(snapshot)
