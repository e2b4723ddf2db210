"""Worker thread: does jobs where the system cannot start processes."""

import sys
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor

from occ_model.parallel.job import CHANNELS, Job, JobResult, counting_heartbeat, do_job


class WorkerThread:
    """A thread of this process, started by the first job; it slows the others meanwhile."""

    count = 1
    lost_by: tuple[type[Exception], ...] = (CancelledError,)

    def __init__(self) -> None:
        self._first_runs = [0] * CHANNELS
        self._counts = [0] * CHANNELS
        self._executor = ThreadPoolExecutor(1, "work")

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        heartbeat = counting_heartbeat(job, channel, run, self._first_runs, self._counts)
        return self._executor.submit(do_job, job, heartbeat)

    def abandon(self, channel: int, run: int) -> None:
        self._first_runs[channel] = run

    def counted(self, counter: int) -> int:
        return self._counts[counter]

    def renew(self) -> None:
        """Do nothing: a thread does not die."""

    def close(self) -> None:
        """Abandon all jobs; the thread ends with the next heartbeat, and is not waited for."""
        self._first_runs[:] = [sys.maxsize] * CHANNELS
        self._executor.shutdown(wait=False, cancel_futures=True)
