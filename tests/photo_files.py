"""Write pictures to files of every format that photos come in."""

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from PIL.ExifTags import IFD, Base

STRIPES = np.tile(np.repeat([30, 220, 90, 160], 12).astype(np.uint8), (32, 1))
PICTURE = Image.fromarray(STRIPES)


def save(folder: Path, picture: Image.Image | np.ndarray, name: str = "x.png", **how: Any) -> Path:
    """Write a picture in the format of its name's ending."""
    picture = Image.fromarray(picture) if isinstance(picture, np.ndarray) else picture
    if name.endswith(".heic"):
        # Not registered with Pillow, whose list of formats the loader may not use.
        from pillow_heif import from_pillow

        exif = how.pop("exif", None)
        notes = {"exif": exif.tobytes()} if isinstance(exif, Image.Exif) else {}
        from_pillow(picture).save(folder / name, **notes, **how)
    else:
        picture.save(folder / name, **how)
    return folder / name


def png(
    width: int,
    height: int,
    *,
    bits: int = 8,
    colours: int = 0,
    more: bytes = b"",
    data: bytes = zlib.compress(bytes(1000)),
) -> bytes:
    """Return a PNG of this size by its header, with more chunks before its compressed data."""
    header = struct.pack(">IIBBBBB", width, height, bits, colours, 0, 0, 0)
    head, tail = png_chunk(b"IHDR", header) + more, png_chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + head + png_chunk(b"IDAT", data) + tail


def png_chunk(name: bytes, content: bytes) -> bytes:
    check = zlib.crc32(name + content)
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)


def save_as_taken(path: Path, image: np.ndarray, **noted: float) -> Path:
    """Write a picture as a camera does, with the focal length or exposure time that it notes."""
    notes = Image.Exif()
    known = {"focal_length": Base.FocalLengthIn35mmFilm, "exposure_time": Base.ExposureTime}
    notes.get_ifd(IFD.Exif).update({known[name]: value for name, value in noted.items()})
    Image.fromarray(image).save(path, quality=92, exif=notes.tobytes())
    return path
