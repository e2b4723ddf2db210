"""Read a photo's EXIF data: exposure, focal length, camera and orientation."""

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from io import BytesIO
from typing import TYPE_CHECKING, Any

from PIL.ExifTags import IFD, Base

from occ_model.errors import ParameterError
from occ_model.photo.reading.tiff import has_short_tags
from occ_model.results.frame import ENHANCED
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.parameters.camera import DIAGONAL_35MM

if TYPE_CHECKING:
    from PIL.Image import Exif, Image as PillowImage

_UNITS = {2.0: 25.4e-3, 3.0: 1e-2, 4.0: 1e-3}
"""Length in metres of the unit of the sensor's resolution, by its tag's value."""

_SIDE_DIFFERENCE = 0.02  # fraction by which a pixel's sides may differ
_DECIMALS = 3  # largest number of decimals of a focal length in millimetres
_ISO_OR_MORE = 65535  # value of the oldest tag, of 16 bits, if the ISO speed is larger

_LONGEST_NAME = 60

_FIRST_TRANSPOSED = 5  # the first orientation in which the picture's columns are stored as lines


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class CameraNotes:
    """A photo's EXIF data; None for a value that is missing or out of range."""

    # exposure_time, f_number, iso, equivalent_focal_length: in SI units, within the range of the
    # scene's parameter of that name.
    exposure_time: float | None = None
    f_number: float | None = None
    iso: float | None = None
    camera: str | None = None
    equivalent_focal_length: float | None = None
    focal_length_step: float = 0.0  # rounding step of the equivalent focal length in metres
    enhancement: str | None = None  # enhancement of a picture that this program's receiver saved


def camera_notes(picture: "PillowImage") -> CameraNotes:
    """Read a picture's EXIF tags (CIPA DC-008).

    If the exposure time or the f-number is missing, its APEX value is used.
    """
    # A picture can be read although its tags are damaged.
    tags: dict[int, Any] = {}
    title = ""
    with suppress(Exception):
        exif = _exif_of(picture)
        tags = dict(exif)
        title = _text(picture.info.get("Description") or tags.get(Base.ImageDescription))
        tags |= exif.get_ifd(IFD.Exif)
    enhancement = title.removeprefix(ENHANCED) if title.startswith(ENHANCED) else None
    return replace(notes_of(tags), enhancement=enhancement)


def notes_of(tags: Mapping[int, Any]) -> CameraNotes:
    """Return the camera's notes from the values of EXIF tags, by the tags' numbers."""
    focal_length, step = _focal_length(tags)
    return CameraNotes(
        exposure_time=_check_range("exposure_time", _number(tags.get(Base.ExposureTime)))
        or _check_range("exposure_time", _power_of_two(tags.get(Base.ShutterSpeedValue), -1.0)),
        f_number=_check_range("f_number", _number(tags.get(Base.FNumber)))
        or _check_range("f_number", _power_of_two(tags.get(Base.ApertureValue), 0.5)),
        iso=_iso(tags),
        camera=_camera(_text(tags.get(Base.Make)), _text(tags.get(Base.Model))),
        equivalent_focal_length=focal_length,
        focal_length_step=step,
    )


def orientation_of(picture: "PillowImage") -> int:
    """Return the EXIF orientation, 1 to 8, that the decoder has not applied."""
    orientation: object = 1
    with suppress(Exception):
        orientation = _exif_of(picture).get(Base.Orientation)
    return orientation if isinstance(orientation, int) and 1 <= orientation <= 8 else 1


def _exif_of(picture: "PillowImage") -> "Exif":
    """Return a picture's EXIF data, or none if a tag has too many numbers."""
    from PIL.Image import Exif

    block = picture.info.get("exif")
    if isinstance(block, bytes) and not has_short_tags(BytesIO(block.removeprefix(b"Exif\0\0"))):
        return Exif()
    return picture.getexif()


