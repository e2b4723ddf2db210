"""A worker thread, which does jobs if the system cannot start processes."""

import sys
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor

from occ_model.parallel.job import CHANNELS, Job, JobResult, do_job, make_heartbeat


class WorkerThread:
    """A thread of this process, started by the first job; it slows the other threads."""

    count = 1
    lost_by: tuple[type[Exception], ...] = (CancelledError,)

    def __init__(self) -> None:
        self._first_runs = [0] * CHANNELS
        self._counts = [0] * CHANNELS
        self._executor = ThreadPoolExecutor(1, "work")

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        heartbeat = make_heartbeat(job, channel, run, self._first_runs, self._counts)
        return self._executor.submit(do_job, job, heartbeat)

    def abandon(self, channel: int, run: int) -> None:
        self._first_runs[channel] = run

    def count_heartbeats(self, counter: int) -> int:
        return self._counts[counter]

    def renew(self) -> None:
        """Do nothing, as a thread does not die."""

    def close(self) -> None:
        """Abandon all jobs without waiting for the thread, which ends at the next heartbeat."""
        self._first_runs[:] = [sys.maxsize] * CHANNELS
        self._executor.shutdown(wait=False, cancel_futures=True)
