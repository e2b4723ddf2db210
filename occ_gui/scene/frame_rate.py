"""Frame rate: the pictures a second by which bits a second are counted, in all panes alike."""

from PySide6.QtCore import QObject, Signal

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

    def __init__(self, value: float = FRAME_RATE.default) -> None:
        super().__init__()
        self.value = value

    def change(self, value: float) -> None:
        """Set the pictures a second, which a field has checked."""
        if value != self.value:
            self.value = FRAME_RATE.check(value)
            self.changed.emit(self.value)