def turns_of(orientation: int) -> tuple[bool, bool, bool]:
    """Return whether to transpose a picture, and then to mirror its rows and its columns."""
    mirror_rows = orientation in (3, 4, 7, 8)
    mirror_columns = orientation in (2, 3, 6, 7)
    return orientation >= _FIRST_TRANSPOSED, mirror_rows, mirror_columns


def _focal_length(tags: Mapping[int, Any]) -> tuple[float | None, float]:
    """Return the equivalent focal length and its step, as noted or by the sensor's size."""
    noted = _number(tags.get(Base.FocalLengthIn35mmFilm))
    if noted and (equivalent := _check_range("equivalent_focal_length", noted / 1e3)):
        return equivalent, 1e-3
    focal_length, diagonal = _number(tags.get(Base.FocalLength)), _sensor_diagonal(tags)
    if focal_length is None or diagonal is None or not math.isfinite(focal_length):
        return None, 0.0
    steps = [10.0**-n for n in range(_DECIMALS + 1)]
    exact_steps = [
        step
        for step in steps
        if math.isclose(focal_length / step, round(focal_length / step), abs_tol=1e-6)
    ]
    scale = 1e-3 * DIAGONAL_35MM / diagonal
    equivalent = _check_range("equivalent_focal_length", focal_length * scale)
    return equivalent, 0.0 if equivalent is None else max([*exact_steps, steps[-1]]) * scale


def _sensor_diagonal(tags: Mapping[int, Any]) -> float | None:
    """Return the sensor's diagonal in metres, by its pixels and its resolution."""
    unit = _UNITS.get(_number(tags.get(Base.FocalPlaneResolutionUnit, 2)) or 0.0)
    width, height, horizontal, vertical = (
        _number(tags.get(tag)) or 0.0 for tag in (
            Base.ExifImageWidth, Base.ExifImageHeight,
            Base.FocalPlaneXResolution, Base.FocalPlaneYResolution,
        )
    )  # fmt: skip
    is_sensible = min(width, height) >= 1.0 and 0.0 < horizontal < math.inf
    if (
        unit is None
        or not is_sensible
        or not math.isclose(horizontal, vertical, rel_tol=_SIDE_DIFFERENCE)
    ):
        return None
    return math.hypot(width, height) / horizontal * unit


def _iso(tags: Mapping[int, Any]) -> float | None:
    noted = _check_range("iso", _number(tags.get(Base.ISOSpeedRatings)))
    if noted is not None and noted != _ISO_OR_MORE:
        return noted
    others = Base.ISOSpeed, Base.RecommendedExposureIndex, Base.StandardOutputSensitivity
    for tag in others:
        speed = _check_range("iso", _number(tags.get(tag)))
        if speed is not None:
            return speed
    return noted


def _check_range(name: str, number: float | None) -> float | None:
    if number is None:
        return None
    try:
        return float(PARAMETERS[name].check(number))
    except ParameterError:
        return None


def _number(value: Any) -> float | None:
    """Read a number, or the first of several, as a float; None for anything else."""
    if isinstance(value, tuple):
        value = value[0] if value else None
    if value is None or isinstance(value, str | bytes):
        return None
    try:
        return float(value)
    except (TypeError, ValueError, ArithmeticError):
        return None


def _power_of_two(apex: Any, rate: float) -> float | None:
    """Convert an APEX value A to 2^(rate A), see CIPA DC-008, annex C."""
    number = _number(apex)
    if number is None:
        return None
    try:
        return math.pow(2.0, rate * number)
    except (OverflowError, ValueError):
        return None


def _text(value: Any) -> str:
    """Read a text as one line of printable characters of bounded length, empty for no text."""
    if not isinstance(value, str):
        return ""
    # A NUL ends a text.
    start = value.split("\0", 1)[0][: 8 * _LONGEST_NAME]
    line = " ".join("".join(c if c.isprintable() else " " for c in start).split())
    return line[:_LONGEST_NAME].strip()


def _camera(make: str, model: str) -> str | None:
    first_word = make.split(" ", 1)[0].casefold()
    if first_word and model.casefold().startswith(first_word):
        return model
    return f"{make} {model}"[:_LONGEST_NAME].strip() or None
