"""Of each kind of work the newest request wins, in the order of ranks, and no loss is silent."""

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Future
from typing import Any

import pytest
from pytestqt.qtbot import QtBot
from worker_calls import count_for_ever, echo, fail, process_id

from occ_gui.background.crew import Crew, Lane
from occ_gui.background.parcel import Outcome, Parcel, Stage, Stages, Task
from occ_gui.background.worker_processes import WorkerProcesses

PATIENCE_S = 10.0
PRELOAD = "worker_calls"


def stages_of(*values: Any, rank: int = 0, stays: bool = False) -> Stages:
    return lambda: [Stage(rank, tuple(Parcel(echo, (v,)) for v in values), stays)]


class HeldWorkers:
    """Workers that do what they are given when they are told to."""

    count = 1

    def __init__(self) -> None:
        self.waiting: list[tuple[Task, Future[Outcome]]] = []
        self.abandoned: list[tuple[int, int]] = []
        self.renewed = self.closed = 0

    def submit(self, task: Task) -> "Future[Outcome]":
        future: Future[Outcome] = Future()
        self.waiting.append((task, future))
        return future

    def answer(self) -> None:
        """Do the first task that waits."""
        deadline = time.monotonic() + PATIENCE_S
        while not self.waiting:
            assert time.monotonic() < deadline
            time.sleep(0.001)
        task, future = self.waiting.pop(0)
        future.set_result(Outcome(task.parcel.arguments[0]))

    def abandon(self, lane: int, run: int) -> None:
        self.abandoned.append((lane, run))

    def counted(self, slot: int) -> int:
        return 0

    def renew(self) -> None:
        self.renewed += 1

    def close(self) -> None:
        self.closed += 1


class Heard:
    """All that a lane tells."""

    def __init__(self, lane: Lane) -> None:
        self.results: list[tuple[Any, Any]] = []
        self.finished: list[Any] = []
        self.failures: list[str] = []
        self.said: list[str] = []
        lane.came.connect(lambda request, found: self.results.extend((request, f) for f in found))
        lane.finished.connect(self.finished.append)
        lane.failed.connect(self.failures.append)
        lane.said.connect(self.said.append)


@pytest.fixture
def crew_of(qtbot: QtBot) -> Iterator[Callable[..., Crew]]:
    crews: list[Crew] = []

    def make(workers: Any, lanes: int = 1) -> Crew:
        crews.append(Crew(lanes, lambda: workers))
        return crews[-1]

    yield make
    for crew in crews:
        crew.stop()


def test_all_results_come_and_then_the_end(
    qtbot: QtBot, crew_of: Callable[..., Crew], inline_workers: Any
) -> None:
    (lane,) = crew_of(inline_workers).lanes
    heard = Heard(lane)
    lane.put("request", lambda: [*stages_of(1, 2)(), *stages_of(3)()])
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results == [("request", 1), ("request", 2), ("request", 3)]
    assert heard.finished == ["request"]


def test_a_newer_request_abandons_the_one_at_work(
    qtbot: QtBot, crew_of: Callable[..., Crew]
) -> None:
    workers = HeldWorkers()
    (lane,) = crew_of(workers).lanes
    heard = Heard(lane)
    lane.put("old", stages_of("a", "b", "c", "d"))
    workers.answer()
    lane.put("new", stages_of("x"))
    qtbot.waitUntil(lambda: (0, 2) in workers.abandoned)
    for _ in range(3):
        workers.answer()
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results[-1] == ("new", "x")
    assert ("old", "c") not in heard.results
    assert heard.finished == ["new"]


def test_a_stage_that_stays_is_ended_before_a_newer_request_and_what_follows_it_is_not(
    qtbot: QtBot, crew_of: Callable[..., Crew]
) -> None:
    workers = HeldWorkers()
    (lane,) = crew_of(workers).lanes
    heard = Heard(lane)
    lane.put("old", lambda: [*stages_of("a", "b", "c", stays=True)(), *stages_of("fine")()])
    workers.answer()
    lane.put("passed over", stages_of("y", stays=True))
    lane.put("new", stages_of("x", stays=True))
    for _ in range(3):
        workers.answer()
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results == [("old", "a"), ("old", "b"), ("old", "c"), ("new", "x")]


