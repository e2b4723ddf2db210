"""Samples of 10, 12 and 16 bits are kept where the file has them, and its white is white."""

import struct
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile
from numpy.typing import NDArray
from photo_files import png, png_chunk, save
from PIL import Image
from pillow_heif import from_bytes

from occ_model.errors import PhotoError
from occ_model.photo.reading.load import load_photo

FILES = Path(__file__).parent / "files"  # written by libheif, libavif and OpenJPEG
STEPS = np.arange(512) // 2  # of 255, along the ramps in them
RAMP = np.tile(np.linspace(0, 1, 512), (16, 1))


def of_bits(bits: int) -> NDArray[np.uint16]:
    return np.rint(RAMP * (2**bits - 1)).astype(np.uint16)


@pytest.mark.parametrize(
    ("name", "bits", "furthest"),
    [
        ("ramp_10_bits.heic", 10, 1),  # one step of its 10 bits, as it is lossy
        ("ramp_12_bits.avif", 12, 0),
        ("ramp_12_bits.jp2", 12, 0),
        ("ramp_16_bits_opacity.png", 16, 0),
    ],
)
def test_every_bit_of_the_file_is_kept(name: str, bits: int, furthest: int) -> None:
    photo = load_photo(FILES / name, "columns")
    white = 2**bits - 1
    stored = np.rint(STEPS * white / 255)
    assert (photo.samples.dtype, photo.channel) == (np.uint16, "grey")
    assert np.abs(np.rint(photo.samples * (white / 65535)) - stored).max() <= furthest


@pytest.mark.parametrize(("name", "bits"), [("grey_4_bits", 4), ("grey_12_bits_signed", 12)])
def test_white_of_a_grey_jpeg_2000_is_white(name: str, bits: int) -> None:
    photo = load_photo(FILES / f"{name}.jp2", "columns")
    assert (
        np.abs(photo.samples[0] / photo.white - RAMP[0]).max()
        <= 0.5 / (2**bits - 1) + 0.5 / photo.white
    )


def test_video_colours_of_a_deep_jpeg_2000_are_refused() -> None:
    with pytest.raises(PhotoError, match="its 12 bits are stored in an unusual way; allowed "):
        load_photo(FILES / "video_12_bits.jp2")


@pytest.mark.parametrize(
    ("name", "steps"), [("grey_10_bits_limited.avif", 876), ("grey_12_bits.avif", 4095)]
)
def test_white_of_a_grey_avif_is_that_of_its_range(name: str, steps: int) -> None:
    samples = load_photo(FILES / name, "columns").samples
    assert np.abs(samples / 65535 - RAMP[0]).max() <= 0.6 / steps


@pytest.mark.parametrize("bits", [10, 12])
@pytest.mark.parametrize(
    ("ending", "shape"),
    [
        (".avif", "colours"),
        (".avif", "opacity"),
        (".heic", "grey"),
        (".heic", "colours"),
        (".heic", "opacity"),
    ],
)
def test_av1_and_hevc_keep_colours_and_opacity_of_ten_and_twelve_bits(
    tmp_path: Path, ending: str, shape: str, bits: int
) -> None:
    stored, path = of_bits(bits), tmp_path / f"x{ending}"
    channels = {"grey": 1, "colours": 3, "opacity": 4}[shape]
    picture = stored if channels == 1 else np.dstack([stored] * channels)
    if channels == 4:
        picture[..., 3] = 2 ** (bits - 1)
    if ending == ".heic":
        mode = {1: "I;16", 3: "RGB;16", 4: "RGBA;16"}[channels]
        heif = from_bytes(mode, (512, 16), (picture << 16 - bits).tobytes())
        heif.save(path, quality=-1, chroma=444)
    else:
        how = [cv2.IMWRITE_AVIF_DEPTH, bits, cv2.IMWRITE_AVIF_QUALITY, 100]
        assert cv2.imwrite(str(path), picture, how)
    photo = load_photo(path, "columns")
    opacity = 2 ** (bits - 1) / (2**bits - 1) if channels == 4 else 1.0
    expected = stored * (opacity / (2**bits - 1))
    assert len(np.unique(photo.samples)) > 400
    assert np.abs(photo.samples / 65535 - expected).max() <= 1.6 / 1023


@pytest.mark.parametrize("white", [1023, 4095, 65535])
@pytest.mark.parametrize("kind", ["P3", "P6"])
def test_a_ppm_keeps_its_numbers(tmp_path: Path, kind: str, white: int) -> None:
    numbers = np.random.default_rng(1).integers(0, white + 1, (5, 9, 3)).astype(">u2")
    data = numbers.tobytes() if kind == "P6" else b" ".join(b"%d" % n for n in numbers.ravel())
    if kind == "P3":
        data = b"# a comment\n" + data
    (tmp_path / "x.ppm").write_bytes(b"%s 9 5 %d\n" % (kind.encode(), white) + data)
    samples = load_photo(tmp_path / "x.ppm", "columns", channel="red").samples
    np.testing.assert_array_equal(samples, np.rint(numbers[..., 0] / white * 65535))
    (tmp_path / "x.ppm").write_bytes(b"%s 9 5 %d\n" % (kind.encode(), white) + data[:-7])
    with pytest.raises(PhotoError, match="the file is damaged"):
        load_photo(tmp_path / "x.ppm")


