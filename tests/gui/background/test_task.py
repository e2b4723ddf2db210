"""The newest request wins, and every finished result of patient work is shown."""

import threading
import time
from collections.abc import Callable, Iterator

import pytest
from gui.kinds import collect
from gui.user import PATIENCE_S
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.background.task import Task, TaskReporter


class Bench:
    """Work that the test can hold up, and a record of its results."""

    def __init__(self) -> None:
        self.begun = threading.Event()
        self.go_on = threading.Event()
        self.go_on.set()
        self.worked_on: list[object] = []
        self.work_threads: set[int] = set()
        self.results: list[object] = []
        self.result_threads: set[int] = set()
        self.failures: list[str] = []
        self.task: Task[object, object] = Task(self._work, "test of the task")
        self.task.finished.connect(self._note_result)
        self.task.failed.connect(self.failures.append)

    def _work(self, request: object, report: TaskReporter) -> object:
        self.worked_on.append(request)
        self.work_threads.add(threading.get_ident())
        self.begun.set()
        assert self.go_on.wait(PATIENCE_S)
        if request == "gives way":
            report.give_way()
        if isinstance(request, Exception):
            raise request
        return f"result of {request}"

    def _note_result(self, result: object) -> None:
        self.results.append(result)
        self.result_threads.add(threading.get_ident())

    def ask_and_hold(self, request: object) -> None:
        self.begun.clear()
        self.go_on.clear()
        self.task.ask(request)
        assert self.begun.wait(PATIENCE_S)


@pytest.fixture
def bench(qtbot: QtBot) -> Iterator[Bench]:
    bench = Bench()
    yield bench
    bench.go_on.set()
    bench.task.stop()


@pytest.fixture
def finish(qtbot: QtBot, bench: Bench) -> Callable[[], None]:
    """Let the work go on, and wait until it has ended."""

    def let_go_and_wait() -> None:
        with qtbot.waitSignal(bench.task.idle):
            bench.go_on.set()

    return let_go_and_wait


def test_the_first_and_last_of_a_burst_are_computed_on_another_thread_and_shown_on_this(
    bench: Bench, finish: Callable[[], None]
) -> None:
    bench.ask_and_hold(1)
    for request in (2, 3, 4, 5):
        bench.task.ask(request)
    assert not bench.task.is_idle
    finish()
    assert bench.task.is_idle
    assert bench.worked_on == [1, 5]
    assert bench.results == ["result of 1", "result of 5"]
    assert len(bench.work_threads) == 1
    assert bench.result_threads == {threading.get_ident()} != bench.work_threads


def test_a_request_made_by_who_is_shown_a_result_is_computed(
    bench: Bench, finish: Callable[[], None]
) -> None:
    again = iter(["follow-up"])
    bench.task.finished.connect(lambda _: [bench.task.ask(r) for r in again])
    bench.ask_and_hold("first")
    finish()
    assert bench.results == ["result of first", "result of follow-up"]


@pytest.mark.parametrize(
    ("mistake", "expected"),
    [
        (RuntimeError("No luck."), "The test of the task failed: RuntimeError: No luck."),
        (MemoryError(), "The test of the task failed: MemoryError."),
        (occ.ProjectionError("The panel is behind the camera."), "The panel is behind the camera."),
    ],
)
def test_an_error_is_a_sentence_and_the_task_goes_on(
    bench: Bench,
    finish: Callable[[], None],
    mistake: Exception,
    expected: str,
    caplog: pytest.LogCaptureFixture,
) -> None:
    bench.ask_and_hold(mistake)
    bench.task.ask("next")
    finish()
    assert bench.failures == [expected]
    assert bench.results == ["result of next"]
    assert ("Traceback" in caplog.text) == (not isinstance(mistake, occ.OccError))


def test_nothing_arrives_after_stopping_once_or_twice_and_nothing_more_is_done(
    bench: Bench, qtbot: QtBot
) -> None:
    bench.ask_and_hold(1)
    bench.go_on.set()
    bench.task.stop()
    QApplication.processEvents()
    assert bench.worked_on == [1]
    assert bench.results == []
    bench.task.stop()
    bench.task.ask(2)
    qtbot.wait(20)
    assert bench.task.is_idle
    assert bench.worked_on == [1]


def test_work_that_gives_way_ends_without_a_result(
    bench: Bench, finish: Callable[[], None]
) -> None:
    bench.ask_and_hold("gives way")
    bench.task.ask("newer")
    finish()
    assert bench.worked_on == ["gives way", "newer"]
    assert (bench.results, bench.failures) == (["result of newer"], [])


def test_work_gives_way_to_a_newer_request_only(bench: Bench, finish: Callable[[], None]) -> None:
    bench.ask_and_hold("older")
    bench.task.ask("gives way")
    finish()
    assert bench.results == ["result of older", "result of gives way"]


def test_cancelled_work_goes_on_unseen_and_the_next_begins_after_it(
    bench: Bench, finish: Callable[[], None]
) -> None:
    bench.ask_and_hold(1)
    bench.task.ask(2)
    bench.task.cancel()
    assert bench.task.is_idle
    bench.task.ask(3)
    finish()
    assert bench.worked_on == [1, 3]
    assert bench.results == ["result of 3"]


def test_reports_arrive_in_order_and_of_a_run_that_is_replaced_none_that_is_on_its_way(
    qtbot: QtBot,
) -> None:
    allowed, made = threading.Semaphore(0), list[str]()

    def work(request: str, report: TaskReporter) -> None:
        for number in range(3):
            assert allowed.acquire(timeout=PATIENCE_S)
            report()  # without a part, which is not passed on
            report(f"{request} {number}")
            made.append(request)

    task: Task[str, None] = Task(work, "test of the reports", impatient=True)
    items, ends = collect(task.reported), collect(task.finished)
    task.ask("a")
    allowed.release()
    qtbot.waitUntil(lambda: items == ["a 0"])
    allowed.release()
    while len(made) < 2:  # without letting the window receive anything
        time.sleep(0.001)
    task.ask("b")
    with qtbot.waitSignal(task.idle):
        allowed.release(4)
    task.stop()
    assert items == ["a 0", "b 0", "b 1", "b 2"]
    assert made == ["a", "a", "b", "b", "b"]
    assert ends == [None]


def test_work_waits_until_what_it_has_reported_is_painted(qtbot: QtBot) -> None:
    order: list[str] = []

    def work(_request: None, report: TaskReporter) -> None:
        report("a part")
        report.wait_for_paint(PATIENCE_S)
        order.append("goes on")

    def paint_soon(part: str) -> None:
        order.append(part)
        QTimer.singleShot(0, lambda: order.append("painted"))

    task: Task[None, None] = Task(work, "test of the paint")
    task.reported.connect(paint_soon)
    with qtbot.waitSignal(task.idle):
        task.ask(None)
    task.stop()
    assert order == ["a part", "painted", "goes on"]
