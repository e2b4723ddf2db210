"""Do jobs by workers, and yield their results here as they become ready."""

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

    A bounded number of jobs is in flight: each is made only when it is needed. ``start`` and
    ``fallback`` are as of a :class:`Scheduler`. What a job raises is raised here, and
    WorkersLostError where workers end again and again.
    """
    ready = _Results()
    scheduler = Scheduler(start, fallback)
    scheduler.put(Run(0, 1, jobs, ready))
    try:
        while not ready.is_ended:
            heartbeat()
            scheduler.step(_BEAT)
            yield from ready.taken()
    finally:
        scheduler.end_workers()
    if ready.error is not None:
        raise ready.error


class _Results:
    """Listens to one run."""

    def __init__(self) -> None:
        self._results: list[Any] = []
        self.is_ended = False
        self.error: Exception | None = None

    def taken(self) -> list[Any]:
        results, self._results = self._results, []
        return results

    def take_results(self, _run: int, results: list[Any]) -> None:
        self._results += results

    def take_end(self, _run: int, error: Exception | None) -> None:
        self.is_ended, self.error = True, error

    def note_lost_workers(self, _run: int, _missing: Exception | None) -> None:
        """Do nothing: the work goes on."""
