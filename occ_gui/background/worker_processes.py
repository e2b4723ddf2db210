"""Processes that work beside the window, with less claim to the processor than it has."""

import os
from concurrent.futures import Future, ProcessPoolExecutor
from time import monotonic
from typing import Any

from occ_gui.background.parcel import SLOTS, Outcome, Task, do_task
from occ_model.parallel.processes import begin_worker, process_context, worker_start

_NICENESS = 10
"""How far the processes stand back behind the window."""

_GRACE = 0.5
"""Seconds that processes get to end by themselves."""


class WorkerProcesses:
    """Processes that live until they are closed, and are started by the first task.

    Parameters
    ----------
    count
        How many.
    preload
        A module that they will need: what can be shared is imported only once.

    Raises
    ------
    OSError, ImportError or NotImplementedError
        The system has no processes to give.
    """

    def __init__(self, count: int, preload: str) -> None:
        self.count = count
        self._context = process_context([__name__, preload])
        # No locks: a process that dies with one in its hand would stop the others.
        self._floors = self._context.RawArray("q", SLOTS)
        self._counts = self._context.RawArray("q", SLOTS)
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
        with worker_start():
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


_shared: dict[str, Any] = {}
"""In a worker: the numbers that it shares with the window's process."""


def _begin(floors: Any, counts: Any) -> None:
    """Prepare a worker: it stands back behind the window, and ends with it."""
    _shared.update(floors=floors, counts=counts)
    if hasattr(os, "nice"):
        os.nice(_NICENESS)
    begin_worker()


def work(task: Task) -> Outcome:
    """Do a task in a worker."""
    return do_task(task, _shared["floors"], _shared["counts"])
