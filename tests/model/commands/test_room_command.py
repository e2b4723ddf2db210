"""The command room simulates a room's picture and finds where a picture was taken."""

import math
from pathlib import Path

import numpy as np
import pytest
from model.commands.conftest import Command
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.room.place_text import format_place
from occ_model.room.pose_fit import Located
from occ_model.room.room import Place


def write_room(folder: Path) -> Path:
    # Every second pixel, read out in the same time.
    room = occ.load_room("hall").replace(rows=2304, columns=1728, readout_time=16e-6)
    path = folder / "small.toml"
    path.write_text(room.to_toml(), encoding="utf-8")
    return path


def test_a_simulated_picture_is_located(tmp_path: Path, run: Command) -> None:
    room, picture = write_room(tmp_path), tmp_path / "picture.png"
    rendered = run("room", "render", "--room", room, "--yaw", "10", "--roll", "40", "-o", picture)
    assert "of 96 lamps in the picture" in rendered.out
    with Image.open(picture) as written:
        assert written.size == (1728, 2304)
    said = run("room", "locate", picture, "--room", room).out
    assert (
        "Focal length: 26 mm equivalent, as the room says, because the photo has no EXIF data"
        in said
    )
    assert "Distortion: none" in said
    assert "I am here:  x 0.5" in said
    assert "yaw 10.0" in said or "yaw 9.9" in said


def test_no_error_is_printed_as_zero_and_no_zero_as_negative() -> None:
    errors = np.array([2e-3, 3e-4, 8.71e-5, *np.radians([0.0042, 0.028, 0.00057])])
    yaw, roll = math.radians(-0.0003), math.radians(40.0012)
    place = Place(x=0.5009, y=-0.2001, z=1.1997, yaw=yaw, pitch=-1e-12, roll=roll)
    said = format_place(place, Located(place, np.diag(errors**2), 1.0, 1))
    assert said == (
        "x 0.5009 ± 0.0020 m, y -0.20010 ± 0.00030 m, z 1.199700 ± 0.000087 m, "
        "yaw -0.0003 ± 0.0042 °, pitch 0.000 ± 0.028 °, roll 40.00120 ± 0.00057 °"
    )
    assert format_place(place).endswith("yaw 0.00 °, pitch 0.00 °, roll 40.00 °")


def test_a_picture_without_a_named_lamp_fails_with_the_reason(
    tmp_path: Path, command: Command
) -> None:
    failed = command("room", "locate", "--room", write_room(tmp_path), "--x", "80")
    assert failed.code != 0
    assert "No lamp was found" in failed.out


def test_a_map_has_no_single_place_of_its_own(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["room", "map", "--x", "1"])
    assert "--x" in capsys.readouterr().err
