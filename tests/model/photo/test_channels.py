"""Which channel of a photo is taken, with all bits of its file."""

import struct
import zlib
from pathlib import Path
from typing import Any, Literal

import cv2
import numpy as np
import pytest
import tifffile
from numpy.typing import NDArray
from photo_files import PICTURE, STRIPES, png, png_chunk, save
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.errors import PhotoError
from occ_model.photo.reading.choices import CHANNELS
from occ_model.photo.reading.load import column_means, load_photo


def deep_stripes() -> NDArray[np.uint16]:
    """Colours of 16 bits: blue, green and red, as OpenCV has them."""
    rng = np.random.default_rng(5)
    return rng.integers(0, 65536, (9, 14, 3), dtype=np.uint16)


@pytest.mark.parametrize("compression", [None, "tiff_lzw", "tiff_adobe_deflate"])
@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_deep_tiff_is_turned_once(
    tmp_path: Path, orientation: int, compression: str | None
) -> None:
    """In one channel, which Pillow decodes, as in three, which OpenCV does."""
    deep = deep_stripes()[..., 0]
    path = tmp_path / "x.tif"
    Image.fromarray(deep).save(path, compression=compression, tiffinfo={274: orientation})
    turned = load_photo(path, "columns").samples
    tags = [(274, 3, 1, orientation, True)]
    tifffile.imwrite(path, np.dstack([deep] * 3), photometric="rgb", extratags=tags)
    np.testing.assert_array_equal(load_photo(path, "columns").samples, turned)
    assert sorted(turned.shape) == sorted(deep.shape)
    assert (turned.shape == deep.shape) is (orientation < 5)
    corners = [deep[0, 0], deep[0, -1], deep[-1, -1], deep[-1, 0]]
    first = {1: 0, 2: 1, 3: 2, 4: 3, 5: 0, 6: 3, 7: 2, 8: 1}[orientation]
    assert turned[0, 0] == corners[first]


def test_deep_colours_of_other_formats_are_turned_by_their_exif_orientation(tmp_path: Path) -> None:
    """OpenCV turns only TIFF."""
    deep, exif = deep_stripes(), Image.Exif()
    exif[274] = 6
    content = cv2.imencode(".png", deep)[1].tobytes()
    place = content.index(b"IDAT") - 4
    chunk = png_chunk(b"eXIf", exif.tobytes().removeprefix(b"Exif\0\0"))
    (tmp_path / "x.png").write_bytes(content[:place] + chunk + content[place:])
    samples = load_photo(tmp_path / "x.png", "columns", channel="red").samples
    np.testing.assert_array_equal(samples, np.rot90(deep[..., 2], -1))


@pytest.mark.parametrize("byte_order", ["<", ">"])
@pytest.mark.parametrize("how", [{}, {"tile": (16, 16)}, {"compression": "zlib"}], ids=str)
@pytest.mark.parametrize("alpha", [False, True])
def test_deep_tiffs_of_all_kinds_are_read_or_refused(
    tmp_path: Path, byte_order: str, how: dict[str, Any], alpha: bool
) -> None:
    deep = deep_stripes()
    kept = np.dstack([deep, np.full(deep.shape[:2], 65535, np.uint16)]) if alpha else deep
    path = tmp_path / "x.tif"
    how |= {"byteorder": byte_order, "photometric": "rgb"}
    tifffile.imwrite(path, kept, extrasamples=["unassalpha"] * alpha, **how)
    samples = load_photo(path, "columns", channel="blue").samples
    np.testing.assert_array_equal(samples, deep[..., 2])
    planes = np.ascontiguousarray(kept.transpose(2, 0, 1))
    extra = ["unassalpha"] * alpha
    tifffile.imwrite(path, planes, planarconfig="separate", extrasamples=extra, **how)
    with pytest.raises(
        PhotoError, match=r"each of its colours of 16 bits is in a plane of its own; "
    ):
        load_photo(path)


