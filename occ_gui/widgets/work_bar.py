"""Work bar: shows the progress of some work, with a button that cancels it."""

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QWidget

from occ_gui.widgets.building import fill, name_widget, push_button

_STEPS = 1000

_DELAY_MS = 300  # shorter work is not shown, because the bar would only flash


class WorkBar(QWidget):
    cancelled = Signal()

    def __init__(self, name: str) -> None:
        super().__init__()
        self.progress = name_widget(QProgressBar(), name, name)
        self.progress.setRange(0, _STEPS)
        self.cancel = push_button("Cancel", "Cancel this work.", self.cancelled)
        self._delay = QTimer(self, singleShot=True)
        self._delay.setInterval(_DELAY_MS)
        self._delay.timeout.connect(self.show)
        fill(QHBoxLayout(self), self.progress, self.cancel, margins=0)
        self.hide()

    def begin(self) -> None:
        self.progress.setValue(0)
        if self.isHidden():
            self._delay.start()

    def show_progress(self, fraction: float) -> None:
        self.progress.setValue(round(_STEPS * fraction))

    def end(self) -> None:
        self._delay.stop()
        self.hide()
