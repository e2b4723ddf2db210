"""The bench in the window: choices are measured, drawn, marked as outdated, and exported."""

import csv
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from gui.conftest import InlineWorkers, RememberingWorkers
from gui.pane_bench import PaneBench
from gui.stores import show, store_of
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import bench
from occ_gui.background.signals import WorkQueue
from occ_gui.bench import bench_results
from occ_gui.bench.bench_results import BITS, RATES, format_cell, make_curve_point
from occ_gui.bench.bench_view import OF_SCENE, PUBLISHED, BenchChoice, BenchView
from occ_gui.bench.pane import BenchController, request_of
from occ_gui.detection_map.slider_strip_controller import RANK
from occ_model.errors import ParameterError
from occ_model.parallel.job import Job, JobResult
from occ_model.results.bit_errors import BenchPoint, BenchRequest, BitErrors
from occ_model.scene.scene import Scene
from occ_model.study.bench.bench import measure_bench_point


def point_of(wrong: int, right: int, exposure: float = 1.0, axis: str = "exposure") -> BenchPoint:
    errors = BitErrors("threshold", 1000, wrong, 0.0 if not wrong else wrong / 2000,
                       (wrong + 10) / 1000, 10, right, right / 20, 1.0, 0.01, 0.02)  # fmt: skip
    return BenchPoint("manchester", axis, exposure, 30.0, errors, "" if right == 10 else "Why.")


class Measuring:
    """A bench with one decoder and few bits, which does its jobs at once."""

    def __init__(self, qtbot: QtBot, scene: Scene, workers: InlineWorkers) -> None:
        self.scenes = store_of(scene)
        self.workers = workers
        self.queue = WorkQueue(1, lambda: workers)
        self.pane = BenchView(("threshold",), ("threshold",))
        qtbot.addWidget(self.pane)
        self.controller = BenchController(self.scenes, self.queue.channels[0], self.pane)
        self.pane.measurement_requested.connect(self.controller.start)
        self.pane.cancelled.connect(self.controller.cancel)
        self._qtbot = qtbot

    def said(self) -> str:
        return self.pane.state.toolTip()

    def cell(self, row: int) -> str:
        item = self.pane.table.item(row, 2)
        return item.text()

    def measure(self, code_source: str = PUBLISHED) -> None:
        self.controller.choose(BenchChoice(code_source, ("threshold",), 64))
        self.pane.measure.click()
        self._qtbot.waitUntil(lambda: self.controller.channel.is_idle)


@pytest.fixture
def measuring(qtbot: QtBot, small_scene: Scene) -> Measuring:
    made = Measuring(qtbot, small_scene, RememberingWorkers())
    qtbot.addWidget(made.pane, before_close_func=lambda _: made.queue.stop())
    return made


def test_the_scenes_code_and_timing_are_measured(small_scene: Scene) -> None:
    scene = small_scene.replace(payload="text:HI", line_code="4b6b", framing="c-ook")
    request = request_of(BenchChoice(OF_SCENE, ("threshold",)), scene)
    assert (request.schemes, request.payload_bits) == (("4b6b/c-ook",), 16)
    period = scene.transmitter.switching_period
    assert request.rows_a_symbol == pytest.approx(period / scene.camera.readout_time)
    assert 0 < request.rows <= scene.camera.columns
    assert request_of(BenchChoice(PUBLISHED), scene) == BenchRequest()
    with pytest.raises(ParameterError, match="raw chip pattern"):
        request_of(BenchChoice(OF_SCENE), small_scene.replace(pattern="01"))


def test_what_the_pane_shows_is_what_the_model_measures(measuring: Measuring) -> None:
    measuring.measure()
    full = measuring.controller.complete
    request, points = full
    expected = [one for place in request.points for one in measure_bench_point(request, place)]
    assert list(points) == expected
    shown = [measuring.cell(row) for row in range(measuring.pane.table.rowCount())]
    assert shown == [format_cell(one, RATES, 30.0) for one in expected]
    assert "15 of 15" in measuring.said()
    x, _ = measuring.pane.plots[RATES].plots["exposure"].viewRange()
    assert x[0] < min(request.exposures)
    assert x[1] > max(request.exposures)


def test_points_of_another_setting_are_marked_until_measured_again(measuring: Measuring) -> None:
    measuring.measure(OF_SCENE)
    assert not measuring.said().startswith("Earlier setting")
    # The setting contains neither the ISO speed nor the exposure of the scene.
    measuring.scenes.change(iso=200.0)
    assert not measuring.said().startswith("Earlier setting")
    measuring.scenes.change(switching_frequency=7e3)
    assert measuring.said().startswith("Earlier setting")
    assert not measuring.pane.outdated.isHidden()
    measuring.measure(OF_SCENE)
    assert not measuring.said().startswith("Earlier setting")
    assert measuring.pane.outdated.isHidden()


def test_what_cannot_be_measured_says_why(measuring: Measuring) -> None:
    measuring.scenes.change(pattern="0110")
    measuring.measure(OF_SCENE)
    assert "raw chip pattern" in measuring.said()
    measuring.controller.choose(BenchChoice(PUBLISHED, ()))
    measuring.pane.measure.click()
    assert "No decoder" in measuring.said()
    assert measuring.controller.complete is None


class BusyWorkers(InlineWorkers):
    """Workers that never end."""

    def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
        self.jobs.append(job)
        return Future()


