"""Scheduler: decides which job goes to the workers next, and reports the results."""

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from dataclasses import dataclass, field
from itertools import islice
from math import inf
from queue import Empty, SimpleQueue
from typing import Any

from occ_model.parallel.job import (
    NO_PROCESSES,
    Job,
    JobResult,
    Listener,
    Workers,
    WorkersLostError,
    reason_of,
)

_JOBS_PER_WORKER = 2  # jobs in flight for each worker: one at work, and the next
_MAX_LOST_WORKERS = 3  # how often workers may end one after the other without a result


@dataclass(eq=False, slots=True)
class Run:
    """Work of a channel, which does its newest run only."""

    channel: int
    number: int  # Later runs of a channel have higher ones
    coming: Iterator[Job]  # Each job is taken where the scheduler runs, when it is needed
    listener: Listener
    waiting: deque[Job] = field(default_factory=deque)  # The next one, and those that workers lost
    unreported: list[Any] = field(default_factory=list)


class Scheduler:
    """Keeps workers busy with the jobs of several channels.

    Of all jobs that wait, one of the lowest rank goes first; of equal ranks, one of the run that
    began first. While an uninterruptible job is under way, no job of a higher rank begins: it
    would delay what somebody waits for. Each channel does its newest run only: a newer one takes
    the place of the older at once, or when the older has completed its uninterruptible jobs.

    :meth:`put`, :meth:`cancel` and :meth:`close` may be called from any thread; they leave a
    message for :meth:`step` or :meth:`run`, in one thread.

    ``start`` starts the workers at the first job; ``fallback`` replaces processes where none can be
    started, else the runs fail.
    """

    def __init__(
        self, start: Callable[[], Workers], fallback: Callable[[], Workers] | None = None
    ) -> None:
        self._start, self._fallback = start, fallback
        self._inbox: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.workers: Workers | None = None
        self._runs: dict[int, Run] = {}
        self._pending: dict[int, Run] = {}
        self._in_flight: dict[Future[JobResult], tuple[Run, Job]] = {}
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
        if now is not None and self._has_uninterruptible(now):
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
        """Make the run's next job where it is time, and end the run where there is none."""
        try:
            if not run.waiting:
                run.waiting.extend(islice(run.coming, 1))
        except Exception as error:  # noqa: BLE001 - an error in one must not stop others
            self._fail(run, error)
            return
        if not self._under_way(run):
            del self._runs[run.channel]
            run.listener.take_end(run.number, None)

    def _under_way(self, run: Run) -> list[Job]:
        """Return the jobs that wait or are with workers."""
        return [*run.waiting, *(job for owner, job in self._in_flight.values() if owner is run)]

    def _has_uninterruptible(self, run: Run, below: float = inf) -> bool:
        """Return whether a job of a rank below this is under way that must be completed."""
        return any(job.uninterruptible and job.rank < below for job in self._under_way(run))

    def _fill(self) -> None:
        """Send jobs until there are enough in flight."""
        while (run := self._next()) is not None:
            workers = self.workers or self._new_workers(run)
            if workers is None:
                continue
            if len(self._in_flight) >= _JOBS_PER_WORKER * workers.count:
                return
            job = run.waiting.popleft()
            try:
                future = workers.submit(job, run.channel, run.number)
            except workers.lost_by as error:
                run.waiting.appendleft(job)
                self._recover(workers, error)
                continue
            except Exception as error:  # noqa: BLE001 - an error in one must not stop others
                self._fail(run, error)
                continue
            self._in_flight[future] = (run, job)
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
            run.listener.note_lost_workers(run.number, error)
        except Exception as error:  # noqa: BLE001 - an error in one must not stop others
            self._fail(run, error)
        return self.workers

    def _next(self) -> Run | None:
        """Choose the run whose job goes next."""
        ready = (
            run
            for channel, run in self._runs.items()
            if run.waiting and (run.waiting[0].uninterruptible or channel not in self._pending)
        )
        chosen = min(ready, key=lambda run: run.waiting[0].rank, default=None)
        if chosen is None:
            return None
        rank = chosen.waiting[0].rank
        would_delay = any(self._has_uninterruptible(run, rank) for run in self._runs.values())
        return None if would_delay else chosen

    def _land(self, future: "Future[JobResult]") -> None:
        workers = self.workers
        if future not in self._in_flight or workers is None:
            return  # workers ended, and its job was given to others
        try:
            result = future.result()
        except workers.lost_by as error:
            self._recover(workers, error)
            return
        except Exception as error:  # noqa: BLE001 - such as arguments that cannot be sent
            result = JobResult(error=error)
        run, _ = self._in_flight.pop(future)
        self._losses = 0
        if self._runs.get(run.channel) is not run:
            return
        if result.error is not None:
            self._fail(run, result.error)
            return
        if not result.is_abandoned:
            run.unreported.append(result.value)
        is_interruptible = not self._has_uninterruptible(run)
        if is_interruptible and run.unreported:
            results, run.unreported = run.unreported, []
            run.listener.take_results(run.number, results)
        if is_interruptible and run.channel in self._pending:
            self._begin_pending(run.channel)
        else:
            self._advance(run)

    def _fail(self, run: Run, error: Exception) -> None:
        self._abandon(run.channel, run.number + 1)
        run.listener.take_end(run.number, error)
        self._begin_pending(run.channel)

    def _recover(self, workers: Workers, error: Exception) -> None:
        """Replace workers that ended, and put back the jobs that they had."""
        for future, (run, job) in reversed(list(self._in_flight.items())):
            if not _has_result(future):
                del self._in_flight[future]
                run.waiting.appendleft(job)
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
            else:
                run.listener.note_lost_workers(run.number, missing)


def _has_result(future: "Future[JobResult]") -> bool:
    """Return whether a job came back before its worker ended."""
    return future.done() and not future.cancelled() and future.exception() is None
