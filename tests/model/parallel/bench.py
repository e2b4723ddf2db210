"""A scheduler with one held worker, driven step by step, and all that it reports."""

from collections.abc import Callable, Iterable
from typing import Any

from worker_calls import HeldWorker, echo

from occ_model.parallel.job import Job, Stage, Workers
from occ_model.parallel.request import Run
from occ_model.parallel.scheduler import Scheduler


def stage(rank: int, *values: Any, whole: bool = False) -> Stage:
    """Make a stage whose jobs give these values; ``whole``: it is uninterruptible."""
    return Stage(rank, tuple(Job(echo, (value,)) for value in values), whole)


class Bench:
    """Drives a scheduler: everything happens at a call, nothing by itself."""

    def __init__(
        self, worker: Workers | None = None, start: Callable[[], Workers] | None = None, **how: Any
    ) -> None:
        self.worker: Any = worker or HeldWorker()
        self.time = 0.0
        self.reports: list[tuple[int, int, list[Any]]] = []
        self.ended: list[tuple[int, int]] = []
        self.errors: list[tuple[int, int, Exception]] = []
        self.notices: list[tuple[str, int, int]] = []
        self.scheduler = Scheduler(
            start or (lambda: self.worker), self, clock=lambda: self.time, **how
        )

    @property
    def sent(self) -> list[Any]:
        """What the worker was sent so far, in order."""
        return list(self.worker.sent)

    @property
    def results(self) -> list[Any]:
        """All results that were reported, in order."""
        return [result for _, _, results in self.reports for result in results]

    def ask(self, channel: int, number: int, *stages: Stage) -> None:
        """Make a request."""
        self.ask_for(channel, number, lambda: stages)

    def ask_for(self, channel: int, number: int, stages: Callable[[], Iterable[Stage]]) -> None:
        """Make a request whose stages a function gives."""
        self.scheduler.put(Run(channel, number, stages))
        self.settle()

    def finish(self, number: int = 1) -> None:
        """Let the worker do some jobs, one after the other."""
        for _ in range(number):
            self.worker.finish()
            self.settle()

    def finish_all(self) -> None:
        """Let the worker do all that it is sent."""
        for _ in range(100):
            if not self.worker.held:
                return
            self.finish()
        raise AssertionError("The work never ends.")

    def settle(self) -> None:
        """Let the scheduler answer all messages."""
        for _ in range(20):
            assert self.scheduler.step(0.0)

    def results_ready(self, channel: int, run: int, results: list[Any]) -> None:
        self.reports.append((channel, run, results))

    def finished(self, channel: int, run: int) -> None:
        self.ended.append((channel, run))

    def failed(self, channel: int, run: int, error: Exception) -> None:
        self.errors.append((channel, run, error))

    def workers_replaced(self, channel: int, run: int) -> None:
        self.notices.append(("replaced", channel, run))

    def workers_missing(self, channel: int, run: int, error: Exception) -> None:
        self.notices.append(("missing", channel, run))
