"""Frame rate: the pictures a second by which bits a second are counted, in all panes alike.

Whether success rates or bits a second are shown is chosen for map and advice together.
"""

from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_gui.core.store import Store
from occ_model.results.sweep_request import Shown
from occ_model.scene.recording import FRAME_RATE


class FrameRate(QObject):
    """The pictures a second in a workspace, and what is shown by them."""

    changed = Signal(object)
    """The new value."""

    shown_changed = Signal(object)
    """What is shown from now on: ``"rate"`` or ``"bits"``."""

    def __init__(self, store: Store) -> None:
        super().__init__()
        self._store = store
        store.select(lambda workspace: workspace.frame_rate).changed.connect(self.changed)
        store.select(lambda workspace: workspace.shown).changed.connect(self.shown_changed)

    @property
    def value(self) -> float:
        """The pictures a second."""
        return self._store.workspace.frame_rate

    @property
    def shown(self) -> Shown:
        """What is shown: success rates, or bits a second."""
        return self._store.workspace.shown

    def change(self, value: float) -> None:
        """Set the pictures a second, which a field has checked."""
        workspace = self._store.workspace
        self._store.put(replace(workspace, frame_rate=FRAME_RATE.check(value)))

    def show(self, shown: Shown) -> None:
        """Show success rates or bits a second."""
        self._store.put(replace(self._store.workspace, shown=shown))
