"""Files that are no photo, or would take too long, are refused in one sentence."""

import logging
import os
import socket
import struct
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import tifffile
from films import film_bytes
from photo_files import PICTURE, png, png_chunk, save
from PIL import Image, PngImagePlugin

import occ_model as occ
from occ_model.errors import PhotoError, one_line
from occ_model.photo.reading.limits import (
    MOST_BYTES,
    MOST_BYTES_IN_PYTHON,
    MOST_BYTES_OF_TIFF,
    check_decoder,
    check_file_size,
)
from occ_model.photo.reading.load import load_photo


def refusal(path: object, **how: int) -> str:
    with pytest.raises(PhotoError) as refused:
        load_photo(path, **how)  # type: ignore[arg-type]
    sentence = str(refused.value)
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence


def test_what_is_no_photo_is_refused_in_a_sentence(tmp_path: Path) -> None:
    whole = tmp_path / "x.png"
    PICTURE.save(whole)
    contents = {
        "text": b"no photo\n",
        "cut": whole.read_bytes()[:-30],
        "head": b"\x89PNG\r\n\x1a\n",
    }
    paths = [tmp_path / "missing.png", whole / "y.png", Path("a\0b")]
    for name, content in contents.items():
        paths.append(tmp_path / f"{name}.png")
        paths[-1].write_bytes(content)
    for path in paths:
        assert refusal(path).startswith(f"{one_line(str(path))} ")
    assert refusal(tmp_path) == f"{tmp_path} is a folder, not a photo."
    (tmp_path / "empty.png").touch()
    assert refusal(tmp_path / "empty.png").endswith("empty.png is an empty file.")


@pytest.mark.parametrize("path", [3, None, b"x.png", ["x.png"]])
def test_what_is_no_path_is_refused_in_a_sentence(path: object) -> None:
    assert refusal(path) == f"{path!r} is not the path of a photo; allowed: str or Path."


def test_a_photo_that_may_not_be_read_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.png"
    PICTURE.save(path)

    def refuse(*_: object, **__: object) -> None:  # root may read everything
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    assert refusal(path) == f"{path} cannot be read: Permission denied."


def test_devices_pipes_and_sockets_are_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.png")
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(tmp_path / "socket.png"))
        for path in (tmp_path / "pipe.png", tmp_path / "socket.png", Path("/dev/zero")):
            assert refusal(path) == f"{path} is a device, pipe or socket, not a photo."


def test_formats_that_need_other_programs_are_no_photos(tmp_path: Path) -> None:
    PICTURE.convert("RGB").save(tmp_path / "x.eps")
    assert refusal(tmp_path / "x.eps").endswith("x.eps is not an image that can be read.")


@pytest.mark.parametrize("start", [b"\xff\x0a", b"\0\0\0\x0cJXL \r\n\x87\n"])
def test_jpeg_xl_is_named(tmp_path: Path, start: bytes) -> None:
    (tmp_path / "x.jxl").write_bytes(start + bytes(90))
    assert refusal(tmp_path / "x.jxl").endswith(
        "is a JPEG XL picture, which cannot be read; save it as PNG."
    )


def test_samples_that_no_photo_has_are_described(tmp_path: Path) -> None:
    tifffile.imwrite(tmp_path / "x.tif", np.zeros((4, 5)))
    sentence = refusal(tmp_path / "x.tif")
    assert "a pixel has 1 x 64 bits of floating point; save it as PNG" in sentence


