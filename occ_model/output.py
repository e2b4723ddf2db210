"""Results to files: complete or not at all."""

import stat
from io import BytesIO
from pathlib import Path
from secrets import token_hex

from occ_model.arrays import ByteArray
from occ_model.errors import OutputError

_FORMATS = {
    ".png": "PNG",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
    ".tif": "TIFF",
    ".tiff": "TIFF",
    ".webp": "WEBP",
    ".bmp": "BMP",
}
"""The image formats that are written, by the file's ending: those that hold any grey picture."""

PICTURE_ENDINGS = tuple(_FORMATS)
"""The endings of the files that pictures are written to."""

LONGEST_SIDE = {"JPEG": 65_500, "WEBP": 16_383}
"""Pixels that a format's encoder takes a side; libjpeg's limit is below the format's own."""


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there complete or not at all.

    A symbolic link is followed, and a file that is there keeps its permissions.

    Raises
    ------
    OutputError
        It cannot be written, or is no regular file; what was there before is untouched.
    """
    try:
        permissions = _permissions_of(path)
        _replace(path.resolve(), content, permissions)
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from None


def write_image(path: Path, image: ByteArray) -> None:
    """Write a grey image in the format that the file's ending names.

    Raises
    ------
    OutputError
        The ending names no image format, the format does not hold an image of that size, or the
        file cannot be written.
    """
    write_whole(path, _encoded(path, image))


def _permissions_of(path: Path) -> int | None:
    """Give the permissions of a file that may be replaced, None where there is none yet."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise OutputError(f"{path} is a folder; name a file to write to.")
    if not stat.S_ISREG(mode):
        raise OutputError(f"{path} is a device, pipe or socket; name a regular file to write to.")
    return stat.S_IMODE(mode)


def _replace(path: Path, content: bytes, permissions: int | None) -> None:
    """Put a file in the place of another in one step."""
    temporary = path.with_name(f".{path.name}.{token_hex(4)}")
    temporary.touch(exist_ok=False)  # with the permissions that new files get
    try:
        temporary.write_bytes(content)
        if permissions is not None:
            temporary.chmod(permissions)
        temporary.replace(path)
    except BaseException:  # whatever happens, nothing half-written stays
        temporary.unlink(missing_ok=True)
        raise


def _encoded(path: Path, image: ByteArray) -> bytes:
    format_name = _FORMATS.get(path.suffix.lower())
    if format_name is None:
        *endings, last = PICTURE_ENDINGS
        raise OutputError(
            f"{path.name} has no ending of an image format; use {', '.join(endings)} or {last}."
        )
    longest = LONGEST_SIDE.get(format_name)
    if longest is not None and max(image.shape) > longest:
        raise OutputError(
            f"{path.name} cannot be encoded as {format_name}: the picture has "
            f"{image.shape[1]:,} x {image.shape[0]:,} pixels; allowed: at most {longest:,} a side."
        )
    # Pillow is slow to import, and only needed when a file is really written.
    from PIL import Image

    buffer = BytesIO()
    try:
        Image.fromarray(image).save(buffer, format=format_name)
    except (OSError, ValueError) as error:
        raise OutputError(f"{path.name} cannot be encoded as {format_name}: {error}.") from None
    return buffer.getvalue()


def make_folder(folder: Path) -> None:
    """Make the folder that figures are written to, where there is none.

    Raises
    ------
    OutputError
        It cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder} cannot be made: {error.strerror or error}.") from None
