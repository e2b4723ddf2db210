"""The command that simulates a film."""

from pathlib import Path

import pytest

import occ_model as occ
from occ_model.cli import main

SMALL = [
    "--set", "rows=120", "--set", "columns=160", "--set", "readout_time=100us",
    "--set", "distance=0.8", "--frames", "4",
]  # fmt: skip


def test_the_film_is_the_recording_of_the_scene(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "film.mkv"
    how = [
        "--frame-rate", "25 Hz", "--frame-jitter", "0.1ms", "--camera-drift", "20ppm",
        "--transmitter-drift", "-5 ppm", "--exposures", "68us,136us", "--seed", "4",
        "--waypoint", "0: roll=0", "--waypoint", "0.1s:offset_x=20cm,roll=5deg",
    ]  # fmt: skip
    assert main(["film", *SMALL, *how, "-o", str(path)]) == 0
    assert capsys.readouterr().out == (
        f"{path}: 4 frames of 160 columns, 120 rows; gap 24 ms, 60 % of a frame\n"
    )
    film = occ.load_video(path)
    recording = occ.Recording(
        frame_rate=25.0,
        frame_jitter=1e-4,
        camera_drift=20e-6,
        transmitter_drift=-5e-6,
        exposure_times=(68e-6, 136e-6),
        path=(occ.Waypoint(0.0), occ.Waypoint(0.1, offset_x=0.2, roll=film_roll())),
    )
    assert film.recording == recording
    assert film.scene is not None
    again = occ.render_video(film.scene, 4, recording, settings=occ.SimulationSettings(seed=4))
    assert all((a.image == b.image).all() for a, b in zip(film, again, strict=True))


def film_roll() -> float:
    """Five degrees, as they are read from a text."""
    value = occ.Scene().value("roll")
    assert value == 0.0
    from occ_model.scene.units import RADIAN

    read = RADIAN.parse("5deg")
    assert read is not None
    return read


def test_a_lossy_film_says_what_it_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["film", *SMALL, "-o", str(tmp_path / "film.mp4")]) == 0
    words = capsys.readouterr().out.splitlines()[1]
    assert words.startswith("Its codec is lossy: in the first frame pixels differ by ")
    loss = float(words.split("differ by ")[1].split()[0])
    assert 0.1 < loss < 8.0
