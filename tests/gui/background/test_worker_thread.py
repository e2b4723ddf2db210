"""Where the system has no processes to give, a thread does their work, and that is said."""

import errno
import os
import signal
import time
from collections.abc import Iterator
from typing import Any

import pytest
from pytestqt.qtbot import QtBot
from worker_calls import count_for_ever, echo, process_id

from occ_gui.background.crew import Crew, Lane
from occ_gui.background.parcel import Parcel, Stage, Stages
from occ_gui.background.worker_processes import WorkerProcesses

START = "No processes can be started ("
END = "): the window does their work itself, and answers more slowly meanwhile."


def no_processes() -> Any:
    raise OSError(errno.EROFS, os.strerror(errno.EROFS))


def calls(*parcels: Parcel) -> Stages:
    return lambda: [Stage(0, parcels)]


class Heard:
    """What a lane tells."""

    def __init__(self, lane: Lane) -> None:
        self.results: list[Any] = []
        self.failures: list[str] = []
        self.said: list[str] = []
        lane.came.connect(lambda _, found: self.results.extend(found))
        lane.failed.connect(self.failures.append)
        lane.said.connect(self.said.append)


@pytest.fixture
def crew() -> Iterator[Crew]:
    crew = Crew(1, no_processes)
    yield crew
    crew.stop()


def test_the_work_is_done_all_the_same(qtbot: QtBot, crew: Crew) -> None:
    (lane,) = crew.lanes
    heard = Heard(lane)
    lane.put("request", calls(*(Parcel(echo, (value,)) for value in (1, 2, 3))))
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results == [1, 2, 3]
    assert heard.failures == []
    (sentence,) = heard.said
    assert sentence.startswith(START)
    assert sentence.endswith(END)


def test_what_nobody_waits_for_is_let_go_and_everything_in_the_end(
    qtbot: QtBot, crew: Crew
) -> None:
    (lane,) = crew.lanes
    heard = Heard(lane)
    lane.put("endless", calls(Parcel(count_for_ever, (), 3)))
    qtbot.waitUntil(lambda: crew.counted(3) > 0)
    lane.put("short", calls(Parcel(echo, ("done",))))
    qtbot.waitUntil(lambda: lane.is_idle)
    assert heard.results == ["done"]
    counted = crew.counted(3)
    lane.put("endless", calls(Parcel(count_for_ever, (), 3)))
    qtbot.waitUntil(lambda: crew.counted(3) > counted)
    crew.stop()
    counted = crew.counted(3)
    time.sleep(0.05)
    assert crew.counted(3) == counted


def test_it_takes_over_from_a_process_that_cannot_be_replaced(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    workers = WorkerProcesses(2, "worker_calls")
    monkeypatch.setattr(workers, "_start", no_processes)
    crew = Crew(1, lambda: workers)
    (lane,) = crew.lanes
    heard = Heard(lane)
    lane.put("request", calls(*(Parcel(process_id, ()) for _ in range(12))))
    qtbot.waitUntil(lambda: bool(heard.results), timeout=20_000)
    os.kill(heard.results[0], signal.SIGKILL)
    qtbot.waitUntil(lambda: lane.is_idle, timeout=20_000)
    crew.stop()
    assert heard.failures == []
    assert heard.said[0].startswith(START)
    assert heard.results[-1] == os.getpid()
    assert len(heard.results) == 12
