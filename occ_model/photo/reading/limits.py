"""Limit a photo by its size and its format, so that reading it takes bounded memory and time."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from occ_model.errors import PhotoError, one_line

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

_MOST_MEMORY = 950_000_000
"""Bytes of memory for reading a photo; numpy, OpenCV and the decoders' libraries take 150 MB more.

A picture of 170 million pixels takes 4 bytes a pixel while it is decoded, with or without colours,
and 1 for the channel.
"""

_LONGEST_SIDE = 1_000_000
"""Largest side of a photo in pixels: the maximum columns of a scene, ten times its maximum rows.

The means of columns and lines have 64 bits and are sorted. In a photo of one line they would take
many times the memory and time of its pixels.
"""

_MARKER = re.compile(rb"\xff+([^\x00\x01\xd0-\xd7\xff])")
"""A JPEG's marker of a segment, but not a byte 255 of the data or a restart inside a scan."""

_END, _SCAN = b"\xd9", b"\xda"  # markers of a JPEG's end and of a scan

_MOST_SCANS = 500  # largest number of scans of a JPEG; encoders write about 10

_MOST_PIXELS_OF_SCANS = 3_000_000_000
"""Largest product of a JPEG's pixels and scans: 17 scans of 170 million pixels take seconds."""

_MOST_SEGMENTS = 10_000
"""Largest number of segments of a JPEG in several scans; 3,000 of full length fill a file of the
largest size."""

MOST_BYTES = {
    "JPEG": 170_000_000,
    "PNG": 150_000_000,
    "JPEG2000": 18_000_000,
    "WEBP": 36_000_000,
    "AVIF": 50_000_000,
    "HEIF": 40_000_000,
    "RAW": 150_000_000,
}
"""Largest file in bytes, by format: its decoder takes some seconds for it."""

MOST_BYTES_OF_TIFF = 150_000_000  # largest compressed TIFF in bytes
MOST_BYTES_IN_PYTHON = 3_500_000  # largest file that Pillow decodes in Python: QOI, some BMP, PPM
_MOST_DEEP_AND_TRANSPARENT = 50_000_000
"""Largest number of pixels of 16-bit colours with transparency, which take at least twice the time
of others."""

_DEEP_BYTES = {
    "AVIF": (26.0, 44.0),
    "JPEG2000": (20.0, 26.0),
    "HEIF": (13.0, 20.0),
    "PPM": (6.0, 6.0),
    "PNG": (9.0, 11.0),
    "TIFF": (9.0, 11.0),
}
"""Peak bytes of a pixel of more than 8 bits, by format, without and with opacity."""

_LIBTIFF_COLOURS = 4  # bytes of a pixel if libtiff itself converts YCbCr colours

_BITS_PER_SAMPLE = 258
_ORIENTATION, _ROWS_PER_STRIP, _TILE_WIDTH, _TILE_LENGTH = 274, 278, 322, 323


def check_size(path: Path, width: int, height: int, max_pixels: int) -> None:
    """Refuse a picture with too many pixels or too long a side, before decoding."""
    description = f"{one_line(str(path))} has {width:,} x {height:,} pixels"
    if width * height > max_pixels:
        raise PhotoError(
            f"{description}, {count_of_pixels(width * height)}; allowed: at most "
            f"{allowed_pixels(max_pixels)}"
        )
    if max(width, height) > _LONGEST_SIDE:
        raise PhotoError(f"{description}; allowed: at most {_LONGEST_SIDE:,} along each side.")


def allowed_pixels(max_pixels: int) -> str:
    """Format the largest number of pixels, and how to allow more."""
    return f"{count_of_pixels(max_pixels)}; raise max_pixels to read it."


def count_of_pixels(pixels: int) -> str:
    """Format a number of pixels, in millions where two decimals suffice."""
    if pixels >= 1_000_000 and pixels % 10_000 == 0:
        return f"{pixels / 1e6:,.10g} million"
    return f"{pixels:,}"


