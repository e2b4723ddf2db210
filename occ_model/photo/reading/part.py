"""A rectangle of a photo: check that it lies within the photo, and cut it out."""

from collections.abc import Sequence
from dataclasses import astuple, replace
from typing import TypeAlias

from occ_model.camera.photometry import WHITE
from occ_model.errors import ParameterError, shown
from occ_model.photo.reading.load import Photo
from occ_model.photo.reading.scan_axis import means_along
from occ_model.results.decoding import Region

Corners: TypeAlias = Region | Sequence[int]
"""A Region, or first row, row after the last, first column, column after the last."""


def region_within(photo: Photo, corners: Corners) -> Region:
    """Return the rectangle of a photo that its corners name."""
    rows, columns = photo.samples.shape
    region = corners if isinstance(corners, Region) else _region_of(corners)
    if region is not None:
        down = 0 <= region.first_row < region.last_row <= rows
        across = 0 <= region.first_column < region.last_column <= columns
        if down and across:
            return region
    raise ParameterError.of(
        "region",
        shown(astuple(corners) if isinstance(corners, Region) else corners),
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
    rows = slice(region.first_row, region.last_row)
    columns = slice(region.first_column, region.last_column)
    samples = photo.samples[rows, columns]
    means = means_along(samples, 0) * (WHITE / photo.white)
    return replace(photo, samples=samples, image=photo.image[rows, columns], profile=means)