def test_colours_of_eight_bits_in_planes_of_their_own_are_read(tmp_path: Path) -> None:
    planes = np.stack([STRIPES, STRIPES // 2, STRIPES // 3])
    tifffile.imwrite(tmp_path / "x.tif", planes, planarconfig="separate", photometric="rgb")
    np.testing.assert_array_equal(load_photo(tmp_path / "x.tif").image, STRIPES)


@pytest.mark.parametrize("brightest", [65535, 20000, 255, 1])
@pytest.mark.parametrize("name", ["x.png", "x.tif"])
def test_sixteen_bits_are_kept_however_dark_the_photo(
    tmp_path: Path, brightest: int, name: str
) -> None:
    deep = np.linspace(0, brightest, 300).astype(np.uint16)[None, :].repeat(4, axis=0)
    deep[2:] = deep[:2, ::-1]
    photo = load_photo(save(tmp_path, deep, name), "columns")
    assert (photo.samples.dtype, photo.white, photo.channel) == (np.uint16, 65535, "grey")
    np.testing.assert_array_equal(photo.samples, deep)
    np.testing.assert_array_equal(photo.image, np.rint(deep / 257))
    np.testing.assert_allclose(photo.profile, deep.mean(axis=0) / 257, rtol=1e-12)


def test_eight_bits_are_kept_once(tmp_path: Path) -> None:
    photo = load_photo(save(tmp_path, PICTURE))
    assert photo.image is photo.samples
    assert (photo.samples.dtype, photo.white, photo.channel) == (np.uint8, 255, "grey")


@pytest.mark.parametrize("name", ["x.png", "x.tiff"])
@pytest.mark.parametrize("channel", ["red", "green", "blue"])
def test_colours_of_sixteen_bits_are_kept(tmp_path: Path, name: str, channel: str) -> None:
    deep = deep_stripes()
    assert cv2.imwrite(str(tmp_path / name), deep)
    photo = load_photo(tmp_path / name, "columns", channel=channel)
    assert (photo.white, photo.channel) == (65535, channel)
    index = ["blue", "green", "red"].index(channel)
    np.testing.assert_array_equal(photo.samples, deep[..., index])


def test_transparency_of_sixteen_bits_darkens_to_the_nearest_level(
    tmp_path: Path,
) -> None:
    alpha = np.random.default_rng(6).integers(0, 65536, (9, 14), dtype=np.uint16)
    alpha[:, 0], alpha[:, 1] = 0, 65535
    deep = np.dstack([deep_stripes(), alpha])
    assert cv2.imwrite(str(tmp_path / "x.png"), deep)
    samples = load_photo(tmp_path / "x.png", "columns", channel="red").samples
    seen = deep[..., 2] * (deep[..., 3] / 65535)
    np.testing.assert_array_equal(samples, np.rint(seen))


def test_white_of_twelve_bits_is_white(tmp_path: Path) -> None:
    packed = bytes([0xFF, 0xF0, 0x00, 0x80, 0x00, 0x00])  # 4095, 0, 2048, 0
    tags = {256: 4, 257: 1, 258: 12, 259: 1, 262: 1, 273: 8, 277: 1, 278: 1, 279: 6}
    entries = b"".join(
        tag.to_bytes(2, "little") + b"\4\0\1\0\0\0" + number.to_bytes(4, "little")
        for tag, number in tags.items()
    )
    start = b"II*\0" + (16).to_bytes(4, "little") + packed + b"\0\0"
    (tmp_path / "x.tif").write_bytes(start + bytes([len(tags), 0]) + entries + bytes(4))
    photo = load_photo(tmp_path / "x.tif", "columns")
    assert photo.samples.tolist() == [[65535, 0, round(2048 / 4095 * 65535), 0]]


@pytest.mark.parametrize(
    ("colour", "brightest"),
    [
        ((200, 20, 10), "red"),
        ((20, 200, 10), "green"),
        ((10, 20, 200), "blue"),
        ((202, 200, 10), "red"),
        ((200, 200, 10), "green"),
        ((10, 200, 200), "green"),
        ((99, 0, 99), "red"),
    ],
)
def test_the_brightest_channel_is_the_one_in_which_the_led_shows(
    tmp_path: Path, colour: tuple[int, int, int], brightest: str
) -> None:
    picture = np.zeros((6, 8, 3), np.uint8)
    picture[:, ::2] = np.array(colour)
    path = save(tmp_path, picture)
    photo = load_photo(path)
    assert photo.channel == brightest
    index = ("red", "green", "blue").index(brightest)
    np.testing.assert_array_equal(photo.image, picture[..., index])
    assert load_photo(path, channel="luma").channel == "luma"


@pytest.mark.parametrize("channel", CHANNELS)
@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "LA", "P", "1"])
def test_a_grey_photo_is_grey_in_whatever_colours_it_is_kept(
    tmp_path: Path, mode: str, channel: str
) -> None:
    grey = PICTURE.point(lambda level: 255 * (level > 99)) if mode == "1" else PICTURE
    photo = load_photo(save(tmp_path, grey.convert(mode)), channel=channel)
    assert photo.channel == "grey"
    np.testing.assert_array_equal(photo.image, np.asarray(grey))


