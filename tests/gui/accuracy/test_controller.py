"""The study runs while the scene is unchanged and the pane visible, never beside a simulation."""

import math
import threading
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from threading import Event
from unittest.mock import create_autospec

import pytest
from gui.stores import store_of
from gui.user import PATIENCE_S
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.accuracy import cost_measurement, pane as module
from occ_gui.accuracy.accuracy_plot import AccuracyPlot
from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.cost_measurement import CostMeasurement, MeasuredPoint, SceneCosts
from occ_gui.accuracy.pane import AccuracyController
from occ_gui.background.task import Superseded
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.simulated import SimulationRequest
from occ_model.results.accuracy import ACCURACY_PARTS, AccuracyPoint
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study import effect_differences

IDLE_MS = 20
TOTAL = 3
COMPLETE = ["study_begun", "1 of 3", "2 of 3", "3 of 3", "study_finished"]
"""What the plot shows of a study that is not interrupted."""


class Bench:
    """A controller whose study measures a point whenever the test allows one."""

    def __init__(self, scene: Scene, qtbot: QtBot) -> None:
        self._qtbot = qtbot
        self._allowed = threading.Semaphore(0)
        self.requests: list[SimulationRequest] = []
        self.scenes = store_of(scene)
        self.settings = self.scenes.settings
        self.simulation = SimulationController(self.scenes)
        self.view = create_autospec(AccuracyView, instance=True)
        self.plot = self.view.plot = create_autospec(AccuracyPlot, instance=True)
        self.controller = AccuracyController(self.scenes, self.simulation, self.view)
        self.simulation.snapshot_shown.connect(self.controller.show_snapshot)
        self.snapshots: list[Snapshot] = []
        self.simulation.snapshot_shown.connect(self.snapshots.append)

    def study(
        self, scene: Scene, settings: SimulationSettings, _complete: object
    ) -> Iterator[AccuracyPoint]:
        self.requests.append(SimulationRequest(scene, settings))
        for number in range(TOTAL):
            assert self._allowed.acquire(timeout=PATIENCE_S)
            yield AccuracyPoint("effects", f"point {number}", 1e-3, 0.1)

    @property
    def shown(self) -> list[str]:
        """What the plot has shown: a number for each point, else the state of the study."""
        calls = ((call[0].removeprefix("show_"), call.args) for call in self.plot.method_calls)
        return [f"{args[1]} of {args[2]}" if what == "point" else what for what, args in calls]

    def allow(self, points: int) -> None:
        self._allowed.release(points)

    def wait_for(self, shown: str) -> None:
        self._qtbot.waitUntil(lambda: shown in self.shown)

    def wait_until_idle(self) -> None:
        self._qtbot.waitUntil(lambda: self.simulation.task.is_idle and self.controller.is_idle)

    def stop(self) -> None:
        self.allow(100)
        self.simulation.stop()
        self.controller.stop()


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    monkeypatch.setattr(module, "IDLE_MS", IDLE_MS)
    bench = Bench(small_scene, qtbot)
    monkeypatch.setattr(cost_measurement, "accuracy", bench.study)
    monkeypatch.setattr(cost_measurement, "point_count", lambda scene, settings: TOTAL)
    yield bench
    bench.stop()


def test_while_visible_the_points_come_one_by_one_and_only_once(bench: Bench) -> None:
    bench.controller.set_visible(True)
    bench.allow(1)
    bench.wait_for("1 of 3")
    assert "study_finished" not in bench.shown
    bench.allow(2)
    bench.wait_until_idle()
    assert bench.shown == COMPLETE
    names = [call.args[0].name for call in bench.plot.show_point.call_args_list]
    assert names == [f"point {number}" for number in range(TOTAL)]
    assert bench.requests == [SimulationRequest(bench.scenes.scene, FIRST_SETTINGS)]
    bench.controller.set_visible(False)
    bench.controller.set_visible(True)
    assert bench.controller.task.is_idle
    bench.wait_until_idle()
    assert bench.shown[-1] == "study_finished"


