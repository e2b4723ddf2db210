"""Process pool: worker processes that do jobs, and are replaced when they die."""

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
    counting_heartbeat,
    do_job_apart,
)

EXIT_SECONDS = 0.2  # seconds that processes get to end by themselves


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
        self._executor = self.start()

    def start(self) -> ProcessPoolExecutor:
        self._context.processes.clear()
        shared = (self._first_runs, self._counts, self._niceness)
        context: Any = self._context
        with worker_start():
            return ProcessPoolExecutor(self.count, context, _begin, shared)

    @property
    def processes(self) -> list[int]:
        return [process.pid for process in self.started()]

    def started(self) -> list[Any]:
        return [process for process in self._context.processes if process.pid is not None]

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        """Queue a job; the first one starts the processes."""
        with worker_start():
            return self._executor.submit(_work, job, channel, run)

    def abandon(self, channel: int, run: int) -> None:
        self._first_runs[channel] = run

    def counted(self, counter: int) -> int:
        return int(self._counts[counter])

    def renew(self) -> None:
        self.close()
        self._executor = self.start()

    def close(self) -> None:
        with interrupts_held():
            # It returns when all processes have ended, and some of them must be killed for that. It
            # waits for them alone: of two that wait for a process one misses its exit code.
            shutdown = Thread(target=self._executor.shutdown, kwargs={"cancel_futures": True})
            shutdown.start()
            shutdown.join(EXIT_SECONDS)
            if shutdown.is_alive():
                for process in self.started():
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


_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""Environment variables that limit the threads of linear algebra."""

_LONGEST_FOLDER = 70
"""Bytes of a temporary folder's path. The path of a server's socket in it is 32 bytes longer, and
may have at most 103 bytes on macOS and 107 on Linux."""


_FILES_OF_SERVER, _FILES_OF_WORKER = 16, 4
"""Files that processes need open, with twice as many for each as it was seen to need."""


def process_context(preload: Sequence[str]) -> Any:
    """Choose how processes are started; ``preload``: what they import, if possible only once."""
    # A process forked from one with threads copies locks that no thread will ever release. So it
    # is forked from a server without threads, or started anew where there is no such server.
    has_server = "forkserver" in get_all_start_methods() and _socket_path_fits()
    method = "forkserver" if has_server else "spawn"
    context: Any = get_context(method)
    if method == "forkserver":
        context.set_forkserver_preload(list(preload))
    return context


def check_open_files(workers: int) -> None:
    """Refuse to start processes that would die half-way, as this one may open too few files."""
    opened: list[int] = []
    try:
        for _ in range(_FILES_OF_SERVER + _FILES_OF_WORKER * workers):
            opened.append(os.open(os.devnull, os.O_RDONLY))  # noqa: PERF401 - closed also half-way
    except OSError as error:
        raise OSError(f"{workers} of them need more open files than are allowed") from error
    finally:
        for each in opened:
            os.close(each)


def _socket_path_fits() -> bool:
    """Return whether the path of a server's socket in the temporary folder is short enough."""
    try:
        return len(os.fsencode(tempfile.gettempdir())) <= _LONGEST_FOLDER
    except OSError:  # there is none that can be written to
        return False


@contextmanager
def worker_start() -> Iterator[None]:
    """Prepare the start of workers within the context.

    They do linear algebra in one thread, and Ctrl-C never reaches them. In this process it is
    answered when all are started: an interrupted start would leave workers that nothing ends.
    """
    with interrupts_held(), _interrupts_blocked(), _single_threads():
        yield


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Answer Ctrl-C at the end of the context; it only ever reaches the main thread."""
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
def _interrupts_blocked() -> Iterator[None]:
    """Block Ctrl-C in processes started meanwhile, which inherit this thread's signal mask."""
    if sys.platform == "win32":
        yield
        return
    _start_resource_tracker()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _start_resource_tracker() -> None:
    """Start Python's process that removes the semaphores of a program that was ended by force.

    The first worker would start it, and that would unblock Ctrl-C again; and it would warn of each
    semaphore on standard error.
    """
    from multiprocessing import resource_tracker

    quiet = "ignore:resource_tracker:UserWarning"
    sys.warnoptions.append(quiet)  # what Python's own processes are started with
    try:
        resource_tracker.ensure_running()
    finally:
        sys.warnoptions.remove(quiet)


@contextmanager
def _single_threads() -> Iterator[None]:
    """Limit linear algebra to one thread in processes started meanwhile."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def begin_worker() -> None:
    """Prepare a worker: only its parent ends it, also by its own end."""
    # Ctrl-C reaches all processes of a terminal; the parent answers it for all.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End when the parent has ended, also where it was killed and could not end its workers."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
