"""Prints what reading a photo costs in memory and time, of each format, at a size of choice."""

import argparse
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import tifffile
from PIL import Image

_READ = """
import sys, time
import occ_model as occ
begin, cpu = time.perf_counter(), time.process_time()
try:
    photo = occ.load_photo(sys.argv[1])
    said = " x ".join(f"{n:,}" for n in photo.image.shape) + f", {photo.channel}"
except occ.PhotoError as error:
    said = str(error)
seconds, spent = time.perf_counter() - begin, time.process_time() - cpu
for line in open("/proc/self/status"):
    if line.startswith("VmHWM:"):
        print(int(line.split()[1]) // 1000, f"MB {seconds:.1f} s wall {spent:.1f} s CPU", said)
"""


def pixels_of(count: int, bands: int, depth: type, noisy: bool) -> np.ndarray:
    """Make stripes, or the noise of a camera, which no encoder shrinks much."""
    side = math.isqrt(count)
    white = 255 if depth is np.float32 else np.iinfo(depth).max
    shape = (side, side, bands) if bands > 1 else (side, side)
    if noisy:
        block = np.random.default_rng(0).integers(40, 72, (509, *shape[1:]))
        if np.dtype(depth).itemsize == 2:
            block = block * 256 + np.random.default_rng(1).integers(0, 256, block.shape)
        block = block.astype(depth)
        return np.concatenate([block] * (side // 509 + 1))[:side]
    stripe = (np.arange(side) // 40 % 2 * 0.6 + 0.2) * white
    row = np.repeat(stripe[:, None], bands, axis=1) * (1 - np.arange(bands) / 10)
    row = row.astype(depth) if bands > 1 else row[:, 0].astype(depth)
    if bands in (2, 4):
        row[:, -1] = white
    return np.broadcast_to(row, shape)


def with_opencv(bands: int, depth: type, *how: int) -> Callable[[Path, int, bool], None]:
    def write(path: Path, count: int, noisy: bool) -> None:
        pixels = np.ascontiguousarray(pixels_of(count, bands, depth, noisy))
        assert cv2.imwrite(str(path), pixels, list(how))

    return write


def with_pillow(mode: str, file_format: str, **how: object) -> Callable[[Path, int, bool], None]:
    def write(path: Path, count: int, noisy: bool) -> None:
        bands = {"L": 1, "P": 1, "1": 1, "F": 1, "I;16": 1}.get(mode, len(mode))
        depth = {"F": np.float32, "I;16": np.uint16}.get(mode, np.uint8)
        pixels = pixels_of(count, bands, depth, noisy)
        if mode == "1":
            pixels = pixels > 127
        picture = Image.fromarray(np.ascontiguousarray(pixels), "CMYK" if mode == "CMYK" else None)
        if mode == "P":
            picture.putpalette(bytes(n for level in range(256) for n in (level, level // 2, 9)))
            picture = picture if picture.mode == "P" else picture.convert("P")
        picture.save(path, file_format, **how)

    return write


def with_tifffile(bands: int, depth: type, **how: Any) -> Callable[[Path, int, bool], None]:
    def write(path: Path, count: int, noisy: bool) -> None:
        pixels = pixels_of(count, bands, depth, noisy)
        kind = "rgb" if bands > 2 else "minisblack"
        extra: dict[str, Any] = {"extrasamples": ["unassalpha"]} if bands in (2, 4) else {}
        tifffile.imwrite(path, np.ascontiguousarray(pixels), photometric=kind, **extra, **how)

    return write


def _heic(path: Path, count: int, noisy: bool) -> None:
    from pillow_heif import from_pillow

    pixels = np.ascontiguousarray(pixels_of(count, 3, np.uint8, noisy))
    from_pillow(Image.fromarray(pixels)).save(path, quality=90)


_MOST_WRITTEN = {"WebP": 60.0, "AVIF": 65.0, "HEIC": 65.0, "QOI": 50.0}
"""Megapixels, of formats that are slow to write: a little more than what is read."""

_FAST = (cv2.IMWRITE_PNG_COMPRESSION, 1)


_PASSES = (
    (0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4),
    (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2),
)  # fmt: skip
"""First column and row, and steps to the next, of what an interlaced PNG gives one by one."""


def _interlaced(path: Path, count: int, noisy: bool) -> None:
    """Write what no library here does."""
    pixels = np.ascontiguousarray(pixels_of(count, 3, np.uint8, noisy))
    height, width = pixels.shape[:2]
    shrink = zlib.compressobj(1)
    data = [
        shrink.compress(b"\0" + row.tobytes())
        for column, line, across, down in _PASSES
        for row in pixels[line::down, column::across]
    ]
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 1)
    chunks = ((b"IHDR", header), (b"IDAT", b"".join(data) + shrink.flush()), (b"IEND", b""))
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, content in chunks:
            check = zlib.crc32(name + content)
            file.write(struct.pack(">I", len(content)) + name + content + struct.pack(">I", check))


_SHRUNK = {"compression": "zlib"}

KINDS: dict[str, tuple[str, Callable[[Path, int, bool], None]]] = {
    "PNG 16-bit RGBA": ("png", with_opencv(4, np.uint16, *_FAST)),
    "PNG 16-bit RGB": ("png", with_opencv(3, np.uint16, *_FAST)),
    "PNG 16-bit grey": ("png", with_opencv(1, np.uint16, *_FAST)),
    "PNG RGBA": ("png", with_opencv(4, np.uint8, *_FAST)),
    "PNG RGB": ("png", with_opencv(3, np.uint8, *_FAST)),
    "PNG grey+alpha": ("png", with_pillow("LA", "PNG", compress_level=1)),
    "PNG grey": ("png", with_opencv(1, np.uint8, *_FAST)),
    "PNG palette": ("png", with_pillow("P", "PNG", compress_level=1)),
    "PNG palette transparent": ("png", with_pillow("P", "PNG", compress_level=1, transparency=3)),
    "PNG 1-bit": ("png", with_pillow("1", "PNG", compress_level=1)),
    "PNG interlaced": ("png", _interlaced),
    "JPEG": ("jpg", with_opencv(3, np.uint8)),
    "JPEG grey": ("jpg", with_opencv(1, np.uint8)),
    "JPEG 4:4:4": ("jpg", with_pillow("RGB", "JPEG", subsampling=0, quality=95)),
    "JPEG progressive": ("jpg", with_opencv(3, np.uint8, cv2.IMWRITE_JPEG_PROGRESSIVE, 1)),
    "JPEG progressive 4:4:4": (
        "jpg",
        with_pillow("RGB", "JPEG", progressive=True, subsampling=0, quality=95),
    ),
    "JPEG CMYK": ("jpg", with_pillow("CMYK", "JPEG")),
    "JPEG 2000": ("jp2", with_pillow("RGB", "JPEG2000")),
    "JPEG 2000 grey": ("jp2", with_pillow("L", "JPEG2000")),
    "JPEG 2000 tiled": ("jp2", with_pillow("RGB", "JPEG2000", tile_size=(1024, 1024))),
    "JPEG 2000 16-bit": ("jp2", with_pillow("I;16", "JPEG2000")),
    "AVIF": ("avif", with_pillow("RGB", "AVIF", speed=10)),
    "AVIF alpha": ("avif", with_pillow("RGBA", "AVIF", speed=10)),
    "WebP": ("webp", with_pillow("RGB", "WEBP", method=0)),
    "WebP alpha": ("webp", with_pillow("RGBA", "WEBP", method=0)),
    "WebP lossless": ("webp", with_pillow("RGB", "WEBP", lossless=True, method=0, quality=0)),
    "GIF": ("gif", with_pillow("P", "GIF")),
    "GIF transparent": ("gif", with_pillow("P", "GIF", transparency=3)),
    "QOI": ("qoi", with_pillow("RGB", "QOI")),
    "QOI alpha": ("qoi", with_pillow("RGBA", "QOI")),
    "TIFF 8-bit RGB": ("tif", with_tifffile(3, np.uint8)),
    "TIFF 8-bit RGB deflate strips": (
        "tif",
        with_tifffile(3, np.uint8, **_SHRUNK, rowsperstrip=16),
    ),
    "TIFF 8-bit RGB deflate tiles": ("tif", with_tifffile(3, np.uint8, **_SHRUNK, tile=(256, 256))),
    "TIFF 8-bit RGB deflate one strip": (
        "tif",
        with_tifffile(3, np.uint8, **_SHRUNK, rowsperstrip=1 << 30),
    ),
    "TIFF 8-bit RGBA": ("tif", with_tifffile(4, np.uint8)),
    "TIFF 8-bit planes": ("tif", with_pillow("RGB", "TIFF")),
    "TIFF 16-bit grey": ("tif", with_tifffile(1, np.uint16)),
    "TIFF 16-bit grey deflate": ("tif", with_tifffile(1, np.uint16, **_SHRUNK)),
    "TIFF 16-bit RGB": ("tif", with_tifffile(3, np.uint16)),
    "TIFF 16-bit RGB deflate tiles": (
        "tif",
        with_tifffile(3, np.uint16, **_SHRUNK, tile=(256, 256)),
    ),
    "TIFF 16-bit RGBA": ("tif", with_tifffile(4, np.uint16)),
    "TIFF 32-bit": ("tif", with_tifffile(1, np.int32)),
    "TIFF float": ("tif", with_tifffile(1, np.float32)),
    "TIFF float deflate": ("tif", with_tifffile(1, np.float32, **_SHRUNK)),
    "TIFF CMYK": ("tif", with_pillow("CMYK", "TIFF")),
    "BMP": ("bmp", with_opencv(3, np.uint8)),
    "PPM": ("ppm", with_opencv(3, np.uint8)),
    "PGM 16-bit": ("pgm", with_opencv(1, np.uint16)),
    "HEIC": ("heic", _heic),
}


def read(path: Path) -> str:
    """Read a photo in a process of its own, and tell what that took."""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    command = [sys.executable, "-c", _READ, str(path)]
    told = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    return told.stdout.strip()


def measure(name: str, megapixels: float, noisy: bool) -> str:
    """Write a file of a kind as large as is accepted, and tell what reading it took."""
    ending, write = KINDS[name]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"x.{ending}"
        write(path, int(megapixels * 1e6), noisy)
        told, size = read(path), path.stat().st_size / 1e6
    least = re.search(r"([0-9.]+) million pixels of this kind", told)
    if least and float(least[1]) < megapixels:
        return measure(name, 0.999 * float(least[1]), noisy)
    return f"{size:8.1f} MB {megapixels:6.1f} MP {told}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--megapixels", type=float, default=169.9)
    parser.add_argument("--noisy", action="store_true", help="files that no encoder shrinks")
    parser.add_argument("kinds", nargs="*", help="parts of the names of those wanted; all")
    options = parser.parse_args()
    for name in KINDS:
        if not options.kinds or any(kind in name for kind in options.kinds):
            most = min(options.megapixels, _MOST_WRITTEN.get(name.split()[0], math.inf))
            print(f"{name:34}", measure(name, most, options.noisy), flush=True)


if __name__ == "__main__":
    main()