def test_a_change_cancels_the_study_and_the_next_one_includes_it(bench: Bench) -> None:
    bench.controller.set_visible(True)
    bench.allow(1)
    bench.wait_for("1 of 3")
    bench.scenes.change(iso=200.0)
    assert bench.controller.task.is_idle
    bench.settings.set_tolerance(2.0)
    assert bench.shown[2:] == ["study_outdated", "study_outdated"]
    bench.allow(1 + TOTAL)
    bench.wait_until_idle()
    assert bench.shown[4:] == COMPLETE
    assert bench.requests[-1] == SimulationRequest(bench.scenes.scene, bench.settings.settings)


def test_hiding_cancels_the_study_and_showing_begins_it_anew(bench: Bench, qtbot: QtBot) -> None:
    bench.controller.set_visible(True)
    bench.allow(1)
    bench.wait_for("1 of 3")
    bench.controller.set_visible(False)
    qtbot.waitUntil(lambda: bench.controller.forecasts.is_idle)
    assert bench.controller.is_idle
    assert bench.shown[-1] == "study_outdated"
    bench.scenes.change(iso=200.0)
    qtbot.waitUntil(lambda: bench.simulation.task.is_idle)
    qtbot.wait(2 * IDLE_MS)
    assert bench.controller.is_idle, "the pane is hidden"
    bench.controller.set_visible(True)
    bench.allow(1 + TOTAL)
    bench.wait_until_idle()
    assert bench.shown[-1] == "study_finished"


def test_the_study_waits_while_a_picture_is_simulated(
    bench: Bench, qtbot: QtBot, release: Event
) -> None:
    bench.scenes.change(iso=123.0)
    assert not bench.simulation.task.is_idle
    bench.controller.set_visible(True)
    qtbot.waitUntil(lambda: bench.controller.is_idle)
    assert bench.requests == []
    release.set()
    bench.allow(TOTAL)
    bench.wait_for("study_finished")


def test_a_study_that_fails_gives_the_reason_and_is_not_repeated(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_arguments: object) -> Iterator[AccuracyPoint]:
        raise occ.ProjectionError("The panel is behind the camera.")

    monkeypatch.setattr(cost_measurement, "accuracy", refuse)
    bench.controller.set_visible(True)
    bench.wait_until_idle()
    assert bench.shown == ["study_begun", "study_failed"]
    bench.plot.show_study_failed.assert_called_with("The panel is behind the camera.")


def collect_reports(request: SimulationRequest, measurement: CostMeasurement) -> list[object]:
    reports: list[object] = []
    measurement(request, reports.append)
    return [report for report in reports if report is not None]


@pytest.fixture(scope="module")
def tiny() -> SimulationRequest:
    scene = occ.load_preset("phone-68us").replace(rows=30, columns=60, edge_time=5e-6)
    return SimulationRequest(scene, FIRST_SETTINGS)


