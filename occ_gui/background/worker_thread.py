"""The thread that a worker lives on, which begins with its first work."""

from PySide6.QtCore import QObject, QThread


class WorkerThread:
    """A thread for one worker: much that could be worked on never is, and needs no thread.

    Parameters
    ----------
    worker
        What works on the thread, in slots that are called by queued signals.
    name
        What it does.
    """

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
        """Wait for the running work, and end the thread."""
        self._may_begin = False
        self._thread.quit()
        self._thread.wait()
