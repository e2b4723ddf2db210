"""Drive a scheduler step by step with one controlled worker, and record its reports."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

from worker_calls import HeldWorker, echo

from occ_model.parallel.job import Job, Workers
from occ_model.parallel.scheduler import Run, Scheduler


def jobs(rank: int, *values: Any, whole: bool = False) -> tuple[Job, ...]:
    """Make jobs that return these values; ``whole``: they are uninterruptible."""
    return tuple(Job(echo, (value,), rank=rank, uninterruptible=whole) for value in values)


@dataclass
class RecordingListener:
    """Records the results and ends of a channel's runs."""

    bench: "Bench"
    channel: int

    def take_results(self, run: int, results: list[Any]) -> None:
        self.bench.reports.append((self.channel, run, results))

    def take_end(self, run: int, error: Exception | None) -> None:
        if error is None:
            self.bench.ended.append((self.channel, run))
        else:
            self.bench.errors.append((self.channel, run, error))

    def note_lost_workers(self, run: int, missing: Exception | None) -> None:
        what = "replaced" if missing is None else "missing"
        self.bench.notices.append((what, self.channel, run))


class Bench:
    """Drives a scheduler in which everything happens on a call and nothing by itself."""

    def __init__(
        self, worker: Workers | None = None, start: Callable[[], Workers] | None = None, **how: Any
    ) -> None:
        self.worker: Any = worker or HeldWorker()
        self.reports: list[tuple[int, int, list[Any]]] = []
        self.ended: list[tuple[int, int]] = []
        self.errors: list[tuple[int, int, Exception]] = []
        self.notices: list[tuple[str, int, int]] = []
        self.scheduler = Scheduler(start or (lambda: self.worker), **how)

    @property
    def sent(self) -> list[Any]:
        """The jobs sent to the worker so far, in order."""
        return list(self.worker.sent)

    @property
    def results(self) -> list[Any]:
        """All reported results, in order."""
        return [result for _, _, results in self.reports for result in results]

    def ask(self, channel: int, number: int, *groups: tuple[Job, ...]) -> None:
        """Make a request."""
        self.ask_for(channel, number, chain(*groups))

    def ask_for(self, channel: int, number: int, coming: Iterator[Job]) -> None:
        """Make a request whose jobs are made one by one."""
        self.scheduler.put(Run(channel, number, coming, RecordingListener(self, channel)))
        self.settle()

    def finish(self, number: int = 1) -> None:
        """Let the worker do some jobs, one after another."""
        for _ in range(number):
            self.worker.finish()
            self.settle()

    def finish_all(self) -> None:
        """Let the worker do all jobs sent to it."""
        for _ in range(100):
            if not self.worker.held:
                return
            self.finish()
        raise AssertionError("The work never ends.")

    def settle(self) -> None:
        """Let the scheduler handle all messages."""
        for _ in range(20):
            assert self.scheduler.step(0.0)
