"""Read a photograph: the samples of one channel, with the columns as scan axis."""

import math
from collections.abc import Sequence
from dataclasses import asdict, astuple, dataclass, replace
from pathlib import Path
from typing import TypeAlias, cast

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_arrays import Samples, samples_of, white_of
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import ParameterError, PhotoError, quote
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.exif import CameraNotes, camera_notes, turns_of
from occ_model.photo.reading.file import open_file, open_picture
from occ_model.photo.reading.image_decoding import (
    DECODED_FRACTION,
    DecodedPicture,
    take_channel,
)
from occ_model.photo.reading.raw import is_raw, read_mosaic
from occ_model.photo.reading.transfer import is_linear_picture
from occ_model.photo.reading.watched_file import Progress, Reporter
from occ_model.results.decoding import Region
from occ_model.scene.argument_checks import check_choice, check_count

__all__ = ["CHANNELS", "Photo", "column_means", "load_photo"]

_USUAL_FRACTION = 0.97
"""Fraction of the smallest differences between neighbours, which are not at a panel's edges."""

_STRIP_PIXELS, _MOST_STRIPS = 8, 240  # lines or columns of a strip, and how many at most

Corners: TypeAlias = Region | Sequence[int]
"""A Region, or first row, row after the last, first column, column after the last."""


@dataclass(frozen=True, eq=False, slots=True)
class Photo(CameraNotes):
    """A photograph.

    Parameters
    ----------
    path
        The file.
    samples : ndarray of uint8 or uint16, shape (rows, columns)
        One channel in the full depth of the file, with the columns as scan axis. Other types that
        :func:`occ_model.decode` accepts are converted.
    white
        The sample value of white: 255 or 65535.
    image : ndarray of uint8, shape (rows, columns)
        The samples in whole grey levels; the same array if they have 8 bits.
    profile : ndarray of float64, shape (columns,)
        Mean of each column's samples in grey levels.
    turned
        Whether the file's lines became the columns.
    channel
        ``"red"``, ``"green"``, ``"blue"``, ``"luma"``, or ``"grey"`` for a photo without colours.
    exposure_time, f_number, iso
        From the EXIF data, in SI units; None if missing or out of range.
    camera
        The camera's maker and model; None if both are missing.
    is_linear
        Whether the samples are in proportion to the light: those of a RAW file, and of a picture
        whose colour profile or gamma says so.
    equivalent_focal_length, focal_length_step
        From the EXIF data in metres, None if missing, and its rounding step in metres.
    enhancement
        The enhancement noted in a picture that this program's receiver saved; None for others.
    """

    path: Path
    samples: Samples
    white: int
    image: ByteArray
    profile: FloatArray
    turned: bool
    channel: str
    is_linear: bool = False

    def __post_init__(self) -> None:
        values = np.asarray(self.samples)
        object.__setattr__(self, "samples", samples_of(values, "The photo"))
        if values.dtype.kind == "f":
            object.__setattr__(self, "white", int(white_of(self.samples)))


def load_photo(
    path: str | Path,
    scan_axis: str = "auto",
    *,
    channel: str = "brightest",
    max_pixels: int = MAX_PIXELS,
    progress: Progress | None = None,
) -> Photo:
    """Read a photograph.

    Parameters
    ----------
    path
        An image file of one of the formats in :mod:`occ_model.photo.reading.file`, of which the
        first picture is read. Its EXIF orientation is applied, transparent parts are black, and
        floating-point samples are fractions of white or grey levels by the rule of
        :func:`occ_model.decode`. For a camera's RAW file the green photosites are read; see
        :mod:`occ_model.photo.reading.raw`.
    scan_axis
        ``"columns"`` or ``"lines"`` of the file, or ``"auto"``.
    channel
        ``"red"``, ``"green"``, ``"blue"``, ``"luma"``, or ``"brightest"``, by its mean.
    max_pixels
        Largest number of pixels. Some formats allow fewer, as the memory is limited, too.
    progress
        Called with the fraction of the work that is done, from 0 to 1. An exception from it cancels
        the reading; that of JPEG 2000, WebP, AVIF, HEIC, RAW, compressed TIFF and colours of 16
        bits only after decoding.

    Raises
    ------
    PhotoError
        There is no such file, it may not be read, or it is not a complete image of allowed size.
    ParameterError
        ``scan_axis`` or ``channel`` is none of these words, or ``max_pixels`` is below 1.
    """
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    check_choice("channel", channel, CHANNELS)
    check_count("max_pixels", max_pixels, 1)
    file, largest = _check_path(path), int(max_pixels)
    report = Reporter(progress)
    report(0.0)
    with open_file(file, largest, report) as opened:
        if is_raw(opened):
            is_linear = True
            mosaic = read_mosaic(file, opened, channel, largest, report)
            notes, orientation, channel_name = mosaic.notes, mosaic.orientation, mosaic.channel
            turned = _is_turned(mosaic.one_plane(), orientation, scan_axis)
            samples = mosaic.samples(along_lines=turned != turns_of(orientation)[0])
        else:
            decoded = DecodedPicture(open_picture(file, opened, largest, DECODED_FRACTION))
            notes, orientation = camera_notes(decoded.picture), decoded.orientation
            is_linear = is_linear_picture(decoded.picture)
            samples, channel_name = take_channel(
                decoded,
                channel,
                lambda fraction: report(DECODED_FRACTION + (1.0 - DECODED_FRACTION) * fraction),
            )
            turned = _is_turned(samples, orientation, scan_axis)
    samples = turn_upright(samples, orientation, turned)
    white = int(white_of(samples))
    return Photo(
        path=file,
        samples=samples,
        white=white,
        image=in_grey_levels(samples),
        profile=means_along(samples, 0) * (WHITE / white),
        turned=turned,
        channel=channel_name,
        is_linear=is_linear,
        **asdict(notes),
    )


