"""Work bar: shows the progress of some work, with a button that cancels it."""

from typing import Protocol

from PySide6.QtCore import QTimer, Signal, SignalInstance
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QWidget

from occ_gui.widgets.building import fill, name_widget, push_button

_STEPS = 1000

_DELAY_MS = 300  # shorter work is not shown, because the bar would only flash


class _Reports(Protocol):
    reported: SignalInstance


class _Work(Protocol):
    begun: SignalInstance
    ended: SignalInstance

    @property
    def task(self) -> _Reports: ...


class WorkBar(QWidget):
    cancelled = Signal()

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.progress = name_widget(QProgressBar(), name, name)
        self.progress.setRange(0, _STEPS)
        self.cancel = push_button("Cancel", "Cancel this work.", self.cancelled)
        self._delay = QTimer(self, singleShot=True)
        self._delay.setInterval(_DELAY_MS)
        self._delay.timeout.connect(self.show)
        fill(QHBoxLayout(self), self.progress, self.cancel, margins=0)
        self.hide()

    def follow(self, work: "_Work") -> None:
        """Show the progress of this work from its start to its end."""
        work.begun.connect(self.begin)
        work.task.reported.connect(self.show_progress)
        work.ended.connect(self.end)

    def begin(self) -> None:
        self.progress.setValue(0)
        if self.isHidden():
            self._delay.start()

    def show_progress(self, fraction: float) -> None:
        self.progress.setValue(round(_STEPS * fraction))

    def end(self) -> None:
        self._delay.stop()
        self.hide()
