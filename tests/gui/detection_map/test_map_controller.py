"""The map agrees with a sweep, follows the scene, and costs nothing while it is hidden."""

from collections.abc import Callable, Iterator
from typing import Any
from unittest.mock import Mock, create_autospec

import numpy as np
import pytest
from gui.conftest import RememberingWorkers
from gui.kinds import not_none
from gui.stores import show, store_of
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.background.signals import WorkQueue
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.detection_map import map_schedule
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.pane import DetectionMapController
from occ_gui.detection_map.rate_map import RateMap
from occ_gui.detection_map.worker import IMAGE_EFFECTS
from occ_model.parallel.job import Job, JobResult
from occ_model.receiver.decoders import QUICK_DECODERS
from occ_model.scene.scene import Scene
from occ_model.study.confidence import interval_of_pictures

SHAPE = (4, 4)
IMAGES = (1, 2)
FREQUENCY, DISTANCE = "switching_frequency", "distance"


def all_shown(show: Mock) -> list[Any]:
    return [call.args[0] for call in show.call_args_list]


def shown(show: Mock) -> Any:
    return all_shown(show)[-1]


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
        self.controller.set_seen(True)
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
    found = bench.look()
    axes = {FREQUENCY: found.x_values, DISTANCE: found.y_values}
    table = occ.sweep(bench.scenes.scene, axes, images=IMAGES[-1], decoder=QUICK_DECODERS)
    assert found.least_images == IMAGES[-1]
    for decoder in QUICK_DECODERS:
        np.testing.assert_array_equal(found.rates(decoder), table.rates(decoder))
    assert (found.x_values[0], found.x_values[-1]) == (500.0, 100e3)
    assert (found.y_values[0], found.y_values[-1]) == (0.2, 5.0)


