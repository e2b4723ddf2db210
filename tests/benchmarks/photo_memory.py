"""Prints what reading a photo costs in memory and time, of each format, at a size of choice."""

import argparse
import math
import os
import re
import subprocess
import sys
import tempfile
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
    shape = (side, side, bands) if bands > 1 else (side, side)
    white = 255 if depth is np.float32 else np.iinfo(depth).max
    if noisy:
        rows = np.random.default_rng(0).uniform(0.16, 0.28, (min(509, side), *shape[1:]))
        block: np.ndarray = (white * rows).astype(depth)
        return np.concatenate([block] * (side // len(block) + 1))[:side]
    stripe = (np.arange(side) // 40 % 2 * 0.6 + 0.2) * white
    colours = 1.0 - np.arange(bands) / 10.0
    row: np.ndarray = (stripe[:, None] * colours).reshape((side, *shape[2:])).astype(depth)
    if bands in (2, 4):
        row[:, -1] = white
    return np.ascontiguousarray(np.broadcast_to(row, shape))


Write = Callable[[Path, int, bool], object]


def with_opencv(bands: int, depth: type, *how: int) -> Write:
    return lambda path, count, noisy: cv2.imwrite(
        str(path), pixels_of(count, bands, depth, noisy), list(how)
    )


def with_pillow(mode: str, file_format: str, **how: object) -> Write:
    depth = np.uint16 if mode == "I;16" else np.uint8
    bands = len(mode) if mode in ("LA", "RGB", "RGBA", "CMYK") else 1

    def write(path: Path, count: int, noisy: bool) -> None:
        pixels = pixels_of(count, bands, depth, noisy)
        picture = Image.fromarray(pixels, "CMYK" if mode == "CMYK" else None)
        if mode in ("P", "1"):
            picture = picture.convert(mode)
        picture.save(path, file_format, **how)

    return write


def with_tifffile(bands: int, depth: type, **how: Any) -> Write:
    how["photometric"] = "rgb" if bands > 2 else "minisblack"
    if bands in (2, 4):
        how["extrasamples"] = ["unassalpha"]
    return lambda path, count, noisy: tifffile.imwrite(
        path, pixels_of(count, bands, depth, noisy), **how
    )


def _heic(path: Path, count: int, noisy: bool) -> None:
    from pillow_heif import from_pillow

    from_pillow(Image.fromarray(pixels_of(count, 3, np.uint8, noisy))).save(path, quality=90)


_MOST_WRITTEN = {"WebP": 60.0, "AVIF": 65.0, "HEIC": 65.0, "QOI": 50.0}
"""Megapixels, of formats that are slow to write: a little more than what is read."""

_FAST = (cv2.IMWRITE_PNG_COMPRESSION, 1)
_PNG = {"compress_level": 1}
_FULL = {"subsampling": 0, "quality": 95}
_SHRUNK = {"compression": "zlib"}

KINDS: dict[str, tuple[str, Write]] = {
    "PNG 16-bit RGBA": ("png", with_opencv(4, np.uint16, *_FAST)),
    "PNG 16-bit RGB": ("png", with_opencv(3, np.uint16, *_FAST)),
    "PNG 16-bit grey": ("png", with_opencv(1, np.uint16, *_FAST)),
    "PNG RGBA": ("png", with_opencv(4, np.uint8, *_FAST)),
    "PNG RGB": ("png", with_opencv(3, np.uint8, *_FAST)),
    "PNG grey+alpha": ("png", with_pillow("LA", "PNG", **_PNG)),
    "PNG grey": ("png", with_opencv(1, np.uint8, *_FAST)),
    "PNG palette": ("png", with_pillow("P", "PNG", **_PNG)),
    "PNG palette transparent": ("png", with_pillow("P", "PNG", transparency=3, **_PNG)),
    "PNG 1-bit": ("png", with_pillow("1", "PNG", **_PNG)),
    "JPEG": ("jpg", with_opencv(3, np.uint8)),
    "JPEG grey": ("jpg", with_opencv(1, np.uint8)),
    "JPEG 4:4:4": ("jpg", with_pillow("RGB", "JPEG", **_FULL)),
    "JPEG progressive": ("jpg", with_opencv(3, np.uint8, cv2.IMWRITE_JPEG_PROGRESSIVE, 1)),
    "JPEG progressive 4:4:4": ("jpg", with_pillow("RGB", "JPEG", progressive=True, **_FULL)),
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
    "TIFF RGB": ("tif", with_tifffile(3, np.uint8)),
    "TIFF RGB deflate strips": ("tif", with_tifffile(3, np.uint8, rowsperstrip=16, **_SHRUNK)),
    "TIFF RGB deflate tiles": ("tif", with_tifffile(3, np.uint8, tile=(256, 256), **_SHRUNK)),
    "TIFF RGB deflate one strip": (
        "tif",
        with_tifffile(3, np.uint8, rowsperstrip=1 << 30, **_SHRUNK),
    ),
    "TIFF RGBA": ("tif", with_tifffile(4, np.uint8)),
    "TIFF planes": ("tif", with_pillow("RGB", "TIFF")),
    "TIFF 16-bit grey": ("tif", with_tifffile(1, np.uint16)),
    "TIFF 16-bit grey deflate": ("tif", with_tifffile(1, np.uint16, **_SHRUNK)),
    "TIFF 16-bit RGB": ("tif", with_tifffile(3, np.uint16)),
    "TIFF 16-bit RGB deflate tiles": (
        "tif",
        with_tifffile(3, np.uint16, tile=(256, 256), **_SHRUNK),
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
