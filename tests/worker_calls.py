"""Functions that tests call in other processes, and workers without processes."""

import os
import pickle
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Future
from pathlib import Path
from typing import Any, NoReturn

from occ_model.parallel.job import Heartbeat, Job, JobResult, do_job

PATIENCE_S = 20.0


def wait_until(happened: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.001)


def echo(value: Any, heartbeat: Heartbeat) -> Any:
    return value


def fail(value: Any, heartbeat: Heartbeat) -> NoReturn:
    """Fail with an unexpected error."""
    raise ValueError(f"no {value}")


def process_id(heartbeat: Heartbeat) -> int:
    """Return the process id after a short time."""
    time.sleep(0.05)
    return os.getpid()


def count_to(number: int, heartbeat: Heartbeat) -> int:
    """Call the heartbeat a number of times."""
    for _ in range(number):
        heartbeat()
    return number


def count_for_ever(heartbeat: Heartbeat) -> NoReturn:
    """Work until a heartbeat ends it."""
    while True:
        heartbeat()
        time.sleep(0.001)


class HeldWorker:
    """One worker that does its jobs only when told, and that can die."""

    count = 1
    lost_by: tuple[type[Exception], ...] = (BrokenExecutor, CancelledError)

    def __init__(self) -> None:
        self.held: list[tuple[Job, Future[JobResult]]] = []
        self.sent: list[Any] = []
        """The first arguments of all jobs, in the order in which they were sent."""
        self.abandoned: list[tuple[int, int]] = []
        self.renewed = self.closed = 0

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        future: Future[JobResult] = Future()
        self.held.append((job, future))
        self.sent.append(job.arguments[0])
        return future

    def finish(self, number: int = 1) -> None:
        """Do the first of the held jobs."""
        for _ in range(number):
            job, future = self.held.pop(0)
            future.set_result(do_job(job, lambda: None))

    def die(self) -> None:
        """Lose all held jobs."""
        held, self.held = self.held, []
        for _, future in held:
            future.set_exception(BrokenExecutor("It was killed."))

    def abandon(self, channel: int, run: int) -> None:
        self.abandoned.append((channel, run))

    def count_heartbeats(self, counter: int) -> int:
        return 0

    def renew(self) -> None:
        self.renewed += 1

    def close(self) -> None:
        self.closed += 1


class PickledJobs(HeldWorker):
    """Workers that do each job at once, pickled as between processes; some jobs end them.

    ``deadly``: the second arguments of these jobs.
    """

    count = 2
    deadly: tuple[Path | str, ...] = ()

    def __init__(self, count: int, preload: str) -> None:
        super().__init__()

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        future = super().submit(job, channel, run)
        if job.arguments[1] in self.deadly:
            self.die()
        else:
            self.held.clear()
            done = do_job(pickle.loads(pickle.dumps(job)), lambda: None)
            future.set_result(pickle.loads(pickle.dumps(done)))
        return future
