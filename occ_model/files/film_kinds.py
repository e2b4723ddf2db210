"""Recognize the kind of a film's file by its first bytes, never by its name.

FFmpeg also opens playlists and lists of files, which name further files and network addresses. Only
files that contain their own pictures are therefore passed to it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from occ_model.errors import SceneFileError, VideoError, one_line
from occ_model.files.reading import BoundedFile, read_start


@dataclass(frozen=True, slots=True)
class Container:
    name: str
    reader: Literal["opencv", "pillow"]  # OpenCV with its FFmpeg, or Pillow
    # The frames' times are multiples of this, in seconds; None if each file has its own step
    time_step: float | None = None
    # Whether it states its number of frames, which is otherwise estimated from the duration
    states_frame_count: bool = True


_MP4 = Container("MP4 or MOV", "opencv")
_AVI = Container("AVI", "opencv")
_MATROSKA = Container("MKV or WebM", "opencv", 1e-3, states_frame_count=False)
_GIF = Container("GIF", "pillow", 1e-2)
_PNG = Container("animated PNG", "pillow")

_BOXES = (b"ftyp", b"moov", b"mdat", b"wide", b"free", b"skip", b"pnot")  # the first in MP4 and MOV
FIRST_BYTES = 16  # number of bytes that identify the kind


def container_of(path: Path, start: bytes) -> Container:
    kind = kind_of_film(start)
    if kind is not None:
        return kind
    raise VideoError(
        f"{one_line(str(path))} is not a film that can be read; allowed: MP4, MOV, AVI, MKV, WebM, "
        "GIF and animated PNG."
    )


def kind_of_film(start: bytes) -> Container | None:
    """Recognize a film by the first bytes of its file; None if it is not a film."""
    if start[4:8] in _BOXES:
        return _MP4
    if start[:4] == b"RIFF" and start[8:12] == b"AVI ":
        return _AVI
    if start[:4] == b"\x1aE\xdf\xa3":
        return _MATROSKA
    if start[:6] in (b"GIF87a", b"GIF89a"):
        return _GIF
    if start[:8] == b"\x89PNG\r\n\x1a\n":
        return _PNG
    return None


HEIC_BRANDS = (b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"hevm", b"hevs")
HEIF_BRANDS = (b"mif1", b"msf1")  # common to HEIC and AVIF
_PICTURES = (*HEIC_BRANDS, *HEIF_BRANDS, b"avif", b"avis", b"crx ")  # the last one is Canon's CR3


def is_film(path: Path) -> bool:
    """Return whether a file contains a film, by its content; it may still be unreadable.

    A GIF or PNG file of a single picture is not a film.
    """
    try:
        start = read_start(path, FIRST_BYTES)
    except SceneFileError:
        return False
    kind = kind_of_film(start)
    if kind is None:
        return False
    if kind.reader == "opencv":
        return not (start[4:8] == b"ftyp" and start[8:12] in _PICTURES)
    # Slow to import, and needed only for these.
    from PIL import Image

    try:
        with BoundedFile(path) as file, Image.open(file, formats=("GIF", "PNG")) as picture:
            return bool(getattr(picture, "is_animated", False))
    except Exception:  # noqa: BLE001 - opening it will state the error
        return False