@pytest.fixture(scope="module")
def reports(tiny: SimulationRequest) -> list[object]:
    """Measure a scene once, for the tests of the reports."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost_measurement, "_PATIENCE", math.inf)  # however busy the machine is
        return collect_reports(tiny, CostMeasurement())


def test_the_models_study_has_as_many_points_as_stated_after_the_costs_of_effects(
    tiny: SimulationRequest, reports: list[object]
) -> None:
    points = [m for m in reports if isinstance(m, MeasuredPoint)]
    assert {point.total for point in points} == {len(points)}
    parts = [point.point.part for point in points]
    assert sum(one != other for one, other in pairwise(parts)) == len(ACCURACY_PARTS) - 1
    kinds = [type(report) for report in reports]
    assert kinds[0] is SceneCosts
    first = kinds.index(MeasuredPoint)
    before = [r for r in reports[:first] if isinstance(r, SceneCosts)]
    present = [d.effect for d in occ.plan(tiny.scene, 0.0).decisions if d.estimate]
    assert list(before[-1].differences) == present
    assert len(before) == 1 + len(present)  # one report an effect


def test_the_differences_of_a_scene_are_measured_only_once(
    tiny: SimulationRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    measurement = CostMeasurement()
    first = [r for r in collect_reports(tiny, measurement) if isinstance(r, SceneCosts)][-1]
    monkeypatch.setattr(effect_differences, "observe", None)  # to use it would fail
    monkeypatch.setattr(cost_measurement, "accuracy", lambda *_: iter(()))
    again = replace(tiny, settings=replace(FIRST_SETTINGS, tolerance=math.inf))
    later = [r for r in collect_reports(again, measurement) if isinstance(r, SceneCosts)][-1]
    for effect, difference in first.differences.items():
        assert later.differences[effect] is difference


def test_cancelled_work_ends_within_the_simulation_of_a_picture(tiny: SimulationRequest) -> None:
    reports: list[object] = []

    def report(message: object) -> None:
        reports.append(message)
        if len(reports) == 3:
            raise Superseded

    with pytest.raises(Superseded):
        CostMeasurement()(tiny, report)
    assert reports == [None] * 3  # before any measurement was complete


def test_costs_of_another_scene_or_observable_are_not_used(
    tiny: SimulationRequest, reports: list[object]
) -> None:
    costs = [r for r in reports if isinstance(r, SceneCosts)][-1]
    assert costs.is_of(replace(tiny, settings=replace(FIRST_SETTINGS, tolerance=3.0)))
    assert not costs.is_of(replace(tiny, scene=tiny.scene.replace(iso=200.0)))
    profile = replace(tiny, settings=replace(FIRST_SETTINGS, observable="profile"))
    assert not costs.is_of(profile)


def test_moves_of_several_sliders_are_timed_with_three_plans_in_turn(
    tiny: SimulationRequest, reports: list[object]
) -> None:
    moves = [report for report in reports if isinstance(report, list)]
    present = frozenset(d.effect for d in occ.plan(tiny.scene, 0.0).decisions if d.estimate)
    chosen = frozenset(occ.plan(tiny.scene).included)
    sets = [move.effects for (move,) in moves]
    plans = list(dict.fromkeys((chosen, present, frozenset())))
    assert sets == plans * (len(sets) // len(plans))
    assert len(sets) // len(plans) == 6  # sliders


def test_all_stated_times_of_a_plan_are_one_number(bench: Bench, qtbot: QtBot) -> None:
    bench.controller.set_visible(True)
    bench.allow(TOTAL)
    bench.wait_for("study_finished")
    qtbot.waitUntil(lambda: bench.controller.forecasts.is_idle)
    costs = bench.view.show_costs.call_args.args[1]
    forecast = bench.view.show_forecast.call_args.args[1]
    assert costs.picture.times.count > 3
    assert forecast.seconds == costs.picture.times.median
    present = [d.effect for d in forecast.plan.decisions if d.estimate]
    complete = costs.times_with(present)
    sets = dict(zip(forecast.effect_sets, forecast.effect_set_seconds, strict=True))
    (all_of_them,) = [s for each, s in sets.items() if each.effects == frozenset(present)]
    assert all_of_them == complete.median
    (no_effects,) = [s for each, s in sets.items() if not each.effects]
    bare = costs.times_with(())
    # The points of the study have no effects.
    point = bench.plot.show_point.call_args.args[0]
    assert point.seconds == no_effects == bare.median


def test_moves_of_the_user_count_until_nine_later_ones(bench: Bench, qtbot: QtBot) -> None:
    log = bench.simulation.moves
    for number in range(12):
        bench.scenes.change(iso=200.0 + number)
        qtbot.waitUntil(lambda: bench.simulation.task.is_idle)
    times = log.costs_of(bench.snapshots[-1].frame).picture.times
    seconds = [snapshot.simulation_seconds for snapshot in bench.snapshots[-9:]]
    assert times.count == 9
    assert (times.least, times.most) == pytest.approx((min(seconds), max(seconds)))
