"""The commands that simulate a film and read one."""

import math
from pathlib import Path

import pytest
from model.commands.conftest import Command

import occ_model as occ
from occ_model.cli import main

SCENE = [
    "--preset", "phone-68us", "--set", "columns=720", "--set", "rows=32",
    "--set", "readout_time=36us", "--set", "switching_frequency=3kHz",
    "--set", "exposure_time=150us", "--set", "distance=0.5", "--set", "panel_height=1.5",
    "--set", "panel_width=0.8", "--set", "framing=c-ook", "--set", "line_code=manchester",
]  # fmt: skip


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("film") / "film.mkv"
    made = ["film", *SCENE, "--set", "payload=text:four", "--frames", "24", "-o", str(path)]
    assert main(made) == 0
    return path


def test_a_film_is_read_and_reported_after_a_line_a_frame(film: Path, run: Command) -> None:
    printed = run("decode", film, *SCENE, "--set", "payload=text:????", "--follow").lines
    assert [line.split()[:2] for line in printed[:24]] == [["frame", f"{n}"] for n in range(24)]
    assert "four" in printed[23]
    lines = {line[:18].strip(): line[18:] for line in printed[24:]}
    assert lines["payload"] == "four"
    assert lines["payload complete"].startswith("after ")
    assert lines["bits"] == "".join(f"{ord(letter):08b}" for letter in "four")
    assert lines["frequency"].startswith(("2.9", "3.0"))
    assert lines["frequency"].endswith("Hz")
    assert "±" in lines["gap"]


def test_a_film_of_another_scheme_fails_with_a_sentence(film: Path, command: Command) -> None:
    failed = command("decode", film, *SCENE, "--set", "framing=raw")
    assert failed.code == 1
    words = failed.err.splitlines()[-1]
    assert "not known for any of" in words
    assert "chips" in words


SMALL = [
    "--set", "rows=120", "--set", "columns=160", "--set", "readout_time=100us",
    "--set", "distance=0.8", "--frames", "4",
]  # fmt: skip


def test_the_film_is_the_recording_of_the_scene(tmp_path: Path, run: Command) -> None:
    path = tmp_path / "film.mkv"
    how = [
        "--frame-rate", "25 Hz", "--frame-jitter", "0.1ms", "--camera-drift", "20ppm",
        "--transmitter-drift", "-5 ppm", "--exposures", "68us,136us", "--seed", "4",
        "--waypoint", "0: roll=0", "--waypoint", "0.1s:offset_x=20cm,roll=5deg",
    ]  # fmt: skip
    assert run("film", *SMALL, *how, "-o", path).out == (
        f"{path}: 4 frames of 160 columns, 120 rows; gap 24 ms, 60 % of a frame\n"
    )
    film = occ.load_video(path)
    recording = occ.Recording(
        frame_rate=25.0,
        frame_jitter=1e-4,
        camera_drift=20e-6,
        transmitter_drift=-5e-6,
        exposure_times=(68e-6, 136e-6),
        path=(occ.Waypoint(0.0), occ.Waypoint(0.1, offset_x=0.2, roll=math.radians(5.0))),
    )
    assert film.recording == recording
    assert film.scene is not None
    again = occ.render_video(film.scene, 4, recording, settings=occ.SimulationSettings(seed=4))
    assert all((a.image == b.image).all() for a, b in zip(film, again, strict=True))


def test_the_loss_of_a_lossy_film_is_stated(tmp_path: Path, run: Command) -> None:
    words = run("film", *SMALL, "-o", tmp_path / "film.mp4").lines[1]
    assert words.startswith("The file is lossy: in the first frame pixels differ by ")
    loss = float(words.split("differ by ")[1].split()[0])
    assert 0.1 < loss < 8.0
