"""Write files completely or not at all, lock them, and encode images by the file's ending."""

import os
import re
import stat
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from errno import EACCES, EAGAIN
from io import BytesIO
from pathlib import Path
from secrets import token_hex
from shutil import rmtree
from typing import Any, BinaryIO

from occ_model.arrays import ByteArray
from occ_model.errors import OutputError, one_line
from occ_model.files.reading import reason_of

if sys.platform == "win32":
    import msvcrt

    _FAR = 2**40
    """Position of the locked byte, beyond any file's end, so that others can read the file."""

    def take_lock(file: BinaryIO) -> None:
        place = file.tell()
        file.seek(_FAR)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        finally:
            file.seek(place)

else:
    import fcntl

    def take_lock(file: BinaryIO) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def lock(file: BinaryIO) -> bool | None:
    """Lock a file until it is closed.

    Return False if another process has locked it, None if the system has no locks.
    """
    try:
        take_lock(file)
    except OSError as error:
        return False if error.errno in (EACCES, EAGAIN) else None
    return True


_FORMATS = {  # formats that can contain any grey picture, by the file's ending
    ".png": "PNG",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
    ".tif": "TIFF",
    ".tiff": "TIFF",
    ".webp": "WEBP",
    ".bmp": "BMP",
}

PICTURE_ENDINGS = tuple(_FORMATS)  # endings of files to which pictures can be written

LONGEST_SIDE = {"JPEG": 65_500, "WEBP": 16_383}
"""Largest side in pixels that an encoder accepts; libjpeg's limit is below that of JPEG."""


def write_whole(path: Path, content: bytes, *, is_private: bool = False) -> None:
    """Write a file completely or not at all; follow links and keep permissions.

    ``is_private``: as for :func:`write_atomically`.
    """
    with write_atomically(path, is_private=is_private) as temporary:
        temporary.write_bytes(content)


def write_image(path: Path, image: ByteArray, description: str = "") -> None:
    """Write a grey image in the format of the file's ending.

    ``description`` becomes the text ``Description`` of a PNG file, the EXIF tag
    ``ImageDescription`` of other formats; BMP files contain no texts.
    """
    write_whole(path, _encode(path, image, description))


def format_of_image(path: Path) -> str:
    """Return the format of an image file by its ending; OutputError for any other ending."""
    return _FORMATS[check_ending(path, "an image format", PICTURE_ENDINGS)]


def check_ending(path: Path, kind: str, endings: Sequence[str]) -> str:
    """Return the ending of a path in lower case; OutputError unless a ``kind`` of file has it."""
    ending = path.suffix.lower()
    if ending not in endings:
        *others, last = endings
        allowed = f"{', '.join(others)} or {last}" if others else last
        raise OutputError(
            f"{one_line(path.name)} does not have the ending of {kind}; use {allowed}."
        )
    return ending


