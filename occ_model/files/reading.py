"""Read the user's files if they are regular and of a bounded size, and recognize films.

FFmpeg also opens playlists and lists of files, which name further files and network addresses. Only
files that contain their own pictures are therefore passed to it.
"""

import errno
import io
import os
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from occ_model.errors import SceneFileError, VideoError, one_line

LARGEST_TEXT = 1_000_000  # bytes of a scene, preset or lesson; usual ones have a few thousand

MOST_READS = 1_000_000  # reads by a file's decoder, which take a few seconds in Python
MOST_BYTES_ONE_BY_ONE = 4_000_000  # largest file that a decoder may read byte by byte, as for QOI

_NOT_REGULAR = "it is a device, pipe or socket"

# A system without a flag does not need it; for example, Windows has no pipes among its files.
_FLAGS = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_NOCTTY", 0)
    | getattr(os, "O_BINARY", 0)
)


def read_bytes(path: Path, largest: int) -> bytes:
    """Read a regular file of at most ``largest`` bytes.

    Pipes are not waited for and devices are not read. The kind is checked after opening, so that
    the file cannot be replaced in between.
    """
    content = read_start(path, largest + 1)
    if len(content) > largest:
        raise _refuse(path, f"it has more than {largest:,} bytes")
    return content


def read_start(path: Path, count: int) -> bytes:
    """Read the first bytes of a regular file, with the checks of :func:`read_bytes`."""
    try:
        descriptor = os.open(path, _FLAGS)
    except OSError as error:
        raise _refuse_error(path, error) from None
    except ValueError as error:  # an impossible name
        raise _refuse(path, reason_of(error)) from None
    try:
        _check_kind(path, os.fstat(descriptor).st_mode)
        chunks, remaining = [], count
        # A file may contain more or fewer bytes than its stated size.
        while remaining > 0 and (chunk := os.read(descriptor, remaining)):
            chunks.append(chunk)
            remaining -= len(chunk)
    except OSError as error:
        raise _refuse_error(path, error) from None
    finally:
        os.close(descriptor)
    return b"".join(chunks)


def read_text(path: Path, largest: int = LARGEST_TEXT) -> str:
    """Read a text file in UTF-8, without the byte order mark that some editors write."""
    try:
        return read_bytes(path, largest).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise _refuse(path, "it is not text in UTF-8") from None


class BoundedFile(io.BufferedReader):
    """A file that its decoder can read only in a limited number of steps.

    A decoder follows the blocks, chunks, segments or directories of a file, possibly without end,
    but each step is a read. Every read above the limit raises SceneFileError, because a decoder may
    suppress the first one.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path.open("rb", buffering=0))
        self._path, self._reads = path, 0
        size = os.fstat(self.fileno()).st_size
        self._most = max(size if size <= MOST_BYTES_ONE_BY_ONE else 0, MOST_READS)

    def read(self, size: int | None = -1, /) -> bytes:
        self._reads += 1
        if self._reads > self._most:
            raise _refuse(self._path, f"it is in more than {self._most:,} parts")
        return super().read(size)


def _check_kind(path: Path, mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise _refuse(path, "it is a folder")
    if not stat.S_ISREG(mode):
        raise _refuse(path, _NOT_REGULAR)


def _refuse_error(path: Path, error: OSError) -> SceneFileError:
    if error.errno == errno.ENXIO:  # a socket, or a missing device
        return _refuse(path, _NOT_REGULAR)
    return _refuse(path, reason_of(error))


def reason_of(error: OSError | ValueError) -> str:
    """Explain why a path cannot be opened; Python raises ValueError for impossible names."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return "no file can have this name"


def _refuse(path: Path, reason: str) -> SceneFileError:
    return SceneFileError(f"{one_line(str(path))} cannot be read: {one_line(reason)}.")


@dataclass(frozen=True, slots=True)
class Container:
    name: str
    reader: Literal["mov", "avi", "matroska", "pillow"]  # Pillow, or a demuxer of FFmpeg


_MP4 = Container("MP4 or MOV", "mov")
_AVI = Container("AVI", "avi")
_MATROSKA = Container("MKV or WebM", "matroska")
_GIF = Container("GIF", "pillow")
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
    if kind.reader != "pillow":
        return not (start[4:8] == b"ftyp" and start[8:12] in _PICTURES)
    # Slow to import, and needed only for these.
    from PIL import Image

    try:
        with BoundedFile(path) as file, Image.open(file, formats=("GIF", "PNG")) as picture:
            return bool(getattr(picture, "is_animated", False))
    except Exception:  # noqa: BLE001 - opening it will state the error
        return False
