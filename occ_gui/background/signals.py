"""Signals of the work queue: results of the job scheduler, delivered on the window's thread."""

from collections.abc import Callable
from threading import Thread
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal, Slot

from occ_gui.background.task import sentence_of
from occ_model.errors import one_line
from occ_model.parallel.job import Stages, Workers
from occ_model.parallel.request import Run
from occ_model.parallel.scheduler import Scheduler
from occ_model.parallel.worker_thread import WorkerThread

_INTERVAL = 0.05
"""Seconds between two reports of a channel's results, so that the window can draw each."""

_STAGE_INTERVAL = 0.3
"""The same during an uninterruptible stage: it is short, and is shown whole where that is soon."""


class JobChannel(QObject):
    """One kind of work, of which only the newest request is processed.

    A newer request replaces the running one; an uninterruptible stage is completed first, so that
    something is shown while requests keep coming.
    """

    results_ready = Signal(object, list)
    """A request and some of its results, no more often than a window can be drawn."""

    finished = Signal(object)  # the request whose results have all been given
    failed = Signal(str)  # a sentence that says why no more results come
    status_message = Signal(str)  # a sentence on what happened meanwhile; the work goes on

    def __init__(self, queue: "WorkQueue", number: int) -> None:
        super().__init__(queue)
        self._queue = queue
        self._number = number
        self._requests: dict[int, Any] = {}
        self._next = 1

    @property
    def is_idle(self) -> bool:
        return not self._requests

    def put(self, request: Any, stages: Stages) -> None:
        run = Run(self._number, self._next, stages)
        self._requests[self._next] = request
        self._next += 1
        self._queue.scheduler().put(run)

    def request(self, run: int) -> Any:
        """Return the request of a run, None if it has been replaced."""
        return self._requests.get(run)

    def cancel(self) -> None:
        """Cancel the work; no more of its results are reported."""
        if self._requests:
            self._requests.clear()
            self._queue.scheduler().cancel(self._number, self._next)

    stop = cancel  # the processes end with the queue, which others use, too

    def _forget_before(self, run: int) -> None:
        for number in [number for number in self._requests if number < run]:
            del self._requests[number]

    def _emit_results(self, run: int, results: list[Any]) -> None:
        if run in self._requests:
            self._forget_before(run)
            self.results_ready.emit(self._requests[run], results)

    def _end(self, run: int, failure: str) -> None:
        if run not in self._requests:
            return
        self._forget_before(run)
        request = self._requests.pop(run)
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit(request)

    def _report(self, run: int, sentence: str) -> None:
        if run in self._requests:
            self.status_message.emit(sentence)


class WorkQueue(QObject):
    """Channels of work, and the scheduler that divides workers among them."""

    _results_ready = Signal(int, int, list)
    _ended = Signal(int, int, str)
    _reported = Signal(int, int, str)

    def __init__(self, channels: int, start: Callable[[], Workers]) -> None:
        super().__init__()
        self._start = start
        self._scheduler: Scheduler | None = None
        self._thread: Thread | None = None
        self._stopped = False
        self.channels = tuple(JobChannel(self, number) for number in range(channels))
        queued = Qt.ConnectionType.QueuedConnection
        self._results_ready.connect(self._on_results, queued)
        self._ended.connect(self._on_end, queued)
        self._reported.connect(self._on_report, queued)

    def scheduler(self) -> Scheduler:
        """Return the scheduler; its thread starts when it is first needed."""
        if self._scheduler is None:
            self._scheduler = Scheduler(
                self._start,
                self,
                fallback=WorkerThread,
                interval=_INTERVAL,
                stage_interval=_STAGE_INTERVAL,
            )
            if not self._stopped:
                self._thread = Thread(target=self._scheduler.run, name="scheduler", daemon=True)
                self._thread.start()
        return self._scheduler

    @property
    def workers(self) -> Workers | None:
        return None if self._scheduler is None else self._scheduler.workers

    def counted(self, counter: int) -> int:
        workers = self.workers
        return 0 if workers is None else workers.counted(counter)

    def stop(self) -> None:
        if self._stopped:
            return
        self._stopped = True
        for channel in self.channels:
            channel.cancel()
        if self._scheduler is not None and self._thread is not None:
            self._scheduler.close()
            self._thread.join()

    def results_ready(self, channel: int, run: int, results: list[Any]) -> None:
        self._results_ready.emit(channel, run, results)

    def finished(self, channel: int, run: int) -> None:
        self._ended.emit(channel, run, "")

    def failed(self, channel: int, run: int, error: Exception) -> None:
        request = self.channels[channel].request(run)
        self._ended.emit(channel, run, sentence_of(error, "work in the background", request))

    def workers_replaced(self, channel: int, run: int) -> None:
        sentence = "A process in the background ended; its work is done again."
        self._reported.emit(channel, run, sentence)

    def workers_missing(self, channel: int, run: int, error: Exception) -> None:
        sentence = (
            f"No processes can be started ({one_line(str(error))}): the window does their work "
            "itself, and answers more slowly meanwhile."
        )
        self._reported.emit(channel, run, sentence)

    @Slot(int, int, list)
    def _on_results(self, channel: int, run: int, results: list[Any]) -> None:
        self.channels[channel]._emit_results(run, results)

    @Slot(int, int, str)
    def _on_end(self, channel: int, run: int, failure: str) -> None:
        self.channels[channel]._end(run, failure)

    @Slot(int, int, str)
    def _on_report(self, channel: int, run: int, sentence: str) -> None:
        self.channels[channel]._report(run, sentence)
