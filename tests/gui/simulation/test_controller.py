"""The panes end with the results of the latest scene, or keep the last if it has no picture."""

from dataclasses import replace
from itertools import count
from typing import Any

import numpy as np
import pytest
from gui.kinds import SnapshotOf
from gui.simulation.conftest import SimulationBench
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.simulation import controller, jobs
from occ_gui.simulation.controller import simulate
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.scene.scene import Scene

BEHIND_THE_CAMERA: dict[str, Any] = {"distance": 0.1, "yaw": 1.2}


def test_every_changed_scene_ends_with_results_equal_to_it(bench: SimulationBench) -> None:
    for iso in (50.0, 100.0, 200.0):
        for frequency in (2e3, 5e3, 9e3):
            bench.store.change(iso=iso, switching_frequency=frequency)
        bench.wait_until_idle()
        assert bench.scenes[-1] == bench.store.scene
    assert bench.failures == []


def test_every_change_of_settings_ends_with_a_picture_of_them(bench: SimulationBench) -> None:
    bench.settings.set_tolerance(50.0)
    bench.settings.set_observable("profile")
    bench.store.force("jpeg", True)
    bench.wait_until_idle()
    frame = bench.views[0].snapshots[-1].frame
    assert (frame.plan.tolerance, frame.plan.observable) == (50.0, "profile")
    assert frame.plan.included == ("jpeg",)
    bench.store.force("jpeg", None)
    bench.wait_until_idle()
    assert bench.views[0].snapshots[-1].frame.plan.included == ()


def test_all_views_show_one_result_before_it_is_announced(
    bench: SimulationBench, qtbot: QtBot
) -> None:
    counts: list[int] = []
    bench.controller.snapshot_shown.connect(lambda _: counts.append(len(bench.views[1].snapshots)))
    with qtbot.waitSignal(bench.controller.snapshot_shown) as signal:
        bench.store.change(iso=200.0)
    assert [signal.args[0]] == [bench.views[0].snapshots[-1]] == [bench.views[1].snapshots[-1]]
    assert counts == [2]


def test_a_scene_without_a_picture_is_reported_and_the_views_keep_the_last_one(
    bench: SimulationBench, small_scene: Scene
) -> None:
    bench.change(**BEHIND_THE_CAMERA)
    (sentence,) = bench.failures
    assert "behind the camera" in sentence
    assert sentence.endswith(".")
    assert bench.scenes == [small_scene]
    bench.change(distance=1.0, yaw=0.2)
    assert bench.scenes[-1] == bench.store.scene
    assert len(bench.failures) == 1
    bench.change(rows=100_000, columns=1_000_000)
    assert "million pixels" in bench.failures[-1]


def test_the_snapshot_holds_the_models_results_for_the_scene(snapshot_of: SnapshotOf) -> None:
    snapshot = snapshot_of(code=0b1011001110)
    scene = snapshot.frame.scene
    assert np.array_equal(snapshot.frame.image, occ.render(scene).image)
    assert snapshot.results["threshold"].code == snapshot.frame.scene.transmitter.code
    assert snapshot.sent == (1, 0, 1, 1, 0, 0, 1, 1, 1, 0)
    assert snapshot.band is not None
    assert np.array_equal(snapshot.band, occ.band_profile(scene))
    assert snapshot.band_undefined == ""
    # 24 chips of 100 us, 8 us a column
    assert snapshot.period_columns == pytest.approx(24 * 100 / 8)
    snapshot = snapshot_of(pattern="01011")
    assert snapshot.sent == ()
    assert snapshot.period_columns == pytest.approx(5 * 100 / 8)
    snapshot = snapshot_of(exposure_time=200e-6)
    assert snapshot.band is None
    assert "200 µs" in snapshot.band_undefined


def test_simulation_and_reading_are_timed_separately(
    small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A clock that advances by one at every call, so that the time between two calls is one.
    monkeypatch.setattr(jobs, "perf_counter", count().__next__)
    timings = {"transmitter": 2.0, "camera": 3.0}
    frame = replace(occ.render(small_scene), timings=timings)
    monkeypatch.setattr(controller, "render_with", lambda scene, settings: frame)
    snapshot = simulate(small_scene)
    assert snapshot.simulation_seconds == 5.0
    assert snapshot.reading_seconds == 1


def test_the_snapshot_holds_each_decoders_result_of_one_picture(
    snapshot_of: SnapshotOf,
) -> None:
    snapshot = snapshot_of(exposure_time=136e-6, switching_frequency=20e3)
    results = snapshot.results.values()
    assert {result.decoder for result in results} == set(QUICK_DECODERS)
    for result in results:
        alone = occ.decode(snapshot.frame.image, snapshot.frame.scene, result.decoder)
        assert (result.code, result.failure) == (alone.code, alone.failure)
        assert result.region == alone.region


def test_a_chosen_decoder_reads_this_and_later_scenes(bench: SimulationBench) -> None:
    def decoders() -> list[str]:
        return list(bench.views[0].readings[-1].results)

    bench.wait_until_idle()
    assert decoders() == list(QUICK_DECODERS)
    bench.controller.add_decoder("sequence")
    bench.wait_until_idle()
    assert decoders() == [*QUICK_DECODERS, "sequence"]
    bench.change(iso=150.0)
    assert decoders() == [*QUICK_DECODERS, "sequence"]
    bench.controller.add_decoder("matched")
    bench.change(iso=160.0)
    assert decoders() == list(QUICK_DECODERS)


def test_the_panels_origin_and_columns_stay_in_the_picture(small_scene: Scene) -> None:
    near = simulate(small_scene.replace(distance=0.3))
    assert near.frame.corners.min() < 0
    assert near.panel_origin == (0.0, 0.0)
    assert near.panel_columns == (0.0, len(near.profile) - 1.0)
    far = simulate(small_scene.replace(distance=100.0))
    assert far.panel_origin == pytest.approx(tuple(far.frame.corners.min(axis=0)))
