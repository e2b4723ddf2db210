"""Worker processes of a sweep's own."""

import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_all_start_methods, get_context, parent_process
from time import monotonic

from occ_model.study.sweep_work import Delivery, Parcel, measure_parcel

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""What tells linear algebra how many threads it may start."""

_GRACE = 0.2
"""Seconds that idle processes get to end by themselves."""


class OwnWorkers:
    """Processes that live as long as a sweep, and are started again when they die.

    Parameters
    ----------
    count
        How many.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self._pool = self._start()

    def _start(self) -> ProcessPoolExecutor:
        # A forked process has the locks of threads that it does not have: only a server that has
        # none is forked, and where there is no such server a process starts from nothing.
        method = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"
        context = get_context(method)
        if method == "forkserver":
            context.set_forkserver_preload([__name__])
        return ProcessPoolExecutor(self.count, context, _begin)

    def submit(self, parcel: Parcel) -> "Future[Delivery]":
        """Hand over a parcel; the first ones start the processes."""
        with _single_threads():
            return self._pool.submit(measure_parcel, parcel)

    def renew(self) -> bool:
        """Start new processes in place of those that died."""
        self.close()
        self._pool = self._start()
        return True

    def close(self) -> None:
        """End the processes, whatever they are at."""
        processes = list((self._pool._processes or {}).values())
        self._pool.shutdown(wait=False, cancel_futures=True)
        deadline = monotonic() + _GRACE
        for process in processes:
            process.join(max(0.0, deadline - monotonic()))
            if process.is_alive():
                process.terminate()


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


def _begin() -> None:
    """Prepare a worker: it ends with its parent, and only by it."""
    # Ctrl-C reaches all processes of a terminal; the parent decides what becomes of it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait for a parent that was killed: nobody else tells a worker that it is alone."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
