"""The map agrees with a sweep, follows the scene, and measures nothing while it is hidden."""

from collections.abc import Callable, Iterator
from typing import Any
from unittest.mock import Mock, create_autospec

import numpy as np
import pytest
from gui.conftest import RememberingWorkers
from gui.stores import show, store_of
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.background.signals import WorkQueue
from occ_gui.detection_map import map_schedule
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.pane import DetectionMapController
from occ_gui.detection_map.rate_map import RateMap
from occ_gui.detection_map.worker import IMAGE_EFFECTS
from occ_model.parallel.job import Job, JobResult
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.scene import Scene
from occ_model.study.confidence import interval_of_pictures

SHAPE = (4, 4)
IMAGES = (1, 2, 5)
FREQUENCY, DISTANCE = "switching_frequency", "distance"


def first_arguments(show: Mock) -> list[Any]:
    return [call.args[0] for call in show.call_args_list]


def last_argument(show: Mock) -> Any:
    return first_arguments(show)[-1]


class Bench:
    """A controller with a small lattice whose workers need no processes."""

    def __init__(self, qtbot: QtBot, scene: Scene, workers: Any) -> None:
        self._qtbot = qtbot
        self.workers = workers
        self.queue = WorkQueue(1, lambda: workers)
        self.scenes = store_of(scene)
        self.settings = self.scenes.settings
        self.pane = create_autospec(MapView, instance=True)
        self.controller = DetectionMapController(self.scenes, self.queue.channels[0], self.pane)

    def wait_until_idle(self) -> RateMap:
        self._qtbot.waitUntil(lambda: self.controller.channel.is_idle)
        assert self.controller.map is not None
        return self.controller.map

    def look(self) -> RateMap:
        self.controller.set_visible(True)
        return self.wait_until_idle()


@pytest.fixture
def bench_of(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[..., Bench]]:
    benches: list[Bench] = []
    monkeypatch.setattr(map_schedule, "SHAPE", SHAPE)
    monkeypatch.setattr(map_schedule, "IMAGES", IMAGES)

    def make(**changes: Any) -> Bench:
        benches.append(Bench(qtbot, small_scene.replace(**changes), RememberingWorkers()))
        return benches[-1]

    yield make
    for bench in benches:
        bench.queue.stop()


