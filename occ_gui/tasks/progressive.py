"""Work off the window's thread whose results come one by one, and which can be cancelled."""

from collections.abc import Callable, Iterator
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QObject, Qt, QThread, Signal, Slot

from occ_gui.tasks.failure import sentence_of

Request = TypeVar("Request")
Item = TypeVar("Item")

_NOTHING = 0
"""The number of no run."""


class Progressive(QObject, Generic[Request, Item]):
    """Runs an iterator on a thread of its own and hands over its items as they come.

    One run at a time: starting another cancels the one before. A cancelled run ends after the item
    that it is at, and nothing of it arrives any more.

    Parameters
    ----------
    work
        Gives the iterator for a request. Neither may touch a widget.
    name
        What it is, for the thread's name and the log.
    """

    item = Signal(object)
    """The next item of the run."""

    finished = Signal()
    """All items of the run have arrived."""

    failed = Signal(str)
    """A sentence that says why no more items come."""

    _ask = Signal(int, object)

    def __init__(self, work: Callable[[Request], Iterator[Item]], name: str) -> None:
        super().__init__()
        self._started = _NOTHING
        self._worker = _Worker(work, name)
        self._thread = QThread()
        self._thread.setObjectName(name)
        self._worker.moveToThread(self._thread)
        queued = Qt.ConnectionType.QueuedConnection
        self._ask.connect(self._worker.run, queued)
        self._worker.item.connect(self._on_item, queued)
        self._worker.ended.connect(self._on_ended, queued)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        """Whether items are still to come."""
        return self._worker.wanted != _NOTHING

    def start(self, request: Request) -> None:
        """Begin a run; the one before is cancelled."""
        self._started += 1
        self._worker.wanted = self._started
        self._ask.emit(self._started, request)

    def cancel(self) -> None:
        """Let nothing of the run arrive any more, and the run end after the item it is at."""
        self._worker.wanted = _NOTHING

    def stop(self) -> None:
        """Cancel, and stop the thread once the item at work is done."""
        self.cancel()
        self._thread.quit()
        self._thread.wait()

    @Slot(int, object)
    def _on_item(self, run: int, item: Any) -> None:
        if run == self._worker.wanted:
            self.item.emit(item)

    @Slot(int, str)
    def _on_ended(self, run: int, failure: str) -> None:
        if run != self._worker.wanted:
            return
        self._worker.wanted = _NOTHING
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit()


class _Worker(QObject):
    """The part that lives on the other thread."""

    item = Signal(int, object)
    ended = Signal(int, str)

    def __init__(self, work: Callable[[Any], Iterator[Any]], name: str) -> None:
        super().__init__()
        self._work = work
        self._name = name
        self.wanted = _NOTHING
        """The number of the run whose items are wanted: written on the window's thread only."""

    @Slot(int, object)
    def run(self, run: int, request: Any) -> None:
        failure = ""
        try:
            self._hand_over(run, request)
        except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
            failure = sentence_of(error, self._name, request)
        self.ended.emit(run, failure)

    def _hand_over(self, run: int, request: Any) -> None:
        if run != self.wanted:  # cancelled before it began
            return
        for item in self._work(request):
            if run != self.wanted:
                return
            self.item.emit(run, item)