@pytest.mark.parametrize("ending", ["mp4", "mkv"])
def test_a_film_is_no_photo(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"film.{ending}"
    path.write_bytes(film_bytes(ending, "mp4v"))
    assert refusal(path) == f"{path} is a film, not a photo; decode it as a film."


@pytest.mark.parametrize("width", [12_000, 100_000, 2**31 - 8])
def test_a_photo_too_large_to_be_honest_is_refused_by_its_header(
    tmp_path: Path, width: int
) -> None:
    path = tmp_path / "x.png"
    path.write_bytes(png(width, 12_000))
    assert refusal(path, max_pixels=100_000_000).startswith(
        f"{path} has {width:,} x 12,000 pixels, {width * 0.012:,.10g} million; "
        "allowed: at most 100 million; raise max_pixels to read it."
    )
    assert "at most 170 million" in refusal(path) or width == 12_000


@pytest.mark.parametrize("across", [True, False])
def test_a_photo_with_a_side_longer_than_a_scene_has_columns_is_refused(
    tmp_path: Path, across: bool
) -> None:
    path = tmp_path / "x.png"
    for longer in (1_000_000, 1_000_001):
        size = (longer, 1) if across else (1, longer)
        Image.new("L", size, 80).save(path)
        if longer == 1_000_000:
            assert load_photo(path).image.size == longer
        else:
            assert refusal(path) == (
                f"{path} has {size[0]:,} x {size[1]:,} pixels; "
                "allowed: at most 1,000,000 along each side."
            )


@pytest.mark.parametrize(("colours", "key"), [(6, False), (2, True), (2, False)])
def test_deep_colours_with_transparency_are_limited_to_fifty_million_pixels(
    tmp_path: Path, colours: int, key: bool
) -> None:
    path = tmp_path / "x.png"
    more = png_chunk(b"tRNS", bytes(6)) if key else b""
    refused = []
    for rows in (6_250, 6_251):
        # More bytes, so that so many pixels could be in the file.
        path.write_bytes(png(8_000, rows, bits=16, colours=colours, more=more) + bytes(9_000))
        refused.append("transparency; allowed: at most 50 million, which" in refusal(path))
    assert refused == [False, colours == 6 or key]


def test_a_size_that_so_few_bytes_cannot_hold_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.png").write_bytes(png(10_000, 10_000))
    assert "bytes cannot hold 10,000 x 10,000 pixels)." in refusal(tmp_path / "x.png")


@pytest.mark.parametrize("name", ["x.png", "x.jpg", "x.tif", "x.webp", "x.gif", "x.heic", "x.jp2"])
def test_max_pixels_is_the_number_of_pixels_that_is_still_read(tmp_path: Path, name: str) -> None:
    save(tmp_path, PICTURE, name)
    size = PICTURE.width * PICTURE.height
    assert load_photo(tmp_path / name, max_pixels=size).image.size == size
    for limit in (size - 1, size // 2 - 1, 1):
        assert f"{limit:,}; raise max_pixels to read it." in refusal(
            tmp_path / name, max_pixels=limit
        )


@pytest.mark.parametrize("limit", [1, 10, None])
@pytest.mark.parametrize("name", ["x.png", "x.tif", "x.webp", "x.gif"])
def test_pillows_own_limit_does_not_matter_and_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: int | None, name: str
) -> None:
    PICTURE.save(tmp_path / name)
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", limit)
    load_photo(tmp_path / name)  # now Pillow knows all formats that it will ever know
    before = list(warnings.filters), dict(Image.OPEN)
    assert load_photo(tmp_path / name).image.size == 1536
    refusal(tmp_path / name, max_pixels=5)
    assert limit == Image.MAX_IMAGE_PIXELS
    assert (list(warnings.filters), dict(Image.OPEN)) == before


def test_photos_may_be_read_in_several_threads(tmp_path: Path) -> None:
    PICTURE.save(tmp_path / "x.png")
    before = Image.MAX_IMAGE_PIXELS, list(warnings.filters), list(logging.getLogger("PIL").handlers)
    with ThreadPoolExecutor(4) as threads:
        limits = [1536, 1535] * 50
        read = threads.map(lambda most: outcome(tmp_path / "x.png", most), limits)
        assert list(read) == [True, False] * 50
    after = Image.MAX_IMAGE_PIXELS, list(warnings.filters), list(logging.getLogger("PIL").handlers)
    assert after == before


def outcome(path: Path, max_pixels: int) -> bool:
    try:
        return load_photo(path, max_pixels=max_pixels).image.size > 0
    except PhotoError:
        return False


def test_a_heic_photo_without_its_reader_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "x.png"  # whatever its name
    save(tmp_path, PICTURE, "x.heic").rename(path)
    assert load_photo(path).image.size == 1536
    monkeypatch.setitem(sys.modules, "pillow_heif", None)
    wanted = f"{path} is a HEIC photo; to read it: pip install occ-explorer[heic]."
    assert refusal(path) == wanted


def test_texts_in_a_png_that_grow_without_bound_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PngImagePlugin, "MAX_TEXT_MEMORY", 2_000_000)
    texts = PngImagePlugin.PngInfo()
    for number in range(3):
        texts.add_text(f"x{number}", "x" * 1_000_000, zip=True)
    PICTURE.save(tmp_path / "x.png", pnginfo=texts)
    assert "the file is damaged (" in refusal(tmp_path / "x.png")


