"""Runs on a thread of their own, of which only the newest is wanted."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, QThread, Signal, Slot

from occ_gui.background.failure import sentence_of

_NOTHING = 0
"""The number of no run."""


class Cancelled(Exception):  # noqa: N818 - no error: the user wanted it
    """Ends work that nobody waits for any more."""


class SingleRun(QObject):
    """Runs a function on a thread of its own.

    One run at a time: starting another cancels the one before. A cancelled run ends where it next
    tells something, and nothing of it arrives any more.

    Parameters
    ----------
    work
        The function: a request and whom to tell of what there is so far in, a result out. Telling
        ends the work by raising. It must not touch a widget.
    name
        What it is, for the thread's name and the log.
    """

    failed = Signal(str)
    """A sentence that says why nothing more comes of the run."""

    _ask = Signal(int, object)

    def __init__(self, work: Callable[[Any, Callable[[Any], None]], Any], name: str) -> None:
        super().__init__()
        self._started = _NOTHING
        self._worker = _Worker(work, name)
        self._thread = QThread()
        self._thread.setObjectName(name)
        self._worker.moveToThread(self._thread)
        queued = Qt.ConnectionType.QueuedConnection
        self._ask.connect(self._worker.run, queued)
        self._worker.told.connect(self._on_told, queued)
        self._worker.ended.connect(self._on_ended, queued)
        self._thread.start()

    @property
    def is_running(self) -> bool:
        """Whether something is still to come."""
        return self._worker.wanted != _NOTHING

    def start(self, request: Any) -> None:
        """Begin a run; the one before is cancelled."""
        self._started += 1
        self._worker.wanted = self._started
        self._ask.emit(self._started, request)

    def cancel(self) -> None:
        """Let nothing of the run arrive any more, and the run end as soon as it can."""
        self._worker.wanted = _NOTHING

    def stop(self) -> None:
        """Cancel, and stop the thread once the run has ended."""
        self.cancel()
        self._thread.quit()
        self._thread.wait()

    def _take(self, told: Any) -> None:
        """Hand on what the wanted run told."""
        raise NotImplementedError

    def _succeed(self, result: Any) -> None:
        """Hand on the wanted run's result."""
        raise NotImplementedError

    @Slot(int, object)
    def _on_told(self, run: int, told: Any) -> None:
        if run == self._worker.wanted:
            self._take(told)

    @Slot(int, object, str)
    def _on_ended(self, run: int, result: Any, failure: str) -> None:
        if run != self._worker.wanted:
            return
        self._worker.wanted = _NOTHING
        if failure:
            self.failed.emit(failure)
        else:
            self._succeed(result)


class _Worker(QObject):
    """The part that lives on the other thread."""

    told = Signal(int, object)
    ended = Signal(int, object, str)

    def __init__(self, work: Callable[[Any, Callable[[Any], None]], Any], name: str) -> None:
        super().__init__()
        self._work = work
        self._name = name
        self.wanted = _NOTHING
        """The number of the run whose result is wanted: written on the window's thread only."""

    @Slot(int, object)
    def run(self, run: int, request: Any) -> None:
        def tell(something: Any) -> None:
            if run != self.wanted:
                raise Cancelled
            self.told.emit(run, something)

        if run != self.wanted:  # cancelled before it began
            return
        result, failure = None, ""
        try:
            result = self._work(request, tell)
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
            failure = sentence_of(error, self._name, request)
        self.ended.emit(run, result, failure)
