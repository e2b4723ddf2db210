"""Read a photograph as a grey image whose columns are the scan axis."""

import warnings
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.photometry import WHITE
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import ParameterError, PhotoError

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

SCAN_AXES = ("auto", "columns", "lines")
"""Which axis of the file the rolling shutter scanned; ``"auto"`` takes the one with stripes."""

_EXPOSURE_TIME, _F_NUMBER, _ISO = 0x829A, 0x829D, 0x8827
_EXIF_IFD = 0x8769


@dataclass(frozen=True, eq=False, slots=True)
class Photo:
    """A photograph.

    Parameters
    ----------
    path
        The file.
    image : ndarray of uint8, shape (rows, columns)
        Luma, columns being the scan axis.
    profile : ndarray of float64, shape (columns,)
        Mean of each column in grey levels.
    turned
        Whether the file's lines became the columns.
    exposure_time, f_number, iso
        What the camera noted, in SI units, None where it noted nothing.
    """

    path: Path
    image: ByteArray
    profile: FloatArray
    turned: bool
    exposure_time: float | None = None
    f_number: float | None = None
    iso: float | None = None


def load_photo(path: str | Path, scan_axis: str = "auto") -> Photo:
    """Read a photograph.

    Parameters
    ----------
    path
        An image file that Pillow reads. Its EXIF orientation is obeyed; colours become luma, 16
        bits become 8, transparent parts black.
    scan_axis
        ``"columns"`` or ``"lines"`` of the file, or ``"auto"``.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        There is no such file, it may not be read, or it is no complete image of reasonable size.
    ParameterError
        ``scan_axis`` is none of these words.
    """
    if scan_axis not in SCAN_AXES:
        raise ParameterError(f"scan_axis is {scan_axis!r}; allowed: {', '.join(SCAN_AXES)}.")
    try:
        path = Path(path)
    except TypeError:
        raise PhotoError(f"{path!r} is not the path of a photo; allowed: str or Path.") from None
    grey, notes = _read(path)
    turned = scan_axis == "lines" or (scan_axis == "auto" and _stripes_are_lines(grey))
    image = np.ascontiguousarray(grey.T if turned else grey)
    return Photo(path, image, image.mean(axis=0), turned, **notes)


def _read(path: Path) -> tuple[ByteArray, dict[str, float | None]]:
    # Pillow is slow to import, and only needed when a photo is really opened.
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        if path.is_dir():
            raise PhotoError(f"{path} is a folder, not a photo.")
        _read_heic_too()
        with warnings.catch_warnings():
            # Of oddities in a file that can be read all the same; its size is checked below.
            warnings.simplefilter("ignore")
            with Image.open(path) as opened:
                if opened.width * opened.height > MAX_PIXELS:
                    raise _too_large(path)
                notes = _exif_notes(opened)
                upright = ImageOps.exif_transpose(opened)
                return _grey(upright), notes
    except PhotoError:
        raise
    except Image.DecompressionBombError:  # Pillow's own limit, above ours
        raise _too_large(path) from None
    except UnidentifiedImageError:
        raise PhotoError(f"{path} is not an image that can be read.") from None
    except OSError as error:
        reason = error.strerror or f"the file is damaged ({error})"
        raise PhotoError(f"{path} cannot be read: {reason}.") from None
    except Exception as error:  # noqa: BLE001 - Pillow's decoders raise anything on damaged files.
        raise PhotoError(f"{path} cannot be read: the file is damaged ({error}).") from None


def _read_heic_too() -> None:
    """Let Pillow read HEIC photos where the extra ``heic`` is installed."""
    with suppress(ImportError):
        from pillow_heif import register_heif_opener

        register_heif_opener()


def _too_large(path: Path) -> PhotoError:
    return PhotoError(f"{path} has more than {MAX_PIXELS // 1_000_000} million pixels.")


def _grey(picture: "PillowImage") -> ByteArray:
    """Turn a Pillow image of any mode into luma of 8 bits."""
    if picture.mode.startswith("I") or picture.mode == "F":
        values = np.asarray(picture, dtype=np.float64)
        # Whole numbers are of 16 bits, however dark the picture; others are grey levels.
        scale = 257.0 if picture.mode.startswith("I") else 1.0
        return to_bytes(np.nan_to_num(values / scale, nan=0.0, posinf=WHITE, neginf=0.0))
    if picture.has_transparency_data:
        from PIL import Image

        backed = Image.new("RGBA", picture.size, (0, 0, 0, 255))
        picture = Image.alpha_composite(backed, picture.convert("RGBA"))
    return np.array(picture.convert("L"), dtype=np.uint8)


def _exif_notes(picture: "PillowImage") -> dict[str, float | None]:
    exif = picture.getexif().get_ifd(_EXIF_IFD)
    return {
        "exposure_time": _positive(exif.get(_EXPOSURE_TIME)),
        "f_number": _positive(exif.get(_F_NUMBER)),
        "iso": _positive(exif.get(_ISO)),
    }


def _positive(value: Any) -> float | None:
    """Read a number that a camera noted, None for anything that is no positive number."""
    if isinstance(value, tuple):
        value = value[0] if value else None
    try:
        number = float(value)
    except (TypeError, ValueError, ZeroDivisionError):
        return None
    return number if 0.0 < number < np.inf else None


def _stripes_are_lines(grey: ByteArray) -> bool:
    """Whether the means of the lines differ more, from one to the next, than those of columns."""
    roughness = [
        float(np.abs(np.diff(grey.mean(axis=axis))).mean()) if grey.shape[1 - axis] > 1 else 0.0
        for axis in (0, 1)
    ]
    return roughness[1] > roughness[0]
