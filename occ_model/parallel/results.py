"""Have workers do jobs, and yield their results in this process as they become ready."""

from collections.abc import Callable, Generator, Iterator
from typing import Any

from occ_model.parallel.job import Heartbeat, Job, Workers
from occ_model.parallel.scheduler import Run, Scheduler

_BEAT = 0.2  # seconds between two heartbeats while this process waits for workers


def results_of(
    jobs: Iterator[Job],
    start: Callable[[], Workers],
    heartbeat: Heartbeat,
    fallback: Callable[[], Workers] | None = None,
) -> Generator[Any, None, None]:
    """Yield the results of jobs in the order in which they are ready; then end the workers.

    Each job is made only when it is needed, so that a limited number is in progress. ``start`` and
    ``fallback`` are as for a :class:`Scheduler`. An exception of a job is raised here, and
    WorkersLostError if workers die again and again.
    """
    ready = _ResultListener()
    scheduler = Scheduler(start, fallback)
    scheduler.put(Run(0, 1, jobs, ready))
    try:
        while not ready.is_ended:
            heartbeat()
            scheduler.step(_BEAT)
            yield from ready.take()
    finally:
        scheduler.end_workers()
    if ready.error is not None:
        raise ready.error


class _ResultListener:
    """Receives the results of one run."""

    def __init__(self) -> None:
        self._results: list[Any] = []
        self.is_ended = False
        self.error: Exception | None = None

    def take(self) -> list[Any]:
        results, self._results = self._results, []
        return results

    def take_results(self, _run: int, results: list[Any]) -> None:
        self._results += results

    def take_end(self, _run: int, error: Exception | None) -> None:
        self.is_ended, self.error = True, error

    def note_lost_workers(self, _run: int, _missing: Exception | None) -> None:
        """Do nothing, as the work goes on."""
