"""Jobs for workers, the interfaces of workers and of receivers of results, and a worker thread."""

import sys
import traceback
from collections.abc import Callable, MutableSequence
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from occ_model.errors import OccError

Heartbeat: TypeAlias = Callable[[], object]  # called regularly by long work; it raises to end it
CHANNELS = 8  # maximum number of channels to the same workers, and of heartbeat counters

NO_PROCESSES = (OSError, ImportError, NotImplementedError)
"""Raised if the system cannot start processes, which need semaphores, memory and open files."""


class Abandoned(Exception):  # noqa: N818 - not an error
    """Ends a job whose result is no longer wanted."""


class WorkersLostError(OccError):
    """Workers ended ``times`` times in a row without a result, or could not be replaced."""

    def __init__(self, reason: str, times: int) -> None:
        super().__init__(f"Processes in the background ended {times} times without a result.")
        self.reason = reason


@dataclass(frozen=True, slots=True)
class Job:
    # A module's function, called with the arguments and a Heartbeat; it must not need Qt
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    counter: int = 0  # The counter of the job's heartbeats
    rank: int = 0  # Waiting jobs of the lowest rank begin first
    # Whether the job is completed even if a newer run is requested
    uninterruptible: bool = False


@dataclass(frozen=True, slots=True)
class JobResult:
    """A job's value, or its error, or neither if it was abandoned.

    A job's error is returned as a value, so that an exception of a future is always due to the
    workers.
    """

    value: Any = None
    error: Exception | None = None
    is_abandoned: bool = False


class Workers(Protocol):
    """Processes or threads that do jobs."""

    count: int  # number of jobs they do at a time

    lost_by: tuple[type[Exception], ...]
    """Exceptions of a future or of ``submit`` that mean that workers have died."""

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        """Queue a job that belongs to a run of a channel."""

    def abandon(self, channel: int, run: int) -> None:
        """End the jobs of all runs of a channel that are earlier than ``run``."""

    def count_heartbeats(self, counter: int) -> int:
        """Return the number of heartbeats in a counter."""

    def renew(self) -> None:
        """Replace workers that have died."""

    def close(self) -> None:
        """End the workers, even in the middle of a job."""


class RunListener(Protocol):
    """Receives the results and ends of runs; called in the scheduler's thread."""

    def take_results(self, run: int, results: list[Any]) -> None:
        """Receive results of a run: one, or those of a sequence of uninterruptible jobs."""

    def take_end(self, run: int, error: Exception | None) -> None:
        """Note that a run has ended; ``error``: why, if results are missing."""

    def note_lost_workers(self, run: int, missing: Exception | None) -> None:
        """Note that other workers repeat the jobs of workers that died.

        ``missing``: why no processes can be started, if the fallback does the jobs.
        """


def do_job(job: Job, heartbeat: Heartbeat) -> JobResult:
    try:
        heartbeat()
        return JobResult(job.function(*job.arguments, heartbeat))
    except Abandoned:
        return JobResult(is_abandoned=True)
    except Exception as error:  # noqa: BLE001 - raised or logged by the receiver of the result
        return JobResult(error=error)


def do_job_in_process(job: Job, heartbeat: Heartbeat = lambda: None) -> JobResult:
    """Do a job in a worker process; an error keeps its traceback as a note."""
    result = do_job(job, heartbeat)
    if result.error is not None:
        # A traceback cannot be sent to another process.
        result.error.add_note("".join(traceback.format_exception(result.error)))
    return result


def make_heartbeat(
    job: Job,
    channel: int,
    run: int,
    first_runs: MutableSequence[int],
    counts: MutableSequence[int],
) -> Heartbeat:
    """Return a heartbeat that counts its calls and ends jobs of runs before ``first_runs``."""

    def heartbeat() -> None:
        if first_runs[channel] > run:
            raise Abandoned
        counts[job.counter] += 1

    return heartbeat


def reason_of(error: BaseException) -> str:
    text = " ".join(str(error).split()).rstrip(".")
    name = type(error).__name__
    return f"{name}: {text}" if text else name


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
