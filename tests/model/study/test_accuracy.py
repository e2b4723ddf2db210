"""Laws of the accuracy study and of its command."""

import csv
from pathlib import Path

import numpy as np
import pytest
from exact_light import OTHER_LIGHTS, ExactLight
from PIL import Image

import occ_model as occ
from occ_model.camera.exposure import lit_fraction
from occ_model.cli import main
from occ_model.results.accuracy import ACCURACY_PARTS, AccuracyPoint
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.accuracy import (
    SAMPLES,
    accuracy,
    exact_lit_fraction,
    point_count,
    sampled_lit_fraction,
    time_moves,
)

SMALL = ("rows=80", "columns=400", "panel_width=0.1", "panel_height=0.08")


def small(preset: str) -> Scene:
    return occ.load_preset(preset).replace(
        rows=80, columns=400, panel_width=0.1, panel_height=0.08, distance=0.5
    )


@pytest.fixture(scope="module")
def points() -> list[AccuracyPoint]:
    return list(accuracy(small("phone-136us-real")))


def select_part(points: list[AccuracyPoint], part: str) -> list[AccuracyPoint]:
    return [point for point in points if point.part == part]


def test_the_count_before_measuring_is_that_of_all_parts(points: list[AccuracyPoint]) -> None:
    assert list(dict.fromkeys(point.part for point in points)) == list(ACCURACY_PARTS)
    assert len(points) == point_count(small("phone-136us-real"))
    assert all(point.seconds > 0.0 for point in points)


def test_a_time_is_the_median_after_moves_of_the_exposure(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene, now, exposures = occ.Scene(), [0.0], list[float]()
    durations = iter((5.0, 0.01, 0.02, 0.09, 0.025))  # the first, of the scene itself, is not timed

    def work(moved: Scene) -> Scene:
        now[0] += next(durations)
        exposures.append(moved.camera.exposure_time)
        return moved

    monkeypatch.setattr("occ_model.study.accuracy.perf_counter", lambda: now[0])
    monkeypatch.setattr("occ_model.study.accuracy._ENOUGH_SECONDS", 0.14)
    assert time_moves(work, scene) == (pytest.approx(0.0225), scene)
    durations = iter((5.0, 0.2))
    time_moves(work, scene)
    assert len(set(exposures)) == len(exposures) - 1  # no move again, which would be remembered


@pytest.mark.parametrize(
    "preset", ["phone-68us", pytest.param("tablet-122us", marks=pytest.mark.whole)]
)
def test_points_are_counted_correctly_if_there_are_few_effects(preset: str) -> None:
    scene = small(preset).replace(gain_variation=0.0)
    settings = SimulationSettings(tolerance=np.inf)
    assert len(list(accuracy(scene, settings))) == point_count(scene, settings)


def test_the_closed_form_is_exact_and_the_error_of_n_samples_is_1_over_n(
    points: list[AccuracyPoint],
) -> None:
    *samples, closed = select_part(points, "integration")
    assert closed.error < 1e-9
    assert len(samples) == len(SAMPLES) == 13
    errors = np.array([point.error for point in samples])
    # Each sample represents 1/n of the exposure, so the error falls in proportion on average.
    slope = np.polyfit(np.log(SAMPLES), np.log(errors), 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.15)


def test_the_last_added_effect_gives_the_complete_simulation(points: list[AccuracyPoint]) -> None:
    *ladder, current = select_part(points, "effects")
    assert ladder[0].name == "paper's model"
    assert ladder[0].error > 1.0
    decisions = occ.plan(small("phone-136us-real")).decisions
    assert ladder[1].effects == (max(decisions, key=lambda one: one.estimate).effect,)
    assert ladder[-1].error == 0.0
    assert current.name == "this plan"
    assert current.error <= 0.5


@pytest.mark.parametrize("tolerance", [pytest.param(0.0, marks=pytest.mark.whole), 5.0])
def test_the_current_setting_is_marked_exactly_once(tolerance: float) -> None:
    scene, settings = small("phone-136us-real"), SimulationSettings(tolerance)
    (current,) = [point for point in accuracy(scene, settings) if point.current]
    assert set(current.effects) == set(occ.plan(scene, tolerance).included)


def test_samples_count_chips_that_are_lit() -> None:
    scene = small("phone-136us").replace(pattern="1")
    assert (sampled_lit_fraction(scene, 7) == 1.0).all()
    halves = scene.replace(pattern="10", exposure_time=1e-3, switching_frequency=1e3)
    assert sampled_lit_fraction(halves.replace(start_time=0.5e-3), 4)[0] == 0.5


@pytest.mark.parametrize("light", OTHER_LIGHTS)
def test_samples_of_any_light_come_near_its_exact_mean(light: str) -> None:
    scene = small("phone-136us").replace(
        **OTHER_LIGHTS[light], exposure_time=1.9e-3, start_time=0.7, columns=60, readout_time=4e-4
    )
    columns = np.arange(60)
    exact = exact_lit_fraction(scene, columns)
    np.testing.assert_allclose(exact, ExactLight(scene).of_columns(), atol=1e-15)
    np.testing.assert_allclose(lit_fraction(scene), exact, atol=1e-12)
    edges = 16  # most in an exposure, of which each is missed by up to a sample
    for samples in (64, 4096):
        sampled = sampled_lit_fraction(scene, samples)
        np.testing.assert_allclose(sampled, exact, atol=edges / samples)
        assert np.abs(sampled - exact).max() > 1e-9


@pytest.mark.whole
def test_the_command_prints_the_table_and_writes_the_figure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = [word for setting in SMALL for word in ("--set", setting)]
    folder = tmp_path / "new"
    command = ["accuracy", *settings, "--tolerance", "2", "--out", str(folder)]
    assert main(command) == 0
    printed = capsys.readouterr().out.splitlines()
    assert sum("<- current" in line for line in printed) == 1
    assert any(line.startswith("integration 4096 samples") for line in printed)
    expected = {f"accuracy.{ending}" for ending in ("pdf", "png", "csv")}
    assert {path.name for path in folder.iterdir()} == expected
    lines = (folder / "accuracy.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert len(rows) == len(printed) - 1
    assert float(rows[0]["time (ms)"]) > 0.0
    with Image.open(folder / "accuracy.png") as picture:
        assert "tolerance 2 levels of the image" in str(picture.info["Description"])


def test_the_plan_is_printed_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plan", "--off", "sensor-noise", "--tolerance", "0.1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 10
    assert any(line.startswith("Shot and read noise: ") and "switched" in line for line in lines)
