"""Open an image file of a supported format, or state in one sentence why it cannot be read."""

import logging
import math
import os
import re
import stat
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, TypeAlias

from occ_model.errors import PhotoError, SceneFileError, one_line
from occ_model.files.reading import HEIC_BRANDS, HEIF_BRANDS, kind_of_film
from occ_model.photo.reading.deep import Opened, is_reduced
from occ_model.photo.reading.levels import bits_of
from occ_model.photo.reading.limits import (
    allowed_pixels,
    check_decoder,
    check_file_size,
    check_memory,
    check_scans,
    check_size,
    check_transparency,
    count_of_pixels,
)
from occ_model.photo.reading.tiff import describe_samples, has_short_tags
from occ_model.photo.reading.watched_file import Reporter, WatchedFile

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

    Factory: TypeAlias = Callable[[IO[bytes]], ImageFile]

_BYTES_A_PIXEL, _BYTES_OF_NOTES = 8, 16_000_000
"""Four channels of 16 bits, and bytes of the metadata that a file may also contain."""

_PIXELS_A_BYTE = {"JPEG": 512, "PNG": 8 * 1032, "GIF": 8 * 4096 // 12}
"""Largest number of pixels in a byte of a file, for formats whose decoders fill in missing data.

JPEG needs at least a bit of Huffman code for a block of 8 x 8 pixels. Deflate compresses to 1/1032
at best, and a pixel of PNG has at least a bit. A code of LZW has 12 bits for at most 4096 pixels.
"""

_JPEG_XL = (b"\xff\x0a", b"\0\0\0\x0cJXL ")  # first bytes of its code stream, and of its file

_pillow_lock = threading.Lock()

_FORMATS = ("JPEG", "PNG", "TIFF", "WEBP", "BMP", "GIF", "PPM", "QOI", "JPEG2000", "AVIF")
"""The supported formats. Pillow reads more, but starts other programs for some of them."""


@contextmanager
def open_file(path: Path, max_pixels: int, report: Reporter) -> Iterator[WatchedFile]:
    """Open a file that should be a photo.

    PhotoError is raised if there is no such file, it may not be read, or it has too many bytes.
    Errors of a decoder inside the ``with`` block become a PhotoError, too.
    """
    try:
        _check_file(path, max_pixels)
        with _configure_pillow(max_pixels), WatchedFile(path, report) as file:
            yield file
    except PhotoError:
        raise
    except SceneFileError as error:  # its sentence suits any file
        raise PhotoError(str(error)) from None
    except Exception as error:  # noqa: BLE001 - decoders raise anything on damaged files.
        # A decoder may have replaced the exception that cancelled it with its own.
        if report.ended_by is not None:
            raise report.ended_by from None
        raise _make_refusal(path, error, max_pixels) from None


def _make_refusal(path: Path, error: Exception, max_pixels: int) -> PhotoError:
    from PIL import Image

    name = one_line(str(path))
    # Some formats check the size on opening.
    if isinstance(error, Image.DecompressionBombError):
        return PhotoError(f"{name} has more than {allowed_pixels(max_pixels)}")
    if isinstance(error, MemoryError):
        return PhotoError(f"{name} cannot be read: there is too little memory for it.")
    reason = error.strerror if isinstance(error, OSError) else None
    return PhotoError(f"{name} cannot be read: {reason or _describe_damage(error)}.")


@contextmanager
def _configure_pillow(max_pixels: int) -> Iterator[None]:
    """Set the limit of pixels in Pillow, and suppress its warnings about readable files.

    These settings are global in Pillow and Python. A lock lets one photo at a time change them, and
    they are restored after reading it.
    """
    from PIL import Image

    # Without a handler, Python would print errors that Pillow logs.
    log, handler = logging.getLogger("PIL"), logging.NullHandler()
    with _pillow_lock, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        log.addHandler(handler)
        former_limit = Image.MAX_IMAGE_PIXELS
        # Pillow refuses a picture of more than twice this number.
        Image.MAX_IMAGE_PIXELS = (max_pixels + 1) // 2
        try:
            yield
        finally:
            Image.MAX_IMAGE_PIXELS = former_limit
            log.removeHandler(handler)


def _check_file(path: Path, max_pixels: int) -> None:
    """Refuse a path that is not a regular file or is empty: opening a pipe could block."""
    name = one_line(str(path))
    try:
        status = path.stat()
    except ValueError as error:  # a name that no file can have
        raise PhotoError(f"{name} cannot be read: {error}.") from None
    if stat.S_ISDIR(status.st_mode):
        raise PhotoError(f"{name} is a folder, not a photo.")
    if not stat.S_ISREG(status.st_mode):
        raise PhotoError(f"{name} is a device, pipe or socket, not a photo.")
    if status.st_size == 0:
        raise PhotoError(f"{name} is an empty file.")
    # Some decoders load the whole file into memory.
    largest = _BYTES_A_PIXEL * max_pixels + _BYTES_OF_NOTES
    if status.st_size > largest:
        raise PhotoError(
            f"{name} has {status.st_size:,} bytes; allowed for a photo of at most "
            f"{count_of_pixels(max_pixels)} pixels: up to {largest:,}."
        )


def open_picture(path: Path, file: WatchedFile, max_pixels: int, last: float) -> Opened:
    """Open a file's first picture, and check its size before decoding.

    ``last``: the fraction of the work that is done when it is decoded. PhotoError is raised if the
    file is not an image, or is damaged or too large.
    """
    path_text, size = one_line(str(path)), os.fstat(file.fileno()).st_size
    name, factory = format_and_factory(path, file)
    check_file_size(path, name, size)
    if name == "TIFF" and not has_short_tags(file):
        raise PhotoError(f"{path_text} cannot be read: one of its tags has too many numbers.")
    file.seek(0, os.SEEK_SET)
    file.watch(size, 0.0, last)
    try:
        picture = factory(file)
    except SyntaxError as error:  # Pillow's error for an invalid header
        problem = _describe_damage(error, "the file is damaged or of an unusual kind")
        if name == "TIFF":
            problem = f"{problem}; {describe_samples(file)}"
        raise PhotoError(f"{path_text} cannot be read: {problem}.") from None
    width, height = picture.size
    check_size(path, width, height, max_pixels)
    # Decoders take seconds to fill a picture of a wrong size with black.
    if width * height > _PIXELS_A_BYTE.get(picture.format or "", math.inf) * size:
        raise PhotoError(
            f"{path_text} cannot be read: the file is damaged ({size:,} bytes cannot hold "
            f"{width:,} x {height:,} pixels)."
        )
    if picture.format == "TIFF":
        _check_tiff(path_text, picture)
    scan_header = file.last
    content = _read_content(file, size) if picture.format in ("AVIF", "JPEG2000") else bytearray()
    bits = bits_of(picture, content)
    is_deep = is_reduced(picture, bits)
    check_decoder(path, picture, size, is_deep)
    check_memory(path, picture, file.total + (size if is_deep else 0), scan_header, is_deep)
    check_transparency(path, picture, is_deep)
    check_scans(path, picture, scan_header, lambda: _read_content(file, size))
    if is_deep and not content:
        content = _read_content(file, size)
    return Opened(path_text, picture, bits, content if is_deep else b"")


def _read_content(file: WatchedFile, size: int) -> bytearray:
    """Read a whole file without reporting progress, as its decoder reads it again."""
    content = bytearray(size)
    place = file.tell()
    file.seek(0, os.SEEK_SET)
    del content[file.readinto(content) :]
    file.seek(place, os.SEEK_SET)
    return content


def _check_tiff(name: str, picture: "ImageFile") -> None:
    """Refuse a TIFF that Pillow would decode wrongly without an error."""
    from PIL.TiffImagePlugin import BITSPERSAMPLE, PLANAR_CONFIGURATION, TiffImageFile

    if not _has_all_tiles(picture):
        raise PhotoError(f"{name} cannot be read: the file is damaged (parts are missing).")
    tags = picture.tag_v2 if isinstance(picture, TiffImageFile) else {}
    bits = tags.get(BITSPERSAMPLE, (1,))
    if tags.get(PLANAR_CONFIGURATION) == 2 and len(bits) > 1 and max(bits) > 8:
        raise PhotoError(
            f"{name} cannot be read: each of its colours of {max(bits)} bits is in a plane of "
            "its own; allowed: colours stored pixel by pixel."
        )


def _has_all_tiles(picture: "ImageFile") -> bool:
    """Return whether the tiles of a TIFF cover it up to the last corner, before rotation."""
    corners = [tile[1][2:] for tile in picture.tile if tile[1] is not None]
    reach = [max((corner[axis] for corner in corners), default=0) for axis in (0, 1)]
    return reach[0] * reach[1] >= picture.width * picture.height


def _describe_damage(error: Exception, problem: str = "the file is damaged") -> str:
    """Format a decoder's message, which may quote the file's bytes, as part of a sentence."""
    words = re.sub(r"\s+", " ", "".join(c if c.isprintable() else " " for c in str(error)))
    words = words.strip().rstrip(".")[:120]
    return f"{problem} ({words})" if words else problem


def format_and_factory(path: Path, file: IO[bytes]) -> "tuple[str, Factory]":
    """Recognize a file's format by its first bytes."""
    from PIL import Image
    from PIL.JpegImagePlugin import JpegImageFile

    file.seek(0, os.SEEK_SET)
    start = file.read(64)
    if _is_heic(start):
        return "HEIF", _heic_factory(path)
    Image.init()
    for name in _FORMATS:
        factory, accepts = Image.OPEN.get(name, (None, None))
        if factory is not None and accepts is not None and accepts(start[:16]) is True:
            # Pillow's own function for JPEG fails if the list of further pictures is damaged.
            return name, partial(_open, JpegImageFile if name == "JPEG" else factory)
    name = one_line(str(path))
    if kind_of_film(start) is not None:
        raise PhotoError(f"{name} is a film, not a photo; decode it as a film.")
    if start.startswith(_JPEG_XL):
        raise PhotoError(f"{name} is a JPEG XL picture, which cannot be read; save it as PNG.")
    raise PhotoError(f"{name} is not an image that can be read.")


def _open(factory: "Callable[[IO[bytes], str], ImageFile]", file: IO[bytes]) -> "ImageFile":
    return factory(file, "")


def _is_heic(start: bytes) -> bool:
    if start[4:8] != b"ftyp":
        return False
    brand, others = start[8:12], start[12:]
    return brand in HEIC_BRANDS or (brand in HEIF_BRANDS and b"avif" not in others)


def _heic_factory(path: Path) -> "Factory":
    """Return the function that opens a HEIC photo, without changing Pillow's global registry."""
    try:
        from pillow_heif import HeifImageFile
    except ImportError:
        raise PhotoError(
            f"{one_line(str(path))} is a HEIC photo; to read it: pip install occ-explorer[heic]."
        ) from None
    factory: Factory = HeifImageFile
    return factory
