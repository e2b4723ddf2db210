"""A camera is measured by bars of mains lamps, and nothing else is taken for them."""

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pytest
from photo_world.mains_rooms import Room, photograph_room, random_room
from PIL import Image

import occ_model as occ

ROWS, COLUMNS = 300, 360
FRAME = 31e-3  # seconds in which the frame is read: 3.1 bars at 50 Hz


def saved(folder: Path, *pictures: np.ndarray) -> list[Path]:
    paths = [folder / f"{number}.png" for number in range(len(pictures))]
    for path, picture in zip(paths, pictures, strict=True):
        Image.fromarray(picture).save(path)
    return paths


def wall(start: float = 0.0, depth: float = 0.3, frame: float = FRAME) -> np.ndarray:
    """Draw an even wall under a cosine of 100 Hz, in sRGB, by its closed form."""
    cycles = start + 100.0 * frame * np.arange(ROWS) / ROWS
    light = 0.3 * (1.0 + depth * np.cos(2.0 * math.pi * cycles))
    noise = np.random.default_rng(5).normal(0.0, 0.5, (ROWS, COLUMNS))
    values = 255.0 * (1.055 * light ** (1.0 / 2.4) - 0.055)
    return np.rint(values[:, None] + noise).astype(np.uint8)


def a_room(**changes: object) -> Room:
    room = next(room for seed in range(100) if 3.0 < (room := random_room(seed)).bars < 4.0)
    return replace(room, size=(ROWS, COLUMNS), **changes)  # type: ignore[arg-type]


@cache
def pair(**changes: object) -> tuple[np.ndarray, ...]:
    return tuple(photograph_room(a_room(**changes)))


def measured_along_lines(paths: list[Path], mains: float = 50.0) -> occ.CameraMeasurement:
    return occ.measure_camera(paths, mains, scan_axis="lines")


def test_an_even_wall_gives_the_readout_time_but_is_never_sure(tmp_path: Path) -> None:
    """Level slats with soft edges give the same pixels."""
    measured = occ.measure_camera(saved(tmp_path, wall()), 50.0)
    error = measured.uncertainties["readout_time"]
    assert measured.verdict == "doubtful"
    assert "One picture does not tell" in measured.reasons[-1]
    assert measured.readout_time == pytest.approx(FRAME / ROWS, abs=3.0 * error)
    assert error < 3e-3 * measured.readout_time
    assert measured.depth == pytest.approx(0.3, abs=0.01)
    assert (measured.scan_axis, measured.lines) == ("lines", ROWS)


def test_a_pair_of_a_textured_room_gives_it_too(tmp_path: Path) -> None:
    room = a_room()
    measured = measured_along_lines(saved(tmp_path, *pair()), room.mains_frequency)
    error = measured.uncertainties["frame_readout_time"]
    assert measured.verdict == "sure"
    assert measured.frame_readout_time == pytest.approx(room.frame_readout, abs=3.0 * error)
    assert error < 0.03 * room.frame_readout


def test_columns_that_are_read_one_by_one_are_found(tmp_path: Path) -> None:
    upright = measured_along_lines(saved(tmp_path, *pair()))
    turned = occ.measure_camera(saved(tmp_path, *(np.ascontiguousarray(one.T) for one in pair())))
    assert turned.scan_axis == "columns"
    assert turned.bars == pytest.approx(upright.bars, abs=upright.uncertainties["bars"])


