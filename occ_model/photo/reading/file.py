"""Open an image file of any kind, or say in one sentence why it cannot be read."""

import logging
import math
import os
import re
import stat
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from occ_model.errors import PhotoError, one_line
from occ_model.photo.reading.formats import format_and_factory
from occ_model.photo.reading.limits import check_decoder, check_file_size, check_memory
from occ_model.photo.reading.watched_file import Teller, WatchedFile

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

    Opener: TypeAlias = Callable[[float, float], ImageFile]

_BYTES_A_PIXEL, _BYTES_OF_NOTES = 8, 16_000_000
"""Four channels of 16 bits, and what else an honest file of so many pixels may hold."""

_PIXELS_A_BYTE = {"JPEG": 512, "PNG": 8 * 1032, "GIF": 8 * 4096 // 12}
"""What a byte of a file can hold at most, of formats whose decoders make up what is missing.

A block of 8 x 8 pixels takes a bit of Huffman code; deflate shrinks to 1/1032 at best, and a pixel
takes a bit; a code of LZW has 12 bits and stands for 4096 pixels.
"""

_pillow_lock = threading.Lock()


@contextmanager
def open_picture(path: Path, max_pixels: int, tell: Teller) -> "Iterator[Opener]":
    """Open an image file.

    Parameters
    ----------
    path
        The file.
    max_pixels
        What a picture may have at most, by its header.
    tell
        Told of progress as the file is read; what it raises comes out of the ``with`` block.

    Yields
    ------
    callable
        Gives the file's first picture, not yet decoded, at each call; takes between which two
        shares of the work it will be decoded.

    Raises
    ------
    PhotoError
        There is no such file, it may not be read, it is no image or a damaged one, or too large.
        Also in place of whatever is raised on decoding inside the ``with`` block.
    """
    try:
        _check_file(path, max_pixels)
        with _pillow_ready(max_pixels), WatchedFile(path, tell) as file:
            yield lambda first, last: _first_picture(path, file, max_pixels, (first, last))
    except PhotoError:
        raise
    except Exception as error:  # noqa: BLE001 - Pillow's decoders raise anything on damaged files.
        # A decoder may have put an error of its own in place of what ended it.
        if tell.ended_by is not None:
            raise tell.ended_by from None
        raise _refusal(path, error, max_pixels) from None


def _refusal(path: Path, error: Exception, max_pixels: int) -> PhotoError:
    """Say why a file cannot be read."""
    from PIL import Image

    shown = one_line(str(path))
    # Of a format that looks at the size on opening.
    if isinstance(error, Image.DecompressionBombError):
        return PhotoError(f"{shown} has more than {_allowed(max_pixels)}")
    if isinstance(error, MemoryError):
        return PhotoError(f"{shown} cannot be read: there is too little memory for it.")
    reason = error.strerror if isinstance(error, OSError) else None
    return PhotoError(f"{shown} cannot be read: {reason or _damaged(error)}.")


@contextmanager
def _pillow_ready(max_pixels: int) -> Iterator[None]:
    """Have our limit in place of Pillow's, and no complaints about oddities in a readable file.

    These are global, to Pillow and to Python: one photo at a time may change them, and all is as
    it was when it has been read.
    """
    from PIL import Image

    # Without any handler an error that Pillow logs would be printed.
    log, handler = logging.getLogger("PIL"), logging.NullHandler()
    with _pillow_lock, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        log.addHandler(handler)
        pillows = Image.MAX_IMAGE_PIXELS
        # Pillow refuses a picture of more than twice this many, and so hardly less than we do.
        Image.MAX_IMAGE_PIXELS = (max_pixels + 1) // 2
        try:
            yield
        finally:
            Image.MAX_IMAGE_PIXELS = pillows
            log.removeHandler(handler)


def _check_file(path: Path, max_pixels: int) -> None:
    """Refuse what is no file with something in it: opening a pipe could wait for ever."""
    shown = one_line(str(path))
    try:
        status = path.stat()
    except ValueError as error:  # a name that no file can have
        raise PhotoError(f"{shown} cannot be read: {error}.") from None
    if stat.S_ISDIR(status.st_mode):
        raise PhotoError(f"{shown} is a folder, not a photo.")
    if not stat.S_ISREG(status.st_mode):
        raise PhotoError(f"{shown} is a device, pipe or socket, not a photo.")
    if status.st_size == 0:
        raise PhotoError(f"{shown} is an empty file, not a photo.")
    # Some decoders take a file into memory as a whole.
    largest = _BYTES_A_PIXEL * max_pixels + _BYTES_OF_NOTES
    if status.st_size > largest:
        raise PhotoError(
            f"{shown} has {status.st_size:,} bytes; allowed for a photo of at most "
            f"{_count(max_pixels)} pixels: up to {largest:,}."
        )


def _first_picture(
    path: Path, file: WatchedFile, max_pixels: int, shares: tuple[float, float]
) -> "ImageFile":
    """Open the file's first picture, and check its size before anything of it is decoded."""
    shown, size = one_line(str(path)), os.fstat(file.fileno()).st_size
    name, factory = format_and_factory(path, file)
    check_file_size(path, name, size)
    file.seek(0, os.SEEK_SET)
    file.watch(size, *shares)
    try:
        picture = factory(file)
    except SyntaxError as error:  # Pillow's word for a header that makes no sense to it
        problem = _damaged(error, "the file is damaged or of an unusual kind")
        raise PhotoError(f"{shown} cannot be read: {problem}.") from None
    width, height = picture.size
    if width * height > max_pixels:
        raise PhotoError(
            f"{shown} has {width:,} x {height:,} pixels, {_count(width * height)}; "
            f"allowed: at most {_allowed(max_pixels)}"
        )
    # A size that is wrong in the header would otherwise be read, in seconds, as so much black.
    if width * height > _PIXELS_A_BYTE.get(picture.format or "", math.inf) * size:
        raise PhotoError(
            f"{shown} cannot be read: the file is damaged ({size:,} bytes cannot hold "
            f"{width:,} x {height:,} pixels)."
        )
    if picture.format == "TIFF":
        _check_tiff(shown, picture)
    check_decoder(path, picture, size)
    check_memory(path, picture, file.total, file.last)
    return picture


def _check_tiff(shown: str, picture: "ImageFile") -> None:
    """Refuse what Pillow would read as something else without a word."""
    from PIL.TiffImagePlugin import BITSPERSAMPLE, PLANAR_CONFIGURATION, TiffImageFile

    if not _is_covered(picture):
        raise PhotoError(f"{shown} cannot be read: the file is damaged (parts are missing).")
    tags = picture.tag_v2 if isinstance(picture, TiffImageFile) else {}
    bits = tags.get(BITSPERSAMPLE, (1,))
    if tags.get(PLANAR_CONFIGURATION) == 2 and len(bits) > 1 and max(bits) > 8:
        raise PhotoError(
            f"{shown} cannot be read: it keeps each colour of {max(bits)} bits in a plane of "
            "its own; allowed: pixel by pixel."
        )


def _is_covered(picture: "ImageFile") -> bool:
    """Whether the tiles of a TIFF, which lie on it before it is turned, reach its far corner."""
    corners = [tile[1][2:] for tile in picture.tile if tile[1] is not None]
    reach = [max((corner[axis] for corner in corners), default=0) for axis in (0, 1)]
    return reach[0] * reach[1] >= picture.width * picture.height


def _damaged(error: Exception, problem: str = "the file is damaged") -> str:
    """Write what a decoder says, which may quote the file's bytes, as part of a sentence."""
    words = re.sub(r"\s+", " ", "".join(c if c.isprintable() else " " for c in str(error)))
    words = words.strip().rstrip(".")[:120]
    return f"{problem} ({words})" if words else problem


def _allowed(max_pixels: int) -> str:
    return f"{_count(max_pixels)}; raise max_pixels to read it."


def _count(pixels: int) -> str:
    """Write a number of pixels, in millions if hundredths of them say it."""
    if pixels >= 1_000_000 and pixels % 10_000 == 0:
        return f"{pixels / 1e6:,.10g} million"
    return f"{pixels:,}"
