"""What a camera noted in its photo."""

import math
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from each_case import each_case
from photo_files import PICTURE, save
from PIL import Image
from PIL.TiffImagePlugin import IFDRational

from occ_model.photo.reading.exif import camera_notes, notes_of
from occ_model.photo.reading.load import Photo, load_photo

EXPOSURE_TIME, F_NUMBER, ISO = 0x829A, 0x829D, 0x8827  # as in CIPA DC-008, and not as Pillow's
SHUTTER_SPEED, APERTURE, ISO_SPEED, ISO_RECOMMENDED = 0x9201, 0x9202, 0x8833, 0x8832
MAKE, MODEL = 0x010F, 0x0110


def noted(first: dict[int, Any], exif: dict[int, Any]) -> Image.Exif:
    notes = Image.Exif()
    notes.update(first)
    notes.get_ifd(0x8769).update(exif)
    read_back = Image.Exif()  # a TIFF gets only the second directory of notes that were read
    read_back.load(notes.tobytes())
    return read_back


def photo_with(
    folder: Path, first: dict[int, Any], exif: dict[int, Any], name: str = "x.jpg"
) -> Photo:
    return load_photo(save(folder, PICTURE, name, exif=noted(first, exif)))


@pytest.mark.parametrize("name", ["x.jpg", "x.png", "x.tif", "x.webp", "x.avif", "x.heic"])
def test_the_cameras_settings_and_its_name_are_read(tmp_path: Path, name: str) -> None:
    settings = {EXPOSURE_TIME: 1 / 8000, F_NUMBER: 2.48, ISO: 100}
    photo = photo_with(tmp_path, {MAKE: "Google", MODEL: "Pixel 6", 0x0112: 6}, settings, name)
    read = (photo.exposure_time, photo.f_number, photo.iso)
    assert read == pytest.approx((1 / 8000, 2.48, 100))
    assert photo.camera == "Google Pixel 6"


@pytest.mark.parametrize("name", ["x.jpg", "x.png", "x.tif", "x.gif", "x.bmp"])
def test_what_the_camera_did_not_note_is_none(tmp_path: Path, name: str) -> None:
    PICTURE.save(tmp_path / name)
    photo = load_photo(tmp_path / name)
    read = (photo.exposure_time, photo.f_number, photo.iso, photo.camera)
    assert read == (None, None, None, None)


FOCAL, EQUIVALENT = 0x920A, 0xA405
SENSOR = {0xA002: 4000, 0xA003: 3000, 0xA20E: 800.0, 0xA20F: 800.0, 0xA210: 4}
"""4000 x 3000 pixels, 800 of them a millimetre: 5 mm x 3.75 mm, its diagonal 6.25 mm."""


def test_the_equivalent_focal_length_is_read_with_its_step(tmp_path: Path) -> None:
    photo = photo_with(tmp_path, {}, {EQUIVALENT: 26})
    assert (photo.equivalent_focal_length, photo.focal_length_step) == (0.026, 0.001)


@pytest.mark.parametrize(
    ("unit", "density"), [(4, 800.0), (3, 8000.0), (2, 20320.0), (None, 20320.0)]
)
def test_a_focal_length_and_the_sensor_s_size_give_the_equivalent_one(
    unit: int | None, density: float
) -> None:
    tags = SENSOR | {FOCAL: IFDRational(425, 100), 0xA20E: density, 0xA20F: density, 0xA210: unit}
    if unit is None:
        del tags[0xA210]
    notes = notes_of(tags)
    times = math.hypot(24.0, 36.0) / 6.25
    assert notes.equivalent_focal_length == pytest.approx(4.25e-3 * times, rel=1e-4)
    assert notes.focal_length_step == pytest.approx(0.01e-3 * times, rel=1e-4)


NONSENSE = [
    0,
    -1,
    math.inf,
    math.nan,
    1e300,
    1e-300,
    10**400,
    IFDRational(0, 0),
    IFDRational(1, 0),
    "100",
    b"100",
    (),
    ("100",),
    (0, 100),
    None,
    [100],
    pytest.param(object(), id="an object"),
]


@each_case(NONSENSE)
def test_nonsense_is_none_and_the_rest_is_read(value: object) -> None:
    names = {EXPOSURE_TIME: "exposure_time", F_NUMBER: "f_number", ISO: "iso"}
    good = {EXPOSURE_TIME: IFDRational(1, 100), F_NUMBER: IFDRational(2), ISO: 100}
    for tag, name in names.items():
        notes = notes_of(good | {tag: value})
        read = {"exposure_time": 0.01, "f_number": 2.0, "iso": 100.0} | {name: None}
        assert {each: getattr(notes, each) for each in read} == read
    for tag in (EQUIVALENT, FOCAL, *SENSOR):
        tags = {} if tag == EQUIVALENT else SENSOR | {FOCAL: 4.25}
        assert notes_of(tags | {tag: value}).equivalent_focal_length is None