@pytest.mark.parametrize("name", ["x.jpg", "x.webp", "x.avif", "x.heic"])
def test_a_lossy_format_does_not_make_a_grey_photo_red_or_blue(tmp_path: Path, name: str) -> None:
    photo = load_photo(save(tmp_path, PICTURE.convert("RGB"), name))
    assert photo.channel in ("grey", "green")
    assert np.abs(photo.profile - STRIPES[0]).max() < 12


def test_colours_become_their_luma_if_asked_for(tmp_path: Path) -> None:
    turns = [np.roll(colour, turn) for colour in ([255, 0, 0], [200, 100, 50]) for turn in range(3)]
    colours = np.array([turns], np.uint8)  # three channels of the same mean
    picture = Image.fromarray(colours)
    for mode in ("RGB", "RGBA", "P"):
        picture = picture.quantize(6) if mode == "P" else picture.convert(mode)
        photo = load_photo(save(tmp_path, picture), "columns", channel="luma")
        assert np.abs(photo.image - colours @ [0.299, 0.587, 0.114]).max() <= 1
        assert photo.channel == "luma"


@pytest.mark.parametrize("mode", ["CMYK", "YCbCr", "LAB"])
def test_colours_of_print_and_video_are_read(tmp_path: Path, mode: str) -> None:
    picture = Image.fromarray(np.dstack([STRIPES] * 3))
    if mode == "LAB":
        picture = Image.merge("LAB", [PICTURE, *[Image.new("L", PICTURE.size, 128)] * 2])
    path = save(tmp_path, picture if mode == "LAB" else picture.convert(mode), "x.tif")
    np.testing.assert_allclose(load_photo(path).image, STRIPES, atol=2)


def test_transparent_is_black_and_one_bit_is_black_or_white(tmp_path: Path) -> None:
    binary = load_photo(save(tmp_path, STRIPES > 128)).image
    np.testing.assert_array_equal(binary, np.where(STRIPES > 128, 255, 0))
    grey_alpha = np.array([[[200, 255], [200, 0], [200, 128], [10, 255]]], np.uint8)
    for mode in ("LA", "RGBA"):
        path = save(tmp_path, Image.fromarray(grey_alpha).convert(mode))
        assert np.abs(load_photo(path, "columns").image - [[200.0, 0, 100, 10]]).max() <= 1
    path = save(tmp_path, PICTURE.convert("P"), transparency=220)
    np.testing.assert_array_equal(load_photo(path).image, np.where(STRIPES == 220, 0, STRIPES))
    deep = STRIPES.astype(np.uint16) * 100
    path = save(tmp_path, deep, transparency=3000)
    np.testing.assert_array_equal(load_photo(path).samples, np.where(deep == 3000, 0, deep))


