"""Work of several kinds that shares some processes, its results handed to the window's thread."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal, Slot

from occ_gui.background.conductor import Conductor, Run
from occ_gui.background.parcel import Stages, Workers


class Lane(QObject):
    """One kind of work: the newest request wins.

    What is at work is abandoned for it, but a stage that must be ended is ended first, so that
    something moves while requests keep coming.
    """

    came = Signal(object, list)
    """A request, and results of it: no more often than a window can be drawn."""

    finished = Signal(object)
    """The request of which no more comes."""

    failed = Signal(str)
    """A sentence that says why no more comes."""

    said = Signal(str)
    """A sentence on what happened on the way; the work goes on."""

    def __init__(self, crew: "Crew", number: int) -> None:
        super().__init__(crew)
        self._crew = crew
        self._number = number
        self._requests: dict[int, Any] = {}
        self._next = 1

    @property
    def is_idle(self) -> bool:
        """Whether nothing is to come."""
        return not self._requests

    def put(self, request: Any, stages: Stages) -> None:
        """Ask for work on a request, in place of what was asked for before."""
        run = Run(self._number, self._next, stages)
        self._requests[self._next] = request
        self._next += 1
        self._crew.conductor().put(run)

    def cancel(self) -> None:
        """Let nothing more arrive, and the work end as soon as it can."""
        if self._requests:
            self._requests.clear()
            self._crew.conductor().cancel(self._number, self._next)

    def _forget_before(self, run: int) -> None:
        for number in [number for number in self._requests if number < run]:
            del self._requests[number]

    def _take(self, run: int, results: list[Any]) -> None:
        if run in self._requests:
            self._forget_before(run)
            self.came.emit(self._requests[run], results)

    def _finish(self, run: int, failure: str) -> None:
        if run not in self._requests:
            return
        self._forget_before(run)
        request = self._requests.pop(run)
        if failure:
            self.failed.emit(failure)
        else:
            self.finished.emit(request)

    def _say(self, run: int, sentence: str) -> None:
        if run in self._requests:
            self.said.emit(sentence)


class Crew(QObject):
    """Lanes of work, and the processes that they share.

    Parameters
    ----------
    lanes
        How many kinds of work there are.
    start
        Starts the workers: called off the window's thread, when there is work for the first time.
    """

    _came = Signal(int, int, list)
    _ended = Signal(int, int, str)
    _said = Signal(int, int, str)

    def __init__(self, lanes: int, start: Callable[[], Workers]) -> None:
        super().__init__()
        self._start = start
        self._conductor: Conductor | None = None
        self._stopped = False
        self.lanes = tuple(Lane(self, number) for number in range(lanes))
        queued = Qt.ConnectionType.QueuedConnection
        self._came.connect(self._on_came, queued)
        self._ended.connect(self._on_ended, queued)
        self._said.connect(self._on_said, queued)

    def conductor(self) -> Conductor:
        """Give the thread that hands out the work; it starts when it is first asked for."""
        if self._conductor is None:
            self._conductor = Conductor(self._start, self)
            if not self._stopped:
                self._conductor.start()
        return self._conductor

    @property
    def workers(self) -> Workers | None:
        """Whoever does the work, None while there was none."""
        return None if self._conductor is None else self._conductor.workers

    def counted(self, slot: int) -> int:
        """Say how many pulses there were in a slot."""
        workers = self.workers
        return 0 if workers is None else workers.counted(slot)

    def stop(self) -> None:
        """Let go of all work and end the workers; nothing arrives any more."""
        if self._stopped:
            return
        self._stopped = True
        for lane in self.lanes:
            lane.cancel()
        if self._conductor is not None:
            self._conductor.close()
            self._conductor.join()

    def came(self, lane: int, run: int, results: list[Any]) -> None:
        """Pass results on to the window's thread."""
        self._came.emit(lane, run, results)

    def finished(self, lane: int, run: int) -> None:
        """Pass it on to the window's thread that a run is finished."""
        self._ended.emit(lane, run, "")

    def failed(self, lane: int, run: int, sentence: str) -> None:
        """Pass it on to the window's thread that a run has failed."""
        self._ended.emit(lane, run, sentence)

    def said(self, lane: int, run: int, sentence: str) -> None:
        """Pass a sentence on to the window's thread."""
        self._said.emit(lane, run, sentence)

    @Slot(int, int, list)
    def _on_came(self, lane: int, run: int, results: list[Any]) -> None:
        self.lanes[lane]._take(run, results)

    @Slot(int, int, str)
    def _on_ended(self, lane: int, run: int, failure: str) -> None:
        self.lanes[lane]._finish(run, failure)

    @Slot(int, int, str)
    def _on_said(self, lane: int, run: int, sentence: str) -> None:
        self.lanes[lane]._say(run, sentence)
