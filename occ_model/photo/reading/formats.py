"""Recognize the format of an image file by its first bytes."""

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, TypeAlias

from occ_model.errors import PhotoError, one_line
from occ_model.files.film_kinds import kind_of_film

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

    Factory: TypeAlias = Callable[[IO[bytes]], ImageFile]

_FORMATS = ("JPEG", "PNG", "TIFF", "WEBP", "BMP", "GIF", "PPM", "QOI", "JPEG2000", "AVIF")
"""The formats that are read. Pillow reads more, and starts other programs for some of them."""

_HEIC_BRANDS = (b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"hevm", b"hevs")
_ANY_HEIF_BRANDS = (b"mif1", b"msf1")


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
            # Pillow's own function for JPEG fails where the list of further pictures is damaged.
            return name, partial(_open, JpegImageFile if name == "JPEG" else factory)
    name = one_line(str(path))
    if kind_of_film(start) is not None:
        raise PhotoError(f"{name} is a film, not a photo; decode it as a film.")
    raise PhotoError(f"{name} is not an image that can be read.")


def _open(factory: "Callable[[IO[bytes], str], ImageFile]", file: IO[bytes]) -> "ImageFile":
    return factory(file, "")


def _is_heic(start: bytes) -> bool:
    if start[4:8] != b"ftyp":
        return False
    brand, others = start[8:12], start[12:]
    return brand in _HEIC_BRANDS or (brand in _ANY_HEIF_BRANDS and b"avif" not in others)


def _heic_factory(path: Path) -> "Factory":
    """Return the function that opens a HEIC photo, without a change of Pillow's global list."""
    try:
        from pillow_heif import HeifImageFile
    except ImportError:
        raise PhotoError(
            f"{one_line(str(path))} is a HEIC photo; to read it: pip install occ-explorer[heic]."
        ) from None
    factory: Factory = HeifImageFile
    return factory
