"""Reading photographs."""

import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from photo_files import PICTURE, STRIPES, save
from PIL import Image

from occ_model.photo.reading.load import load_photo


@pytest.fixture(autouse=True)
def no_warnings() -> Iterator[None]:
    """Let every warning be seen: as an error the loader could take it for a damaged file."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        yield
    assert [str(warning.message) for warning in seen] == []


LOSSLESS = ["png", "tif", "bmp", "gif", "PNG", "pgm", "qoi", "jp2"]
LOSSY = ["jpg", "mpo", "webp", "avif", "heic"]


@pytest.mark.parametrize("ending", [*LOSSLESS, *LOSSY])
def test_a_photo_is_read_exactly_where_its_format_is_lossless(tmp_path: Path, ending: str) -> None:
    colours = ending in ("mpo", "qoi")  # which keep no grey
    picture = PICTURE.convert("RGB") if colours else PICTURE
    path = save(tmp_path, picture, f"x.{ending}", quality=95)
    photo = load_photo(str(path))
    assert (photo.path, photo.image.dtype, photo.image.shape) == (path, np.uint8, STRIPES.shape)
    furthest = 12 if ending in LOSSY else 0
    assert np.abs(photo.image.astype(float) - STRIPES).max() <= furthest
    assert np.abs(photo.profile - STRIPES[0]).max() <= furthest


@pytest.mark.parametrize("lines_are_striped", [False, True])
@pytest.mark.parametrize("axis", ["auto", "columns", "lines"])
@pytest.mark.parametrize("rows", [32, 1])
def test_the_axis_that_the_shutter_scanned_becomes_the_columns(
    tmp_path: Path, axis: str, lines_are_striped: bool, rows: int
) -> None:
    stripes = STRIPES[:rows].T if lines_are_striped else STRIPES[:rows]
    photo = load_photo(save(tmp_path, np.ascontiguousarray(stripes)), axis)
    assert photo.turned is {"auto": lines_are_striped, "columns": False, "lines": True}[axis]
    np.testing.assert_array_equal(photo.image, stripes.T if photo.turned else stripes)


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("name", ["x.jpg", "x.png", "x.tif", "x.webp", "x.avif", "x.heic"])
def test_the_orientation_that_the_camera_noted_is_obeyed(
    tmp_path: Path, name: str, orientation: int
) -> None:
    noted = Image.Exif()
    noted[0x0112] = orientation
    picture = STRIPES.copy()
    picture[:8] = 0  # so that top and bottom differ
    path = save(tmp_path, picture, name, exif=noted)
    upright = {
        1: picture,
        2: picture[:, ::-1],
        3: picture[::-1, ::-1],
        4: picture[::-1],
        5: picture.T,
        6: np.rot90(picture, -1),
        7: picture[::-1, ::-1].T,
        8: np.rot90(picture),
    }[orientation]
    image = load_photo(path, "columns").image
    assert image.shape == upright.shape
    assert np.abs(image - upright.astype(float)).mean() < 5


@pytest.mark.parametrize("name", ["x.gif", "x.tif", "x.webp", "x.png", "x.mpo"])
def test_of_several_pictures_in_a_file_the_first_is_read(tmp_path: Path, name: str) -> None:
    others = [Image.new("RGB", PICTURE.size, "white"), Image.new("RGB", PICTURE.size, "red")]
    picture = PICTURE.convert("RGB")
    how = {"lossless": True} if name == "x.webp" else {}
    path = save(tmp_path, picture, name, save_all=True, append_images=others, **how)
    furthest = 12 if name == "x.mpo" else 0
    assert np.abs(load_photo(path).image - STRIPES.astype(float)).max() <= furthest


@pytest.mark.parametrize("size", [(1, 1), (1, 4000), (4000, 1)])
@pytest.mark.parametrize("axis", ["auto", "columns", "lines"])
def test_a_photo_may_be_one_pixel_wide_or_high(
    tmp_path: Path, size: tuple[int, int], axis: str
) -> None:
    photo = load_photo(save(tmp_path, Image.new("RGB", size, (9, 8, 7))), axis)
    assert photo.image.size == size[0] * size[1]
    assert set(photo.profile) == {9.0}