def test_more_bytes_than_its_pixels_could_need_are_refused(tmp_path: Path) -> None:
    PICTURE.save(tmp_path / "x.png")
    with (tmp_path / "x.png").open("r+b") as file:
        file.truncate(10**10)  # a sparse file
    assert " has 10,000,000,000 bytes; allowed " in refusal(tmp_path / "x.png")


def test_whole_numbers_beyond_sixteen_bits_are_refused(tmp_path: Path) -> None:
    Image.fromarray(np.full((3, 4), 65_535, np.int32)).save(tmp_path / "x.tif")
    assert (load_photo(tmp_path / "x.tif").samples == 65_535).all()
    Image.fromarray(np.full((3, 4), 70_000, np.int32)).save(tmp_path / "x.tif")
    assert "samples up to 70,000; allowed: up to 65,535." in refusal(tmp_path / "x.tif")


def test_a_tiff_without_its_last_rows_is_refused(tmp_path: Path) -> None:
    PICTURE.save(tmp_path / "x.tif")
    content = bytearray((tmp_path / "x.tif").read_bytes())
    height = content.find(struct.pack("<HHII", 257, 4, 1, 32))
    height = height if height >= 0 else content.find(struct.pack("<HHIH", 257, 3, 1, 32))
    content[height + 8] = 64
    (tmp_path / "x.tif").write_bytes(content)
    assert "the file is damaged (" in refusal(tmp_path / "x.tif")


PATH = Path("a-photo")


@pytest.mark.parametrize(("kind", "most"), MOST_BYTES.items())
def test_a_file_may_have_as_many_bytes_as_are_read_within_seconds(kind: str, most: int) -> None:
    check_file_size(PATH, kind, most)
    with pytest.raises(occ.PhotoError, match=f"has {most + 1:,} bytes; .*up to {most:,}"):
        check_file_size(PATH, kind, most + 1)


def test_formats_that_are_read_as_fast_as_they_are_copied_have_no_limit() -> None:
    check_file_size(PATH, "TIFF", 10**12)


def picture_of(decoder: str, kind: str) -> Any:
    return SimpleNamespace(tile=[(decoder, (0, 0, 1, 1), 0, "")], format=kind)


@pytest.mark.parametrize(
    ("decoder", "kind", "most"),
    [("libtiff", "TIFF", MOST_BYTES_OF_TIFF), ("qoi", "QOI", MOST_BYTES_IN_PYTHON)],
)
def test_a_slow_decoder_has_a_limit_of_its_own(decoder: str, kind: str, most: int) -> None:
    Image.init()  # Pillow knows its decoders in Python once they are imported
    check_decoder(PATH, picture_of(decoder, kind), most)
    with pytest.raises(
        occ.PhotoError, match=rf"\({'compressed ' if kind == 'TIFF' else ''}{kind}\)"
    ):
        check_decoder(PATH, picture_of(decoder, kind), most + 1)
    check_decoder(PATH, picture_of("raw", kind), 10**12)
