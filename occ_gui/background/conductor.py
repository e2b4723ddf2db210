"""Who hands out parcels: a thread that is told by messages and never waits for one parcel."""

import threading
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Future
from dataclasses import dataclass, field
from queue import SimpleQueue
from time import monotonic
from typing import Any, Protocol

from occ_gui.background.failure import sentence_of
from occ_gui.background.parcel import Outcome, Parcel, Stage, Stages, Task, Workers
from occ_gui.background.worker_thread import WorkerThread
from occ_model.errors import one_line
from occ_model.parallel.processes import NO_PROCESSES

_AHEAD = 2
"""Parcels in flight to a worker: one at work, and one that it can go on with."""

_LULL = 0.05
"""Seconds between two deliveries of a lane, so that the window can keep up with them."""

_LONG_LULL = 0.3
"""The same while a stage is under way that would rather be shown whole."""

_TRIES = 3
"""How often workers may die one after the other with nothing done in between."""


class Listener(Protocol):
    """Who is told what comes of the work; called on the conductor's thread."""

    def came(self, lane: int, run: int, results: list[Any]) -> None:
        """Take results of a run."""

    def finished(self, lane: int, run: int) -> None:
        """Take note that no more comes of a run."""

    def failed(self, lane: int, run: int, sentence: str) -> None:
        """Take note that no more comes of a run, and why."""

    def said(self, lane: int, run: int, sentence: str) -> None:
        """Take note of what happened on the way."""


@dataclass(eq=False, slots=True)
class _Leg:
    """A stage under way."""

    stage: Stage
    waiting: deque[Parcel]
    flying: int = 0

    @property
    def is_done(self) -> bool:
        return not (self.waiting or self.flying)


@dataclass(eq=False, slots=True)
class Run:
    """Work on one request of a lane."""

    lane: int
    number: int
    stages: Stages
    legs: list[_Leg] = field(default_factory=list)
    coming: Iterator[Stage] | None = None
    batch: list[Any] = field(default_factory=list)

    def next_leg(self) -> _Leg | None:
        """Give the stage whose parcel is next, None where all are on their way or done."""
        if self.coming is None:
            self.coming = iter(self.stages())
        while not any(leg.waiting for leg in self.legs):
            stage = next(self.coming, None)
            if stage is None:
                return None
            if stage.parcels:
                self.legs.append(_Leg(stage, deque(stage.parcels)))
        return next(leg for leg in self.legs if leg.waiting)

    @property
    def stays(self) -> bool:
        """Whether it is at a stage that is to be ended."""
        return any(leg.stage.stays for leg in self.legs)


