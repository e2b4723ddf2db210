"""Reports arrive one by one and in order; of a cancelled run nothing arrives any more."""

import threading
from collections.abc import Iterator

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.background.task import Report, Task

PATIENCE_S = 10.0


class Bench:
    """Work that yields an item when it is let, and a record of what became of it."""

    def __init__(self, qtbot: QtBot) -> None:
        self._qtbot = qtbot
        self._allowed = threading.Semaphore(0)
        self.at_work = threading.Event()
        self.made: list[object] = []
        self.items: list[object] = []
        self.ends: list[str] = []
        self.runner: Task[str, None] = Task(self._work, "test of the runner", impatient=True)
        self.runner.reported.connect(self.items.append)
        self.runner.finished.connect(lambda _: self.ends.append("finished"))
        self.runner.failed.connect(self.ends.append)

    def _work(self, request: str, report: Report) -> None:
        for number in range(3):
            self.at_work.set()
            assert self._allowed.acquire(timeout=PATIENCE_S)
            self.made.append(f"{request} {number}")
            report(f"{request} {number}")

    def allow(self, items: int = 1) -> None:
        self._allowed.release(items)

    def wait_for(self, items: int) -> None:
        self._qtbot.waitUntil(lambda: len(self.items) == items)

    def wait_for_end(self) -> None:
        self._qtbot.waitUntil(lambda: bool(self.ends))


@pytest.fixture
def bench(qtbot: QtBot) -> Iterator[Bench]:
    bench = Bench(qtbot)
    yield bench
    bench.allow(100)
    bench.runner.stop()


def test_items_arrive_in_order_each_as_it_comes_and_then_the_end(bench: Bench) -> None:
    bench.runner.ask("a")
    bench.allow()
    bench.wait_for(1)
    assert not bench.runner.is_idle
    assert bench.ends == []
    bench.allow(2)
    bench.wait_for_end()
    assert bench.items == ["a 0", "a 1", "a 2"]
    assert bench.ends == ["finished"]
    assert bench.runner.is_idle


@pytest.mark.parametrize("is_cancelled", [True, False])
def test_a_run_that_is_cancelled_or_replaced_ends_at_its_current_item(
    bench: Bench, is_cancelled: bool
) -> None:
    bench.runner.ask("a")
    bench.allow()
    bench.wait_for(1)
    if is_cancelled:
        bench.runner.cancel()
        assert bench.runner.is_idle
        bench.allow(1)
    bench.runner.ask("b")
    bench.allow(4)
    bench.wait_for_end()
    assert bench.items == ["a 0", "b 0", "b 1", "b 2"]
    assert bench.ends == ["finished"]
    assert [made for made in bench.made if str(made).startswith("a")] == ["a 0", "a 1"]


def test_an_item_in_flight_when_cancelled_is_not_delivered(bench: Bench) -> None:
    bench.allow(3)
    bench.runner.ask("a")
    while len(bench.made) < 3:  # without letting the window receive anything
        bench.at_work.wait(PATIENCE_S)
    bench.runner.cancel()
    QApplication.processEvents()
    assert bench.items == bench.ends == []
