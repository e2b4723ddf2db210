"""The window, the model and the studies agree about a scene."""

import csv
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from gui.conftest import InlineWorkers
from gui.pane_bench import handle_middle
from gui.user import User
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.detection_map import slider_strip_controller, wiring
from occ_gui.detection_map.colour_map import RATES, to_colours
from occ_gui.detection_map.map_schedule import MapRequest
from occ_gui.detection_map.slider_strip_controller import (
    SCENE_IMAGES,
    RateRequest as Request,
    compute_scene_rate,
    make_scene_rate_job,
)
from occ_gui.detection_map.worker import SEED, UNSEEN_PARAMETERS, make_rate_settings, measure_strip
from occ_gui.simulation.verdict import verdict_on
from occ_gui.widgets.state_look import State
from occ_model.cli import main
from occ_model.parallel.job import do_job
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study import working_range as module
from occ_model.study.success_rate import count_right_and_whole, right_bits_of_images
from occ_model.study.sweep.sweep import measure_points
from occ_model.study.theory import null_frequency
from occ_model.study.working_range import working_range


def frontier_scene() -> Scene:
    """Return a scene with the paper's phone near the end of the decoder's working range."""
    scene, random = occ.load_preset("phone-136us"), np.random.default_rng(21)
    changes: dict[str, ParameterValue] = {
        "rows": scene.camera.rows // 12,
        "columns": scene.camera.columns // 2,
        "readout_time": scene.camera.readout_time * 2.0,
        "panel_width": scene.transmitter.panel_width * 1.3,
        "switching_frequency": null_frequency(scene) * float(random.uniform(0.8, 1.05)),
        "code": int(random.integers(1024)),
        "distance": float(random.uniform(0.6, 1.2)),
        "start_time": float(random.uniform(0.0, 0.01)),
        "iso": float(100.0 * 2.0 ** random.uniform(0.0, 3.0)),
    }
    return scene.replace(**changes)


def test_a_picture_that_studies_may_contradict_states_what_it_leaves_out(
    application: Application, user: User
) -> None:
    scene = occ.load_preset("phone-136us").replace(rows=800, switching_frequency=14.6e3)
    user.put(scene, "another scene")
    label = application.view("decode").omissions
    application.settings.set_tolerance(3.0)
    user.wait_until_idle()
    assert label.isHidden()
    application.settings.set_observable("profile")  # its means hide what the signal shows
    user.wait_until_idle()
    assert not label.isHidden()
    assert "Shot and read noise" in label.text()
    application.settings.set_observable("signal")
    user.wait_until_idle()
    assert label.isHidden()


@cache
def scene_of(decoder: str) -> Scene:
    """Return a scene near an end of a decoder's working range."""
    few = occ.load_preset("phone-136us").replace(rows=300, switching_frequency=3.4e3)
    if decoder in {"threshold", "matched"}:
        return frontier_scene()
    return few if decoder == "equalizer" else few.replace(switching_frequency=1.85e3)


EACH_DECODER = [
    "threshold",
    *(pytest.param(name, marks=pytest.mark.whole) for name in ("sequence", "matched", "equalizer")),
]


