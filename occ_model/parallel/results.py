"""Do jobs by workers, and yield their results here as they become ready."""

from collections.abc import Callable, Generator, Iterator
from typing import Any

from occ_model.parallel.job import Heartbeat, Job, Stage, Workers
from occ_model.parallel.request import Run
from occ_model.parallel.scheduler import Scheduler

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
    scheduler = Scheduler(start, ready, fallback=fallback)
    scheduler.put(Run(0, 1, lambda: (Stage(0, jobs),)))
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

    def results_ready(self, _channel: int, _run: int, results: list[Any]) -> None:
        self._results += results

    def finished(self, _channel: int, _run: int) -> None:
        self.is_ended = True

    def failed(self, _channel: int, _run: int, error: Exception) -> None:
        self.is_ended, self.error = True, error

    def workers_replaced(self, _channel: int, _run: int) -> None:
        """Do nothing: the work goes on."""

    def workers_missing(self, _channel: int, _run: int, _error: Exception) -> None:
        """Do nothing: the fallback does the work."""
