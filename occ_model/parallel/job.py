"""Jobs: calls that workers make, and what workers and receivers of results must be able to do."""

import traceback
from collections.abc import Callable, MutableSequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from occ_model.errors import OccError

Heartbeat: TypeAlias = Callable[[], object]  # called by long work; ends it by raising
CHANNELS = 8  # most channels to the same workers, and most counters of heartbeats

NO_PROCESSES = (OSError, ImportError, NotImplementedError)
"""Raised where the system cannot start processes: no semaphores (a /dev/shm that cannot be written
to), no memory or files left for one more."""


class Abandoned(Exception):  # noqa: N818 - no error: the result is no longer wanted
    """Ends a job whose result is no longer wanted."""


class WorkersLostError(OccError):
    """Workers ended ``times`` in a row without a result, and no others could replace them."""

    def __init__(self, reason: str, times: int) -> None:
        super().__init__(f"Processes in the background ended {times} times without a result.")
        self.reason = reason


@dataclass(frozen=True, slots=True)
class Job:
    # A function of some module. It takes a Heartbeat after the arguments and must not need Qt.
    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    counter: int = 0  # The counter that the job's heartbeats are added to
    rank: int = 0  # Of all jobs that wait, those of the lowest rank go first
    # Whether the job is done, once its run has come to it, in spite of a newer run
    uninterruptible: bool = False


@dataclass(frozen=True, slots=True)
class JobResult:
    """A job's value, or its error, or neither where it was abandoned.

    An error is a value here, so that an exception of a future is always the workers' own.
    """

    value: Any = None
    error: Exception | None = None
    is_abandoned: bool = False


class Workers(Protocol):
    """Processes or threads that do jobs."""

    count: int  # how many jobs they do at a time

    lost_by: tuple[type[Exception], ...]
    """Exceptions of a future, or raised by ``submit``, that mean that workers ended."""

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        """Queue a job that belongs to a run of a channel."""

    def abandon(self, channel: int, run: int) -> None:
        """End the jobs of all runs of a channel that are earlier than ``run``."""

    def counted(self, counter: int) -> int:
        """Return the number of heartbeats in a counter."""

    def renew(self) -> None:
        """Replace workers that ended."""

    def close(self) -> None:
        """End the workers, also in the middle of a job."""


class Listener(Protocol):
    """Receives what becomes of runs; called where the scheduler runs."""

    def take_results(self, run: int, results: list[Any]) -> None:
        """Receive results of a run: one, or those of all uninterruptible jobs in a row."""

    def take_end(self, run: int, error: Exception | None) -> None:
        """Note that no more results of a run come, and why, unless all were given."""

    def note_lost_workers(self, run: int, missing: Exception | None) -> None:
        """Note that others repeat the jobs of lost workers.

        ``missing``: why no processes can be started, where the fallback does the jobs.
        """


def do_job(job: Job, heartbeat: Heartbeat) -> JobResult:
    try:
        heartbeat()
        return JobResult(job.function(*job.arguments, heartbeat))
    except Abandoned:
        return JobResult(is_abandoned=True)
    except Exception as error:  # noqa: BLE001 - raised or logged where the result is wanted
        return JobResult(error=error)


def do_job_apart(job: Job, heartbeat: Heartbeat = lambda: None) -> JobResult:
    """Do a job in another process; an error keeps its traceback as a note."""
    result = do_job(job, heartbeat)
    if result.error is not None:
        # A traceback cannot be sent to another process.
        result.error.add_note("".join(traceback.format_exception(result.error)))
    return result


def counting_heartbeat(
    job: Job,
    channel: int,
    run: int,
    first_runs: MutableSequence[int],
    counts: MutableSequence[int],
) -> Heartbeat:
    """Make a heartbeat that counts itself and ends a job of a run before ``first_runs``."""

    def heartbeat() -> None:
        if first_runs[channel] > run:
            raise Abandoned
        counts[job.counter] += 1

    return heartbeat


def reason_of(error: BaseException) -> str:
    text = " ".join(str(error).split()).rstrip(".")
    name = type(error).__name__
    return f"{name}: {text}" if text else name
