"""Cancellable work on a thread, which reports its progress or its results one by one."""

from collections.abc import Callable
from typing import Any, Generic, TypeAlias, TypeVar

from PySide6.QtCore import QObject, Qt, Signal, Slot

from occ_gui.background.failure import sentence_of
from occ_gui.background.worker_thread import WorkerThread

Request = TypeVar("Request")
Result = TypeVar("Result")

Report: TypeAlias = Callable[[Any], None]
"""Takes the share of the work that is done, a part of the result, or None, which is not given on;
ends cancelled work by raising an exception."""

_NO_RUN = 0


class Cancelled(Exception):  # noqa: N818 - no error: the user wanted it
    """Ends work whose result is no longer wanted."""


class Cancellable(QObject, Generic[Request, Result]):
    """Runs a function on a thread of its own, for the newest request only.

    Starting a run cancels the one before. A cancelled run ends at its next report, and nothing of
    it is given any more.

    Parameters
    ----------
    work
        The function: a request and a :data:`Report` in, a result out. It must not touch a widget.
    name
        What it does, for the thread's name and the log.
    """

    reported = Signal(object)
    """What the run reported."""

    finished = Signal(object)
    """The result of the run."""

    failed = Signal(str)
    """A sentence that says why nothing more comes of the run."""

    _ask = Signal(int, object)

    def __init__(self, work: Callable[[Request, Report], Result], name: str) -> None:
        super().__init__()
        self._started = _NO_RUN
        self._worker = _Worker(work, name)
        self._thread = WorkerThread(self._worker, name)
        queued = Qt.ConnectionType.QueuedConnection
        self._ask.connect(self._worker.run, queued)
        self._worker.reported.connect(self._on_report, queued)
        self._worker.ended.connect(self._on_end, queued)

    @property
    def is_running(self) -> bool:
        """Whether a result is still to come."""
        return self._worker.wanted != _NO_RUN

    def start(self, request: Request) -> None:
        """Begin a run; the one before is cancelled."""
        self._started += 1
        self._worker.wanted = self._started
        self._thread.begin()
        self._ask.emit(self._started, request)

    def cancel(self) -> None:
        """Give nothing of the run any more, and let it end at its next report."""
        self._worker.wanted = _NO_RUN

    def stop(self) -> None:
        """Cancel, and stop the thread once the run has ended."""
        self.cancel()
        self._thread.end()

    @Slot(int, object)
    def _on_report(self, run: int, report: Any) -> None:
        if run == self._worker.wanted:
            self.reported.emit(report)

    @Slot(int, object, str)
    def _on_end(self, run: int, result: Any, failure: str) -> None:
        if run != self._worker.wanted:
            return
        self._worker.wanted = _NO_RUN
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit(result)


class _Worker(QObject):
    """The part that lives on the other thread."""

    reported = Signal(int, object)
    ended = Signal(int, object, str)

    def __init__(self, work: Callable[[Any, Report], Any], name: str) -> None:
        super().__init__()
        self._work = work
        self._name = name
        self.wanted = _NO_RUN
        """The number of the run whose result is wanted: written on the window's thread only."""

    @Slot(int, object)
    def run(self, run: int, request: Any) -> None:
        def report(something: Any) -> None:
            if run != self.wanted:
                raise Cancelled
            if something is not None:
                self.reported.emit(run, something)

        if run != self.wanted:  # cancelled before it began
            return
        result, failure = None, ""
        try:
            result = self._work(request, report)
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - the window must outlive any error
            failure = sentence_of(error, self._name, request)
        self.ended.emit(run, result, failure)