def test_a_value_noted_as_several_is_the_first_of_them() -> None:
    notes = notes_of({ISO: (200, 0), F_NUMBER: (IFDRational(9, 5),)})
    assert (notes.iso, notes.f_number) == (200.0, 1.8)


@pytest.mark.parametrize("plain", [None, 0, "1/100", IFDRational(0, 0)])
def test_apex_values_stand_in_for_what_is_missing(plain: object) -> None:
    tags = {EXPOSURE_TIME: plain, F_NUMBER: plain, SHUTTER_SPEED: IFDRational(13), APERTURE: 2}
    notes = notes_of(tags)
    assert (notes.exposure_time, notes.f_number) == (1 / 8192, 2.0)


@pytest.mark.parametrize("apex", [1e9, -1e9, 10**400, math.nan, math.inf, -math.inf, "5", None])
def test_apex_nonsense_is_none(apex: object) -> None:
    notes = notes_of({SHUTTER_SPEED: apex, APERTURE: apex})
    assert (notes.exposure_time, notes.f_number) == (None, None)


def test_an_iso_beyond_sixteen_bits_is_read_from_its_other_tag() -> None:
    for tags, iso in (
        ({ISO: 65535, ISO_SPEED: 102_400}, 102_400),
        ({ISO: 65535}, 65535),
        ({ISO_RECOMMENDED: 80}, 80),
        ({ISO: 400, ISO_RECOMMENDED: 80}, 400),
    ):
        assert notes_of(tags).iso == iso


@each_case(
    [
        ("Google", "Pixel 6", "Google Pixel 6"),
        ("Canon", "Canon EOS 5D", "Canon EOS 5D"),
        ("NIKON CORPORATION", "NIKON D90", "NIKON D90"),
        ("samsung", "SM-G991B", "samsung SM-G991B"),
        (" Maker\0rest", "  A\tB\n\x1b[31mC\u202e ", "Maker A B [31mC"),
        ("", "Phone", "Phone"),
        ("Maker", None, "Maker"),
        (None, None, None),
        ("\0\0", " \n ", None),
        (b"Maker", 5, None),
        ("\ud800", "x", "x"),
    ]
)
def test_the_cameras_name_is_one_clean_line(
    make: object, model: object, camera: str | None
) -> None:
    assert notes_of({MAKE: make, MODEL: model}).camera == camera


def test_a_cameras_name_has_a_bounded_length() -> None:
    camera = notes_of({MAKE: "M" * 10**6, MODEL: "x" * 10**6}).camera
    assert len(camera) <= 60


class Broken:
    def getexif(self) -> None:
        raise ZeroDivisionError


def test_notes_that_cannot_be_read_are_none() -> None:
    notes = camera_notes(Broken())  # type: ignore[arg-type]
    assert notes.exposure_time is notes.f_number is notes.iso is notes.camera is None


@pytest.mark.parametrize("name", ["x.jpg", "x.png", "x.webp"])
def test_broken_notes_never_make_a_picture_unreadable(tmp_path: Path, name: str) -> None:
    whole = noted({MAKE: "Maker", 0x0112: 1}, {ISO: 100, F_NUMBER: 2.0}).tobytes()
    rng, kept = np.random.default_rng(3), 0
    for trial in range(70):
        broken = bytearray(whole)
        for place in rng.integers(6, len(broken), size=trial % 7 + 1):
            broken[place] = rng.integers(256)
        PICTURE.save(tmp_path / name, exif=bytes(broken[: rng.integers(7, len(broken) + 1)]))
        photo = load_photo(tmp_path / name)
        assert photo.image.size == PICTURE.width * PICTURE.height
        kept += photo.iso == 100
    assert kept > 0


def test_tags_that_share_bytes_take_no_more_memory_than_the_file(tmp_path: Path) -> None:
    tags = 3000
    entries = b"".join(
        (40_000 + tag).to_bytes(2, "little") + b"\1\0" + (30_000).to_bytes(4, "little") + bytes(4)
        for tag in range(tags)
    )
    bomb = b"Exif\0\0II*\0\x08\0\0\0" + tags.to_bytes(2, "little") + entries + bytes(4)
    PICTURE.save(tmp_path / "x.png", exif=bomb)
    tracemalloc.start()
    try:
        photo = load_photo(tmp_path / "x.png")
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert photo.iso is None
    assert most < 40 * len(bomb)  # each tag on its own: thousands of times as much
