"""Reading photographs."""

import io
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from occ_model.errors import ParameterError, PhotoError
from occ_model.photo import load
from occ_model.photo.load import load_photo

STRIPES = np.tile(np.repeat([30, 220, 90, 160], 12).astype(np.uint8), (32, 1))
PICTURE = Image.fromarray(STRIPES)
NOTES = {"orientation": 0x0112, "exposure_time": 0x829A, "f_number": 0x829D, "iso": 0x8827}


@pytest.fixture(autouse=True)
def no_warnings() -> Iterator[None]:
    """Let every warning be seen: as an error the loader could take it for a damaged file."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        yield
    assert [str(warning.message) for warning in seen] == []


def saved(
    folder: Path, picture: Image.Image | np.ndarray, name: str = "x.png", **how: object
) -> Path:
    picture = Image.fromarray(picture) if isinstance(picture, np.ndarray) else picture
    picture.save(folder / name, **how)
    return folder / name


def exif(**noted: float) -> Image.Exif:
    notes = Image.Exif()
    for name, value in noted.items():
        (notes if name == "orientation" else notes.get_ifd(0x8769))[NOTES[name]] = value
    return notes


@pytest.mark.parametrize("ending", ["png", "tif", "bmp", "gif", "PNG", "jpg", "webp"])
def test_a_photo_is_read_to_the_last_bit_where_its_format_keeps_it(
    tmp_path: Path, ending: str
) -> None:
    path = saved(tmp_path, PICTURE, f"x.{ending}", quality=95)
    photo = load_photo(str(path))
    assert (photo.path, photo.image.dtype, photo.image.shape) == (path, np.uint8, STRIPES.shape)
    furthest = 12 if ending in ("jpg", "webp") else 0
    assert np.abs(photo.image.astype(float) - STRIPES).max() <= furthest
    assert np.abs(photo.profile - STRIPES[0]).max() <= furthest


@pytest.mark.parametrize("lines_are_striped", [False, True])
@pytest.mark.parametrize("axis", ["auto", "columns", "lines"])
@pytest.mark.parametrize("rows", [32, 1])
def test_the_axis_that_the_shutter_scanned_becomes_the_columns(
    tmp_path: Path, axis: str, lines_are_striped: bool, rows: int
) -> None:
    stripes = STRIPES[:rows].T if lines_are_striped else STRIPES[:rows]
    photo = load_photo(saved(tmp_path, np.ascontiguousarray(stripes)), axis)
    assert photo.turned is {"auto": lines_are_striped, "columns": False, "lines": True}[axis]
    np.testing.assert_array_equal(photo.image, stripes.T if photo.turned else stripes)


def test_an_axis_of_another_name_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^scan_axis is 'rows'; allowed: auto, columns, "):
        load_photo("x.png", "rows")


@pytest.mark.parametrize(("orientation", "quarter_turns"), [(1, 0), (3, 2), (6, -1), (8, 1)])
@pytest.mark.parametrize("name", ["x.jpg", "x.png"])
def test_the_orientation_that_the_camera_noted_is_obeyed(
    tmp_path: Path, name: str, orientation: int, quarter_turns: int
) -> None:
    path = saved(tmp_path, PICTURE, name, exif=exif(orientation=orientation))
    upright = np.rot90(STRIPES, quarter_turns)
    image = load_photo(path, "columns").image
    assert image.shape == upright.shape
    assert np.abs(image - upright.astype(float)).mean() < 5


def test_the_cameras_settings_are_read_and_what_it_did_not_note_is_none(tmp_path: Path) -> None:
    def settings(**noted: float) -> tuple[float | None, ...]:
        photo = load_photo(saved(tmp_path, PICTURE, "x.jpg", exif=exif(**noted)))
        return photo.exposure_time, photo.f_number, photo.iso

    noted = settings(exposure_time=1 / 8000, f_number=2.48, iso=100, orientation=6)
    assert noted == pytest.approx((1 / 8000, 2.48, 100))
    assert settings(f_number=2.0, iso=0) == (None, 2.0, None)
    assert settings() == (None, None, None)


@pytest.mark.parametrize("brightest", [65535, 20000, 255, 1])
def test_sixteen_bits_become_eight_however_dark_the_photo(tmp_path: Path, brightest: int) -> None:
    deep = np.linspace(0, brightest, 300).astype(np.uint16)[None, :].repeat(4, axis=0)
    image = load_photo(saved(tmp_path, deep), "columns").image
    np.testing.assert_array_equal(image, np.rint(deep / 257))


def test_colours_become_their_luma(tmp_path: Path) -> None:
    colours = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [200, 100, 50]]], np.uint8)
    picture = Image.fromarray(colours)
    for mode in ("RGB", "RGBA", "P"):
        picture = picture.quantize(4) if mode == "P" else picture.convert(mode)
        image = load_photo(saved(tmp_path, picture), "columns").image
        assert np.abs(image - colours @ [0.299, 0.587, 0.114]).max() <= 1


def test_transparent_parts_are_black_and_one_bit_is_black_or_white(tmp_path: Path) -> None:
    binary = load_photo(saved(tmp_path, STRIPES > 128)).image
    np.testing.assert_array_equal(binary, np.where(STRIPES > 128, 255, 0))
    grey_alpha = np.array([[[200, 255], [200, 0], [200, 128], [10, 255]]], np.uint8)
    for mode in ("LA", "RGBA"):
        path = saved(tmp_path, Image.fromarray(grey_alpha).convert(mode))
        assert np.abs(load_photo(path, "columns").image - [[200.0, 0, 100, 10]]).max() <= 1
    path = saved(tmp_path, PICTURE.convert("P"), transparency=220)
    np.testing.assert_array_equal(load_photo(path).image, np.where(STRIPES == 220, 0, STRIPES))


def test_floating_point_pixels_are_grey_levels_and_no_number_is_black(tmp_path: Path) -> None:
    levels = np.array([[0.2, 99.6, -5.0, 300.0, np.inf, -np.inf, np.nan]], np.float32)
    image = load_photo(saved(tmp_path, levels, "x.tif"), "columns").image
    assert image.tolist() == [[0, 100, 0, 255, 255, 0, 0]]


def test_what_is_no_photo_is_refused_in_a_sentence(tmp_path: Path) -> None:
    whole = saved(tmp_path, PICTURE).read_bytes()
    contents = {"empty": b"", "text": b"no photo\n", "cut": whole[:-30], "head": whole[:8]}
    paths = [tmp_path, tmp_path / "missing.png", tmp_path / "x.png" / "y.png", Path("a\0b")]
    for name, content in contents.items():
        paths.append(tmp_path / f"{name}.png")
        paths[-1].write_bytes(content)
    for path in paths:
        with pytest.raises(PhotoError) as refused:
            load_photo(path)
        assert str(refused.value).startswith(f"{path} ")
        assert str(refused.value).endswith(".")


@pytest.mark.parametrize("path", [3, None, b"x.png", ["x.png"]])
def test_what_is_no_path_is_refused_in_a_sentence(path: object) -> None:
    with pytest.raises(PhotoError) as refused:
        load_photo(path)  # type: ignore[arg-type]
    assert str(refused.value) == f"{path!r} is not the path of a photo; allowed: str or Path."


@pytest.mark.parametrize("pixels", [1535, 1000, 100])
def test_a_photo_too_large_to_be_honest_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pixels: int
) -> None:
    path = saved(tmp_path, PICTURE)
    monkeypatch.setattr(load, "MAX_PIXELS", STRIPES.size)
    assert load_photo(path).image.size == STRIPES.size == 1536
    monkeypatch.setattr(load, "MAX_PIXELS", pixels)
    with pytest.raises(PhotoError, match=r"x\.png has more than \d+ million pixels\.$"):
        load_photo(path)


@pytest.mark.parametrize("file_format", ["png", "jpeg", "tiff", "gif", "bmp", "webp"])
def test_a_damaged_photo_is_read_or_refused(tmp_path: Path, file_format: str) -> None:
    buffer = io.BytesIO()
    PICTURE.save(buffer, file_format, exif=exif(orientation=6, iso=100))
    rng, read, refused = np.random.default_rng(11), 0, 0
    for trial in range(120):
        damaged = bytearray(buffer.getvalue())
        if trial % 3 == 0:
            del damaged[rng.integers(len(damaged)) :]
        else:
            for place in rng.integers(len(damaged), size=trial % 5 + 1):
                damaged[place] ^= 1 << rng.integers(8)
        (tmp_path / "damaged").write_bytes(damaged)
        try:
            read += load_photo(tmp_path / "damaged").image.size > 0
        except PhotoError as error:
            refused += str(error).endswith(".")
    assert read + refused == 120
    assert min(read, refused) > 0


def stripe_period(profile: np.ndarray, shortest: int, longest: int) -> float:
    """Period of the stripes by autocorrelation, its peak refined by a parabola."""
    padded = np.pad(profile, 150, mode="reflect")
    signal = profile - np.convolve(padded, np.full(301, 1 / 301), "valid")
    lags = range(shortest - 1, longest + 2)
    match = np.array([np.corrcoef(signal[lag:], signal[:-lag])[0, 1] for lag in lags])
    best = 1 + int(match[1:-1].argmax())
    assert match[best] > 0.8
    before, at, after = match[best - 1 : best + 2]
    return lags[best] + (before - after) / (2 * (before - 2 * at + after))


@pytest.mark.photos
def test_the_real_photo_of_1_khz_has_the_stripes_that_its_readout_time_says(photos: Path) -> None:
    photo = load_photo(photos / "led_1khz_frame.png")
    assert (photo.turned, photo.image.shape) == (True, (1920, 1080))
    assert stripe_period(photo.profile, 40, 100) == pytest.approx(1e-3 / 14.565e-6, rel=0.01)


@pytest.mark.photos
def test_the_real_photo_of_21_chips_repeats_after_as_many(photos: Path) -> None:
    photo = load_photo(photos / "vlcdetector_stripes.png")
    assert (photo.turned, photo.image.shape) == (False, (890, 1080))
    assert stripe_period(photo.profile, 200, 400) == pytest.approx(21 * 13.9, rel=0.01)