def test_the_map_is_the_sweeps_table_of_the_same_points_along_both_sliders(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    rates = bench.look()
    axes = {FREQUENCY: rates.x_values, DISTANCE: rates.y_values}
    table = occ.sweep(bench.scenes.scene, axes, images=IMAGES[-1], decoder=QUICK_DECODERS)
    assert rates.least_images == IMAGES[-1]
    assert map_schedule.make_table(*bench.controller.complete).rows == table.rows
    for decoder in QUICK_DECODERS:
        np.testing.assert_array_equal(rates.rates(decoder), table.rates(decoder))
    rates.images[0, 0] = IMAGES[-2]
    assert bench.controller.complete is None
    assert (rates.x_values[0], rates.x_values[-1]) == (500.0, 100e3)
    assert (rates.y_values[0], rates.y_values[-1]) == (0.2, 5.0)


def test_a_coarse_map_comes_first_and_no_point_is_measured_again(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.look()
    points = [
        (index, image)
        for job in bench.workers.jobs
        if job.function.__name__ == "measure_points"
        for index, _ in job.arguments[2]
        for image in range(job.arguments[3], job.arguments[1].images)
    ]
    assert sorted(points) == [(i, image) for i in range(16) for image in range(IMAGES[-1])]
    assert {index for index, _ in points[:4]} == {4 * x + y for x in (0, 3) for y in (0, 3)}
    before = len(bench.workers.jobs)
    bench.controller.set_visible(False)
    bench.look()
    assert len(bench.workers.jobs) == before


def test_nothing_is_measured_while_the_map_is_hidden(
    bench_of: Callable[..., Bench], qtbot: QtBot
) -> None:
    bench = bench_of()
    bench.scenes.change(iso=200.0)
    qtbot.wait(30)
    assert bench.workers.jobs == []
    assert bench.queue.workers is None
    bench.scenes.undo_stack.undo()
    bench.look()
    bench.controller.set_visible(False)
    before = len(bench.workers.jobs)
    bench.scenes.change(iso=400.0)
    qtbot.wait(30)
    assert len(bench.workers.jobs) == before


def test_a_change_that_does_not_affect_the_map_measures_nothing(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.look()
    before = len(bench.workers.jobs)
    bench.scenes.change(switching_frequency=7e3, distance=2.0, start_time=1e-3)
    bench.wait_until_idle()
    assert len(bench.workers.jobs) == before
    assert bench.controller.complete is not None


def test_the_point_at_the_mouse_has_the_interval_of_its_pictures(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    rates = bench.look()
    bench.controller.point_at((3, 3))
    facts = last_argument(bench.pane.show_facts)
    assert (facts.x, facts.y, facts.sent) == (rates.x_values[3], rates.y_values[3], 50)
    for name, right, low, high in facts.counts:
        assert 100 * right / facts.sent == rates.rates(name)[3, 3]
        assert (low, high) == interval_of_pictures(right, facts.sent, facts.images)
    bench.controller.point_at(None)
    assert last_argument(bench.pane.show_facts) is None


def test_refused_points_are_hatched_and_give_the_reason(bench_of: Callable[..., Bench]) -> None:
    # So steep a panel reaches behind a close camera.
    bench = bench_of(yaw=1.0, panel_width=2.0)
    rates = bench.look()
    refused = rates.find_refused() != 0
    assert refused[:, 0].all()
    assert not refused[:, -1].any()
    np.testing.assert_array_equal(np.isnan(rates.rates("threshold")), refused)
    bench.controller.point_at((0, 0))
    assert last_argument(bench.pane.show_facts).note


def test_image_effects_are_simulated_or_left_out_with_a_note(
    bench_of: Callable[..., Bench], few_points: None
) -> None:
    bench = bench_of(vignetting_exponent=8.0, rows=40, columns=60)
    bench.look()
    assert last_argument(bench.pane.show_omissions) == ()
    settings = bench.workers.jobs[0].arguments[1]
    assert (settings.force, settings.path) == ({}, "auto")
    bench.workers.jobs.clear()
    bench.controller.use_image_effects(False)
    bench.wait_until_idle()
    assert last_argument(bench.pane.show_omissions) == ("Vignetting",)
    settings = bench.workers.jobs[0].arguments[1]
    assert settings.force == dict.fromkeys(IMAGE_EFFECTS, False)


def test_a_failure_is_shown_and_the_last_map_stays(bench_of: Callable[..., Bench]) -> None:
    bench = bench_of()
    before = bench.look()

    def refuse(job: Job) -> JobResult:
        raise MemoryError("no memory")

    bench.workers.result = refuse
    bench.scenes.change(iso=200.0)
    assert bench.wait_until_idle() is before
    assert list(filter(None, first_arguments(bench.pane.show_failure))) == [
        "The work in the background failed: MemoryError: no memory."
    ]


def test_the_pane_follows_axes_shown_values_and_frame_rate(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.controller.choose_axes(DISTANCE, DISTANCE)
    assert bench.pane.show_axes.call_args.args == (DISTANCE, FREQUENCY)
    bench.controller.choose_axes(DISTANCE, DISTANCE)
    assert bench.pane.show_axes.call_args.args == (FREQUENCY, DISTANCE)
    show(bench.scenes.store, shown="bits")
    assert bench.pane.show_quantity.call_args.args[0] == "bits"
    show(bench.scenes.store, frame_rate=12.0)
    assert bench.pane.show_quantity.call_args.args == ("bits", 12.0)


def test_theory_divides_the_map_at_one_and_two_chips_an_exposure(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    rates = bench.look()
    along, _ = rates.theory.places
    exposure = bench.scenes.scene.camera.exposure_time
    frequencies = 500.0 * (100e3 / 500.0) ** along
    for name, limit in (("band", 1 / exposure), ("null", 2 / exposure)):
        np.testing.assert_array_equal(
            rates.theory.sides[name][:, 0] > 0, frequencies > limit, err_msg=name
        )


@pytest.fixture
def few_points(bench_of: Callable[..., Bench], monkeypatch: pytest.MonkeyPatch) -> None:
    """Give maps fewer points than ``bench_of``, which it therefore follows."""
    monkeypatch.setattr(map_schedule, "SHAPE", (3, 2))


def test_a_map_of_an_earlier_scene_ages_until_the_next_one_comes(
    bench_of: Callable[..., Bench], few_points: None
) -> None:
    bench = bench_of()
    bench.look()
    assert set(first_arguments(bench.pane.show_age)) == {0.0}
    bench.pane.show_age.reset_mock()
    bench.scenes.change(start_time=1e-3)  # the map does not depend on it
    assert set(first_arguments(bench.pane.show_age)) == {0.0}
    bench.scenes.change(exposure_time=136e-6)
    assert last_argument(bench.pane.show_age) > 0.0
    bench.wait_until_idle()
    assert last_argument(bench.pane.show_age) == 0.0


def test_first_points_are_awaited_until_they_come_or_the_map_is_hidden(
    bench_of: Callable[..., Bench], monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = bench_of()
    controller = bench.controller
    waits_at_maps: list[bool] = []
    monkeypatch.setattr(bench.pane, "show_map", lambda _: waits_at_maps.append(waits()))

    def waits() -> bool:
        return controller.awaits_first_points

    assert not waits()
    controller.set_visible(True)
    assert waits()
    bench.wait_until_idle()
    assert waits_at_maps
    assert not any(waits_at_maps)
    assert controller.complete[0] is controller.map
    bench.scenes.change(iso=200.0)
    assert waits()
    controller.set_visible(False)
    assert not waits()
    assert controller.complete is None, "the map is of another scene"


def test_counts_that_arrive_before_those_ahead_of_them_are_kept() -> None:
    rates = RateMap("distance", "iso", (1.0, 2.0), (1.0,), ("threshold",))
    first, rest = (SweepPoint(1, sent=10 * n, right=(9 * n,), whole=(n - 1,)) for n in (5, 15))
    rates.enter([rest], 20, first=5)
    assert rates.known_count == 0
    rates.enter([first], 5)
    for _ in range(2):  # what is known does not count again
        rates.enter([first], 5)
        rates.enter([rest], 20, first=5)
    assert (rates.images[1, 0], rates.sent[1, 0], rates.right[1, 0, 0]) == (20, 200, 180)
    assert rates.whole[1, 0, 0] == 18