def test_the_lowest_rank_of_all_lanes_goes_first(
    qtbot: QtBot, crew_of: Callable[..., Crew], inline_workers: Any
) -> None:
    one, other = crew_of(inline_workers, 2).lanes
    done: list[Any] = []
    gate = threading.Event()

    def late() -> list[Stage]:
        gate.wait(PATIENCE_S)  # until both have been asked for
        return list(stages_of("late", rank=5)())

    one.put("one", late)
    other.put("other", stages_of("soon", rank=1))
    gate.set()
    for lane in (one, other):
        lane.came.connect(lambda _, found: done.extend(found))
    qtbot.waitUntil(lambda: one.is_idle and other.is_idle)
    assert sorted(done) == ["late", "soon"]
    ranked = [task.parcel.arguments[0] for task in inline_workers.tasks]
    assert set(ranked) == {"late", "soon"}


def test_after_cancelling_nothing_arrives(qtbot: QtBot, crew_of: Callable[..., Crew]) -> None:
    workers = HeldWorkers()
    (lane,) = crew_of(workers).lanes
    heard = Heard(lane)
    lane.put("request", stages_of("a", "b"))
    qtbot.waitUntil(lambda: len(workers.waiting) == 2)
    lane.cancel()
    workers.answer()
    assert lane.is_idle
    qtbot.wait(30)
    assert (heard.results, heard.finished) == ([], [])


def test_a_mistake_in_the_work_is_said_and_the_next_request_is_done(
    qtbot: QtBot, crew_of: Callable[..., Crew], inline_workers: Any
) -> None:
    (lane,) = crew_of(inline_workers).lanes
    heard = Heard(lane)
    lane.put("bad", lambda: [Stage(0, (Parcel(fail, ("luck",)),))])
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.failures == ["The work in the background failed: ValueError: no luck."]
    lane.put("good", stages_of(1))
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results == [("good", 1)]


def test_workers_that_keep_dying_are_said_to(qtbot: QtBot, crew_of: Callable[..., Crew]) -> None:
    class Dying(HeldWorkers):
        def submit(self, task: Task) -> "Future[Outcome]":
            future: Future[Outcome] = Future()
            future.set_exception(BrokenExecutor("gone"))
            return future

    workers = Dying()
    (lane,) = crew_of(workers).lanes
    heard = Heard(lane)
    lane.put("request", stages_of(1))
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.failures == ["Processes in the background ended 3 times without a result."]
    assert workers.renewed == 3


def test_a_killed_process_is_replaced_and_its_work_done_again(
    qtbot: QtBot, crew_of: Callable[..., Crew]
) -> None:
    workers = WorkerProcesses(2, PRELOAD)
    (lane,) = crew_of(workers).lanes
    heard = Heard(lane)
    lane.put("request", lambda: [Stage(0, tuple(Parcel(process_id, ()) for _ in range(12)))])
    qtbot.waitUntil(lambda: bool(heard.results), timeout=20_000)
    os.kill(heard.results[0][1], signal.SIGKILL)
    qtbot.waitUntil(lambda: lane.is_idle, timeout=20_000)
    assert heard.failures == []
    assert heard.said == ["A process in the background ended; its work is done again."]
    assert len(heard.results) == 12
    assert len({found for _, found in heard.results}) > 2


def test_stopping_ends_the_processes_whatever_they_are_at(
    qtbot: QtBot, crew_of: Callable[..., Crew]
) -> None:
    workers = WorkerProcesses(2, PRELOAD)
    crew = crew_of(workers)
    (lane,) = crew.lanes
    lane.put("request", lambda: [Stage(0, (Parcel(count_for_ever, (), 3),))])
    qtbot.waitUntil(lambda: crew.counted(3) > 0, timeout=20_000)
    processes = workers.processes
    assert processes
    crew.stop()
    for number in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(number, 0)


def test_work_that_nobody_waits_for_ends_at_its_next_pulse(
    qtbot: QtBot, crew_of: Callable[..., Crew]
) -> None:
    workers = WorkerProcesses(1, PRELOAD)
    crew = crew_of(workers)
    (lane,) = crew.lanes
    heard = Heard(lane)
    lane.put("endless", lambda: [Stage(0, (Parcel(count_for_ever, (), 3),))])
    qtbot.waitUntil(lambda: crew.counted(3) > 0, timeout=20_000)
    lane.put("short", stages_of("done"))
    qtbot.waitUntil(lambda: lane.is_idle, timeout=20_000)
    assert heard.results == [("short", "done")]
