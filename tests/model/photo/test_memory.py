"""Reading a photo takes bounded memory, however much a small file promises; it can be ended."""

import io
import json
import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from photo_files import png, save
from PIL import Image

from occ_model.errors import PhotoError
from occ_model.photo.reading.limits import decoder_bytes_a_pixel
from occ_model.photo.reading.load import load_photo

MOST_MEMORY_MB = 1200
SIDE = 13_034
"""Of nearly 170 million pixels, of which every kind is read or refused."""


_READ = """
import json, pathlib, sys
from occ_model.errors import PhotoError
from occ_model.photo.reading.load import load_photo
refusals = []
for path in sys.argv[1:]:
    try:
        load_photo(path)
        refusals.append("")
    except PhotoError as error:
        refusals.append(str(error))
(peak,) = (
    int(line.split()[1]) / 1000
    for line in pathlib.Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    if line.startswith("VmHWM:")
)
print(json.dumps({"memory_mb": peak, "refusals": refusals}))
"""


class Stopped(Exception):  # noqa: N818 - no error: the caller wanted it
    """What a caller ends the reading with."""


def repeated(line: bytes, times: int) -> bytes:
    """Compress a line that is repeated, without going through all of it.

    What is compressed between two full flushes means the same wherever it stands.
    """
    shrink = zlib.compressobj(1, wbits=-zlib.MAX_WBITS)
    part = shrink.compress(line) + shrink.flush(zlib.Z_FULL_FLUSH)
    check = 1
    for _ in range(times):
        check = zlib.adler32(line, check)
    return b"\x78\x01" + part * times + shrink.flush() + struct.pack(">I", check)


