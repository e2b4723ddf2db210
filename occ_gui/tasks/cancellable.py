"""One piece of work off the window's thread that tells how far it is, and can be cancelled."""

from collections.abc import Callable
from typing import Any, Generic, TypeAlias, TypeVar

from PySide6.QtCore import QObject, Qt, QThread, Signal, Slot

from occ_gui.tasks.failure import sentence_of

Request = TypeVar("Request")
Result = TypeVar("Result")

Progress: TypeAlias = Callable[[float], None]
"""Takes the share of the work that is done, from 0 to 1; ends the work by raising."""

_NOTHING = 0
"""The number of no run."""


class Cancelled(Exception):  # noqa: N818 - no error: the user wanted it
    """Ends work that nobody waits for any more."""


class Cancellable(QObject, Generic[Request, Result]):
    """Runs a function on a thread of its own.

    One run at a time: starting another cancels the one before. A cancelled run ends where it next
    tells of its progress, and nothing of it arrives any more.

    Parameters
    ----------
    work
        The function: a request and whom to tell of progress in, a result out. It must not touch
        a widget.
    name
        What it is, for the thread's name and the log.
    """

    progressed = Signal(float)
    """The share of the work that is done, from 0 to 1."""

    finished = Signal(object)
    """The result."""

    failed = Signal(str)
    """A sentence that says why there is none."""

    _ask = Signal(int, object)

    def __init__(self, work: Callable[[Request, Progress], Result], name: str) -> None:
        super().__init__()
        self._started = _NOTHING
        self._worker = _Worker(work, name)
        self._thread = QThread()
        self._thread.setObjectName(name)
        self._worker.moveToThread(self._thread)
        queued = Qt.ConnectionType.QueuedConnection
        self._ask.connect(self._worker.run, queued)
        self._worker.progressed.connect(self._on_progress, queued)
        self._worker.ended.connect(self._on_ended, queued)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        """Whether a result is still to come."""
        return self._worker.wanted != _NOTHING

    def start(self, request: Request) -> None:
        """Begin a run; the one before is cancelled."""
        self._started += 1
        self._worker.wanted = self._started
        self._ask.emit(self._started, request)

    def cancel(self) -> None:
        """Let nothing of the run arrive any more, and the run end as soon as it can."""
        self._worker.wanted = _NOTHING

    def stop(self) -> None:
        """Cancel, and stop the thread once the run has ended."""
        self.cancel()
        self._thread.quit()
        self._thread.wait()

    @Slot(int, float)
    def _on_progress(self, run: int, share: float) -> None:
        if run == self._worker.wanted:
            self.progressed.emit(share)

    @Slot(int, object, str)
    def _on_ended(self, run: int, result: Any, failure: str) -> None:
        if run != self._worker.wanted:
            return
        self._worker.wanted = _NOTHING
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit(result)


class _Worker(QObject):
    """The part that lives on the other thread."""

    progressed = Signal(int, float)
    ended = Signal(int, object, str)

    def __init__(self, work: Callable[[Any, Progress], Any], name: str) -> None:
        super().__init__()
        self._work = work
        self._name = name
        self.wanted = _NOTHING
        """The number of the run whose result is wanted: written on the window's thread only."""

    @Slot(int, object)
    def run(self, run: int, request: Any) -> None:
        def progress(share: float) -> None:
            if run != self.wanted:
                raise Cancelled
            self.progressed.emit(run, share)

        result, failure = None, ""
        try:
            progress(0.0)  # not even begun where it was cancelled before
            result = self._work(request, progress)
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
            failure = sentence_of(error, self._name, request)
        self.ended.emit(run, result, failure)
