"""Scheduler: decides which job goes to the workers next, and reports the results."""

from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty, SimpleQueue
from time import monotonic

from occ_model.parallel.job import (
    NO_PROCESSES,
    Job,
    JobResult,
    Listener,
    Workers,
    WorkersLostError,
    reason_of,
)
from occ_model.parallel.request import Run, StageProgress

_JOBS_PER_WORKER = 2  # jobs in flight for each worker: one at work, and the next
_MAX_LOST_WORKERS = 3  # how often workers may end one after the other without a result


class Scheduler:
    """Keeps workers busy with the jobs of several channels.

    Of all jobs that wait, one of the lowest rank goes first; of equal ranks, one of the request
    that began first. While an uninterruptible stage is under way, no job of a higher rank begins:
    it would delay what somebody waits for. Each channel does its newest request only: a newer one
    takes the place of the older at once, or when the older has completed its uninterruptible stage.

    :meth:`put`, :meth:`cancel` and :meth:`close` may be called from any thread; they leave a
    message for :meth:`step` or :meth:`run`, in one thread.

    ``start`` starts the workers at the first job; ``fallback`` replaces processes where none can be
    started, else the runs fail. ``interval`` and ``stage_interval``: minimum seconds between two
    reports of a channel's results, and during an uninterruptible stage.
    """

    def __init__(
        self,
        start: Callable[[], Workers],
        listener: Listener,
        *,
        fallback: Callable[[], Workers] | None = None,
        interval: float = 0.0,
        stage_interval: float = 0.0,
        clock: Callable[[], float] = monotonic,
    ) -> None:
        self._start = start
        self._listener = listener
        self._fallback = fallback
        self._reports = Reports(listener, interval, stage_interval, clock)
        self._inbox: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.workers: Workers | None = None
        self._runs: dict[int, Run] = {}
        self._pending: dict[int, Run] = {}
        self._in_flight: dict[Future[JobResult], tuple[Run, StageProgress, Job]] = {}
        self._losses = 0

    def put(self, run: Run) -> None:
        """Request work in place of the channel's earlier runs."""
        self._inbox.put(lambda: self._receive(run))

    def cancel(self, channel: int, run: int) -> None:
        """Cancel all runs of a channel that are earlier than ``run``."""
        self._inbox.put(lambda: self._cancel(channel, run))

    def close(self) -> None:
        """Let :meth:`run` end after the messages that wait."""
        self._inbox.put(None)

    def run(self) -> None:
        """Answer messages until the scheduler is closed; then end the workers."""
        try:
            while self.step():
                pass
        finally:
            self.end_workers()

    def step(self, timeout: float | None = None) -> bool:
        """Answer a message after at most ``timeout`` seconds; return whether more may come."""
        try:
            message = self._inbox.get(timeout=timeout)
        except Empty:
            return True
        if message is None:
            return False
        message()
        self._fill()
        return True

    def end_workers(self) -> None:
        for future in self._in_flight:
            future.cancel()
        self._in_flight.clear()
        if self.workers is not None:
            for channel, run in self._runs.items():
                self.workers.abandon(channel, run.number + 1)
            self.workers.close()

    def _receive(self, run: Run) -> None:
        now = self._runs.get(run.channel)
        if now is not None and now.is_uninterruptible:
            self._pending[run.channel] = run
        else:
            self._begin(run)

    def _cancel(self, channel: int, number: int) -> None:
        self._abandon(channel, number)
        if channel not in self._runs:
            self._begin_pending(channel)

    def _begin_pending(self, channel: int) -> None:
        if channel in self._pending:
            self._begin(self._pending.pop(channel))

    def _begin(self, run: Run) -> None:
        self._abandon(run.channel, run.number)
        self._runs[run.channel] = run
        self._advance(run)

    def _abandon(self, channel: int, number: int) -> None:
        for runs in (self._runs, self._pending):
            if channel in runs and runs[channel].number < number:
                del runs[channel]
        if self.workers is not None:
            self.workers.abandon(channel, number)

    def _advance(self, run: Run) -> None:
        """Begin the run's next stage where it is time, and end the run where there is none."""
        try:
            run.advance()
        except Exception as error:  # noqa: BLE001 - an error in one must not stop others
            self._fail(run, error)
            return
        if run.is_done:
            self._finish(run)

    def _fill(self) -> None:
        """Send jobs until there are enough in flight."""
        while (chosen := self._next()) is not None:
            run, stage = chosen
            workers = self.workers or self._new_workers(run)
            if workers is None:
                continue
            if len(self._in_flight) >= _JOBS_PER_WORKER * workers.count:
                return
            job = stage.take()
            try:
                future = workers.submit(job, run.channel, run.number)
            except workers.lost_by as error:
                stage.put_back(job)
                self._recover(workers, error)
                continue
            except Exception as error:  # noqa: BLE001 - an error in one must not stop others
                self._fail(run, error)
                continue
            self._in_flight[future] = (run, stage, job)
            self._advance(run)
            future.add_done_callback(lambda done: self._inbox.put(lambda: self._land(done)))

    def _new_workers(self, run: Run) -> Workers | None:
        try:
            self.workers = self._start()
        except NO_PROCESSES as error:
            if self._fallback is None:
                self._fail(run, error)
                return None
            self.workers = self._fallback()
            self._listener.workers_missing(run.channel, run.number, error)
        except Exception as error:  # noqa: BLE001 - an error in one must not stop others
            self._fail(run, error)
        return self.workers

    def _next(self) -> tuple[Run, StageProgress] | None:
        """Choose the run and the stage whose job goes next."""
        ready = []
        for run in self._runs.values():
            stage = run.waiting_stage
            if stage is None:
                continue
            if stage.stage.uninterruptible or run.channel not in self._pending:
                ready.append((run, stage))
        chosen = min(ready, key=lambda pair: pair[1].stage.rank, default=None)
        if chosen is None or self._would_delay(chosen[1].stage.rank):
            return None
        return chosen

    def _would_delay(self, rank: int) -> bool:
        """Return whether jobs of this rank would delay an uninterruptible stage."""
        return any(
            stage.stage.uninterruptible and stage.stage.rank < rank
            for run in self._runs.values()
            for stage in run.begun
        )

    def _land(self, future: "Future[JobResult]") -> None:
        workers = self.workers
        if future not in self._in_flight or workers is None:
            return  # workers ended, and its job was given to others
        run, stage, _ = self._in_flight[future]
        try:
            result = future.result()
        except workers.lost_by as error:
            self._recover(workers, error)
            return
        except Exception as error:  # noqa: BLE001 - such as arguments that cannot be sent
            result = JobResult(error=error)
        del self._in_flight[future]
        stage.in_flight -= 1
        self._losses = 0
        if self._runs.get(run.channel) is not run:
            return
        if result.error is not None:
            self._fail(run, result.error)
            return
        if not result.is_abandoned:
            run.unreported.append(result.value)
        self._progress(run, stage)

    def _progress(self, run: Run, stage: StageProgress) -> None:
        """Report the results of a job, and begin or end what it leads to."""
        self._reports.report(run, stage)
        if stage.is_done:
            run.begun.remove(stage)
        if run.channel in self._pending and not run.is_uninterruptible:
            self._begin_pending(run.channel)
        else:
            self._advance(run)

    def _finish(self, run: Run) -> None:
        del self._runs[run.channel]
        self._listener.finished(run.channel, run.number)

    def _fail(self, run: Run, error: Exception) -> None:
        self._abandon(run.channel, run.number + 1)
        self._listener.failed(run.channel, run.number, error)
        self._begin_pending(run.channel)

    def _recover(self, workers: Workers, error: Exception) -> None:
        """Replace workers that ended, and put back the jobs that they had."""
        for future, (_, stage, job) in reversed(list(self._in_flight.items())):
            if not _has_result(future):
                del self._in_flight[future]
                stage.put_back(job)
        self._losses += 1
        missing: Exception | None = None
        try:
            workers.renew()
        except NO_PROCESSES as none:
            missing = none
            if self._fallback is not None:
                self.workers = self._fallback()
        is_hopeless = missing is not None and self._fallback is None
        for run in list(self._runs.values()):
            if is_hopeless or self._losses >= _MAX_LOST_WORKERS:
                self._fail(run, WorkersLostError(reason_of(error), self._losses))
            elif missing is not None:
                self._listener.workers_missing(run.channel, run.number, missing)
            else:
                self._listener.workers_replaced(run.channel, run.number)


def _has_result(future: "Future[JobResult]") -> bool:
    """Return whether a job came back before its worker ended."""
    return future.done() and not future.cancelled() and future.exception() is None


class Reports:
    """Reports the results of each channel, at most once in an ``interval`` of seconds."""

    def __init__(
        self,
        listener: Listener,
        interval: float,
        stage_interval: float,
        clock: Callable[[], float],
    ) -> None:
        self._listener = listener
        self._interval, self._stage_interval = interval, stage_interval
        self._clock = clock
        self._last: dict[int, float] = {}

    def report(self, run: Run, stage: StageProgress) -> None:
        """Report the run's new results if it is time, or the stage is done."""
        now = self._clock()
        interval = self._stage_interval if stage.stage.uninterruptible else self._interval
        is_due = now - self._last.get(run.channel, -interval) >= interval
        if run.unreported and (stage.is_done or is_due):
            self._last[run.channel] = now
            results, run.unreported = run.unreported, []
            self._listener.results_ready(run.channel, run.number, results)
