"""A pool of worker processes, which do jobs and are replaced when they die."""

import os
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_all_start_methods, get_context, parent_process
from threading import Thread
from typing import Any

from occ_model.parallel.job import (
    CHANNELS,
    NO_PROCESSES,
    Job,
    JobResult,
    do_job_in_process,
    make_heartbeat,
)

EXIT_SECONDS = 0.2  # seconds in which processes can end by themselves


class ProcessPool:
    """Processes that are started by the first job and run until the pool is closed.

    ``preload``: a module that is imported once for all processes if possible. ``niceness``: as for
    :func:`os.nice`.
    """

    lost_by: tuple[type[Exception], ...] = (BrokenExecutor, CancelledError, *NO_PROCESSES)

    def __init__(self, count: int, preload: str, niceness: int = 0) -> None:
        self.count = count
        self._niceness = niceness
        self._context = _RecordingContext(process_context([__name__, preload]))
        # Without locks, because a process that dies while holding one would block the others.
        self._first_runs = self._context.RawArray("q", CHANNELS)
        self._counts = self._context.RawArray("q", CHANNELS)
        self._executor = self.start()

    def start(self) -> ProcessPoolExecutor:
        self._context.processes.clear()
        shared = (self._first_runs, self._counts, self._niceness)
        context: Any = self._context
        with prepare_start():
            return ProcessPoolExecutor(self.count, context, _begin, shared)

    @property
    def processes(self) -> list[int]:
        return [process.pid for process in self.started_processes()]

    def started_processes(self) -> list[Any]:
        return [process for process in self._context.processes if process.pid is not None]

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        """Queue a job; the first one starts the processes."""
        with prepare_start():
            return self._executor.submit(_work, job, channel, run)

    def abandon(self, channel: int, run: int) -> None:
        self._first_runs[channel] = run

    def count_heartbeats(self, counter: int) -> int:
        return int(self._counts[counter])

    def renew(self) -> None:
        self.close()
        self._executor = self.start()

    def close(self) -> None:
        with delay_interrupts():
            # This shutdown returns when all processes have ended, if necessary because they were
            # killed. Nothing else waits for them, because only one waiter gets the exit code.
            shutdown = Thread(target=self._executor.shutdown, kwargs={"cancel_futures": True})
            shutdown.start()
            shutdown.join(EXIT_SECONDS)
            if shutdown.is_alive():
                for process in self.started_processes():
                    process.kill()
            shutdown.join()


class _RecordingContext:
    """A context of :mod:`multiprocessing` that records the processes made with it."""

    def __init__(self, context: Any) -> None:
        self._context = context
        self.processes: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def Process(self, *args: Any, **kwargs: Any) -> Any:  # noqa: N802 - as in multiprocessing
        process = self._context.Process(*args, **kwargs)
        self.processes.append(process)
        return process


_shared: dict[str, Any] = {}  # in a worker: the numbers shared with its parent process


def _begin(first_runs: Any, counts: Any, niceness: int) -> None:
    _shared.update(first_runs=first_runs, counts=counts)
    if niceness and hasattr(os, "nice"):
        os.nice(niceness)
    begin_worker()


def _work(job: Job, channel: int, run: int) -> JobResult:
    heartbeat = make_heartbeat(job, channel, run, _shared["first_runs"], _shared["counts"])
    return do_job_in_process(job, heartbeat)


_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""Environment variables that limit the threads of linear algebra."""

_LONGEST_FOLDER = 70
"""Maximum bytes of the temporary folder's path; a socket's is longer by 32 and limited to 103."""


def process_context(preload: Sequence[str]) -> Any:
    """Choose how processes are started; ``preload``: modules to import, if possible only once."""
    # A process forked from one with threads copies locks that no thread will ever release. Workers
    # are therefore forked from a server without threads, or spawned if there is none.
    has_server = "forkserver" in get_all_start_methods() and _socket_path_fits()
    method = "forkserver" if has_server else "spawn"
    context: Any = get_context(method)
    if method == "forkserver":
        context.set_forkserver_preload(list(preload))
    return context


def _socket_path_fits() -> bool:
    """Return whether the path of a server's socket in the temporary folder is short enough."""
    return len(os.fsencode(tempfile.gettempdir())) <= _LONGEST_FOLDER


@contextmanager
def prepare_start() -> Iterator[None]:
    """Prepare the start of workers within the context.

    They do linear algebra in one thread, and Ctrl-C never reaches them. This process handles Ctrl-C
    only after all workers have started, because an interrupted start would leave workers that
    nothing ends.
    """
    with delay_interrupts(), _block_interrupts(), _limit_threads():
        yield


@contextmanager
def delay_interrupts() -> Iterator[None]:
    """Delay Ctrl-C to the end of the context; it only ever reaches the main thread."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    received: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _frame: received.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if received:
            signal.raise_signal(signal.SIGINT)


@contextmanager
def _block_interrupts() -> Iterator[None]:
    """Block Ctrl-C in processes started within the context, which inherit this thread's mask."""
    if sys.platform == "win32":
        yield
        return
    _start_resource_tracker()
    mask_before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask_before)


def _start_resource_tracker() -> None:
    """Start Python's process that removes the semaphores of a program that was killed.

    Otherwise the first worker would start it, which would unblock Ctrl-C again, and it would print
    a warning about each semaphore.
    """
    from multiprocessing import resource_tracker

    quiet = "ignore:resource_tracker:UserWarning"
    sys.warnoptions.append(quiet)  # options with which Python starts its own processes
    try:
        resource_tracker.ensure_running()
    finally:
        sys.warnoptions.remove(quiet)


@contextmanager
def _limit_threads() -> Iterator[None]:
    """Limit linear algebra to one thread in processes started within the context."""
    values_before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in values_before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def begin_worker() -> None:
    """Prepare a worker so that only its parent ends it, if necessary by ending itself."""
    # Ctrl-C reaches all processes of a terminal; the parent handles it for all.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when the parent has ended, even if it was killed."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
