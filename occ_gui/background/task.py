"""Task: one kind of work outside the window's thread, done for the newest request."""

import logging
from collections.abc import Callable
from threading import Event
from typing import Any, Generic, TypeAlias, TypeVar

from PySide6.QtCore import QObject, Qt, QThread, QTimer, Signal, Slot

from occ_model.errors import OccError
from occ_model.scene.refusal import sentence_with_label

_log = logging.getLogger(__name__)


def sentence_of(error: Exception, name: str, request: object) -> str:
    """Explain why work has failed; an unexpected error is logged with its traceback."""
    if isinstance(error, OccError):
        return sentence_with_label(error)
    _log.error("%s failed for %r", name, request, exc_info=error)
    reason = f"{type(error).__name__}: {error}".rstrip(": .")
    return f"The {name} failed: {reason}."


Request = TypeVar("Request")
Result = TypeVar("Result")

Report: TypeAlias = Callable[[Any], None]
"""A function that work calls with a part of its result, the fraction done, or None, which is not
passed on; it raises an exception in cancelled work."""


class Superseded(Exception):  # noqa: N818 - not an error: the result is no longer needed
    """Ends work whose result is no longer needed, without a report."""


class _Run:
    """A running request, with the flags that the window sets for its worker."""

    def __init__(self, request: Any) -> None:
        self.request = request
        self.is_wanted = True
        self.newer_request, self.paint_done = Event(), Event()

    def abandon(self) -> None:
        self.is_wanted = False
        self.newer_request.set()
        self.paint_done.set()


class TaskReporter:
    """Lets running work report to its task, and wait for it, on the worker's thread."""

    def __init__(self, worker: "_Worker", run: _Run) -> None:
        self._worker, self._run = worker, run

    def __call__(self, part: Any = None) -> None:
        """Report a part of the result, or the fraction done; end cancelled work."""
        if not self._run.is_wanted:
            raise Superseded
        if part is not None:
            self._worker.reported.emit(self._run, part)

    def give_way(self, seconds: float = 0.0) -> None:
        """End the work if a newer request is waiting, or comes within some seconds."""
        if self._run.newer_request.wait(seconds):
            raise Superseded

    def wait_for_paint(self, seconds: float) -> None:
        """Wait until the window has painted what was reported, but at most some seconds.

        Painting and the following work need the same interpreter and memory. At the same time,
        both would take twice as long, and the user would wait longer for the picture.
        """
        self._run.paint_done.clear()
        self._worker.paint_awaited.emit(self._run)
        self._run.paint_done.wait(seconds)


class Task(QObject, Generic[Request, Result]):
    """Runs a function on a thread of its own, for one request at a time.

    A request that comes meanwhile waits, and a newer one replaces it. The running request goes on,
    and its result is shown: if every move of a slider ended it, nothing would be shown until the
    slider stops. In an impatient task, a newer request ends the running one at its next report.
    The function takes a request and a :class:`TaskReporter`, and must not touch a widget; the name
    is for the log.
    """

    reported = Signal(object)
    finished = Signal(object)

    failed = Signal(str)  # a sentence that says why there is no result
    failed_for = Signal(str, object)  # the sentence, and the names of the parameters it is about
    idle = Signal()  # no request is running or waiting any more

    _begun = Signal(object)

    def __init__(
        self, work: Callable[[Request, TaskReporter], Result], name: str, impatient: bool = False
    ) -> None:
        super().__init__()
        self._is_impatient, self._is_stopped = impatient, False
        self._current_run: _Run | None = None
        self._next_run: _Run | None = None
        self._worker = _Worker(work, name)
        self._thread = QThread()
        self._thread.setObjectName(name)
        self._worker.moveToThread(self._thread)
        queued = Qt.ConnectionType.QueuedConnection
        self._begun.connect(self._worker.run, queued)
        self._worker.reported.connect(self._on_report, queued)
        self._worker.paint_awaited.connect(self._on_paint_awaited, queued)
        self._worker.ended.connect(self._on_end, queued)

    @property
    def is_idle(self) -> bool:
        current = self._current_run
        return self._next_run is None and (current is None or not current.is_wanted)

    def ask(self, request: Request) -> None:
        if self._is_stopped:
            return
        self._next_run = _Run(request)
        if self._current_run is None:
            self._begin()
        elif self._is_impatient:
            self._current_run.abandon()
        else:
            self._current_run.newer_request.set()

    def cancel(self) -> None:
        """Report no more results; running work ends at its next report."""
        self._next_run = None
        if self._current_run is not None:
            self._current_run.abandon()

    def stop(self) -> None:
        """End the thread after its running work."""
        self._is_stopped = True
        self.cancel()
        self._thread.quit()
        self._thread.wait()

    def _begin(self) -> None:
        self._current_run, self._next_run = self._next_run, None
        if not self._thread.isRunning():
            self._thread.start()
        self._begun.emit(self._current_run)

    @Slot(object, object)
    def _on_report(self, run: _Run, part: Any) -> None:
        if run.is_wanted:
            self.reported.emit(part)

    @Slot(object)
    def _on_paint_awaited(self, run: _Run) -> None:
        # Two turns of the event loop: the report requests a paint, and panes may request another
        # one in the next turn.
        QTimer.singleShot(0, self, lambda: QTimer.singleShot(0, self, run.paint_done.set))

    @Slot(object, object, str, object)
    def _on_end(self, run: _Run, result: Any, failure: str, parameters: tuple[str, ...]) -> None:
        self._current_run = None
        # The next request starts before this result is drawn, so that both run at the same time.
        if self._next_run is not None:
            self._begin()
        if not run.is_wanted:
            return
        if failure:
            self.failed.emit(failure)
            self.failed_for.emit(failure, parameters)
        elif not isinstance(result, Superseded):
            self.finished.emit(result)
        if self.is_idle:
            self.idle.emit()


class _Worker(QObject):
    reported = Signal(object, object)
    paint_awaited = Signal(object)
    ended = Signal(object, object, str, object)

    def __init__(self, work: Callable[[Any, TaskReporter], Any], name: str) -> None:
        super().__init__()
        self._work, self._name = work, name

    @Slot(object)
    def run(self, run: _Run) -> None:
        result, failure = None, ""
        parameters: tuple[str, ...] = ()
        try:
            if run.is_wanted:
                result = self._work(run.request, TaskReporter(self, run))
        except Superseded as reason:
            result = reason
        except Exception as error:  # noqa: BLE001 - the window must outlive any error
            failure = sentence_of(error, self._name, run.request)
            parameters = error.parameters if isinstance(error, OccError) else ()
        self.ended.emit(run, result, failure, parameters)
