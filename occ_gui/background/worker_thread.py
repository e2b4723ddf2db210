"""The thread that a worker lives on, which begins with its first work."""

from PySide6.QtCore import QObject, QThread

from occ_model import plugins

PATIENCE_MS = 2000  # how long the ends of all threads together wait for plug-ins

_LOOK_MS = 50

_left: list[QThread] = []
"""Threads whose plug-in does not come back: Qt would abort the process if one were deleted."""


class WorkerThread:
    """A thread for one worker: much that could be worked on never is, and needs no thread."""

    _waited_ms = 0

    def __init__(self, worker: QObject, name: str) -> None:
        self._thread = QThread()
        self._thread.setObjectName(name)
        self._may_begin = True
        worker.moveToThread(self._thread)

    def begin(self) -> None:
        """Start the thread before the first work; not again once it was ended."""
        if self._may_begin:
            self._may_begin = False
            self._thread.start()

    def end(self) -> None:
        """Wait for the running work, and end the thread.

        Our own work always comes to its end; a plug-in's need not, and is left behind.
        """
        self._may_begin = False
        self._thread.quit()
        while not self._thread.wait(_LOOK_MS):
            WorkerThread._waited_ms += _LOOK_MS if plugins.all_at_work() else 0
            if WorkerThread._waited_ms >= PATIENCE_MS and plugins.all_at_work():
                _left.append(self._thread)
                return