def check_bytes(path: Path, width: int, height: int, decoding: float, kept: int) -> None:
    """Refuse a picture that takes too much memory.

    ``decoding``: bytes that decoding takes, in proportion to the pixels. ``kept``: bytes of the
    file that stay in memory during decoding.
    """
    if decoding + kept > _MOST_MEMORY:
        most = width * height * max(_MOST_MEMORY - kept, 0) / decoding
        raise PhotoError(
            f"{one_line(str(path))} has {width:,} x {height:,} pixels, which take "
            f"{(decoding + kept) / 1e9:.2f} GB of memory to be decoded; allowed: at most "
            f"{_MOST_MEMORY / 1e9:.2f} GB, {most / 1e6:.1f} million pixels of this kind."
        )


def count_scans(content: bytes | bytearray, most: int, most_segments: int) -> int:
    """Count a JPEG's scans without decoding; return ``most + 1`` for more, or too many segments."""
    scans, place = 0, 2
    for _ in range(most_segments):
        marker = _MARKER.search(content, place)
        if marker is None or marker[1] == _END:
            return scans
        scans += marker[1] == _SCAN
        if scans > most:
            return scans
        place = marker.end() + int.from_bytes(content[marker.end() : marker.end() + 2], "big")
    return most + 1


def check_file_size(path: Path, file_format: str, size: int) -> None:
    """Refuse a file that would take its decoder too long, before it is opened."""
    _refuse_above(MOST_BYTES.get(file_format, size), path, file_format, size)


def check_decoder(path: Path, picture: "ImageFile", size: int, is_deep: bool = False) -> None:
    """Refuse a file that would take its decoder too long, before decoding.

    ``is_deep``: whether it is one of :mod:`occ_model.photo.reading.deep`, of which only numbers as
    text are slow.
    """
    from PIL import Image

    decoders = {tile[0] for tile in picture.tile}
    kind = picture.format or ""
    if "libtiff" in decoders:
        _refuse_above(MOST_BYTES_OF_TIFF, path, "compressed TIFF", size)
    if not decoders.isdisjoint(Image.DECODERS) and not (is_deep and decoders == {"ppm"}):
        _refuse_above(MOST_BYTES_IN_PYTHON, path, kind, size)


def _refuse_above(largest: int, path: Path, kind: str, size: int) -> None:
    if size > largest:
        raise PhotoError(
            f"{one_line(str(path))} has {size:,} bytes; allowed for a photo of this kind "
            f"({kind}): up to {largest:,}, which are read within seconds."
        )


def check_transparency(path: Path, picture: "ImageFile", is_deep: bool) -> None:
    """Refuse a large picture of 16-bit colours with transparency, before decoding."""
    transparent = "A" in picture.mode or "transparency" in picture.info
    large = picture.width * picture.height > _MOST_DEEP_AND_TRANSPARENT
    if large and transparent and is_deep:
        raise PhotoError(
            f"{one_line(str(path))} has {picture.width:,} x {picture.height:,} pixels of 16-bit "
            f"colours with transparency; allowed: at most "
            f"{_MOST_DEEP_AND_TRANSPARENT // 1_000_000} million, which are read within seconds."
        )


def check_memory(
    path: Path, picture: "ImageFile", bytes_read: int, scan_header: int, is_deep: bool = False
) -> None:
    """Refuse a picture that would take too much memory, before decoding.

    ``bytes_read``: bytes read on opening the file, all of which may stay in memory.
    ``scan_header``: bytes of the last read, which in a JPEG is the header of the first scan.
    """
    if is_deep:
        bytes_a_pixel = _DEEP_BYTES[picture.format or ""]["A" in picture.mode]
    else:
        bytes_a_pixel = _bytes_a_pixel(picture, scan_header)
    decoding = picture.width * picture.height * bytes_a_pixel + _bytes_of_a_strip(picture)
    check_bytes(path, picture.width, picture.height, decoding, bytes_read)


