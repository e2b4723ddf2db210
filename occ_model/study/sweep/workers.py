"""Measure the points of a study by workers, or in this process if they die."""

import warnings
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Executor, Future, wait
from contextlib import closing
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any, Generic

from occ_model.errors import one_line
from occ_model.parallel.job import (
    NO_PROCESSES,
    Heartbeat,
    Job,
    JobResult,
    Workers,
    WorkersLostError,
    do_job_in_process,
)
from occ_model.parallel.scheduler import results_of
from occ_model.study.sweep.results_file import Point

_JOB_SECONDS = 0.1  # duration of a job: long compared to sending it, short for a waiting user
_WAIT = 0.2  # seconds given to the futures of a breaking executor to end
_UNKNOWN_WORKERS = 32  # assumed for an executor that does not give the number


@dataclass(frozen=True, slots=True)
class StudyWork(Generic[Point]):
    """The points of a study as jobs."""

    study_name: str  # Such as "sweep"
    # The function of a job, called with its arguments and a heartbeat; returns an object with the
    # ``points`` and the ``seconds`` that they took. A worker process imports its module
    function: Callable[..., Any]
    arguments: Callable[[Iterable[int]], tuple[Any, ...]]  # Arguments of a job of some points

    def measure_here(
        self, indices: Iterable[int], heartbeat: Heartbeat
    ) -> Generator[Point, None, None]:
        parts = _Parts(indices)
        for part in parts:
            measured = self.function(*self.arguments(part), heartbeat)
            parts.note(measured)
            yield from measured.points


class _Parts:
    """Takes points in parts, each of a job's duration: one point until its time is known."""

    def __init__(self, indices: Iterable[int]) -> None:
        self._indices = iter(indices)
        self._seconds_a_point = _JOB_SECONDS

    def __iter__(self) -> Iterator[tuple[int, ...]]:
        while part := tuple(
            islice(self._indices, max(1, int(_JOB_SECONDS / self._seconds_a_point)))
        ):
            yield part

    def note(self, measured: Any) -> None:
        """Note the duration of a part that has been measured."""
        self._seconds_a_point = max(measured.seconds / len(measured.points), 1e-9)


class GivenExecutor:
    """An executor that belongs to the caller and is neither renewed nor closed."""

    # Each kind of executor has its own exceptions for dead workers.
    lost_by: tuple[type[Exception], ...] = (Exception,)

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self._futures: set[Future[JobResult]] = set()
        self.count: int = getattr(executor, "_max_workers", _UNKNOWN_WORKERS)

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":  # noqa: ARG002
        future = self._executor.submit(do_job_in_process, job)
        self._futures.add(future)
        future.add_done_callback(self._futures.discard)
        return future

    def abandon(self, channel: int, run: int) -> None:
        """Do nothing: these workers share no memory with this process."""

    def count_heartbeats(self, counter: int) -> int:  # noqa: ARG002
        """Return 0: these workers share no memory with this process."""
        return 0

    def renew(self) -> None:
        """Cancel the jobs that have not begun; then raise, as no worker can be replaced."""
        # A breaking executor ends its futures one by one, and fails if one is cancelled meanwhile.
        wait(list(self._futures), timeout=_WAIT)
        for future in list(self._futures):
            future.cancel()
        raise NotImplementedError("only the owner of an executor can replace its workers")

    def close(self) -> None:
        """Leave the executor to its owner."""


def measure_anywhere(
    work: StudyWork[Point],
    indices: Iterator[int],
    executor: Executor | None,
    jobs: int,
    heartbeat: Heartbeat,
) -> Generator[Point, None, None]:
    """Measure points by an executor, by a number of processes, or in this process."""
    if executor is not None:
        return measure_by(GivenExecutor(executor), work, indices, heartbeat)
    if jobs > 1:
        # Imported here because the import takes time.
        from occ_model.parallel.process_pool import ProcessPool

        try:
            return measure_by(ProcessPool(jobs, work.function.__module__), work, indices, heartbeat)
        except NO_PROCESSES as error:
            warnings.warn(
                f"No processes can be started ({one_line(str(error))}); this one does the "
                f"{work.study_name} alone.",
                RuntimeWarning,
                stacklevel=3,
            )
    return work.measure_here(indices, heartbeat)


def measure_by(
    workers: Workers, work: StudyWork[Point], indices: Iterator[int], heartbeat: Heartbeat
) -> Generator[Point, None, None]:
    """Measure points by workers and yield them in the order in which they are ready.

    A limited number of jobs is in progress at a time. If workers die, their points are measured
    again by new ones or here, since a point does not depend on other points.
    """
    unfinished: dict[int, None] = {}
    parts = _Parts(indices)

    def jobs() -> Iterator[Job]:
        for part in parts:
            unfinished.update(dict.fromkeys(part))
            yield Job(work.function, work.arguments(part))

    try:
        with closing(results_of(jobs(), lambda: workers, heartbeat)) as results:
            for result in results:
                parts.note(result)
                for point in result.points:
                    del unfinished[point.index]
                yield from result.points
    except WorkersLostError as error:
        warnings.warn(
            f"The {work.study_name}'s workers are gone ({error.reason}); this process finishes it "
            "alone.",
            RuntimeWarning,
            stacklevel=2,
        )
    yield from work.measure_here(chain(unfinished, indices), heartbeat)
