"""Worker processes: how they are started, and how they end with their parent."""

import os
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing import get_all_start_methods, get_context, parent_process
from typing import Any

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""What tells linear algebra how many threads it may start."""

_LONGEST_FOLDER = 70
"""Bytes of a temporary folder's path. A server's socket has a name of 32 bytes in it, and a path of
at most 103 bytes on macOS and 107 on Linux."""


def process_context(preload: Sequence[str]) -> Any:
    """Choose how processes are started.

    Parameters
    ----------
    preload
        Modules that they will need: where it can be shared it is imported only once.
    """
    # A forked process has the locks of threads that it does not have: only a server that has
    # none is forked, and where there is no such server a process starts from nothing.
    has_server = "forkserver" in get_all_start_methods() and _has_room_for_a_socket()
    method = "forkserver" if has_server else "spawn"
    context: Any = get_context(method)
    if method == "forkserver":
        context.set_forkserver_preload(list(preload))
    return context


def _has_room_for_a_socket() -> bool:
    """Say whether a server's socket can stand in the folder for temporary files."""
    try:
        return len(os.fsencode(tempfile.gettempdir())) <= _LONGEST_FOLDER
    except OSError:  # there is none that can be written to
        return False


@contextmanager
def worker_start() -> Iterator[None]:
    """Prepare the start of workers within the context.

    They do linear algebra in one thread, as they are many themselves, and Ctrl-C reaches them at no
    moment of their lives. Here it is answered when all are started: half of a start would leave
    workers that nobody knows.
    """
    with interrupts_held(), _interrupts_blocked(), _single_threads():
        yield


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Answer Ctrl-C at the end of the context; outside the main thread it does not come anyway."""
    answer = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(answer):
        yield
        return
    came: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _frame: came.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, answer)
        if came:
            signal.raise_signal(signal.SIGINT)


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Let processes started meanwhile have Ctrl-C blocked, as they have what this thread has."""
    if sys.platform == "win32":
        yield
        return
    # It would be started by the first process, and let Ctrl-C through again when it was.
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _single_threads() -> Iterator[None]:
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