def check_replaceable(path: Path) -> int | None:
    """Refuse a path to which no file can be written; return the existing file's permissions."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        folder = path.resolve().parent
        if not folder.is_dir():
            raise OutputError(
                f"{one_line(str(path))} cannot be written: its folder does not exist; name one "
                "that does."
            ) from None
        if not os.access(folder, os.W_OK | os.X_OK):
            raise _refuse(path, PermissionError(EACCES, os.strerror(EACCES))) from None
        return None
    except (OSError, ValueError) as error:  # ValueError: an impossible path
        raise _refuse(path, error) from None
    name = one_line(str(path))
    if stat.S_ISDIR(mode):
        raise OutputError(f"{name} is a folder; name a file to write to.")
    if not stat.S_ISREG(mode):
        raise OutputError(f"{name} is a device, pipe or socket; name a regular file to write to.")
    # Write protection is respected even if the administrator may write to any file.
    if not mode & _ANY_WRITE or not os.access(path, os.W_OK):
        raise OutputError(f"{name} is write-protected; name another file, or allow writing to it.")
    return stat.S_IMODE(mode)


_PRIVATE = stat.S_IRUSR | stat.S_IWUSR

_ANY_WRITE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH


def _refuse(path: Path, error: OSError | ValueError) -> OutputError:
    return OutputError(f"{one_line(str(path))} cannot be written: {reason_of(error)}.")


@contextmanager
def write_atomically(path: Path, *, is_private: bool = False) -> Iterator[Path]:
    """Yield a temporary file in the same folder, which replaces the path unless an error is raised.

    ``is_private``: nobody else may read it, whatever the permissions of an existing file.
    """
    permissions = check_replaceable(path)
    target = path.resolve()
    temporary = _temporary_beside(target, path.suffix)
    try:
        temporary.touch(exist_ok=False)
        try:
            if is_private:
                permissions = _PRIVATE
            elif permissions is None:  # those of a new file, which follow the process's umask
                permissions = stat.S_IMODE(temporary.stat().st_mode)
            # Nobody else can read it before it is complete, even if the program is killed.
            make_private(temporary)
            yield temporary
            temporary.chmod(permissions)
            temporary.replace(target)
        except BaseException:  # leave no half-written file, whatever happens
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise _refuse(path, error) from None


_TEMPORARY = re.compile(r"\.occ-[0-9a-f]{16}(\..*)?")
_ABANDONED = 86_400.0  # seconds after which a temporary file is of a program that was killed


def _temporary_beside(target: Path, suffix: str) -> Path:
    """Return a new name in the folder of a path, and remove what killed programs left there."""
    for path in target.parent.glob(".occ-*"):
        with suppress(OSError):
            age = time.time() - path.lstat().st_mtime
            if _TEMPORARY.fullmatch(path.name) and age > _ABANDONED:
                if path.is_dir():
                    rmtree(path)
                else:
                    path.unlink()
    return target.with_name(f".occ-{token_hex(8)}{suffix}")


def write_folder(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Write files into a folder; one that is new appears only with all of them."""
    is_new = not folder.exists()
    make_folder(folder.parent if is_new else folder)
    target = _temporary_beside(folder.resolve(), "") if is_new else folder
    try:
        target.mkdir(exist_ok=not is_new)
        for name, content in contents.items():
            if is_new:  # an error of write_whole would name the temporary folder
                (target / name).write_bytes(content)
            else:
                write_whole(target / name, content)
        if is_new:
            target.replace(folder)
    except OSError as error:
        raise OutputError(f"{one_line(str(folder))} cannot be made: {reason_of(error)}.") from None
    finally:
        if is_new:
            rmtree(target, ignore_errors=True)


def _encode(path: Path, image: ByteArray, description: str) -> bytes:
    format_name = format_of_image(path)
    longest = LONGEST_SIDE.get(format_name)
    if longest is not None and max(image.shape) > longest:
        raise OutputError(
            f"{one_line(path.name)} cannot be encoded as {format_name}: the picture has "
            f"{image.shape[1]:,} x {image.shape[0]:,} pixels; allowed: at most {longest:,} a side."
        )
    # Pillow is slow to import, and needed only when a file is actually written.
    from PIL import Image

    buffer = BytesIO()
    try:
        notes = _notes(format_name, description) if description else {}
        Image.fromarray(image).save(buffer, format=format_name, **notes)
    except (OSError, ValueError) as error:
        raise OutputError(
            f"{one_line(path.name)} cannot be encoded as {format_name}: {error}."
        ) from None
    return buffer.getvalue()


def _notes(format_name: str, description: str) -> dict[str, Any]:
    if format_name == "PNG":
        from PIL.PngImagePlugin import PngInfo

        texts = PngInfo()
        texts.add_text("Description", description)
        return {"pnginfo": texts}
    if format_name == "BMP":
        return {}
    from PIL import ExifTags, Image

    exif = Image.Exif()
    exif[ExifTags.Base.ImageDescription] = description
    return {"exif": exif}


def make_folder(folder: Path, *, is_private: bool = False) -> None:
    """Create a folder unless it exists; ``is_private``: nobody else may open a new one."""
    try:
        folder.mkdir(mode=0o700 if is_private else 0o777, parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise OutputError(f"{one_line(str(folder))} cannot be made: {reason_of(error)}.") from None


def make_private(path: Path) -> None:
    """Let nobody else read or write a regular file, if the file system has permissions."""
    with suppress(OSError):
        if stat.S_ISREG(path.lstat().st_mode):
            path.chmod(_PRIVATE)