def test_a_smaller_picture_gives_the_same_time_of_a_frame(tmp_path: Path) -> None:
    whole = measured_along_lines(saved(tmp_path, *pair()))
    size = (COLUMNS // 2, ROWS // 2)
    smaller = (cv2.resize(one, size, interpolation=cv2.INTER_AREA) for one in pair())
    half = measured_along_lines(saved(tmp_path, *smaller))
    error = math.hypot(*(each.uncertainties["bars"] for each in (whole, half)))
    assert half.bars == pytest.approx(whole.bars, abs=2.0 * error)
    assert half.lines == ROWS // 2


def test_bars_that_stand_still_are_refused_with_that_reason(tmp_path: Path) -> None:
    with pytest.raises(occ.MatchError, match="stand still"):
        measured_along_lines(saved(tmp_path, wall(), wall()))


def test_a_room_without_bars_is_refused(tmp_path: Path) -> None:
    with pytest.raises(occ.MatchError, match="do not differ by bars"):
        measured_along_lines(saved(tmp_path, *pair(has_bars=False)))


def test_bars_bent_by_a_lens_correction_are_refused_by_name(tmp_path: Path) -> None:
    down, across = np.indices((ROWS, COLUMNS)) - np.array([ROWS, COLUMNS]).reshape(2, 1, 1) / 2
    square = (down**2 + across**2) / (ROWS**2 / 4 + COLUMNS**2 / 4)
    bent = [
        cv2.remap(
            one,
            (COLUMNS / 2 + across * (1.0 + 0.05 * square)).astype(np.float32),
            (ROWS / 2 + down * (1.0 + 0.05 * square)).astype(np.float32),
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REFLECT,
        )
        for one in (wall(), wall(start=0.4))
    ]
    with pytest.raises(occ.MatchError, match="corrected the lens's distortion"):
        measured_along_lines(saved(tmp_path, *bent))


def test_wrong_arguments_are_refused(tmp_path: Path) -> None:
    paths = saved(tmp_path, wall(), wall(start=0.3)[:-20], wall())
    with pytest.raises(occ.ParameterError, match="photos is 3 pictures; allowed: two pictures"):
        occ.measure_camera(paths)
    with pytest.raises(occ.ParameterError, match="photos is 0 pictures"):
        occ.measure_camera([])
    with pytest.raises(occ.ParameterError, match="mains_frequency is 0 Hz"):
        occ.measure_camera(paths[:1], 0.0)
    with pytest.raises(occ.MatchError, match="300 and 280 lines"):
        occ.measure_camera(paths[:2])


@pytest.mark.parametrize(
    ("shape", "level", "said"),
    [
        ((60, 80), 0, "Only 0 % of the picture can be used"),
        ((60, 80), 255, "Only 0 % of the picture can be used"),
        ((60, 80), 90, "do not differ by bars"),
        ((1, 1), 90, "at least 40 that are read one by one"),
        ((400, 3), 90, "at least 40 that are read one by one"),
    ],
)
def test_pictures_that_show_nothing_are_refused(
    tmp_path: Path, shape: tuple[int, int], level: int, said: str
) -> None:
    empty = np.full(shape, level, np.uint8)
    with pytest.raises(occ.MatchError, match=said):
        occ.measure_camera(saved(tmp_path, empty, empty))


def test_the_result_is_kept_as_json_and_answers_in_a_sentence(tmp_path: Path) -> None:
    measured = measured_along_lines(saved(tmp_path, wall()))
    kept = json.loads(json.dumps(measured.to_dict()))
    assert kept["readout_time"] == measured.readout_time
    assert kept["verdict"] == "doubtful"
    assert measured.sentence.startswith("Your camera reads a line in 103.")
    assert measured.longest_exposure == pytest.approx(0.02)


def test_a_match_of_mains_light_points_to_the_measurement(tmp_path: Path) -> None:
    photo = occ.load_photo(saved(tmp_path, wall())[0], "lines")
    scene = occ.load_preset("phone-136us").replace(light="lamp", lamp_frequency=100.0)
    try:
        said = occ.match_photo(photo, scene).reasons
    except occ.MatchError as error:
        said = error.reasons
    assert "occ-model camera --mains 50Hz" in said[-1]
    assert "chips" not in " ".join(said)


def test_fewer_bars_than_two_are_doubtful_with_a_wide_error(tmp_path: Path) -> None:
    measured = measured_along_lines(saved(tmp_path, wall(frame=14e-3), wall(0.4, frame=14e-3)))
    error = measured.uncertainties["frame_readout_time"]
    assert measured.verdict == "doubtful"
    assert "at least 1.9 are needed" in measured.reasons[0]
    assert measured.frame_readout_time == pytest.approx(14e-3, abs=2.0 * error)
    assert error > 0.1 * measured.frame_readout_time
