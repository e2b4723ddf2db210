"""The command ``match`` with a film measures a camera by a lamp, or a lamp by a camera."""

import re
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.cli import main
from occ_model.scene.recording import Recording

READOUT, FRAMES = 25e-6, 24
LAMP = occ.load_preset("phone-136us").replace(
    light="lamp", lamp_frequency=1000.0, duty=0.5, rows=64, columns=1080, readout_time=READOUT,
    exposure_time=1e-4, iso=400.0, panel_width=0.8, panel_height=1.5, distance=0.9,
)  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Films of a lamp at 29.97 frames a second in two containers, and slowed down."""
    folder = tmp_path_factory.mktemp("films")
    film = occ.render_video(LAMP, FRAMES, Recording(frame_rate=29.97))
    occ.write_video(film, folder / "lamp.mkv")
    occ.write_video(film, folder / "lamp.mp4")
    return folder


def measured(text: str) -> tuple[float, float]:
    """Return the number and the error of a line such as ``gap  6.3 ± 0.1 ms``."""
    value, _, error = text.split()[:3]
    return float(value), float(error)


def lines_of(printed: str) -> dict[str, str]:
    return {line[:18].strip(): line[18:] for line in printed.splitlines()}


@pytest.mark.parametrize("ending", ["mkv", "mp4"])
def test_the_first_line_is_the_readout_time_of_the_camera(
    ending: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = str(folder / f"lamp.{ending}")
    assert main(["match", film, "--led-frequency", "1kHz"]) == 0
    printed, problems = capsys.readouterr()
    assert printed.startswith("readout time      ")
    assert "µs" in printed.splitlines()[0]
    value, error = measured(lines_of(printed)["readout time"])
    assert abs(value - 25.0) < 4.0 * error
    assert error < 0.01
    assert problems == ""


def test_a_lamp_is_measured_by_a_camera_that_is_known(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = str(folder / "lamp.mkv")
    known = ["--estimate", "switching_frequency", "--set", "readout_time=25.2us"]
    lamp = ["--set", "light=lamp", "--set", "lamp_frequency=3kHz", "--readout-tolerance", "1%"]
    assert main(["match", film, *known, *lamp]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.startswith("lamp frequency    ")
    value, error = measured(first[18:])
    scale = 1.0 if "kHz" in first else 1e-3
    assert abs(value * scale - 1.0) < 4.0 * error * scale


def test_all_lamps_that_an_inexact_oscillator_may_be_are_listed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = str(folder / "lamp.mkv")
    options = ["--led-frequency", "985Hz", "--frequency-tolerance", "2%"]
    assert main(["match", film, *options]) == 0
    printed, problems = capsys.readouterr()
    assert printed.splitlines()[0].endswith("µs, not sure")
    assert "every 29.97 Hz" in lines_of(printed)["lamp frequency"]
    assert re.search(r": (1 kHz|1000|999\.9).* and (970|969\.9)", problems)


def test_the_mains_are_measured_by_the_light_of_a_wall(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = LAMP.replace(
        light="mains",
        mains_frequency=50.03,
        mains_depth=0.3,
        exposure_time=1e-3,
        iso=50.0,
        distance=0.5,
    )
    film = str(tmp_path / "wall.png")
    occ.write_video(occ.render_video(scene, 60, Recording(frame_rate=29.97)), film)
    known = ["--set", "light=mains", "--set", "readout_time=25.5us"]
    assert main(["match", film, "--estimate", "switching_frequency", *known]) == 0
    printed = capsys.readouterr().out
    value, error = measured(printed.splitlines()[0][18:])
    assert abs(value - 100.06) < 4.0 * error
    assert error < 0.002
    readout, error = measured(lines_of(printed)["readout time"])
    assert abs(readout - 25.0) < 2.0 * error


@pytest.mark.parametrize("option", ["--lamps", "--chips", "--region=0:9,0:9", "--fit-gamma"])
def test_what_only_a_photo_has_is_refused_for_a_film(
    option: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["match", str(folder / "lamp.mkv"), option]) != 0
    said = capsys.readouterr().err
    assert f"{option.partition('=')[0]} is given with a film; allowed: with a photo." in said


def test_a_lamp_that_the_film_cannot_show_is_not_measured(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["match", str(folder / "lamp.mkv"), "--led-frequency", "0.01Hz"]) == 1
    printed, problems = capsys.readouterr()
    assert printed == ""
    assert "The film gives no clock: " in problems


@pytest.mark.parametrize("frequency", ["1013Hz", "1GHz"])
def test_a_frequency_that_the_phases_contradict_gives_nothing_sure(
    frequency: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["match", str(folder / "lamp.mkv"), "--led-frequency", frequency])
    printed, problems = capsys.readouterr()
    assert "not sure" in printed.splitlines()[0]
    assert "rests on the frequency of the lamp alone, which may be another one" in problems


def test_a_film_of_something_else_than_the_scene_sends_is_no_success(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["match", str(folder / "lamp.mkv"), "--set", "readout_time=25us"]) == 1
    printed, problems = capsys.readouterr()
    assert "not sure" in printed.splitlines()[0]
    assert "No frame contains packets as the scene sends them." in problems


def test_a_film_without_stripes_fails_with_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    dark = occ.render_video(LAMP.replace(exposure_time=1e-3), 3)
    occ.write_video(dark, tmp_path / "dark.mkv")
    assert main(["match", str(tmp_path / "dark.mkv"), "--led-frequency", "1kHz"]) == 1
    assert "No frame shows stripes" in capsys.readouterr().err
