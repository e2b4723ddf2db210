"""The command ``match`` with a film measures a camera by a lamp, or a lamp by a camera."""

import re
from pathlib import Path

import pytest
from model.commands.conftest import Command, Outcome

import occ_model as occ
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


def parse_measured(text: str) -> tuple[float, float]:
    """Return the number and the error of a text such as ``6.3 ± 0.1 ms``."""
    value, _, error = text.split()[:3]
    return float(value), float(error)


def lines_of(found: Outcome) -> dict[str, str]:
    return {line[:18].strip(): line[18:] for line in found.lines}


@pytest.mark.parametrize("ending", ["mkv", "mp4"])
def test_the_first_line_is_the_readout_time_of_the_camera(
    ending: str, folder: Path, run: Command
) -> None:
    found = run("match", folder / f"lamp.{ending}", "--led-frequency", "1kHz")
    assert found.out.startswith("readout time      ")
    assert "µs" in found.lines[0]
    value, error = parse_measured(lines_of(found)["readout time"])
    assert abs(value - 25.0) < 4.0 * error
    assert error < 0.01
    assert found.err == ""


def test_a_lamp_is_measured_by_a_camera_that_is_known(folder: Path, run: Command) -> None:
    known = ["--estimate", "switching_frequency", "--set", "readout_time=25.2us"]
    lamp = ["--set", "light=lamp", "--set", "lamp_frequency=3kHz", "--readout-tolerance", "1%"]
    first = run("match", folder / "lamp.mkv", *known, *lamp).lines[0]
    assert first.startswith("lamp frequency    ")
    value, error = parse_measured(first[18:])
    scale = 1.0 if "kHz" in first else 1e-3
    assert abs(value * scale - 1.0) < 4.0 * error * scale


def test_all_lamps_that_an_inexact_oscillator_may_be_are_listed(folder: Path, run: Command) -> None:
    options = ["--led-frequency", "985Hz", "--frequency-tolerance", "2%"]
    found = run("match", folder / "lamp.mkv", *options)
    assert found.lines[0].endswith("µs, not sure")
    assert "every 29.97 Hz" in lines_of(found)["lamp frequency"]
    assert re.search(r": (1 kHz|1000|999\.9).* and (970|969\.9)", found.err)


def test_the_mains_are_measured_by_the_light_of_a_wall(tmp_path: Path, run: Command) -> None:
    scene = LAMP.replace(
        light="mains", mains_frequency=50.03, mains_depth=0.3, exposure_time=1e-3, iso=50.0,
        distance=0.5,
    )  # fmt: skip
    film = tmp_path / "wall.png"
    occ.write_video(occ.render_video(scene, 60, Recording(frame_rate=29.97)), film)
    known = ["--set", "light=mains", "--set", "readout_time=25.5us"]
    found = run("match", film, "--estimate", "switching_frequency", *known)
    value, error = parse_measured(found.lines[0][18:])
    assert abs(value - 100.06) < 4.0 * error
    assert error < 0.002
    readout, error = parse_measured(lines_of(found)["readout time"])
    assert abs(readout - 25.0) < 2.0 * error


@pytest.mark.parametrize("option", ["--lamps", "--chips", "--region=0:9,0:9", "--fit-gamma"])
def test_what_only_a_photo_has_is_refused_for_a_film(
    option: str, folder: Path, command: Command
) -> None:
    refused = command("match", folder / "lamp.mkv", option)
    assert refused.code != 0
    assert f"{option.partition('=')[0]} is given with a film; allowed: with a photo." in refused.err


def test_a_lamp_that_the_film_cannot_show_is_not_measured(folder: Path, command: Command) -> None:
    failed = command("match", folder / "lamp.mkv", "--led-frequency", "0.01Hz")
    assert (failed.code, failed.out) == (1, "")
    assert "The film gives no clock: " in failed.err


@pytest.mark.parametrize("frequency", ["1013Hz", "1GHz"])
def test_a_frequency_that_the_phases_contradict_gives_nothing_sure(
    frequency: str, folder: Path, command: Command
) -> None:
    found = command("match", folder / "lamp.mkv", "--led-frequency", frequency)
    assert "not sure" in found.lines[0]
    assert "rests on the frequency of the lamp alone, which may be another one" in found.err


def test_a_film_of_something_else_than_the_scene_sends_is_no_success(
    folder: Path, command: Command
) -> None:
    found = command("match", folder / "lamp.mkv", "--set", "readout_time=25us")
    assert found.code == 1
    assert "not sure" in found.lines[0]
    assert "No frame contains packets as the scene sends them." in found.err


def test_a_film_without_stripes_fails_with_a_sentence(tmp_path: Path, command: Command) -> None:
    dark = occ.render_video(LAMP.replace(exposure_time=1e-3), 3)
    occ.write_video(dark, tmp_path / "dark.mkv")
    failed = command("match", tmp_path / "dark.mkv", "--led-frequency", "1kHz")
    assert failed.code == 1
    assert "No frame shows stripes" in failed.err
