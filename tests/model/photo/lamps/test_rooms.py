"""Lamps of whole rooms: small, hidden in part, thin, lit in turn."""

from pathlib import Path

import numpy as np
import pytest
from amount import amount
from photo_world.lamp_scores import Score
from photo_world.rooms import room_scene
from simulated_photos import photo_of

import occ_model as occ
from occ_model.files.writing import write_image
from occ_model.photo.reading.load import stripes_are_lines


def test_most_lamps_of_a_room_are_found_and_no_frequency_is_surely_wrong() -> None:
    """Of rooms whose seeds nothing was chosen on; ``matching.py rooms`` tries 200."""
    score = Score()
    for seed in range(7000, 7000 + amount(3, 12)):
        scene = room_scene(seed)
        score.add(seed, scene, occ.find_lamps(photo_of(scene.image)))
    # Of the rooms that the search was made with 47 of 53 are right: three deviations less.
    assert score.right >= 0.88 * score.there - 3.0 * (0.88 * 0.12 * score.there) ** 0.5
    assert score.surely_wrong == 0
    assert score.invented <= 0.05 * score.reported


@pytest.mark.parametrize("is_turned", [False, True])
def test_a_small_lamp_in_a_dark_photo_gives_the_scan_axis(is_turned: bool) -> None:
    random = np.random.default_rng(5)
    light = 12.0 + random.normal(0.0, 2.0, (1600, 1200))
    light += np.linspace(0.0, 25.0, 1200)  # a wall that is lit from a side: steps along all columns
    light[:, 300:330] += 40.0  # a door's frame
    light[900:960, 700:780] += 150.0 * (np.arange(60)[:, None] % 12 < 6)
    image = np.clip(np.rint(light), 0, 255).astype(np.uint8)
    assert stripes_are_lines(image.T if is_turned else image, False) is not is_turned


def test_a_lamp_as_thin_as_a_strip_is_found_by_its_many_edges() -> None:
    image = 12.0 + np.random.default_rng(6).normal(0.0, 1.5, (800, 700))
    image[400:409, 200:380] += 150.0 * (np.arange(180) % 15 < 7)
    (lamp,) = occ.find_lamps(photo_of(np.clip(np.rint(image), 0, 255).astype(np.uint8)))
    assert lamp.period == pytest.approx(15.0, rel=0.005)


READOUT, CYCLE, BARS = 97e-6, 10e-3, 5
"""Times in seconds: of a line, and of a round of the running light of so many bars."""


@pytest.fixture
def running_light(tmp_path: Path) -> Path:
    """Five bars, each lit a fifth of the time after the one before; rows are the lines."""
    fine = (np.arange(3200) + 0.5) / 8 * READOUT / CYCLE
    image = np.full((400, 24 * BARS), 4.0)
    for bar in range(BARS):
        lit = ((fine - bar / BARS) % 1.0 < 1.0 / BARS).reshape(400, 8).mean(axis=1)
        image[:, 24 * bar + 8 : 24 * bar + 16] += 180.0 * lit[:, None] ** (1 / 2.2)
    path = tmp_path / "bars.png"
    write_image(path, np.rint(image).astype(np.uint8))
    return path


def test_each_bar_of_a_running_light_measures_the_camera_and_has_its_own_phase(
    running_light: Path,
) -> None:
    photo = occ.load_photo(running_light, "lines")
    scene = occ.Scene().replace(light="lamp", lamp_frequency=1.0 / CYCLE)
    every = occ.match_lamps(photo, scene)
    matched = [(lamp, match) for lamp, match in every if isinstance(match, occ.Match)]
    assert len(matched) >= 3
    assert any(match.verdict == "sure" for _, match in matched)
    for lamp, match in matched:
        error = match.uncertainties["readout_time"]
        if match.verdict == "sure":  # the error of a ramp of one line holds only then
            assert match.readout_time == pytest.approx(
                READOUT, abs=max(3.0 * error, 5e-4 * READOUT)
            )
        bar = (lamp.region.first_row - 8) // 24
        # The later a bar is lit, the earlier in its cycle the first line is read.
        late = (match.start_time + bar * CYCLE / BARS) / CYCLE
        assert abs(late - round(late)) < 0.02


def test_bars_that_blink_along_the_other_axis_are_said_to_do_so(running_light: Path) -> None:
    photo = occ.load_photo(running_light, "columns")
    scene = occ.Scene().replace(light="lamp", lamp_frequency=1.0 / CYCLE)
    matched = occ.match_lamps(photo, scene)
    assert matched
    assert all("with lines as the scan axis" in str(why) for _, why in matched)