def check_scans(
    path: Path, picture: "ImageFile", scan_header: int, content: Callable[[], bytes | bytearray]
) -> None:
    """Refuse a JPEG with too many scans; ``content`` reads it if it has several."""
    if picture.format != "JPEG" or _is_in_one_scan(picture, scan_header):
        return
    most = min(_MOST_SCANS, _MOST_PIXELS_OF_SCANS // (picture.width * picture.height))
    if count_scans(content(), most, _MOST_SEGMENTS) > most:
        raise PhotoError(
            f"{one_line(str(path))} is a JPEG of {picture.width:,} x {picture.height:,} pixels in "
            f"too many scans; allowed for this size: up to {most:,} scans and "
            f"{_MOST_SEGMENTS:,} segments, which are read within seconds."
        )


def _bytes_a_pixel(picture: "ImageFile", scan_header: int) -> float:
    """Return the peak number of bytes a pixel, from decoding to the extracted channel."""
    decoded = _bytes_decoded(picture.mode)
    channel = 2 if picture.mode.startswith(("I", "F")) else 1
    # Finally the channel is transposed and copied in whole grey levels.
    transposing = 5 if channel == 2 else 2
    return max(
        decoded + decoder_bytes_a_pixel(picture, scan_header), decoded + channel, transposing
    )


def _bytes_decoded(mode: str) -> int:
    if mode in ("1", "L", "P"):
        return 1
    return 2 if mode.startswith("I;16") else 4


def decoder_bytes_a_pixel(picture: "ImageFile", scan_header: int) -> float:
    """Return the bytes a pixel that a format's decoder allocates in addition to the picture."""
    bands = len(picture.getbands())
    kind = picture.format
    if kind == "JPEG":
        layers = getattr(picture, "layer", [])
        # Several scans need coefficients of 16 bits for the whole picture.
        one_scan = _is_in_one_scan(picture, scan_header)
        return 0.0 if one_scan else 2 * _samples_a_pixel(layers)
    if kind == "JPEG2000":  # integers of 32 bits, and samples of 16
        return 6 * bands
    if kind == "TIFF":  # Pillow rotates it
        tags = getattr(picture, "tag_v2", {})
        return 0.0 if tags.get(_ORIENTATION, 1) == 1 else _bytes_decoded(picture.mode)
    from PIL import Image

    if any(tile[0] in Image.DECODERS for tile in picture.tile):  # in Python, in an array
        return 5.0
    return {"WEBP": 13.0, "AVIF": 12.0, "HEIF": 12.0}.get(kind or "", 0.0)


def _is_in_one_scan(picture: "ImageFile", scan_header: int) -> bool:
    """Return whether the first scan of a JPEG has all colours, so that no other is decoded."""
    layers = getattr(picture, "layer", [])
    return scan_header == 4 + 2 * len(layers) and "progressive" not in picture.info


def _samples_a_pixel(layers: list[tuple[object, int, int, object]]) -> float:
    """Return the number of samples of a JPEG per pixel, as colours may be subsampled."""
    widest = max((across for _, across, _, _ in layers), default=1)
    highest = max((down for _, _, down, _ in layers), default=1)
    return sum(across * down for _, across, down, _ in layers) / (widest * highest)


def _bytes_of_a_strip(picture: "ImageFile") -> float:
    """Return the bytes of a strip or tile in which a TIFF is decoded, which may be all of it."""
    tags = getattr(picture, "tag_v2", None)
    if tags is None or picture.format != "TIFF":
        return 0.0
    if len(picture.tile) == 1 and picture.tile[0][0] == "raw":  # read line by line
        return 0.0
    area = picture.width * min(int(tags.get(_ROWS_PER_STRIP, picture.height)), picture.height)
    if _TILE_WIDTH in tags and _TILE_LENGTH in tags:
        area = int(tags[_TILE_WIDTH]) * int(tags[_TILE_LENGTH])
    bits = tags.get(_BITS_PER_SAMPLE, (1,))
    return float(area * max(sum(bits) / 8, _LIBTIFF_COLOURS))