def test_a_cancelled_bench_keeps_its_points_and_is_not_whole(
    qtbot: QtBot, small_scene: Scene
) -> None:
    workers = BusyWorkers()
    measuring = Measuring(qtbot, small_scene, workers)
    choice = BenchChoice(PUBLISHED, ("threshold",), 64)
    measuring.controller.choose(choice)
    measuring.pane.measure.click()
    qtbot.waitUntil(lambda: len(workers.jobs) > 1)
    assert not measuring.pane.measure.isEnabled()
    request = request_of(choice, small_scene)
    first = measure_bench_point(request, request.points[0])
    measuring.queue.channels[0].results_ready.emit(request, [first])
    assert "1 of 15" in measuring.said()
    measuring.pane.work.cancel.click()
    assert measuring.said().startswith("Cancelled")
    assert measuring.controller.channel.is_idle
    assert measuring.controller.complete is None
    assert measuring.cell(0).startswith("0 (")
    assert measuring.pane.measure.isEnabled()
    measuring.queue.stop()


def test_more_pictures_than_are_read_out_are_refused_in_a_sentence(measuring: Measuring) -> None:
    measuring.measure()
    measuring.pane.quantity.show_key(BITS)
    measuring.pane.quantity.chosen.emit(BITS)
    show(measuring.scenes.store, frame_rate=60.0)
    assert "frames_a_second is 60.0; allowed: above 0 to 36" in measuring.said()
    show(measuring.scenes.store, frame_rate=15.0)
    assert "frames_a_second" not in measuring.said()
    assert measuring.cell(0).startswith(f"{256 * 15:,}")


@pytest.mark.parametrize(("wrong", "right"), [(0, 10), (10, 9), (500, 0)])
def test_points_are_drawn_where_their_values_are(wrong: int, right: int) -> None:
    point = point_of(wrong, right)
    rate, bits = make_curve_point(point, RATES, 30.0), make_curve_point(point, BITS, 30.0)
    assert 10.0**rate.high == pytest.approx(point.errors.high)
    assert (rate.value == rate.value) == bool(wrong)  # NaN without an error
    if wrong:
        assert 10.0**rate.value == pytest.approx(point.errors.rate)
    assert 10.0**bits.value == pytest.approx(max(point.errors.bits_a_second(30.0), 1.0))
    assert bits.low <= bits.value <= bits.high


def test_the_bench_is_exported_with_its_own_setting(
    qtbot: QtBot, small_scene: Scene, inline_workers: InlineWorkers, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    panes, queue = PaneBench(qtbot, small_scene), WorkQueue(1, lambda: inline_workers)
    measuring: Any = SimpleNamespace(channel=lambda _name: queue.channels[0])
    path = tmp_path / "bench.csv"
    panes.shell.add(bench(panes.scenes, measuring), panes.window)
    panes.simulate()
    assert "not complete" in panes.export("bench", path)
    panes.see("bench")
    request = BenchRequest(decoders=("threshold",), exposures=(1.0,), decibels=(), bits=64)
    found = request, tuple(measure_bench_point(request, request.points[0]))
    complete: Callable[[], object] = lambda: found  # noqa: E731
    monkeypatch.setattr(BenchController, "complete", property(lambda _self: complete()))
    assert panes.export("bench", path).startswith("Exported")
    queue.stop()
    panes.shell.stop()
    lines = path.read_text("utf-8").splitlines()
    assert any("5 rows a symbol" in line for line in lines if line.startswith("#"))
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["decoder"] for row in rows] == ["threshold"]


def test_a_cell_tells_its_note_and_every_point_is_in_view(measuring: Measuring) -> None:
    measuring.measure()
    assert measuring.controller.complete is not None
    _, (first, *_) = measuring.controller.complete
    measuring.pane.table.show_points([replace(first, note="Why.")], RATES, 30.0)
    item = measuring.pane.table.item(0, 2)
    assert item.toolTip() == "Why."
    plots = measuring.pane.plots[RATES]
    values = [
        value
        for curves in plots.curves.values()
        for curve in curves
        for value in (curve.with_errors.getData()[1], curve.intervals.getData()[1])
    ]
    shown = np.concatenate(values)
    above = shown[shown > bench_results.FLOOR[RATES]]
    assert above.size < shown.size  # an interval that begins at zero is cut off at the bottom
    for plot in plots.plots.values():
        low, high = plot.viewRange()[1]
        assert above.min() - 0.5 < low < above.min()
        assert above.max() < high


def test_before_the_first_measurement_the_pane_says_what_it_is_for_and_then_what_theory_says(
    measuring: Measuring,
) -> None:
    pane = measuring.pane
    assert not pane.invitation.isHidden()
    measuring.measure()
    assert not pane.plots[RATES].isHidden()
    assert pane.frame_rate.isHidden()
    # What theory says stands beside the points, in either plot.
    pane.quantity.show_key(BITS)
    pane.quantity.chosen.emit(BITS)
    assert not pane.plots[BITS].isHidden()
    assert not pane.frame_rate.isHidden()  # which bits a second depend on
    for curve in pane.plots[BITS].bounds.values():
        x, _ = curve.getData()
        assert len(x) > 1
    for plots in pane.plots.values():
        for axis, plot in plots.plots.items():
            assert plots.bounds[axis] in plot.getPlotItem().items
    pane.resize(700, 500)
    pane.show()
    QApplication.processEvents()
    assert pane.state.width() > 0.6 * pane.width()


def test_each_number_of_bits_is_one_of_whole_payloads_and_is_measured_before_the_map(
    measuring: Measuring,
) -> None:
    effort, whole = measuring.pane.effort, BenchRequest().payload_bits
    offered = [int(effort.itemData(place)) for place in range(effort.count())]
    assert len(offered) > 1
    assert all(bits % whole == 0 for bits in offered)
    assert offered == sorted(set(offered))
    measuring.measure()
    assert measuring.workers.jobs
    assert all(job.rank < min(0, RANK) for job in measuring.workers.jobs)