def png_of(side: int, bits: int, colours: int) -> bytes:
    """Return a PNG of one colour: a few hundred kilobytes for as many pixels as are allowed."""
    bands = {0: 1, 2: 3, 4: 2, 6: 4}[colours]
    line = b"\0" + b"\x50" * ((side * bands * bits + 7) // 8)
    return png(side, side, bits=bits, colours=colours, data=repeated(line, side))


def small(file_format: str, mode: str = "RGB", **how: object) -> bytearray:
    buffer = io.BytesIO()
    Image.new(mode, (64, 64), 80 if mode == "L" else (80,) * len(mode)).save(
        buffer, file_format, **how
    )
    return bytearray(buffer.getvalue())


@pytest.mark.parametrize(("orientation", "more"), [(1, 0.0), (6, 4.0)])
def test_a_tiff_that_pillow_rotates_is_in_memory_twice(orientation: int, more: float) -> None:
    content = small("TIFF", tiffinfo={274: orientation})
    with Image.open(io.BytesIO(content)) as picture:
        assert decoder_bytes_a_pixel(picture, 0) == more


@cache
def jpeg_that_promises(side: int, mode: str = "RGB") -> bytes:
    """Write another size into a progressive JPEG of one colour, and comments to be long enough."""
    content = small("JPEG", mode, progressive=True)
    struct.pack_into(">HH", content, content.index(b"\xff\xc2") + 5, side, side)
    comment = b"\xff\xfe\xff\xff" + bytes(0xFFFF - 2)
    return bytes(content[:2]) + comment * (side * side // 2**26 * 4 + 1) + bytes(content[2:])


def jpeg_2000_that_promises(side: int) -> bytes:
    """Write another size into a picture of one colour, whose data then mean little but are few."""
    content = small("JPEG2000")
    for place in [i for i in range(len(content) - 4) if content[i : i + 4] == b"\0\0\0\x40"]:
        struct.pack_into(">I", content, place, side)
    return bytes(content)


def webp_that_promises(side: int) -> bytes:
    """Write another size into a lossless WebP: two numbers of 14 bits, each less one."""
    content = small("WEBP", lossless=True)
    place = content.index(b"VP8L") + 9
    (header,) = struct.unpack_from("<I", content, place)
    struct.pack_into("<I", content, place, header >> 28 << 28 | (side - 1) << 14 | side - 1)
    return bytes(content)


def avif_that_promises(side: int) -> bytes:
    """Write another size into an AVIF."""
    content = small("AVIF", speed=10)
    struct.pack_into(">II", content, content.index(b"ispe") + 8, side, side)
    return bytes(content)


def gif(side: int) -> bytes:
    """Encode a picture of one colour: what a small file of an honest encoder can hold."""
    buffer = io.BytesIO()
    Image.new("P", (side, side)).save(buffer, "GIF")
    return buffer.getvalue()


FILES: dict[str, Callable[[], bytes]] = {
    "png-16-rgba": lambda: png_of(SIDE, 16, 6),
    "png-16-rgb-accepted": lambda: png_of(9_700, 16, 2),
    "png-8-rgba": lambda: png_of(SIDE, 8, 6),
    "jpeg-promises": lambda: jpeg_that_promises(SIDE),
    "jpeg-2000-promises": lambda: jpeg_2000_that_promises(SIDE),
    "avif-promises": lambda: avif_that_promises(9_000),
    "webp-promises": lambda: webp_that_promises(12_000),
    "gif": lambda: gif(9_000),
}
COSTLY = {"png-16-rgba", "png-8-rgba", "png-16-rgb-accepted", "avif-promises", "gif"}
ACCEPTED = {"png-16-rgb-accepted", "png-8-rgba", "gif"}


@pytest.mark.parametrize(
    "kinds", [FILES.keys() - COSTLY, pytest.param(COSTLY, marks=pytest.mark.whole)],
    ids=["refused at once", "costly"],
)  # fmt: skip
def test_small_files_that_promise_much_take_bounded_memory(tmp_path: Path, kinds: set[str]) -> None:
    paths = [tmp_path / kind for kind in sorted(kinds)]
    for path in paths:
        path.write_bytes(FILES[path.name]())
        assert path.stat().st_size < 12_000_000
    command = [sys.executable, "-W", "error", "-c", _READ, *map(str, paths)]
    finished = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    outcome = json.loads(finished.stdout)
    assert outcome["memory_mb"] < MOST_MEMORY_MB
    assert finished.stderr == ""
    for path, refusal in zip(paths, outcome["refusals"], strict=True):
        if path.name in ACCEPTED:
            assert refusal == ""
        else:
            assert " GB of memory to be decoded; allowed: at most 0.95 GB, " in refusal


@pytest.mark.whole
@pytest.mark.parametrize("progressive", [False, True])
def test_a_jpeg_of_fifty_megapixels_is_allowed(tmp_path: Path, progressive: bool) -> None:
    picture = Image.new("RGB", (8160, 6144))
    path = save(tmp_path, picture, "x.jpg", progressive=progressive, subsampling=0)
    assert load_photo(path).image.size == 8160 * 6144


def test_a_jpeg_in_scans_counts_as_what_its_decoder_keeps(tmp_path: Path) -> None:
    content = jpeg_that_promises(SIDE)
    assert content.count(b"\xff\xc2") == 1
    sequential = tmp_path / "x.jpg"
    # Of a first scan of one colour only: the others' come later, so all are kept.
    place = content.index(b"\xff\xda")
    header = struct.pack(">HB", 8, 1) + content[place + 5 : place + 7] + bytes([0, 63, 0])
    scan = content[: place + 2] + header + content[place + 14 :]
    sequential.write_bytes(scan.replace(b"\xff\xc2", b"\xff\xc1", 1))
    with pytest.raises(PhotoError, match=r"GB of memory to be decoded; allowed: at most 0\.95 GB"):
        load_photo(sequential)


def jpeg_of_scans(side: int, scans: int, between: bytes = b"") -> bytes:
    """Repeat the last scan of a progressive JPEG until it has this many."""
    content = jpeg_that_promises(side, "L")
    last, end = content.rindex(b"\xff\xda"), content.rindex(b"\xff\xd9")
    more = scans - content.count(b"\xff\xda")
    return content[:end] + (between + content[last:end]) * more + content[end:]


@pytest.mark.parametrize(("side", "most"), [(64, 500), (3_000, 333), (13_000, 17)])
def test_a_jpeg_of_more_scans_than_are_read_within_seconds_is_refused(
    tmp_path: Path, side: int, most: int
) -> None:
    path = tmp_path / "x.jpg"
    if side == 64:
        path.write_bytes(jpeg_of_scans(side, most))
        assert load_photo(path).image.size == side * side
    for between in (b"", b"\xff\xd0\0\xff\0\xff\xff", b"\xff\xfe\0\4\xff\xd9"):
        path.write_bytes(jpeg_of_scans(side, most + 1, between))
        with pytest.raises(PhotoError, match=rf" in too many scans; .* up to {most} scans and"):
            load_photo(path)


def test_what_looks_like_a_scan_inside_of_a_segment_is_not_counted(tmp_path: Path) -> None:
    path = tmp_path / "x.jpg"
    content = jpeg_of_scans(64, 8)
    note = b"\xff\xda\0\2" * 600
    comment = b"\xff\xfe" + struct.pack(">H", len(note) + 2) + note
    path.write_bytes(content[:2] + comment + content[2:])
    assert load_photo(path).image.size == 64 * 64


def test_a_progressive_jpeg_of_many_empty_segments_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.jpg"
    path.write_bytes(jpeg_of_scans(64, 8, b"\xff\xfe\0\2" * 10_000))
    with pytest.raises(PhotoError, match=r" scans and 10,000 segments, which are read within"):
        load_photo(path)


@pytest.mark.parametrize("name", ["x.qoi", "x.ppm"])
def test_what_is_decoded_in_python_is_refused_by_its_bytes(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    if name == "x.ppm":  # of other than 255 levels
        path.write_bytes(b"P6 1500 1500 99\n" + bytes(1500 * 1500 * 3))
    else:  # each pixel by itself, as noise is
        header = b"qoif" + struct.pack(">IIBB", 1100, 1100, 3, 0)
        path.write_bytes(header + b"\xfe\1\2\3" * (1100 * 1100) + bytes(7) + b"\1")
    with pytest.raises(PhotoError, match=r"\): up to 3,500,000, which are read within seconds\.$"):
        load_photo(path)


@cache
def noise_in(ending: str) -> bytes:
    """Encode a picture of noise; some encoders take seconds for it."""
    shape = (200, 250, 3) if ending in (".heic", ".avif") else (240, 300, 3)
    noise = np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8)
    with TemporaryDirectory() as folder:
        return save(Path(folder), noise, f"x{ending}").read_bytes()


@pytest.mark.parametrize("name", ["x.png", "x.jpg", "x.tif", "x.webp", "x.gif", "x.jp2", "x.heic"])
def test_progress_goes_from_nothing_to_all_and_never_back(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(noise_in(Path(name).suffix))
    fractions: list[float] = []
    load_photo(path, progress=fractions.append)
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)
    assert len(fractions) > 3


@pytest.mark.parametrize("after", [0.0, 0.1, 0.3, 0.9])
@pytest.mark.parametrize("name", ["x.png", "x.jpg", "x.webp", "x.gif", "x.jp2", "x.avif"])
def test_what_progress_raises_ends_the_reading_unchanged(
    tmp_path: Path, name: str, after: float
) -> None:
    path = tmp_path / name
    path.write_bytes(noise_in(Path(name).suffix))
    fractions: list[float] = []

    def stop(fraction: float) -> None:
        fractions.append(fraction)
        if fraction >= after:
            raise Stopped

    with pytest.raises(Stopped):
        load_photo(path, progress=stop)
    assert sum(fraction >= after for fraction in fractions) == 1


@pytest.mark.parametrize("name", ["a\nb.png", "a\x1b[31mb.png", "a\u202eb.png", "a\udcffb.png"])
def test_a_files_name_is_shown_in_one_line(tmp_path: Path, name: str) -> None:
    for content in (None, b"", b"no photo", png(20_000, 20_000, bits=1)[:90]):
        if content is not None:
            (tmp_path / name).write_bytes(content)
        with pytest.raises(PhotoError) as refused:
            load_photo(tmp_path / name)
        assert str(refused.value).isprintable()
