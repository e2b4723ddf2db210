"""Pictures are written to files of every supported format."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra import numpy as arrays
from PIL import ExifTags, Image

from occ_model.errors import OutputError
from occ_model.files.writing import write_image

IMAGE = np.random.default_rng(7).integers(0, 256, (13, 21), dtype=np.uint8)


@pytest.mark.parametrize(
    ("ending", "format_name"),
    [("png", "PNG"), ("tif", "TIFF"), ("tiff", "TIFF"), ("bmp", "BMP"), ("PNG", "PNG")],
)
@given(image=arrays.arrays(np.uint8, arrays.array_shapes(min_dims=2, max_dims=2, max_side=9)))
def test_a_lossless_format_returns_the_same_pixels(
    tmp_path_factory: pytest.TempPathFactory, ending: str, format_name: str, image: np.ndarray
) -> None:
    path = tmp_path_factory.mktemp("lossless") / f"picture.{ending}"
    write_image(path, image)
    with Image.open(path) as read:
        assert read.format == format_name
        np.testing.assert_array_equal(np.asarray(read), image)


@pytest.mark.parametrize(
    ("ending", "format_name"),
    [("jpg", "JPEG"), ("jpeg", "JPEG"), ("JPG", "JPEG"), ("webp", "WEBP")],
)
def test_a_lossy_format_returns_a_similar_picture(
    tmp_path: Path, ending: str, format_name: str
) -> None:
    image = np.tile(np.linspace(0, 255, 200).astype(np.uint8), (50, 1))
    write_image(tmp_path / f"picture.{ending}", image)
    with Image.open(tmp_path / f"picture.{ending}") as read:
        assert read.format == format_name
        difference = np.asarray(read.convert("L"), dtype=float) - image
    assert np.abs(difference).max() < 8


@pytest.mark.parametrize("ending", ["jpg", "tif", "webp", "bmp"])
def test_other_formats_than_png_store_a_description_as_exif_if_they_can(
    tmp_path: Path, ending: str
) -> None:
    path = tmp_path / f"picture.{ending}"
    write_image(path, IMAGE, "Camera's picture")
    with Image.open(path) as picture:
        text = picture.getexif().get(ExifTags.Base.ImageDescription)
    assert text == (None if ending == "bmp" else "Camera's picture")


@pytest.mark.parametrize("name", ["x", "x.", "x.txt", "x.png.x", ".png", "x.gif", "x.pdf"])
def test_an_ending_of_no_image_format_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError) as refused:
        write_image(tmp_path / name, IMAGE)
    assert str(refused.value) == (
        f"{name} does not have the ending of an image format; "
        "use .png, .jpg, .jpeg, .tif, .tiff, .webp or .bmp."
    )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("ending", "format_name", "longest"), [("jpg", "JPEG", 65_500), ("webp", "WEBP", 16_383)]
)
@pytest.mark.parametrize("wide", [True, False], ids=["wide", "tall"])
def test_a_picture_too_long_for_its_format_is_refused(
    tmp_path: Path, ending: str, format_name: str, longest: int, wide: bool
) -> None:
    path = tmp_path / f"picture.{ending}"
    for length in (longest + 1, 70_000):
        image = np.zeros((1, length) if wide else (length, 1), dtype=np.uint8)
        with pytest.raises(OutputError) as refused:
            write_image(path, image)
        size = f"{length:,} x 1" if wide else f"1 x {length:,}"
        assert str(refused.value) == (
            f"picture.{ending} cannot be encoded as {format_name}: the picture has {size} pixels; "
            f"allowed: at most {longest:,} a side."
        )
        assert list(tmp_path.iterdir()) == []
    write_image(path, image[:longest, :longest])
    with Image.open(path) as read:
        assert max(read.size) == longest
