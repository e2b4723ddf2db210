"""A photo of a room is read as its picture, with what the file states about the camera."""

import dataclasses
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from photo_files import save_as_taken
from PIL import Image
from small_rooms import small_room

import occ_model as occ
from occ_model.cli import main
from occ_model.room.locate_photo import RoomPhoto, read_room_photo
from occ_model.room.room import Place, Room


@cache
def _room(focal_length: float = 0.026) -> Room:
    camera = Place(x=0.5, y=0.7, z=-0.2, yaw=0.1, pitch=-0.1, roll=0.4)
    return small_room(apart=1.1, camera=camera, rows=1024, equivalent_focal_length=focal_length)


@cache
def _picture() -> np.ndarray:
    return occ.render_room(_room()).camera_image


def _off(found: RoomPhoto, true: Place) -> np.ndarray:
    assert found.reading.is_sure, found.reading.reasons
    off = np.array(dataclasses.astuple(found.reading.located.place)) - dataclasses.astuple(true)
    off[3:] = (off[3:] + np.pi) % (2.0 * np.pi) - np.pi
    return np.abs(off)


def test_a_rounded_focal_length_is_part_of_the_stated_errors(tmp_path: Path) -> None:
    true_focal_length = 0.0256
    room = _room(true_focal_length)
    path = save_as_taken(
        tmp_path / "room.jpg", occ.render_room(room).camera_image,
        focal_length=26, exposure_time=60e-6,
    )  # fmt: skip
    photo, known = occ.load_photo(path), _room(0.03)
    found = read_room_photo(photo, known)
    assert {lamp.name for lamp in found.reading.lamps} == {"L0", "L1", "L2", "L3"}
    located = found.reading.located
    assert (_off(found, room.camera) < 4.0 * located.errors).all()
    assert located.focal_length == pytest.approx(true_focal_length, abs=4.0 * located.focal_error)
    assert 0.0 < located.focal_error < 2e-3 / np.sqrt(12.0)
    assert "26 mm equivalent, ± 0.29 mm, as the EXIF data say" in found.assumed[0]
    # Taken as exact, it gives a wrong height; with the correct one, the error is smaller.
    exact = read_room_photo(photo, known, 0.026).reading.located
    right = read_room_photo(photo, known, true_focal_length)
    assert exact is None or abs(exact.place.z + 0.2) > 5.0 * exact.errors[2]
    assert right.reading.located.errors[2] < 0.5 * located.errors[2]
    assert (_off(right, room.camera) < 4.0 * right.reading.located.errors).all()
    assert "as given" in right.assumed[0]


@pytest.mark.parametrize("quarters", [1, pytest.param(2, marks=pytest.mark.whole)])
def test_a_photo_is_read_in_any_orientation(tmp_path: Path, quarters: int) -> None:
    room = _room()
    image = np.rot90(_picture(), quarters)
    found = read_room_photo(occ.load_photo(save_as_taken(tmp_path / "room.jpg", image)), room)
    assert (_off(found, room.camera) < 4.0 * found.reading.located.errors).all()
    assert ("turned" in found.assumed[-1]) == bool(quarters)


def test_a_photo_of_half_the_size_has_twice_the_readout_time_per_column(tmp_path: Path) -> None:
    room = _room()
    image = Image.fromarray(_picture()).resize((384, 512), Image.Resampling.BOX)
    found = read_room_photo(
        occ.load_photo(save_as_taken(tmp_path / "room.jpg", np.asarray(image))), room
    )
    assert found.room.scene.camera.readout_time == pytest.approx(72e-6)
    assert "scaled to a picture of 384 columns instead of 768" in found.assumed[1]
    assert {lamp.name for lamp in found.reading.lamps if lamp.name} == {"L0", "L1", "L2", "L3"}
    assert (_off(found, room.camera) < 4.0 * found.reading.located.errors).all()


def test_a_mirrored_photo_has_no_place(tmp_path: Path) -> None:
    room = _room()
    image = _picture()[::-1]
    found = read_room_photo(occ.load_photo(save_as_taken(tmp_path / "room.jpg", image)), room)
    assert any(lamp.name for lamp in found.reading.lamps)
    assert found.reading.located is None
    assert "mirrored" in found.reading.reasons[0]


def test_the_command_states_its_assumptions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    room = _room()
    path = save_as_taken(tmp_path / "room.jpg", _picture(), focal_length=26)
    file = tmp_path / "room.toml"
    file.write_text(room.to_toml(), encoding="utf-8")
    words = ["room", "locate", str(path), "--room", str(file)]
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "Assumed. Focal length: 26 mm equivalent, ± 0.29 mm, as the EXIF data say" in said
    assert "Focal length that fits: 2" in said
    assert main([*words, "--set", "equivalent_focal_length=26mm"]) == 0
    said = capsys.readouterr().out
    assert "26 mm equivalent, as given" in said
    assert "that fits" not in said


def test_a_nearly_known_focal_length_keeps_its_error() -> None:
    room = _room()
    image = _picture()
    for fraction in (1e-7, 1e-6):
        located = occ.read_room(image, room, fraction).located
        widened = max(1.0, np.sqrt(located.deviations / located.freedom))
        assert located.focal_error == pytest.approx(0.026 * fraction * widened, rel=0.01)
