"""Work that reports its progress, and that ends when its result is not wanted any more."""

import logging
import threading
from collections.abc import Iterator

import pytest
from pytestqt.qtbot import QtBot

from occ_gui.background.cancellable import Cancellable, Report
from occ_model.errors import MatchError

PATIENCE_S = 10.0


class Bench:
    """Work in steps, each of which waits for a word, and what arrives of it."""

    def __init__(self) -> None:
        self.begun = threading.Event()
        self.go_on = threading.Event()
        self.ended = threading.Event()
        self.steps: list[tuple[int, float]] = []
        self.results: list[int] = []
        self.shares: list[float] = []
        self.failures: list[str] = []
        self.task: Cancellable[int, int] = Cancellable(self._work, "test work")
        self.task.finished.connect(self.results.append)
        self.task.reported.connect(self.shares.append)
        self.task.failed.connect(self.failures.append)

    def _work(self, request: int, report: Report) -> int:
        try:
            self.begun.set()
            assert self.go_on.wait(PATIENCE_S)
            if request < 0:
                raise MatchError("There are no stripes.")
            if request == 0:
                return 1 // request
            for share in (0.25, 0.5, 1.0):
                report(share)
                self.steps.append((request, share))
            return 10 * request
        finally:
            self.ended.set()


@pytest.fixture
def bench(qtbot: QtBot) -> Iterator[Bench]:
    bench = Bench()
    yield bench
    bench.go_on.set()
    bench.task.stop()


def wait_until_idle(qtbot: QtBot, bench: Bench) -> None:
    bench.go_on.set()
    qtbot.waitUntil(lambda: not bench.task.is_running)


def test_the_result_arrives_and_before_it_how_far_the_work_was(qtbot: QtBot, bench: Bench) -> None:
    bench.task.start(4)
    assert bench.task.is_running
    wait_until_idle(qtbot, bench)
    assert bench.results == [40]
    assert bench.shares == [0.25, 0.5, 1.0]
    assert bench.failures == []


def test_cancelled_work_ends_at_its_next_step_without_a_result(qtbot: QtBot, bench: Bench) -> None:
    bench.task.start(1)
    assert bench.begun.wait(PATIENCE_S)
    bench.task.cancel()
    assert not bench.task.is_running
    bench.go_on.set()
    assert bench.ended.wait(PATIENCE_S)
    bench.task.start(2)
    wait_until_idle(qtbot, bench)
    assert bench.results == [20]
    assert {request for request, _ in bench.steps} == {2}
    assert bench.failures == []


def test_the_next_start_cancels_the_one_before(qtbot: QtBot, bench: Bench) -> None:
    bench.task.start(1)
    assert bench.begun.wait(PATIENCE_S)
    for request in (2, 3):
        bench.task.start(request)
    wait_until_idle(qtbot, bench)
    assert bench.results == [30]
    assert {request for request, _ in bench.steps} == {3}


def test_a_refusal_of_the_model_arrives_as_its_sentence(qtbot: QtBot, bench: Bench) -> None:
    bench.task.start(-1)
    wait_until_idle(qtbot, bench)
    assert bench.failures == ["There are no stripes."]
    assert bench.results == []


def test_an_internal_error_is_a_sentence_and_is_logged(
    qtbot: QtBot, bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.ERROR):
        bench.task.start(0)
        wait_until_idle(qtbot, bench)
    (sentence,) = bench.failures
    assert sentence.startswith("The test work failed: ZeroDivisionError")
    assert "Traceback" in caplog.text
    bench.task.start(5)
    wait_until_idle(qtbot, bench)
    assert bench.results == [50]


def test_stopping_while_it_works_lets_nothing_arrive(qtbot: QtBot) -> None:
    bench = Bench()
    bench.task.start(1)
    assert bench.begun.wait(PATIENCE_S)
    bench.go_on.set()
    bench.task.stop()
    qtbot.wait(20)
    assert bench.results == []
    assert bench.failures == []
