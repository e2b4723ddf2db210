"""Photos of every format that is read: damaged ones, and valid but unusual ones."""

import io
import struct
import warnings
import zlib
from collections.abc import Callable
from functools import cache

import cv2
import damage
import numpy as np
from numpy.random import Generator
from PIL import Image
from PIL.ExifTags import IFD, Base
from pillow_heif import from_pillow

STRIPES = np.tile(np.repeat([30, 220, 90, 160], 16).astype(np.uint8), (48, 1))
COLOURS = np.dstack([STRIPES, STRIPES // 2, 255 - STRIPES])


def encode(pixels: np.ndarray | Image.Image, file_format: str, **how: object) -> bytes:
    picture = Image.fromarray(pixels) if isinstance(pixels, np.ndarray) else pixels
    buffer = io.BytesIO()
    picture.save(buffer, file_format, **how)
    return buffer.getvalue()


def encode_with_opencv(pixels: np.ndarray, ending: str) -> bytes:
    _, encoded = cv2.imencode(ending, pixels)
    return encoded.tobytes()


@cache
def whole_files() -> dict[str, bytes]:
    """Return a small file of each format."""
    exif = Image.Exif()
    exif[Base.Orientation], exif[Base.Make] = 6, "Maker"
    exif.get_ifd(IFD.Exif).update(
        {Base.ExposureTime: 1 / 8000, Base.FNumber: 1.8, Base.ISOSpeedRatings: 100}
    )
    notes = {"exif": exif.tobytes()}
    deep = COLOURS.astype(np.uint16) * 257 + 3
    palette = Image.fromarray(COLOURS).quantize(16)
    heic = io.BytesIO()
    from_pillow(Image.fromarray(COLOURS)).save(heic, exif=exif.tobytes())
    tiled = encode(COLOURS, "TIFF", compression="tiff_adobe_deflate")
    return {
        "png": encode(STRIPES, "PNG", **notes),
        "png-palette": encode(palette, "PNG", transparency=3),
        "png-16": encode(deep[..., 0], "PNG"),
        "png-16-colours": encode_with_opencv(deep, ".png"),
        "png-alpha": encode(Image.fromarray(COLOURS).convert("RGBA"), "PNG"),
        "jpeg": encode(COLOURS, "JPEG", **notes),
        "jpeg-progressive": encode(STRIPES, "JPEG", progressive=True),
        "jpeg-cmyk": encode(Image.fromarray(COLOURS).convert("CMYK"), "JPEG"),
        "mpo": encode(
            COLOURS, "MPO", save_all=True, append_images=[Image.fromarray(STRIPES).convert("RGB")]
        ),
        "tiff": encode(STRIPES, "TIFF", exif=exif),
        "tiff-deflate": tiled,
        "tiff-lzw": encode(COLOURS, "TIFF", compression="tiff_lzw"),
        "tiff-jpeg": encode(COLOURS, "TIFF", compression="jpeg"),
        "tiff-fax": encode(Image.fromarray(STRIPES > 99), "TIFF", compression="group4"),
        "tiff-float": encode(STRIPES.astype(np.float32), "TIFF"),
        "tiff-16": encode(deep[..., 0], "TIFF"),
        "tiff-16-colours": encode_with_opencv(deep, ".tiff"),
        "webp": encode(COLOURS, "WEBP", **notes),
        "webp-lossless": encode(COLOURS, "WEBP", lossless=True),
        "bmp": encode(COLOURS, "BMP"),
        "bmp-palette": encode(palette, "BMP"),
        "gif": encode(palette, "GIF", save_all=True, append_images=[Image.fromarray(STRIPES)]),
        "ppm": encode(COLOURS, "PPM"),
        "ppm-16": b"P6 64 48 65535\n" + deep.astype(">u2").tobytes(),
        "jp2": encode(COLOURS, "JPEG2000"),
        "jp2-16": encode_with_opencv(deep, ".jp2"),
        "avif": encode(COLOURS, "AVIF", **notes),
        "heic": heic.getvalue(),
    }


def swap_headers(rng: Generator, content: bytearray) -> bytearray:
    other = list(whole_files().values())[rng.integers(len(whole_files()))]
    length = rng.integers(4, 64)
    return bytearray(other[:length] + content[length:])


def write_wrong_size(rng: Generator, content: bytearray) -> bytearray:
    """Write another size into a PNG's header with its checksum, or into another format."""
    sizes = [0, 1, 63, 65, 5000, 9000, 40_000, 2**31 - 1, 2**32 - 1, int(rng.integers(2**20))]
    if content.startswith(b"\x89PNG"):
        struct.pack_into(">II", content, 16, *(int(size) for size in rng.choice(sizes, 2)))
        struct.pack_into(">I", content, 29, zlib.crc32(content[12:29]))
        return content
    for size in (64, 48):  # wherever the size is in another format
        for order in "<>":
            written = struct.pack(f"{order}H", size)
            place = content.find(written)
            if place >= 0:
                struct.pack_into(f"{order}H", content, place, int(rng.choice(sizes)) & 0xFFFF)
    return content


WAYS: tuple[Callable[[Generator, bytearray], bytearray], ...] = (
    *damage.WAYS, swap_headers, write_wrong_size,
)  # fmt: skip


def make_damaged(seed: int) -> tuple[str, bytes]:
    """Return a description and the bytes of the damaged photo of a seed."""
    rng = np.random.default_rng(seed)
    kinds = list(whole_files())
    kind, way = kinds[rng.integers(len(kinds))], WAYS[rng.integers(len(WAYS))]
    return f"{kind} {way.__name__}", bytes(way(rng, bytearray(whole_files()[kind])))


SIZES = ((1, 1), (1, 2), (3, 1), (1, 900), (900, 1), (2, 2), (7, 5), (48, 256), (300, 300))
"""Rows and columns of unusual photos."""

MODES = ("1", "L", "LA", "P", "RGB", "RGBA", "CMYK", "I;16", "F", "I", "HSV", "LAB", "YCbCr")


def make_unusual(seed: int) -> tuple[str, bytes]:
    """Return description and bytes of a valid photo with unusual size, pixels or EXIF data."""
    rng = np.random.default_rng(seed)
    mode = MODES[rng.integers(len(MODES))]
    picture = _picture(rng, mode)
    buffer = io.BytesIO()
    for name in rng.permutation(["PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF", "PPM", "JPEG2000"]):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # about unusual values
                picture.save(buffer, str(name), exif=_unusual_exif(rng))
        # The format has no such pixels, or Pillow cannot parse the damaged EXIF data.
        except (OSError, ValueError, KeyError, TypeError, SyntaxError):
            buffer = io.BytesIO()
            continue
        return f"{mode} {name}", buffer.getvalue()
    return f"{mode} as numbers", picture.tobytes()


def _picture(rng: Generator, mode: str) -> Image.Image:
    rows, columns = SIZES[rng.integers(len(SIZES))]
    waves = np.sin(np.arange(columns) / rng.uniform(1, 60)) * rng.choice([0, 1, 40, 127]) + 128
    levels = np.broadcast_to(waves, (rows, columns)) + rng.normal(0, rng.choice([0, 5]), (rows, 1))
    if mode == "I;16":
        return Image.fromarray((levels * 257).clip(0, 65535).astype(np.uint16))
    if mode in ("F", "I"):
        scale = rng.choice([1e-3, 1.0, 1e6]) if mode == "F" else 1.0
        numbers = (levels * scale).astype(np.float32 if mode == "F" else np.int32)
        if mode == "F" and rng.integers(2):
            numbers.flat[rng.integers(numbers.size)] = rng.choice([np.nan, np.inf, -np.inf, 1e38])
        return Image.fromarray(numbers)
    grey = Image.fromarray(levels.clip(0, 255).astype(np.uint8))
    if mode in ("HSV", "LAB", "YCbCr", "CMYK"):
        grey = grey.convert("RGB")
    return grey if mode == "LAB" else grey.convert(mode)


def _unusual_exif(rng: Generator) -> bytes:
    """Return EXIF data with values of wrong range or type, sometimes damaged."""
    exif = Image.Exif()
    texts = ["", "Maker", "\x1b[31m", "a" * 5000, "\n\n", "é", "\0\0"]
    exif[Base.Orientation] = int(rng.choice([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 255, 65535]))
    exif[Base.Make], exif[Base.Model] = str(rng.choice(texts)), str(rng.choice(texts))
    numbers = [0.0, 1e-9, 1 / 8000, 1.0, 1e9, float("nan")]
    exif.get_ifd(IFD.Exif).update(
        {
            Base.ExposureTime: float(rng.choice(numbers[:5])),
            Base.FNumber: float(rng.choice(numbers[:5])),
            Base.ISOSpeedRatings: int(rng.choice([0, 1, 100, 65535])),
        }
    )
    content = exif.tobytes()
    if rng.integers(3) == 0:
        place = int(rng.integers(len(content)))
        content = content[:place] + rng.bytes(4) + content[place + 4 :]
    return content
