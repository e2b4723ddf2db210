"""Process pool: worker processes that do jobs, and that are replaced when they die."""

import os
from concurrent.futures import BrokenExecutor, CancelledError, Future, ProcessPoolExecutor
from threading import Thread
from typing import Any

from occ_model.parallel.job import (
    CHANNELS,
    NO_PROCESSES,
    Job,
    JobResult,
    counting_heartbeat,
    do_job_apart,
)
from occ_model.parallel.processes import (
    begin_worker,
    check_open_files,
    interrupts_held,
    process_context,
    worker_start,
)

_EXIT_SECONDS = 0.2  # seconds that processes get to end by themselves


class ProcessPool:
    """Processes that live until the pool is closed, and are started by the first job.

    ``preload``: a module that is imported once for all, where possible. ``niceness``: as
    :func:`os.nice`.
    """

    lost_by: tuple[type[Exception], ...] = (BrokenExecutor, CancelledError, *NO_PROCESSES)

    def __init__(self, count: int, preload: str, niceness: int = 0) -> None:
        self.count = count
        self._niceness = niceness
        check_open_files(count)
        self._context = _RecordingContext(process_context([__name__, preload]))
        # Without locks: a process that dies while it holds one would stop the others.
        self._first_runs = self._context.RawArray("q", CHANNELS)
        self._counts = self._context.RawArray("q", CHANNELS)
        self._executor = self._start()

    def _start(self) -> ProcessPoolExecutor:
        self._context.processes.clear()
        shared = (self._first_runs, self._counts, self._niceness)
        context: Any = self._context
        with worker_start():
            return ProcessPoolExecutor(self.count, context, _begin, shared)

    @property
    def processes(self) -> list[int]:
        """The numbers of the processes that were started."""
        return [process.pid for process in self._started()]

    def _started(self) -> list[Any]:
        return [process for process in self._context.processes if process.pid is not None]

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        """Queue a job; the first one starts the processes."""
        with worker_start():
            return self._executor.submit(_work, job, channel, run)

    def abandon(self, channel: int, run: int) -> None:
        """Let the jobs of all runs of a channel that are earlier than ``run`` end."""
        self._first_runs[channel] = run

    def counted(self, counter: int) -> int:
        return int(self._counts[counter])

    def renew(self) -> None:
        """Start new processes in place of those that died."""
        self.close()
        self._executor = self._start()

    def close(self) -> None:
        """End the processes, also in the middle of a job."""
        with interrupts_held():
            # It returns when all processes have ended, and some of them must be killed for that. It
            # waits for them alone: of two that wait for a process one misses its exit code.
            shutdown = Thread(target=self._executor.shutdown, kwargs={"cancel_futures": True})
            shutdown.start()
            shutdown.join(_EXIT_SECONDS)
            if shutdown.is_alive():
                for process in self._started():
                    process.kill()
            shutdown.join()


class _RecordingContext:
    """A context of :mod:`multiprocessing` that keeps the processes that are made with it."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self.processes: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def Process(self, *args: Any, **kwargs: Any) -> Any:  # noqa: N802 - as in multiprocessing
        process = self._context.Process(*args, **kwargs)
        self.processes.append(process)
        return process


_shared: dict[str, Any] = {}  # in a worker: the numbers shared with the process that started it


def _begin(first_runs: Any, counts: Any, niceness: int) -> None:
    _shared.update(first_runs=first_runs, counts=counts)
    if niceness and hasattr(os, "nice"):
        os.nice(niceness)
    begin_worker()


def _work(job: Job, channel: int, run: int) -> JobResult:
    heartbeat = counting_heartbeat(job, channel, run, _shared["first_runs"], _shared["counts"])
    return do_job_apart(job, heartbeat)
