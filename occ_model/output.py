"""Results to files: complete or not at all."""

import os
import tempfile
from io import BytesIO
from pathlib import Path

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


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there complete or not at all.

    Raises
    ------
    OutputError
        It cannot be written; a file that was there before is untouched.
    """
    temporary: Path | None = None
    try:
        if path.is_dir():
            raise OutputError(f"{path} is a folder; name a file to write to.")
        descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        temporary = Path(name)
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except BaseException as error:  # whatever happens, nothing half-written stays
        if temporary is not None:
            temporary.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise OutputError(f"{path} cannot be written: {error.strerror or error}.") from None
        raise


def write_image(path: Path, image: ByteArray) -> None:
    """Write a grey image in the format that the file's ending names.

    Raises
    ------
    OutputError
        The ending names no image format, or the file cannot be written.
    """
    write_whole(path, _encoded(path, image))


def _encoded(path: Path, image: ByteArray) -> bytes:
    format_name = _FORMATS.get(path.suffix.lower())
    if format_name is None:
        raise OutputError(
            f"{path.name} has no ending of an image format; use .png, .jpg, .tif, .webp or .bmp."
        )
    # Pillow is slow to import, and only needed when a file is really written.
    from PIL import Image

    buffer = BytesIO()
    try:
        Image.fromarray(image).save(buffer, format=format_name)
    except (OSError, ValueError) as error:
        raise OutputError(f"{path.name} cannot be encoded as {format_name}: {error}.") from None
    return buffer.getvalue()


def _umask() -> int:
    """Read the mask that new files get their permissions by; it can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
