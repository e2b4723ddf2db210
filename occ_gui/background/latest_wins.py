"""Work off the window's thread: the newest request wins, and every finished result is shown."""

from collections.abc import Callable
from threading import Event
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QObject, Qt, Signal, Slot

from occ_gui.background.failure import sentence_of
from occ_gui.background.worker_thread import WorkerThread
from occ_model.errors import OccError

Request = TypeVar("Request")
Result = TypeVar("Result")


class Superseded(Exception):  # noqa: N818 - no error: a newer request is there
    """Ends work whose result is not needed any more; nothing is reported of it."""


class LatestWins(QObject, Generic[Request, Result]):
    """Runs one function on a thread of its own, for one request at a time.

    A request that comes while another is at work waits; a newer one takes its place. The running
    one goes on: cancelling it at every move of a slider would show nothing until the slider stops.
    Work that has shown something already may end itself: see :meth:`give_way`.

    Parameters
    ----------
    work
        The function: a request in, a result out. It must not touch a widget.
    name
        What it does, for the thread's name and the log.
    """

    finished = Signal(object)
    """A result."""

    failed = Signal(str)
    """A sentence that says why there is none."""

    failed_for = Signal(str, object)
    """The same, and the names of the parameters that it is about."""

    idle = Signal()
    """Nothing is at work or waiting."""

    _ask = Signal(object)

    def __init__(self, work: Callable[[Request], Result], name: str) -> None:
        super().__init__()
        self._busy = False
        self._stopped = False
        self._waiting: tuple[Request] | None = None
        self._newer = Event()
        self._worker = _Worker(work, name)
        self._thread = WorkerThread(self._worker, name)
        self._ask.connect(self._worker.run, Qt.ConnectionType.QueuedConnection)
        self._worker.done.connect(self._on_done, Qt.ConnectionType.QueuedConnection)

    @property
    def is_idle(self) -> bool:
        """Whether nothing is at work or waiting."""
        return not self._busy

    @property
    def is_stopped(self) -> bool:
        """Whether it was stopped: what the work has emitted before may still be waiting."""
        return self._stopped

    def submit(self, request: Request) -> None:
        """Ask for a result; a request still waiting is forgotten."""
        if self._busy:
            self._waiting = (request,)
            self._newer.set()
            return
        self._busy = True
        self._newer.clear()
        self._thread.begin()
        self._ask.emit(request)

    def give_way(self, seconds: float = 0.0) -> None:
        """End the running work if a newer request waits, or comes within some seconds.

        To be called by the work itself, on its thread.

        Raises
        ------
        Superseded
            There is one.
        """
        if self._newer.wait(seconds):
            raise Superseded

    def stop(self) -> None:
        """Let the running work end and stop the thread; nothing arrives any more."""
        self._waiting = None
        self._stopped = True
        self._newer.set()
        self._thread.end()

    @Slot(object, str, object)
    def _on_done(self, result: Any, failure: str, parameters: tuple[str, ...]) -> None:
        if self._stopped:  # what would show it is being closed
            return
        self._busy = False
        # The next request goes to work before this result is drawn: both cores are then busy.
        if self._waiting is not None:
            (request,) = self._waiting
            self._waiting = None
            self.submit(request)
        if isinstance(result, Superseded):
            pass
        elif failure:
            self.failed.emit(failure)
            self.failed_for.emit(failure, parameters)
        else:
            self.finished.emit(result)
        if not self._busy:
            self.idle.emit()


class _Worker(QObject):
    """The part that lives on the other thread."""

    done = Signal(object, str, object)

    def __init__(self, work: Callable[[Any], Any], name: str) -> None:
        super().__init__()
        self._work = work
        self._name = name

    @Slot(object)
    def run(self, request: Any) -> None:
        result, failure = None, ""
        parameters: tuple[str, ...] = ()
        try:
            result = self._work(request)
        except Superseded as reason:
            result = reason
        except Exception as error:  # noqa: BLE001 - the window must outlive any error
            failure = sentence_of(error, self._name, request)
            parameters = error.parameters if isinstance(error, OccError) else ()
        self.done.emit(result, failure, parameters)
