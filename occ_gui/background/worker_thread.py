"""A thread that works where the system has no processes to give."""

import sys
from concurrent.futures import Future, ThreadPoolExecutor

from occ_gui.background.parcel import SLOTS, Outcome, Task, do_task


class WorkerThread:
    """A thread of the window's own process, started by the first task.

    It shares the processor with the window, which answers more slowly meanwhile.
    """

    count = 1

    def __init__(self) -> None:
        self._floors = [0] * SLOTS
        self._counts = [0] * SLOTS
        self._pool = ThreadPoolExecutor(1, "work")

    def submit(self, task: Task) -> "Future[Outcome]":
        """Hand over a task."""
        return self._pool.submit(do_task, task, self._floors, self._counts)

    def abandon(self, lane: int, run: int) -> None:
        """Let go of all runs of a lane that are earlier than ``run``."""
        self._floors[lane] = run

    def counted(self, slot: int) -> int:
        """Say how many pulses there were in a slot."""
        return self._counts[slot]

    def renew(self) -> None:
        """Go on: a thread does not die."""

    def close(self) -> None:
        """Let all tasks go, and end with the next pulse."""
        self._floors[:] = [sys.maxsize] * SLOTS
        self._pool.shutdown(cancel_futures=True)
