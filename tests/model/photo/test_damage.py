"""Damaged photos: each is read or refused in a sentence, soon, in little memory and in silence.

Run as a program, this file reads a range of damaged files, so that one which crashes the
interpreter or never ends takes that program down and not the tests.
"""

import io
import json
import signal
import struct
import subprocess
import sys
import tempfile
import zlib
from collections import Counter
from collections.abc import Callable
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.random import Generator
from PIL import Image
from pillow_heif import from_pillow

from occ_model.errors import PhotoError
from occ_model.photo.reading.load import Photo, load_photo

SAMPLE, WHOLE = 2000, 5000
AT_ONCE = 2
PATIENCE_CPU_S = 2.0
MOST_MEMORY_MB = 400
"""Numpy, OpenCV and the decoders' libraries are some 150 MB of it."""

STRIPES = np.tile(np.repeat([30, 220, 90, 160], 16).astype(np.uint8), (48, 1))
COLOURS = np.dstack([STRIPES, STRIPES // 2, 255 - STRIPES])


def saved(pixels: np.ndarray | Image.Image, file_format: str, **how: object) -> bytes:
    picture = Image.fromarray(pixels) if isinstance(pixels, np.ndarray) else pixels
    buffer = io.BytesIO()
    picture.save(buffer, file_format, **how)
    return buffer.getvalue()


def with_opencv(pixels: np.ndarray, ending: str) -> bytes:
    _, encoded = cv2.imencode(ending, pixels)
    return encoded.tobytes()


@cache
def whole_files() -> dict[str, bytes]:
    """One small file of each kind."""
    exif = Image.Exif()
    exif[0x0112], exif[0x010F] = 6, "Maker"
    exif.get_ifd(0x8769).update({0x829A: 1 / 8000, 0x829D: 1.8, 0x8827: 100})
    noted = {"exif": exif.tobytes()}
    deep = COLOURS.astype(np.uint16) * 257 + 3
    palette = Image.fromarray(COLOURS).quantize(16)
    heic = io.BytesIO()
    from_pillow(Image.fromarray(COLOURS)).save(heic, exif=exif.tobytes())
    tiled = saved(COLOURS, "TIFF", compression="tiff_adobe_deflate")
    return {
        "png": saved(STRIPES, "PNG", **noted),
        "png-palette": saved(palette, "PNG", transparency=3),
        "png-16": saved(deep[..., 0], "PNG"),
        "png-16-colours": with_opencv(deep, ".png"),
        "png-alpha": saved(Image.fromarray(COLOURS).convert("RGBA"), "PNG"),
        "jpeg": saved(COLOURS, "JPEG", **noted),
        "jpeg-progressive": saved(STRIPES, "JPEG", progressive=True),
        "jpeg-cmyk": saved(Image.fromarray(COLOURS).convert("CMYK"), "JPEG"),
        "mpo": saved(
            COLOURS, "MPO", save_all=True, append_images=[Image.fromarray(STRIPES).convert("RGB")]
        ),
        "tiff": saved(STRIPES, "TIFF", exif=exif),
        "tiff-deflate": tiled,
        "tiff-lzw": saved(COLOURS, "TIFF", compression="tiff_lzw"),
        "tiff-jpeg": saved(COLOURS, "TIFF", compression="jpeg"),
        "tiff-fax": saved(Image.fromarray(STRIPES > 99), "TIFF", compression="group4"),
        "tiff-float": saved(STRIPES.astype(np.float32), "TIFF"),
        "tiff-16": saved(deep[..., 0], "TIFF"),
        "tiff-16-colours": with_opencv(deep, ".tiff"),
        "webp": saved(COLOURS, "WEBP", **noted),
        "webp-lossless": saved(COLOURS, "WEBP", lossless=True),
        "bmp": saved(COLOURS, "BMP"),
        "bmp-palette": saved(palette, "BMP"),
        "gif": saved(palette, "GIF", save_all=True, append_images=[Image.fromarray(STRIPES)]),
        "ppm": saved(COLOURS, "PPM"),
        "jp2": saved(COLOURS, "JPEG2000"),
        "avif": saved(COLOURS, "AVIF", **noted),
        "heic": heic.getvalue(),
    }


def cut(rng: Generator, content: bytearray) -> bytearray:
    return content[: rng.integers(1, len(content))]


def flip(rng: Generator, content: bytearray) -> bytearray:
    for place in rng.integers(len(content), size=rng.integers(1, 9)):
        content[place] ^= 1 << rng.integers(8)
    return content


def flip_in_the_header(rng: Generator, content: bytearray) -> bytearray:
    for place in rng.integers(min(len(content), 120), size=rng.integers(1, 5)):
        content[place] = rng.integers(256)
    return content


def swap_headers(rng: Generator, content: bytearray) -> bytearray:
    other = list(whole_files().values())[rng.integers(len(whole_files()))]
    length = rng.integers(4, 64)
    return bytearray(other[:length] + content[length:])


def insert_a_run(rng: Generator, content: bytearray) -> bytearray:
    place, length = int(rng.integers(len(content))), int(rng.integers(1, 3000))
    run = rng.bytes(length) if rng.integers(2) else bytes([int(rng.integers(256))]) * length
    return content[:place] + run + content[place:]


def drop_a_run(rng: Generator, content: bytearray) -> bytearray:
    place = rng.integers(len(content))
    return content[:place] + content[place + rng.integers(1, 200) :]


def wrong_size(rng: Generator, content: bytearray) -> bytearray:
    """Write another size into a PNG's header, and the check sum that fits it."""
    sizes = [0, 1, 63, 65, 5000, 9000, 40_000, 2**31 - 1, 2**32 - 1, int(rng.integers(2**20))]
    if content.startswith(b"\x89PNG"):
        struct.pack_into(">II", content, 16, *(int(size) for size in rng.choice(sizes, 2)))
        struct.pack_into(">I", content, 29, zlib.crc32(content[12:29]))
        return content
    for size in (64, 48):  # in the others wherever their size stands
        for order in "<>":
            written = struct.pack(f"{order}H", size)
            place = content.find(written)
            if place >= 0:
                struct.pack_into(f"{order}H", content, place, int(rng.choice(sizes)) & 0xFFFF)
    return content


def wrong_number(rng: Generator, content: bytearray) -> bytearray:
    """Write numbers at the edge of what fits over some of the first bytes."""
    for _ in range(rng.integers(1, 4)):
        place = int(rng.integers(2, min(len(content), 400) - 4))
        number = int(rng.choice([0, 1, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF]))
        struct.pack_into("<I" if rng.integers(2) else ">I", content, place, number)
    return content


def only_the_magic(rng: Generator, content: bytearray) -> bytearray:
    return content[: rng.integers(4, 40)] + rng.bytes(int(rng.integers(1, 2000)))


WAYS: tuple[Callable[[Generator, bytearray], bytearray], ...] = (
    cut,
    flip,
    flip_in_the_header,
    swap_headers,
    insert_a_run,
    drop_a_run,
    wrong_size,
    wrong_number,
    only_the_magic,
)


def damaged(seed: int) -> tuple[str, bytes]:
    """Make the damaged file of this number, and say what it is."""
    rng = np.random.default_rng(seed)
    kinds = list(whole_files())
    kind, way = kinds[seed % len(kinds)], WAYS[rng.integers(len(WAYS))]
    return f"{kind} {way.__name__}", bytes(way(rng, bytearray(whole_files()[kind])))


def read_in_a_row(seeds: range) -> None:
    """Read damaged files; print each one's number before, and what came of them all at the end."""
    outcomes: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "photo"
        for seed in seeds:
            name, content = damaged(seed)
            path.write_bytes(content)
            print(seed, name, flush=True)  # noqa: T201
            # No handler: the signal ends this program wherever it hangs.
            signal.setitimer(signal.ITIMER_PROF, PATIENCE_CPU_S)
            try:
                photo = load_photo(path)
            except PhotoError as error:
                sentence = str(error)
                assert sentence.endswith(".")
                assert sentence.isprintable()
                assert len(sentence) < 300
                outcomes["refused"] += 1
            else:
                assert_is_a_photo(photo)
                outcomes["read"] += 1
            signal.setitimer(signal.ITIMER_PROF, 0)
    print(json.dumps({**outcomes, "memory_mb": peak_kilobytes() / 1024}))  # noqa: T201


def peak_kilobytes() -> int:
    """Give the most memory that this process has had, and not what its parent had before it."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1])
    raise AssertionError("this system does not give a process's peak memory")


def assert_is_a_photo(photo: Photo) -> None:
    assert photo.samples.dtype in (np.uint8, np.uint16)
    assert photo.white == np.iinfo(photo.samples.dtype).max
    assert photo.image.dtype == np.uint8
    assert photo.image.shape == photo.samples.shape
    assert photo.profile.shape == photo.samples.shape[1:]
    assert np.isfinite(photo.profile).all()
    assert -1e-9 <= photo.profile.min() <= photo.profile.max() <= 255 + 1e-9


@pytest.fixture(
    scope="module",
    params=[SAMPLE, pytest.param(WHOLE, marks=pytest.mark.whole)],
    ids=["sample", "whole"],
)
def results(request: pytest.FixtureRequest) -> list[subprocess.CompletedProcess[str]]:
    """Read some damaged files, or all, in a few programs at once."""
    commands = [
        [sys.executable, "-W", "error", __file__, str(first), str(request.param), str(AT_ONCE)]
        for first in range(AT_ONCE)
    ]
    running = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for command in commands
    ]
    results = []
    for program in running:
        printed, complaints = program.communicate(timeout=600)
        results.append(
            subprocess.CompletedProcess(program.args, program.returncode, printed, complaints)
        )
    return results


def test_every_damaged_photo_is_read_or_refused_with_a_sentence(
    results: list[subprocess.CompletedProcess[str]],
) -> None:
    total: Counter[str] = Counter()
    for result in results:
        last = result.stdout.splitlines()[-1]
        assert result.returncode == 0, f"damaged({last}) ended it: {result.stderr[-3000:]}"
        total += Counter(json.loads(last))
    files = total["read"] + total["refused"]
    assert files in {SAMPLE, WHOLE}
    assert min(total["read"], total["refused"]) > files / 10


def test_no_damaged_photo_takes_much_memory(
    results: list[subprocess.CompletedProcess[str]],
) -> None:
    for result in results:
        assert json.loads(result.stdout.splitlines()[-1])["memory_mb"] < MOST_MEMORY_MB


def test_no_decoder_writes_what_it_thinks_of_a_damaged_photo(
    results: list[subprocess.CompletedProcess[str]],
) -> None:
    assert [result.stderr for result in results] == [""] * AT_ONCE


if __name__ == "__main__":
    read_in_a_row(range(*map(int, sys.argv[1:])))
