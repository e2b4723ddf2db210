"""Frame rate: the pictures a second by which bits a second are counted, in all panes alike.

Whether success rates or bits a second are shown is chosen for map and advice together.
"""

from PySide6.QtCore import QObject, Signal

from occ_model.results.sweep_request import Shown
from occ_model.scene.recording import FRAME_RATE


class FrameRate(QObject):
    """Stores the pictures a second, and emits a signal when they change.

    Parameters
    ----------
    value
        The first value.
    """

    changed = Signal(float)
    """The new value."""

    shown_changed = Signal(str)
    """What is shown from now on: ``"rate"`` or ``"bits"``."""

    def __init__(self, value: float = FRAME_RATE.default) -> None:
        super().__init__()
        self.value = value
        self.shown: Shown = "rate"

    def change(self, value: float) -> None:
        """Set the pictures a second, which a field has checked."""
        if value != self.value:
            self.value = FRAME_RATE.check(value)
            self.changed.emit(self.value)

    def show(self, shown: Shown) -> None:
        """Show success rates or bits a second."""
        if shown != self.shown:
            self.shown = shown
            self.shown_changed.emit(shown)
