"""A scheduler, which chooses the next job for the workers and reports the results."""

from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future
from dataclasses import dataclass, field
from itertools import islice
from math import inf
from queue import Empty, SimpleQueue
from typing import Any

from occ_model.parallel.job import (
    NO_PROCESSES,
    Heartbeat,
    Job,
    JobResult,
    RunListener,
    Workers,
    WorkersLostError,
    reason_of,
)

_JOBS_PER_WORKER = 2  # jobs sent to each worker: the current one and the next
_MAX_LOSSES = 3  # number of times in a row that workers may die without a result


@dataclass(eq=False, slots=True)
class Run:
    """A sequence of jobs of a channel, which does only its newest run."""

    channel: int
    number: int  # Later runs of a channel have higher numbers
    jobs: Iterator[Job]  # Each job is made in the scheduler's thread when it is needed
    listener: RunListener
    waiting: deque[Job] = field(default_factory=deque)  # The next job, and those of dead workers
    unreported: list[Any] = field(default_factory=list)


class Scheduler:
    """Keeps workers busy with the jobs of several channels.

    Of all waiting jobs, one of the lowest rank begins first; of equal ranks, one of the run that
    began first. While an uninterruptible job waits or is being done, no job of a higher rank
    begins, because it would delay that job's result. Each channel does only its newest run, which
    replaces an older one at once, or as soon as the older one has completed its uninterruptible
    jobs.

    :meth:`put`, :meth:`cancel` and :meth:`close` may be called from any thread. They leave a
    message for :meth:`step` or :meth:`run`, which are called from a single thread.

    ``start`` starts the workers at the first job. ``fallback`` makes other workers if no processes
    can be started; without it the runs fail.
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
        """Let :meth:`run` end after the waiting messages."""
        self._inbox.put(None)

    def run(self) -> None:
        """Handle messages until the scheduler is closed; then end the workers."""
        try:
            while self.step():
                pass
        finally:
            self.end_workers()

    def step(self, timeout: float | None = None) -> bool:
        """Wait ``timeout`` seconds for a message and handle it; return whether more may come."""
        try:
            message = self._inbox.get(timeout=timeout)
        except Empty:
            return True
        if message is None:
            return False
        message()
        self._send_jobs()
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
        current = self._runs.get(run.channel)
        if current is not None and self._has_uninterruptible(current):
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
        """Make the run's next job if none is waiting, and end the run if there is none."""
        try:
            if not run.waiting:
                run.waiting.extend(islice(run.jobs, 1))
        except Exception as error:  # noqa: BLE001 - an error in one must not stop others
            self._fail(run, error)
            return
        if not self._unfinished_jobs(run):
            del self._runs[run.channel]
            run.listener.take_end(run.number, None)

    def _unfinished_jobs(self, run: Run) -> list[Job]:
        """Return the jobs that wait or are being done."""
        return [*run.waiting, *(job for owner, job in self._in_flight.values() if owner is run)]

    def _has_uninterruptible(self, run: Run, below: float = inf) -> bool:
        """Return whether an uninterruptible job of a rank below this waits or is being done."""
        return any(job.uninterruptible and job.rank < below for job in self._unfinished_jobs(run))

    def _send_jobs(self) -> None:
        """Send jobs until the workers have enough."""
        while (run := self._choose_run()) is not None:
            workers = self.workers or self._start_workers(run)
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
            future.add_done_callback(lambda done: self._inbox.put(lambda: self._take_back(done)))

    def _start_workers(self, run: Run) -> Workers | None:
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

    def _choose_run(self) -> Run | None:
        """Choose the run whose job goes next."""
        runs = (
            run
            for channel, run in self._runs.items()
            if run.waiting and (run.waiting[0].uninterruptible or channel not in self._pending)
        )
        first = min(runs, key=lambda run: run.waiting[0].rank, default=None)
        if first is None:
            return None
        rank = first.waiting[0].rank
        would_delay = any(self._has_uninterruptible(run, rank) for run in self._runs.values())
        return None if would_delay else first

    def _take_back(self, future: "Future[JobResult]") -> None:
        workers = self.workers
        if future not in self._in_flight or workers is None:
            return  # its worker died, and another one does the job
        try:
            result = future.result()
        except workers.lost_by as error:
            self._recover(workers, error)
            return
        except Exception as error:  # noqa: BLE001 - for example, arguments that cannot be sent
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
        """Replace workers that died, and put their jobs back."""
        for future, (run, job) in reversed(list(self._in_flight.items())):
            has_result = future.done() and not future.cancelled() and future.exception() is None
            if not has_result:
                del self._in_flight[future]
                run.waiting.appendleft(job)
        self._losses += 1
        missing: Exception | None = None
        try:
            workers.renew()
        except NO_PROCESSES as no_processes:
            missing = no_processes
            if self._fallback is not None:
                self.workers = self._fallback()
        is_hopeless = missing is not None and self._fallback is None
        for run in list(self._runs.values()):
            if is_hopeless or self._losses >= _MAX_LOSSES:
                self._fail(run, WorkersLostError(reason_of(error), self._losses))
            else:
                run.listener.note_lost_workers(run.number, missing)


_BEAT = 0.2  # seconds between two heartbeats while this process waits for workers


def results_of(
    jobs: Iterator[Job],
    start: Callable[[], Workers],
    heartbeat: Heartbeat,
    fallback: Callable[[], Workers] | None = None,
) -> Generator[Any, None, None]:
    """Yield the results of jobs in the order in which they are ready; then end the workers.

    Each job is made only when it is needed, so that a limited number is in progress. ``start`` and
    ``fallback`` are as for a :class:`Scheduler`. An exception of a job is raised here, and a
    WorkersLostError if workers die repeatedly.
    """
    listener = _ResultListener()
    scheduler = Scheduler(start, fallback)
    scheduler.put(Run(0, 1, jobs, listener))
    try:
        while not listener.is_ended:
            heartbeat()
            scheduler.step(_BEAT)
            while listener.results:
                yield listener.results.popleft()
    finally:
        scheduler.end_workers()
    if listener.error is not None:
        raise listener.error


@dataclass(eq=False, slots=True)
class _ResultListener:
    """Receives the results of one run."""

    results: deque[Any] = field(default_factory=deque)
    is_ended: bool = False
    error: Exception | None = None

    def take_results(self, _run: int, results: list[Any]) -> None:
        self.results += results

    def take_end(self, _run: int, error: Exception | None) -> None:
        self.is_ended, self.error = True, error

    def note_lost_workers(self, _run: int, _missing: Exception | None) -> None:
        """Do nothing, as the work goes on."""
