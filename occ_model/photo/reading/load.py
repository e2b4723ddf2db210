"""Read a photograph as samples of one channel whose columns are the scan axis."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import ParameterError, PhotoError, shown
from occ_model.photo.reading.channels import CHANNELS, take_channel, white_of
from occ_model.photo.reading.decoding import DECODED, DecodedPicture, Samples
from occ_model.photo.reading.exif import CameraNotes, camera_notes, orientation_of, turns_of
from occ_model.photo.reading.file import open_picture
from occ_model.photo.reading.watched_file import Progress, Teller
from occ_model.scene.argument_checks import check_choice, check_count

__all__ = ["CHANNELS", "SCAN_AXES", "Photo", "column_means", "load_photo"]

_USUAL = 0.97
"""Share of the steps between neighbours that are not a panel's rims."""

SCAN_AXES = ("auto", "columns", "lines")
"""Which axis of the file the rolling shutter scanned; ``"auto"`` takes the one with stripes."""


@dataclass(frozen=True, eq=False, slots=True)
class Photo:
    """A photograph.

    Parameters
    ----------
    path
        The file.
    samples : ndarray of uint8 or uint16, shape (rows, columns)
        One channel in the full depth of the file, columns being the scan axis.
    white
        The sample value of white: 255 or 65535.
    image : ndarray of uint8, shape (rows, columns)
        The samples in whole grey levels; the very same array if they are of 8 bits.
    profile : ndarray of float64, shape (columns,)
        Mean of each column's samples in grey levels.
    turned
        Whether the file's lines became the columns.
    channel
        What was taken: ``"red"``, ``"green"``, ``"blue"``, ``"luma"``, or ``"grey"`` of a photo
        that has no colours.
    exposure_time, f_number, iso
        What the camera noted, in SI units, None where it noted nothing that makes sense.
    camera
        Its maker and model, None where it noted neither.
    """

    path: Path
    samples: Samples
    white: int
    image: ByteArray
    profile: FloatArray
    turned: bool
    channel: str
    exposure_time: float | None = None
    f_number: float | None = None
    iso: float | None = None
    camera: str | None = None


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
        A JPEG, PNG, TIFF, WebP, BMP, GIF, PPM, QOI, JPEG 2000 or AVIF file, or a HEIC file where
        the extra ``heic`` is installed; of several pictures in it the first. Its EXIF orientation
        is obeyed. Numbers with a fraction are grey levels, transparent parts are black.
    scan_axis
        ``"columns"`` or ``"lines"`` of the file, or ``"auto"``.
    channel
        ``"red"``, ``"green"``, ``"blue"``, ``"luma"``, or ``"brightest"``: the colour with the
        largest mean, in which a coloured LED shows.
    max_pixels
        What the photo may have at most; the decoders take no more than the default, and some of
        them less: reading a photo takes at most a gigabyte of memory.
    progress
        Called with the share of the work that is done, from 0 to 1. What it raises ends the
        reading and is raised here: as soon as more of the file is read or more pixels are
        converted, which some formats' decoders (JPEG 2000, WebP, AVIF, HEIC, and libtiff) do not
        come to before all is decoded.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        There is no such file, it may not be read, or it is no complete image of reasonable size.
    ParameterError
        ``scan_axis`` or ``channel`` is none of these words, or ``max_pixels`` no number from 1.
    """
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    check_choice("channel", channel, CHANNELS)
    check_count("max_pixels", max_pixels, 1)
    try:
        path = Path(path)
    except TypeError:
        raise PhotoError(
            f"{shown(path)} is not the path of a photo; allowed: str or Path."
        ) from None
    tell = Teller(progress)
    tell(0.0)
    samples, taken, turned, notes = _read(path, channel, scan_axis, int(max_pixels), tell)
    white = white_of(samples)
    return Photo(
        path=path,
        samples=samples,
        white=white,
        image=_in_grey_levels(samples),
        profile=_means(samples, 0) * (WHITE / white),
        turned=turned,
        channel=taken,
        exposure_time=notes.exposure_time,
        f_number=notes.f_number,
        iso=notes.iso,
        camera=notes.camera,
    )


def column_means(photo: Photo, first_row: int, last_row: int) -> FloatArray:
    """Average the columns of a photo over some of its rows.

    Parameters
    ----------
    photo
        Its samples are taken, in the full depth of the file.
    first_row, last_row
        The first row, and the one after the last.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Grey levels.

    Raises
    ------
    ParameterError
        There are no such rows.
    """
    rows = len(photo.samples)
    if not 0 <= first_row < last_row <= rows:
        raise ParameterError(
            f"The rows from {first_row} to before {last_row} were asked for; "
            f"allowed: at least one, from 0 to before {rows}."
        )
    means = _means(photo.samples[first_row:last_row], 0)
    return means * (WHITE / photo.white)


def _read(
    path: Path, channel: str, scan_axis: str, max_pixels: int, tell: Teller
) -> tuple[Samples, str, bool, CameraNotes]:
    """Read a file's samples of one channel with the scan axis as columns.

    Also what was taken, whether the lines became the columns, and what the camera noted.
    """
    samples, taken, notes, orientation = _taken(path, channel, max_pixels, tell)
    transpose, mirror_rows, mirror_columns = turns_of(orientation)
    turned = scan_axis == "lines" or (
        scan_axis == "auto" and _stripes_are_lines(samples, transpose)
    )
    if turned:
        transpose, mirror_rows, mirror_columns = not transpose, mirror_columns, mirror_rows
    # Each step lets go of the array before it.
    if transpose:
        samples = cast("Samples", cv2.transpose(samples))
    if mirror_rows:
        samples = cast("Samples", cv2.flip(samples, 0))
    if mirror_columns:
        samples = cast("Samples", cv2.flip(samples, 1))
    return samples, taken, turned, notes


def _taken(
    path: Path, channel: str, max_pixels: int, tell: Teller
) -> tuple[Samples, str, CameraNotes, int]:
    """Read a file's samples of one channel as they lie in it, and what the camera noted."""
    with open_picture(path, max_pixels, tell) as opened:
        decoded = DecodedPicture(opened)
        try:
            notes, orientation = camera_notes(decoded.picture), orientation_of(decoded.picture)
            samples, taken = take_channel(
                decoded, channel, lambda share: tell(DECODED + (1.0 - DECODED) * share)
            )
        finally:
            decoded.close()
    return samples, taken, notes, orientation


def _in_grey_levels(samples: Samples) -> ByteArray:
    if samples.dtype == np.uint8:
        return np.asarray(samples, dtype=np.uint8)  # the same array
    return np.asarray(cv2.convertScaleAbs(samples, alpha=WHITE / white_of(samples)), np.uint8)


def _means(samples: Samples, axis: int) -> FloatArray:
    """Average samples along an axis, many times faster than numpy does."""
    sums = cv2.reduce(samples, axis, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
    means: FloatArray = np.asarray(sums, dtype=np.float64).ravel() / samples.shape[axis]
    return means


def _stripes_are_lines(samples: Samples, lying: bool) -> bool:
    """Whether the means of the lines differ more, from one to the next, than those of columns.

    Lines and columns are those of the upright photo, of which ``samples`` may be lying.
    """
    axes = (1, 0) if lying else (0, 1)
    columns, lines = (_roughness(_means(samples, axis)) for axis in axes)
    return lines > columns


def _roughness(means: FloatArray) -> float:
    """Say how much neighbours differ, but for the greatest steps: those are the panel's rims."""
    steps = np.sort(np.abs(np.diff(means)))
    usual = steps[: math.ceil(_USUAL * len(steps))]
    return float(usual.mean()) if usual.size else 0.0