@pytest.mark.parametrize(("white", "order"), [(255, ">"), (1, "<"), (1, ">")])
def test_floating_point_pixels_are_fractions_or_levels_and_nan_is_black(
    tmp_path: Path, white: float, order: Literal["<", ">"]
) -> None:
    levels = np.array([[0.2, 99.6, -5.0, 255.0, np.inf, -np.inf, np.nan]]) / 255 * white
    tifffile.imwrite(tmp_path / "x.tif", levels.astype(f"{order}f4"), byteorder=order)
    photo = load_photo(tmp_path / "x.tif", "columns")
    assert photo.image.tolist() == [[0, 100, 0, 255, 255, 0, 0]]
    assert photo.profile[:2] == pytest.approx([0.2, 99.6], abs=1 / 500)


@pytest.mark.parametrize("largest", [1.01, 2.0, 256.0, 65535.0])
def test_a_photo_whose_white_is_not_known_is_refused(tmp_path: Path, largest: float) -> None:
    path = save(tmp_path, np.array([[0.0, np.nan, largest]], np.float32), "x.tif")
    with pytest.raises(PhotoError, match=rf"has values from 0 to {largest:g}; allowed in float"):
        load_photo(path)


@pytest.mark.parametrize("bits", [8, 16])
def test_column_means_are_those_of_the_rows_asked_for(tmp_path: Path, bits: int) -> None:
    samples = deep_stripes()[..., 0]
    if bits == 8:
        samples = (samples >> 8).astype(np.uint8)
    photo = load_photo(save(tmp_path, samples), "columns")
    for first, last in ((0, 9), (2, 5), (8, 9)):
        expected = samples[first:last].mean(axis=0) * 255 / (2**bits - 1)
        np.testing.assert_allclose(column_means(photo, first, last), expected, rtol=1e-12)


@pytest.mark.parametrize(("channel", "code"), [("brightest", 0), ("red", 0), ("blue", 1)])
def test_the_decoder_reads_the_channel_asked_for(
    tmp_path: Path, channel: str, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    image = occ.render(occ.Scene().replace(rows=60)).image
    red_led = np.dstack([image, np.full_like(image, 9), np.full_like(image, 9)])
    path = save(tmp_path, red_led)
    assert main(["decode", str(path), "--channel", channel]) == code
    assert ("code" in capsys.readouterr().out) is (code == 0)


def test_the_colour_that_is_called_transparent_is_black_and_no_other(tmp_path: Path) -> None:
    deep = np.random.default_rng(5).integers(1, 65536, (5, 7, 3)).astype(">u2")
    deep[2, 3] = deep[4, 4] = (700, 800, 900)
    deep[0, 0] = (700, 800, 901)
    lines = b"".join(b"\0" + line.tobytes() for line in deep)
    key = png_chunk(b"tRNS", struct.pack(">HHH", 700, 800, 900))
    content = png(7, 5, bits=16, colours=2, more=key, data=zlib.compress(lines))
    (tmp_path / "x.png").write_bytes(content)
    samples = load_photo(tmp_path / "x.png", "columns", channel="blue").samples
    expected = deep[..., 2].copy()
    expected[2, 3] = expected[4, 4] = 0
    assert samples.tolist() == expected.tolist()


@pytest.mark.parametrize("kind", ["unassalpha", "assocalpha", "unspecified"])
def test_a_fourth_channel_of_a_deep_tiff_is_what_the_file_says(tmp_path: Path, kind: Any) -> None:
    deep = np.dstack([deep_stripes(), np.full((9, 14), 32768, np.uint16)])
    tifffile.imwrite(tmp_path / "x.tif", deep, photometric="rgb", extrasamples=[kind])
    samples = load_photo(tmp_path / "x.tif", "columns", channel="red").samples
    factor = 32768 / 65535 if kind == "unassalpha" else 1.0
    np.testing.assert_array_equal(samples, np.rint(deep[..., 0] * factor))
