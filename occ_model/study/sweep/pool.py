"""Worker processes of a sweep's own."""

from concurrent.futures import Future, ProcessPoolExecutor
from time import monotonic

from occ_model.parallel.processes import (
    NO_PROCESSES,
    begin_worker,
    interrupts_held,
    process_context,
    worker_start,
)
from occ_model.study.sweep.points import Delivery, Parcel, measure_parcel

_GRACE = 0.2
"""Seconds that idle processes get to end by themselves."""


class OwnWorkers:
    """Processes that live as long as a sweep, and are started again when they die.

    Parameters
    ----------
    count
        How many.

    Raises
    ------
    OSError, ImportError or NotImplementedError
        The system has no processes to give.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self._pool = self._start()

    def _start(self) -> ProcessPoolExecutor:
        with worker_start():
            return ProcessPoolExecutor(self.count, process_context([__name__]), begin_worker)

    def submit(self, parcel: Parcel) -> "Future[Delivery]":
        """Hand over a parcel; the first ones start the processes."""
        with worker_start():
            return self._pool.submit(measure_parcel, parcel)

    def renew(self) -> bool:
        """Start new processes in place of those that died, where there are any to be had."""
        self.close()
        try:
            self._pool = self._start()
        except NO_PROCESSES:
            return False
        return True

    def close(self) -> None:
        """End the processes, whatever they are at."""
        with interrupts_held():
            processes = list((self._pool._processes or {}).values())
            self._pool.shutdown(wait=False, cancel_futures=True)
            deadline = monotonic() + _GRACE
            for process in processes:
                process.join(max(0.0, deadline - monotonic()))
                if process.is_alive():
                    process.terminate()
