"""ResultUpdater: a result is computed when its request changes, and kept for the same request."""

import threading
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from gui.kinds import collect
from gui.stores import store_of
from gui.user import PATIENCE_S
from pytestqt.qtbot import QtBot

from occ_gui.background.task import Report, Task
from occ_gui.shell.results import Results, ResultsStore, ResultUpdater


class UpdaterBench:
    """A result that depends on the name of the decoder; the test decides when it is ready."""

    def __init__(self, qtbot: QtBot, **options: Any) -> None:
        self.store, self.results_store = store_of().store, ResultsStore()
        self.requests: list[str] = []
        self.announced: list[object] = []
        self.may_finish = threading.Event()
        self.may_finish.set()
        self.work = ResultUpdater(
            self.store, self.results_store, Task(self._do, "work", impatient=True),
            lambda workspace, _: workspace.decoder or None, self._put, **options,
        )  # fmt: skip
        results = self.results_store.select(lambda results: results.chips)
        results.changed.connect(self.announced.append)
        self._qtbot = qtbot

    def _do(self, name: str, report: Report) -> str:
        self.requests.append(name)
        assert self.may_finish.wait(PATIENCE_S)
        report(0.5)
        if name == "bad":
            raise ValueError("no result")
        return name.upper()

    def _put(self, results: Results, result: Any) -> Results:
        return replace(results, chips=result)

    @property
    def result(self) -> object:
        return self.results_store.results.chips

    def choose(self, name: str) -> None:
        self.store.put(replace(self.store.workspace, decoder=name))

    def wait(self) -> None:
        self.may_finish.set()
        self._qtbot.waitUntil(lambda: self.work.task.is_idle)


@pytest.fixture(params=[{}, {"stays": True}, {"keep": 2}], ids=["removed", "stays", "cached"])
def bench(qtbot: QtBot, request: pytest.FixtureRequest) -> Iterator[UpdaterBench]:
    bench = UpdaterBench(qtbot, **request.param)
    bench.wait()
    yield bench
    bench.may_finish.set()
    bench.work.task.stop()


def test_a_result_follows_its_request_and_is_removed_with_it(bench: UpdaterBench) -> None:
    assert bench.result == "THRESHOLD"
    bench.choose("other")
    bench.wait()
    assert (bench.result, bench.announced[-1]) == ("OTHER", "OTHER")
    bench.store.put(replace(bench.store.workspace, picture_kind="receiver"))
    announced = list(bench.announced)
    bench.results_store.put(replace(bench.results_store.results))
    assert (bench.requests, bench.announced) == (["threshold", "other"], announced)
    bench.choose("")
    assert bench.result is None


def test_work_that_is_no_longer_needed_has_no_result(bench: UpdaterBench, qtbot: QtBot) -> None:
    ended: list[bool] = []
    bench.work.ended.connect(lambda: ended.append(True))
    bench.may_finish.clear()
    bench.choose("other")
    bench.choose("")
    assert ended == [True]
    assert bench.work.task.is_idle
    bench.may_finish.set()
    qtbot.wait(20)
    assert bench.result is None


def test_a_failure_is_stated_in_a_sentence(bench: UpdaterBench) -> None:
    failures = collect(bench.work.failed)
    bench.choose("bad")
    bench.wait()
    assert failures == ["The work failed: ValueError: no result."]


@pytest.mark.parametrize("stays", [True, False])
def test_the_last_result_stays_until_the_next_one_if_so_declared(qtbot: QtBot, stays: bool) -> None:
    bench = UpdaterBench(qtbot, stays=stays)
    bench.wait()
    bench.may_finish.clear()
    bench.choose("other")
    assert bench.result == ("THRESHOLD" if stays else None)
    bench.wait()
    assert bench.result == "OTHER"
    bench.work.task.stop()


def test_the_last_results_come_back_at_once(qtbot: QtBot) -> None:
    bench = UpdaterBench(qtbot, keep=2)
    for name in ("threshold", "b", "c"):
        bench.choose(name)
        bench.wait()
    bench.choose("b")
    assert (bench.result, bench.work.task.is_idle) == ("B", True)
    bench.choose("threshold")
    assert bench.result is None, "only two are kept"
    bench.wait()
    assert bench.requests == ["threshold", "b", "c", "threshold"]
    bench.work.task.stop()
