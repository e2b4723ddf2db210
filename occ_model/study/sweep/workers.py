"""Workers of a study: they measure its points, and this process completes it where they die."""

import warnings
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Executor, Future, wait
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any, Generic

from occ_model.errors import one_line
from occ_model.parallel.job import (
    NO_PROCESSES,
    Heartbeat,
    Job,
    JobResult,
    Stage,
    Workers,
    WorkersLostError,
    do_job_apart,
)
from occ_model.parallel.request import Run
from occ_model.parallel.scheduler import Scheduler
from occ_model.study.sweep.results_file import Point

_JOB_SECONDS = 0.1  # seconds of a job: long against sending it, short against anybody's patience
_BEAT = 0.2  # seconds between two heartbeats while this process waits for workers
_UNKNOWN_WORKERS = 32  # assumed of an executor that does not say how many it has


@dataclass(frozen=True, slots=True)
class Work(Generic[Point]):
    """The points of a study as jobs."""

    what: str  # What the study is called: a sweep
    # The function of a job, which takes its arguments and a heartbeat and returns an object with
    # the ``points`` and the ``seconds`` that they took; its module is what a worker process needs
    function: Callable[..., Any]
    arguments: Callable[[Iterable[int]], tuple[Any, ...]]  # Of a job of some points

    def job(self, indices: Iterable[int]) -> Job:
        return Job(self.function, self.arguments(indices))

    def here(self, indices: Iterable[int], heartbeat: Heartbeat) -> Generator[Point, None, None]:
        """Measure points in this process."""
        for index in indices:
            yield from self.function(*self.arguments((index,)), heartbeat).points


class GivenExecutor:
    """An executor that belongs to the caller: it is neither renewed nor closed."""

    # Each kind of executor has its own exceptions for workers that died.
    lost_by: tuple[type[Exception], ...] = (Exception,)

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self._futures: set[Future[JobResult]] = set()
        self.count: int = getattr(executor, "_max_workers", _UNKNOWN_WORKERS)

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":  # noqa: ARG002
        """Queue a job."""
        future = self._executor.submit(do_job_apart, job)
        self._futures.add(future)
        future.add_done_callback(self._futures.discard)
        return future

    def abandon(self, channel: int, run: int) -> None:
        """Do nothing: these workers share no memory with this process."""

    def counted(self, counter: int) -> int:  # noqa: ARG002
        """Return none: these workers share no memory with this process."""
        return 0

    def renew(self) -> None:
        """Withdraw the jobs that have not begun."""
        # An executor that breaks ends its futures one by one; one withdrawn meanwhile confuses it.
        wait(list(self._futures), timeout=_BEAT)
        for future in list(self._futures):
            future.cancel()
        raise NotImplementedError("only the owner of an executor can replace its workers")

    def close(self) -> None:
        """Leave the executor to its owner."""


def measure_anywhere(
    work: Work[Point],
    todo: Iterator[int],
    executor: Executor | None,
    jobs: int,
    heartbeat: Heartbeat,
) -> Generator[Point, None, None]:
    """Measure points by an executor, by so many processes, or here."""
    if executor is not None:
        return measure_by(GivenExecutor(executor), work, todo, heartbeat)
    if jobs > 1:
        # Importing what starts processes takes time.
        from occ_model.parallel.process_pool import ProcessPool

        try:
            return measure_by(ProcessPool(jobs, work.function.__module__), work, todo, heartbeat)
        except NO_PROCESSES as error:
            warnings.warn(
                f"No processes can be started ({one_line(str(error))}); this one does the "
                f"{work.what} alone.",
                RuntimeWarning,
                stacklevel=3,
            )
    return work.here(todo, heartbeat)


def measure_by(
    workers: Workers, work: Work[Point], indices: Iterator[int], heartbeat: Heartbeat
) -> Generator[Point, None, None]:
    """Measure points by workers, in the order in which they are ready.

    A bounded number of jobs is in flight. When workers die, their points are measured again, by new
    ones or here: a point depends on nothing but itself.
    """
    progress = _Progress(work, indices)
    scheduler = Scheduler(lambda: workers, progress)
    scheduler.put(Run(0, 1, lambda: (Stage(0, progress.jobs()),)))
    try:
        while not progress.is_ended:
            heartbeat()
            scheduler.step(_BEAT)
            yield from progress.newly_measured()
        if isinstance(progress.error, WorkersLostError):
            reason = progress.error.reason
            warnings.warn(
                f"The {work.what}'s workers are gone ({reason}); this process finishes it alone.",
                RuntimeWarning,
                stacklevel=2,
            )
        elif progress.error is not None:
            raise progress.error
        yield from work.here(progress.left(), heartbeat)
    finally:
        scheduler.end_workers()


class _Progress(Generic[Point]):
    """The points of a study that are to be sent, that workers have, and that are measured."""

    def __init__(self, work: Work[Point], indices: Iterator[int]) -> None:
        self._work = work
        self._unsent = indices
        self._sent: dict[int, None] = {}
        self._measured: list[Point] = []
        self._seconds_a_point = 0.0
        self.is_ended = False
        self.error: Exception | None = None

    def jobs(self) -> Iterator[Job]:
        """Make jobs of the points, each only when it is needed."""
        while chosen := tuple(islice(self._unsent, self._size())):
            self._sent.update(dict.fromkeys(chosen))
            yield self._work.job(chosen)

    def _size(self) -> int:
        """Return the number of points in a job: one until their time is known."""
        each = self._seconds_a_point
        return max(1, int(_JOB_SECONDS / each)) if each else 1

    def newly_measured(self) -> list[Point]:
        """Return the points that were measured since the last call."""
        measured, self._measured = self._measured, []
        return measured

    def left(self) -> Iterable[int]:
        """Return the points without a result."""
        return chain(self._sent, self._unsent)

    def results_ready(self, _channel: int, _run: int, results: list[Any]) -> None:
        """Take the points of jobs that have come back."""
        for result in results:
            self._take(result)

    def _take(self, result: Any) -> None:
        self._seconds_a_point = result.seconds / len(result.points)
        for point in result.points:
            del self._sent[point.index]
        self._measured += result.points

    def finished(self, _channel: int, _run: int) -> None:
        """Note that all points are measured."""
        self.is_ended = True

    def failed(self, _channel: int, _run: int, error: Exception) -> None:
        """Note that workers measure no more, and why."""
        self.is_ended, self.error = True, error

    def workers_replaced(self, _channel: int, _run: int) -> None:
        """Do nothing: the work goes on."""

    def workers_missing(self, _channel: int, _run: int, _error: Exception) -> None:
        """Do nothing: it does not happen without a fallback."""