@pytest.mark.parametrize("decoder", EACH_DECODER)
def test_six_ways_give_the_same_rate(
    decoder: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Compare strip, map, working range, two commands of the shell, and banner."""
    scene = scene_of(decoder).replace(**UNSEEN_PARAMETERS)
    settings, images = SimulationSettings(), SCENE_IMAGES
    frequency = scene.transmitter.switching_frequency
    banner = make_scene_rate_job(Request(scene, settings, decoder))
    rate = compute_scene_rate(do_job(banner, lambda: None).value)
    percent = occ.success_rate(scene, images, decoder)
    own_place: dict[str, ParameterValue] = {"switching_frequency": frequency}
    at = ((0, own_place),)
    elsewhere = scene.replace(switching_frequency=5e3)
    strip = measure_strip(
        elsewhere, make_rate_settings(settings, images, (decoder,), True), "switching_frequency",
        at, lambda: None,
    ).points[0]  # fmt: skip
    request = MapRequest(elsewhere, "switching_frequency", "distance", settings)
    sweep = request.make_sweep(images, (decoder,))
    cell = ((0, own_place | {"distance": scene.pose.distance}),)
    of_map = measure_points(sweep.scene, sweep.settings, cell, 0, lambda: None).points[0]
    counts = RateSettings(images, (decoder,), SEED)
    monkeypatch.setattr(module, "STEP", 1e9)  # no values between the scene's own and the ends
    own = working_range(scene, "switching_frequency", 99.0, counts).own
    scene_file, table = tmp_path / "scene.toml", tmp_path / "rates.csv"
    scene_file.write_text(elsewhere.to_toml(), encoding="utf-8")
    assert main([
        "sweep", "--scene", str(scene_file), "--vary", f"switching_frequency={frequency!r}Hz",
        "--decoder", decoder, "--images", str(images), "--jobs", "1", "--out", str(table),
    ]) == 0  # fmt: skip
    lines = [line for line in table.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    (line,) = csv.DictReader(lines)
    assert float(line["success rate (%)"]) == percent
    assert 100.0 * rate.fraction == pytest.approx(percent, abs=1e-9)
    assert 100.0 * strip.right[0] / strip.sent == percent
    assert 100.0 * of_map.right[0] / of_map.sent == percent
    assert own.rate == percent
    assert (float(line["95 % from (%)"]), float(line["95 % to (%)"])) == (own.low, own.high)
    assert (100.0 * rate.low, 100.0 * rate.high) == pytest.approx((own.low, own.high))
    scene_file.write_text(scene.to_toml(), encoding="utf-8")
    capsys.readouterr()
    main([
        "limits", "--scene", str(scene_file), "--decoder", decoder, "--images", str(images),
        "--rate", "99.9", "--jobs", "1",
    ])  # fmt: skip
    row = capsys.readouterr().out.splitlines()[2].split()
    assert (row[0], row[-1]) == (decoder, f"{float(line['bits a second']):.4g}")


@pytest.mark.parametrize("decoder", EACH_DECODER)
def test_the_verdict_on_a_picture_agrees_with_the_studys_count(decoder: str) -> None:
    scene = scene_of(decoder)
    sent = scene.transmitter.payload_bits
    duration = len(occ.packet(scene)) * scene.transmitter.switching_period
    counts = right_bits_of_images(scene, RateSettings(6, (decoder,), SEED, path="image"))
    for image, (right,) in enumerate(counts):
        random = np.random.default_rng(np.random.SeedSequence(SEED, spawn_key=(image,)))
        at_start = scene.replace(start_time=float(random.uniform(0.0, duration)))
        seed = int(random.integers(2**32))
        frame = occ.render(at_start, observable="signal", seed=seed)
        verdict = verdict_on(occ.decode(frame.image, at_start, decoder), sent)
        assert (verdict.state is State.GOOD) == (right == len(sent))
        assert (verdict.state is State.BAD) == (right == 0)


@pytest.fixture
def workers(monkeypatch: pytest.MonkeyPatch, inline_workers: InlineWorkers) -> None:
    """Run all measurements of the window in this process."""
    monkeypatch.setattr(slider_strip_controller, "POSITIONS", 3)
    monkeypatch.setattr(wiring, "new_workers", lambda: inline_workers)


@pytest.mark.own_window
def test_strip_and_banner_state_the_rate_of_the_study(
    workers: None, application: Application, user: User, qtbot: QtBot
) -> None:
    """Check that the rate at the handle is the study's, too, and not that of the shown picture."""
    application.scene_store.put(
        application.scene_store.scene.replace(rows=300, switching_frequency=3.4e3), "an edge"
    )
    user.wait_until_idle()
    scene, strips = application.scene_store.scene, application.slider_strips.strips
    own = application.background_rates.scene_rate
    qtbot.waitUntil(lambda: own.rate is not None)
    rate = occ.success_rate(scene, 20)
    assert 5.0 < rate < 99.0
    # Some pictures are read in part. Bits a second count whole ones, which the banner states, too.
    (whole,) = count_right_and_whole(scene, RateSettings(20, ("threshold",), SEED))[1]
    assert own.rate.whole == whole
    assert {
        round(100.0 * s.present_rate.fraction, 9) for s in strips.values() if s.present_rate
    } == {rate}
    badges = {badge.key: badge.text for badge in application.story.verdict.badges.badges}
    assert badges["rate"] == f"20 pictures: {rate:.3g} % of bits read"
    strip = strips["iso"]
    assert f"{rate:.3g} % of the bits of 20 pictures" in strip.toolTip()
    strip.show_fractions((0.0,) * 9)
    colour = to_colours(np.array([[rate]]), 0.0, 100.0, RATES)[0, 0, :3].tolist()
    pixel = strip.grab().toImage().pixelColor(round(handle_middle(strip.slider) - strip.x() + 9), 3)
    assert [pixel.red(), pixel.green(), pixel.blue()] == colour
    application.scene_store.change(switching_frequency=14e3)
    assert {s.present_rate for s in strips.values()} == {None}
