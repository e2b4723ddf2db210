"""Processes that work beside the window, with less claim to the processor than it has."""

import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_all_start_methods, get_context, parent_process
from time import monotonic
from typing import Any

from occ_gui.tasks.parcel import Abandoned, Outcome, Task

_SLOTS = 8
"""Lanes that there can be, and places to count pulses in."""

_NICENESS = 10
"""How far the processes stand back behind the window."""

_GRACE = 0.5
"""Seconds that processes get to end by themselves."""

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""What tells linear algebra how many threads it may start."""


class WorkerProcesses:
    """Processes that live until they are closed, and are started by the first task.

    Parameters
    ----------
    count
        How many.
    preload
        A module that they will need: what can be shared is imported only once.
    """

    def __init__(self, count: int, preload: str) -> None:
        self.count = count
        # A forked process has the locks of threads that it does not have: only a server that has
        # none is forked, and where there is no such server a process starts from nothing.
        method = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"
        self._context: Any = get_context(method)
        if method == "forkserver":
            self._context.set_forkserver_preload([__name__, preload])
        # No locks: a process that dies with one in its hand would stop the others.
        self._floors = self._context.RawArray("q", _SLOTS)
        self._counts = self._context.RawArray("q", _SLOTS)
        self._pool = self._start()

    def _start(self) -> ProcessPoolExecutor:
        shared = (self._floors, self._counts)
        return ProcessPoolExecutor(self.count, self._context, _begin, shared)

    @property
    def processes(self) -> list[int]:
        """The numbers of the processes that were started."""
        return list(self._pool._processes or {})

    def submit(self, task: Task) -> "Future[Outcome]":
        """Hand over a task."""
        with _single_threads():
            return self._pool.submit(work, task)

    def abandon(self, lane: int, run: int) -> None:
        """Let go of all runs of a lane that are earlier than ``run``."""
        self._floors[lane] = run

    def counted(self, slot: int) -> int:
        """Say how many pulses there were in a slot."""
        return int(self._counts[slot])

    def renew(self) -> None:
        """Start new processes in place of those that died."""
        self._end()
        self._pool = self._start()

    def close(self) -> None:
        """End the processes, whatever they are at."""
        self._end()

    def _end(self) -> None:
        processes = list((self._pool._processes or {}).values())
        manager: Any = self._pool._executor_manager_thread
        self._pool.shutdown(wait=False, cancel_futures=True)
        deadline = monotonic() + _GRACE
        for process in processes:
            process.join(max(0.0, deadline - monotonic()))
            if process.is_alive():
                process.kill()
                process.join()
        if manager is not None:
            manager.join()


@contextmanager
def _single_threads() -> Iterator[None]:
    """Let processes started meanwhile do linear algebra in one thread: they are many themselves."""
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


_shared: dict[str, Any] = {}
"""In a worker: the numbers that it shares with the window's process."""


def _begin(floors: Any, counts: Any) -> None:
    """Prepare a worker: it stands back behind the window, and ends with it."""
    _shared.update(floors=floors, counts=counts)
    # Ctrl-C reaches all processes of a terminal; the parent decides what becomes of it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(_NICENESS)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait for a parent that was killed: nobody else tells a worker that it is alone."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def work(task: Task) -> Outcome:
    """Do a task in a worker."""
    floors, counts = _shared["floors"], _shared["counts"]
    parcel = task.parcel

    def pulse() -> None:
        if floors[task.lane] > task.run:
            raise Abandoned
        counts[parcel.slot] += 1

    try:
        pulse()
        return Outcome(parcel.function(*parcel.arguments, pulse))
    except Abandoned:
        return Outcome(None, abandoned=True)