def test_opacity_of_grey_of_sixteen_bits_darkens_it(tmp_path: Path) -> None:
    numbers = np.random.default_rng(2).integers(0, 65536, (6, 7, 2)).astype(np.uint16)
    lines = b"".join(b"\0" + line.astype(">u2").tobytes() for line in numbers)
    path = tmp_path / "x.png"
    path.write_bytes(png(7, 6, bits=16, colours=4, data=zlib.compress(lines)))
    expected = np.rint(numbers[..., 0] * (numbers[..., 1] / 65535))
    np.testing.assert_array_equal(load_photo(path, "columns").samples, expected)


@pytest.mark.parametrize("kind", ["u1", "u2", "f4"])
@pytest.mark.parametrize("how", [{}, {"compression": "zlib"}], ids=str)
def test_white_stored_as_zero_is_white(tmp_path: Path, kind: str, how: dict[str, Any]) -> None:
    white = 1.0 if kind == "f4" else np.iinfo(kind).max
    numbers = (RAMP * white).astype(kind)
    tifffile.imwrite(tmp_path / "x.tif", white - numbers, photometric="miniswhite", **how)
    photo = load_photo(tmp_path / "x.tif", "columns")
    assert np.abs(photo.samples / photo.white - numbers / white).max() <= 0.51 / 65535


def test_white_of_numbers_with_a_sign_is_their_largest(tmp_path: Path) -> None:
    numbers = np.array([[-5, 0, 16384, 32767]], np.int16)
    tifffile.imwrite(tmp_path / "x.tif", numbers, photometric="minisblack")
    samples = load_photo(tmp_path / "x.tif", "columns").samples
    assert samples.tolist() == [[0, 0, 32769, 65535]]


@pytest.mark.parametrize("bits", [8, 10])
def test_a_grey_heic_of_limited_range_has_its_white_at_235(tmp_path: Path, bits: int) -> None:
    levels = (16 + RAMP * 219) * 2 ** (bits - 8)
    mode, kind = ("L", np.uint8) if bits == 8 else ("I;16", np.uint16)
    stored = np.rint(levels).astype(kind)
    pixels = stored if bits == 8 else stored << 6
    for is_full in (0, 1):
        heif = from_bytes(mode, (512, 16), pixels.tobytes())
        heif.save(tmp_path / "x.heic", quality=-1, full_range_flag=is_full)
        photo = load_photo(tmp_path / "x.heic", "columns")
        expected = stored / (2**bits - 1) if is_full else RAMP
        assert (
            np.abs(photo.samples / photo.white - expected).max() <= 1 / 219
        )  # half a stored step, half a kept one


def test_a_heic_that_calls_its_full_range_limited_is_known_by_its_pixels(tmp_path: Path) -> None:
    heif = from_bytes("L", (512, 16), of_bits(8).astype(np.uint8).tobytes())
    heif.save(tmp_path / "x.heic", quality=-1, full_range_flag=0)
    image = load_photo(tmp_path / "x.heic", "columns").image
    np.testing.assert_array_equal(image, of_bits(8))


def test_colours_of_limited_range_are_those_of_the_full_one(tmp_path: Path) -> None:
    picture = Image.fromarray(of_bits(8).astype(np.uint8)).convert("RGB")
    path = save(tmp_path, picture, "x.heic", quality=-1, full_range_flag=0)
    assert np.abs(load_photo(path, "columns").image - of_bits(8).astype(float)).max() <= 1


def test_what_a_deep_file_promises_beyond_its_bytes_is_not_allocated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """OpenCV would take tens of seconds for such files."""
    monkeypatch.setattr(cv2, "imdecode", lambda *_: pytest.fail("OpenCV is asked"))
    content = png(7, 6, bits=16, colours=2, more=png_chunk(b"tEXt", b"x"))
    longer = content.replace(struct.pack(">L", 1) + b"tEXt", struct.pack(">L", 2**30) + b"tEXt")
    assert longer != content
    # Pillow refuses most by itself, so that the chunk is behind what it reads.
    end = content.index(b"IEND") - 4
    behind = content[:end] + struct.pack(">L", 2**30) + b"tEXt" + content[end:]
    other = (FILES / "ramp_12_bits.jp2").read_bytes()
    place = other.index(b"\xff\x4f\xff\x51") + 8
    wider = other[:place] + struct.pack(">LL", 30_000, 30_000) + other[place + 8 :]
    for name, damaged in (("x.png", longer), ("y.png", behind), ("x.jp2", wider)):
        (tmp_path / name).write_bytes(damaged)
        with pytest.raises(PhotoError, match="damaged"):
            load_photo(tmp_path / name)
