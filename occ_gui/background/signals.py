"""The work queue: results of the job scheduler as signals on the window's thread."""

from collections.abc import Callable, Iterator
from threading import Thread
from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal, Slot

from occ_gui.background.task import sentence_of
from occ_model.errors import one_line
from occ_model.parallel.job import Job, Workers, WorkerThread
from occ_model.parallel.scheduler import Run, Scheduler

_PAUSE_MS = 50
"""Milliseconds between reports of a channel's results, in which the window can draw them."""


class JobChannel(QObject):
    """A channel for one kind of work, which processes only the newest request.

    A newer request replaces the running one; uninterruptible jobs are finished first, so that
    results appear even while requests keep coming.
    """

    results_ready = Signal(object, list)
    """A request and some of its results, after the first no more often than they can be drawn."""

    finished = Signal(object)  # the request, after all of its results
    failed = Signal(str)  # a sentence that says why no more results come
    status_message = Signal(str)  # a sentence about a problem after which the work goes on

    _results = Signal(int, list)
    _end = Signal(int, str)
    _report = Signal(int, str)

    def __init__(self, queue: "WorkQueue", number: int) -> None:
        super().__init__(queue)
        self._queue = queue
        self._number = number
        self._requests: dict[int, Any] = {}
        self._next_run = 1
        self._unreported: list[Any] = []
        self._pause = QTimer(self, singleShot=True)
        self._pause.setInterval(_PAUSE_MS)
        self._pause.timeout.connect(self._emit_results)
        queued = Qt.ConnectionType.QueuedConnection
        self._results.connect(self._on_results, queued)
        self._end.connect(self._on_end, queued)
        self._report.connect(self._on_report, queued)

    @property
    def is_idle(self) -> bool:
        return not self._requests

    def put(self, request: Any, jobs: Iterator[Job]) -> None:
        """Do the jobs for a request; the iterator runs in the background."""
        run = Run(self._number, self._next_run, jobs, self)
        self._requests[self._next_run] = request
        self._next_run += 1
        self._queue.scheduler().put(run)

    def cancel(self) -> None:
        """Cancel the work; no more of its results are reported."""
        if self._requests:
            self._forget_before(self._next_run)
            self._queue.scheduler().cancel(self._number, self._next_run)

    stop = cancel  # the processes stop with the queue, which other channels share

    def take_results(self, run: int, results: list[Any]) -> None:
        self._results.emit(run, results)

    def take_end(self, run: int, error: Exception | None) -> None:
        request = self._requests.get(run)  # None if it was replaced
        failure = "" if error is None else sentence_of(error, "work in the background", request)
        self._end.emit(run, failure)

    def note_lost_workers(self, run: int, missing: Exception | None) -> None:
        sentence = "A background process ended unexpectedly; its work is done again."
        if missing is not None:
            sentence = (
                f"No background processes can be started ({one_line(str(missing))}): the window "
                "does their work itself, and responds more slowly meanwhile."
            )
        self._report.emit(run, sentence)

    @Slot(int, list)
    def _on_results(self, run: int, results: list[Any]) -> None:
        if self._accept_results_of(run):
            self._unreported += results
            if not self._pause.isActive():
                self._emit_results()

    @Slot(int, str)
    def _on_end(self, run: int, failure: str) -> None:
        if self._accept_results_of(run):
            self._emit_results()
        if run not in self._requests:
            return
        request = self._requests.pop(run)
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit(request)

    @Slot(int, str)
    def _on_report(self, run: int, sentence: str) -> None:
        if run in self._requests:
            self.status_message.emit(sentence)

    def _accept_results_of(self, run: int) -> bool:
        """Return whether a request's results are still needed; if so, forget earlier requests.

        Results of earlier requests that have already arrived are emitted first.
        """
        if run in self._requests and run != next(iter(self._requests)):
            self._emit_results()
            self._forget_before(run)
            self._pause.stop()  # the first results of a request need not wait
        return run in self._requests

    def _emit_results(self) -> None:
        results, self._unreported = self._unreported, []
        if results:
            self._pause.start()
            self.results_ready.emit(next(iter(self._requests.values())), results)

    def _forget_before(self, run: int) -> None:
        for number in [number for number in self._requests if number < run]:
            del self._requests[number]
        self._unreported.clear()


class WorkQueue(QObject):
    """Channels of work, and the scheduler that shares the workers among them."""

    def __init__(self, channels: int, start: Callable[[], Workers]) -> None:
        super().__init__()
        self._start_workers = start
        self._scheduler: Scheduler | None = None
        self._thread: Thread | None = None
        self._is_stopped = False
        self.channels = tuple(JobChannel(self, number) for number in range(channels))

    def scheduler(self) -> Scheduler:
        """Return the scheduler; its thread starts when it is first needed."""
        if self._scheduler is None:
            self._scheduler = Scheduler(self._start_workers, WorkerThread)
            if not self._is_stopped:
                self._thread = Thread(target=self._scheduler.run, name="scheduler", daemon=True)
                self._thread.start()
        return self._scheduler

    @property
    def workers(self) -> Workers | None:
        return None if self._scheduler is None else self._scheduler.workers

    def count_heartbeats(self, counter: int) -> int:
        workers = self.workers
        return 0 if workers is None else workers.count_heartbeats(counter)

    def stop(self) -> None:
        if self._is_stopped:
            return
        self._is_stopped = True
        for channel in self.channels:
            channel.cancel()
        if self._scheduler is not None and self._thread is not None:
            self._scheduler.close()
            self._thread.join()