class Conductor(threading.Thread):
    """Keeps the workers busy with the lanes' parcels, those of the lowest rank first.

    Parameters
    ----------
    start
        Starts the workers; called when there is work for the first time.
    listener
        Who is told.
    """

    def __init__(self, start: Callable[[], Workers], listener: Listener) -> None:
        super().__init__(name="conductor", daemon=True)
        self._start_workers = start
        self._listener = listener
        self._inbox: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.workers: Workers | None = None
        self._runs: dict[int, Run] = {}
        self._pending: dict[int, Run] = {}
        self._flying: dict[Future[Outcome], tuple[Run, _Leg, Parcel]] = {}
        self._told: dict[int, float] = {}
        self._lost = False
        self._losses = 0

    def put(self, run: Run) -> None:
        """Ask for work; what the lane is at is abandoned, or ended first where it must be."""
        self._inbox.put(lambda: self._take(run))

    def cancel(self, lane: int, run: int) -> None:
        """Let go of all runs of a lane that are earlier than ``run``."""
        self._inbox.put(lambda: self._drop(lane, run))

    def close(self) -> None:
        """Let go of everything, end the workers and then the thread."""
        self._inbox.put(None)

    def run(self) -> None:
        """Do what the messages say, until there is one that says no more."""
        try:
            while (message := self._inbox.get()) is not None:
                message()
                self._fill()
        finally:
            if self.workers is not None:
                for lane, run in self._runs.items():
                    self.workers.abandon(lane, run.number + 1)
                self.workers.close()

    def _take(self, run: Run) -> None:
        now = self._runs.get(run.lane)
        if now is not None and now.stays:
            self._pending[run.lane] = run
            return
        self._begin(run)

    def _begin(self, run: Run) -> None:
        self._drop(run.lane, run.number)
        self._runs[run.lane] = run
        self._inbox.put(lambda: None)  # whoever is choosing parcels has looked at it before

    def _drop(self, lane: int, number: int) -> None:
        for runs in (self._runs, self._pending):
            if lane in runs and runs[lane].number < number:
                del runs[lane]
        if self.workers is not None:
            self.workers.abandon(lane, number)

    def _fill(self) -> None:
        """Send parcels until there are enough in flight."""
        while not self._lost and (chosen := self._next()) is not None:
            run, leg = chosen
            try:
                if self.workers is None:
                    self.workers = self._new_workers(run)
                if len(self._flying) >= _AHEAD * self.workers.count:
                    return
                parcel = leg.waiting.popleft()
                future = self.workers.submit(Task(run.lane, run.number, parcel))
            except BrokenExecutor:
                leg.waiting.appendleft(parcel)
                self._lost = True
                self._recover()
                return
            except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
                self._fail(run, sentence_of(error, "work in the background", run.number))
                continue
            leg.flying += 1
            self._flying[future] = (run, leg, parcel)
            future.add_done_callback(lambda done: self._inbox.put(lambda: self._land(done)))

    def _new_workers(self, run: Run) -> Workers:
        """Start the workers, or a thread where there are no processes to be had."""
        try:
            return self._start_workers()
        except NO_PROCESSES as error:
            self._listener.said(run.lane, run.number, _alone(error))
            return WorkerThread()

    def _next(self) -> tuple[Run, _Leg] | None:
        """Choose the run whose parcel goes next, and end those that have none left."""
        ready = []
        for run in list(self._runs.values()):
            try:
                leg = run.next_leg()
            except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
                self._fail(run, sentence_of(error, "work in the background", run.number))
                continue
            if leg is not None:
                if not (run.lane in self._pending and not leg.stage.stays):
                    ready.append((run, leg))
            elif all(each.is_done for each in run.legs):
                self._end(run)
        chosen = min(ready, key=lambda pair: pair[1].stage.rank, default=None)
        # What somebody waits for is not delayed by what would only fill a gap behind it.
        if chosen is not None and any(
            leg.stage.rank < chosen[1].stage.rank
            for run in self._runs.values()
            for leg in run.legs
            if leg.stage.stays
        ):
            return None
        return chosen

    def _land(self, future: "Future[Outcome]") -> None:
        run, leg, parcel = self._flying.pop(future)
        leg.flying -= 1
        wanted = self._runs.get(run.lane) is run
        try:
            outcome = future.result()
        except (BrokenExecutor, CancelledError):
            self._lost = True
            leg.waiting.appendleft(parcel)
        except Exception as error:  # noqa: BLE001 - the window must outlive a mistake of ours
            if wanted:
                self._fail(run, sentence_of(error, "work in the background", parcel))
        else:
            self._losses = 0
            if wanted and not outcome.abandoned:
                run.batch.append(outcome.result)
                self._progress(run, leg)
        if self._lost:
            self._recover()

    def _progress(self, run: Run, leg: _Leg) -> None:
        # A stage that stays is short: it is worth waiting for the whole of it.
        lull = _LONG_LULL if leg.stage.stays else _LULL
        if leg.is_done or monotonic() - self._told.get(run.lane, 0.0) >= lull:
            self._tell(run)
        if leg.is_done:
            run.legs.remove(leg)
            if run.lane in self._pending and not run.stays:
                self._begin(self._pending.pop(run.lane))

    def _tell(self, run: Run) -> None:
        if run.batch:
            self._told[run.lane] = monotonic()
            self._listener.came(run.lane, run.number, run.batch)
            run.batch = []

    def _end(self, run: Run) -> None:
        self._tell(run)
        del self._runs[run.lane]
        self._listener.finished(run.lane, run.number)

    def _fail(self, run: Run, sentence: str) -> None:
        self._drop(run.lane, run.number + 1)
        self._listener.failed(run.lane, run.number, sentence)
        if run.lane in self._pending:
            self._begin(self._pending.pop(run.lane))

    def _recover(self) -> None:
        """Replace workers that died, once all that they had is back."""
        if self._flying or self.workers is None:
            return
        self._lost = False
        self._losses += 1
        said = "A process in the background ended; its work is done again."
        try:
            self.workers.renew()
        except NO_PROCESSES as error:
            self.workers, said = WorkerThread(), _alone(error)
        for run in list(self._runs.values()):
            if self._losses >= _TRIES:
                self._fail(
                    run, f"Processes in the background ended {_TRIES} times without a result."
                )
            else:
                self._listener.said(run.lane, run.number, said)


def _alone(error: Exception) -> str:
    """Say that there are no processes, and what is done about it."""
    return (
        f"No processes can be started ({one_line(str(error))}): the window does their work "
        "itself, and answers more slowly meanwhile."
    )