def _check_path(path: str | Path) -> Path:
    try:
        return Path(path)
    except TypeError:
        raise PhotoError(
            f"{quote(path)} is not the path of a photo; allowed: str or Path."
        ) from None


def column_means(photo: Photo, first_row: int, last_row: int) -> FloatArray:
    """Average each column over rows before ``last_row``, in grey levels with the file's depth."""
    return means_along(photo.samples[first_row:last_row], 0) * (WHITE / photo.white)


def _is_turned(samples: Samples, orientation: int, scan_axis: str) -> bool:
    transposed, _, _ = turns_of(orientation)
    return scan_axis == "lines" or (scan_axis == "auto" and stripes_are_lines(samples, transposed))


def turn_upright(samples: Samples, orientation: int, turned: bool) -> Samples:
    """Turn samples upright, and then make the scan axis the columns."""
    transpose, mirror_rows, mirror_columns = turns_of(orientation)
    if turned:
        transpose, mirror_rows, mirror_columns = not transpose, mirror_columns, mirror_rows
    # Each step frees the array before it.
    if transpose:
        samples = cast("Samples", cv2.transpose(samples))
    if mirror_rows:
        samples = cast("Samples", cv2.flip(samples, 0))
    if mirror_columns:
        samples = cast("Samples", cv2.flip(samples, 1))
    return samples


def in_grey_levels(samples: Samples) -> ByteArray:
    if samples.dtype == np.uint8:
        return np.asarray(samples, dtype=np.uint8)  # the same array
    return np.asarray(cv2.convertScaleAbs(samples, alpha=WHITE / white_of(samples)), np.uint8)


def stripes_are_lines(samples: Samples, transposed: bool) -> bool:
    """Return whether the means of neighbouring lines differ more than those of columns.

    The means of the whole photo show faint bars, those of strips of it show small lamps. Lines and
    columns are those of the upright photo; ``samples`` may be ``transposed``.
    """
    axes = (1, 0) if transposed else (0, 1)
    columns, lines = (
        roughness_along(samples, axis) * _shared_steps(samples, axis) for axis in axes
    )
    return lines > columns


def _shared_steps(samples: Samples, axis: int) -> float:
    """Return the root sum of squares of the steps in strips of pixels that the next strip shares.

    The steps of noise differ from strip to strip, and so add nothing.
    """
    count = max(1, min(samples.shape[axis] // _STRIP_PIXELS, _MOST_STRIPS))
    shape = (samples.shape[1], count) if axis == 0 else (count, samples.shape[0])
    means = cv2.resize(samples, shape, interpolation=cv2.INTER_AREA).astype(np.float32)
    steps = np.diff(means if axis == 0 else means.T, axis=1)
    shared = np.vdot(steps[1:], steps[:-1]) if count > 1 else np.vdot(steps, steps)
    return math.sqrt(max(float(shared), 0.0))


def roughness_along(samples: Samples | ByteArray, axis: int) -> float:
    """Return the mean difference of neighbouring means, without those at a panel's edges."""
    means = means_along(samples, axis)
    steps = np.sort(np.abs(np.diff(means)))
    usual = steps[: math.ceil(_USUAL_FRACTION * len(steps))]
    return float(usual.mean()) if usual.size else 0.0


def means_along(samples: Samples | ByteArray, axis: int) -> FloatArray:
    """Average samples along an axis, much faster than NumPy."""
    sums = cv2.reduce(samples, axis, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
    means: FloatArray = np.asarray(sums, dtype=np.float64).ravel() / samples.shape[axis]
    return means


def region_within(photo: Photo, corners: Corners | None) -> Region:
    """Return a rectangle of a photo, the whole of it for None, and refuse any other."""
    rows, columns = photo.samples.shape
    if corners is None:
        return Region(0, rows, 0, columns)
    region = corners if isinstance(corners, Region) else _region_of(corners)
    if region is not None:
        has_rows = 0 <= region.first_row < region.last_row <= rows
        has_columns = 0 <= region.first_column < region.last_column <= columns
        if has_rows and has_columns:
            return region
    raise ParameterError.of(
        "region",
        quote(astuple(corners) if isinstance(corners, Region) else corners),
        "first row, row after the last, first column, column after the last, of at least one row "
        f"and column, up to {rows} and {columns}",
    )


def _region_of(corners: Sequence[int]) -> Region | None:
    try:
        numbers = [int(number) for number in corners if number == int(number)]
        return Region(*numbers) if len(numbers) == len(corners) else None
    except (TypeError, ValueError, OverflowError):
        return None


def part_of(photo: Photo, region: Region) -> Photo:
    """Cut a rectangle out of a photo; its pixels are views of the photo's, not copies."""
    part = replace(photo, samples=region.crop(photo.samples), image=region.crop(photo.image))
    return replace(part, profile=column_means(part, 0, region.rows))