def test_a_coarse_map_comes_first_and_no_point_is_measured_again(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.look()
    points = [
        (index, job.arguments[1].images)
        for job in bench.workers.jobs
        if job.function.__name__ == "measure_points"
        for index, _ in job.arguments[2]
    ]
    assert sorted(points) == sorted((i, n) for n in IMAGES for i in range(16))
    assert {index for index, _ in points[:4]} == {4 * x + y for x in (0, 3) for y in (0, 3)}
    before = len(bench.workers.jobs)
    bench.controller.set_seen(False)
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
    bench.controller.set_seen(False)
    before = len(bench.workers.jobs)
    bench.scenes.change(iso=400.0)
    qtbot.wait(30)
    assert len(bench.workers.jobs) == before


def test_a_change_that_the_map_does_not_depend_on_measures_nothing(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.look()
    before = len(bench.workers.jobs)
    bench.scenes.change(switching_frequency=7e3, distance=2.0, start_time=1e-3)
    bench.wait_until_idle()
    assert len(bench.workers.jobs) == before
    assert bench.controller.full is not None


def test_the_point_at_the_mouse_has_the_interval_of_its_pictures(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    found = bench.look()
    bench.controller.point_at((3, 3))
    facts = not_none(shown(bench.pane.show_facts))
    assert (facts.x, facts.y, facts.sent) == (found.x_values[3], found.y_values[3], 20)
    for name, right, low, high in facts.counts:
        assert 100 * right / facts.sent == found.rates(name)[3, 3]
        assert (low, high) == interval_of_pictures(right, facts.sent, facts.images)
    bench.controller.point_at(None)
    assert shown(bench.pane.show_facts) is None


def test_what_the_model_refuses_is_hatched_and_says_why(bench_of: Callable[..., Bench]) -> None:
    # A panel that is so steep reaches behind a camera that is close.
    bench = bench_of(yaw=1.0, panel_width=2.0)
    found = bench.look()
    refused = found.find_refused() != 0
    assert refused[:, 0].all()
    assert not refused[:, -1].any()
    np.testing.assert_array_equal(np.isnan(found.rates("threshold")), refused)
    bench.controller.point_at((0, 0))
    assert shown(bench.pane.show_facts) is not None
    assert shown(bench.pane.show_facts).note


def test_image_effects_are_simulated_or_left_out_with_a_note(
    bench_of: Callable[..., Bench], few_points: None
) -> None:
    bench = bench_of(vignetting_exponent=8.0, rows=40, columns=60)
    bench.look()
    assert shown(bench.pane.show_left_out) == ()
    settings = bench.workers.jobs[0].arguments[1]
    assert (settings.force, settings.path) == ({}, "auto")
    bench.workers.jobs.clear()
    bench.controller.use_image_effects(False)
    bench.wait_until_idle()
    assert shown(bench.pane.show_left_out) == ("Vignetting",)
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
    assert list(filter(None, all_shown(bench.pane.show_failure))) == [
        "The work in the background failed: MemoryError: no memory."
    ]


def test_the_pane_follows_the_axes_what_is_shown_and_the_pictures_a_second(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    bench.controller.choose_axes(DISTANCE, DISTANCE)
    assert bench.pane.show_axes.call_args.args == (DISTANCE, FREQUENCY)
    bench.controller.choose_axes(DISTANCE, DISTANCE)
    assert bench.pane.show_axes.call_args.args == (FREQUENCY, DISTANCE)
    show(bench.scenes.store, shown="bits")
    assert bench.pane.show_bits.call_args.args[0] == "bits"
    show(bench.scenes.store, frame_rate=12.0)
    assert bench.pane.show_bits.call_args.args == ("bits", 12.0)


def test_the_theoretical_limits_lie_where_theory_says(
    bench_of: Callable[..., Bench],
) -> None:
    bench = bench_of()
    found = bench.look()
    assert found.theory is not None
    along, _ = found.theory.places
    exposure = bench.scenes.scene.camera.exposure_time
    frequencies = 500.0 * 200.0**along
    for name, limit in (("band", 1 / exposure), ("null", 2 / exposure)):
        np.testing.assert_array_equal(
            found.theory.sides[name][:, 0] > 0, frequencies > limit, err_msg=name
        )


@pytest.fixture
def few_points(bench_of: Callable[..., Bench], monkeypatch: pytest.MonkeyPatch) -> None:
    """Give maps few points if no other test uses them."""
    monkeypatch.setattr(map_schedule, "SHAPE", (3, 2))


def test_a_map_of_an_earlier_scene_ages_until_the_next_is_there(
    bench_of: Callable[..., Bench], few_points: None
) -> None:
    bench = bench_of()
    bench.look()
    assert set(all_shown(bench.pane.show_age)) == {0.0}
    bench.pane.show_age.reset_mock()
    bench.scenes.change(start_time=1e-3)  # the map does not depend on it
    assert set(all_shown(bench.pane.show_age)) == {0.0}
    bench.scenes.change(exposure_time=136e-6)
    assert shown(bench.pane.show_age) > 0.0
    bench.wait_until_idle()
    assert shown(bench.pane.show_age) == 0.0


def test_a_first_answer_is_awaited_until_it_is_there_or_found_to_take_long(
    bench_of: Callable[..., Bench], monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = bench_of()
    controller = bench.controller
    awaited: list[tuple[int, bool]] = []
    monkeypatch.setattr(
        bench.pane, "show_map", lambda rates: awaited.append((rates.known, waits()))
    )

    def waits() -> bool:
        return controller.is_first_answer_awaited

    assert not waits()
    controller.set_seen(True)
    assert waits()
    bench.wait_until_idle()
    assert awaited
    assert not any(waiting for _, waiting in awaited)
    assert controller.full is not None
    assert controller.full[0] is controller.map
    bench.scenes.change(iso=200.0)
    assert waits()
    controller.set_seen(False)
    assert not waits()
    assert controller.full is None, "it is of its own scene alone"


@pytest.mark.parametrize("with_image_effects", [False, True])
def test_only_rows_of_pictures_take_long(small_scene: Scene, with_image_effects: bool) -> None:
    scene = small_scene.replace(jpeg_quality=30)
    request = map_schedule.MapRequest(
        scene, FREQUENCY, DISTANCE, FIRST_SETTINGS, with_image_effects
    )
    told: list[int] = []
    next(request.jobs(request.empty_map().images, False, lambda: told.append(1)))
    assert bool(told) == with_image_effects
