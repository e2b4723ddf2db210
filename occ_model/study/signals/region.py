"""The rectangles that a receiver finds round the panels of many pictures, drawn without pixels.

:func:`occ_model.receiver.signal.locate` takes the cells of a grid with enough bright pixels, and
then the bright pixels in and beside them. Pixels err independently, so that it can be drawn for
each row and each column of cells whether one of them is marked, and for rows and columns of pixels
at the ends of the marked cells which is the first to have a bright one.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import cv2
import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray, Pixels
from occ_model.receiver.signal import grid_size_of, least_bright_fraction
from occ_model.results.decoding import Region

_MAX_PROBABILITY = 1.0 - 1e-7  # largest probability of a bright pixel, for its logarithm
_MOST_SUMMED = 1000  # pixels of a cell, of which there are more sets than a float holds
_NO_VARIANCE = 1e-7  # mean variance of pixels of which none is drawn
_SURELY_ENOUGH = 0.5  # fraction of bright pixels from which a cell is surely marked
_MANY_PIXELS = 25  # fewest pixels of such a cell


@dataclass(frozen=True, eq=False, slots=True)
class BrightPixels:
    """The probability that a pixel counts as bright, in bands of a picture and beside them."""

    size: tuple[int, int]  # Rows and columns of the picture
    span: Region  # The rows for which the bands stand
    # Shape (images, bands, columns) and (images, columns)
    inside: Pixels
    beside: Pixels

    def draw_regions(self, randoms: list[np.random.Generator]) -> list[Region]:
        """Draw the rectangle that is found; the whole picture where no pixel is bright."""
        rows, columns = self.size
        grid = grid_size_of(rows, columns)
        cells = _RowsOfCells(self, grid[0])
        inside, beside = (_of_cells(each, grid[1]) for each in (self.inside, self.beside))
        pixels = round(rows / grid[0] * columns / grid[1])
        down, across = (np.zeros((len(randoms), count), dtype=np.bool_) for count in grid)
        numbers = [random.random(sum(grid) + 4, dtype=np.float32) for random in randoms]
        drawn = np.array(numbers)
        for least in (least_bright_fraction(), 0.5 / 255.0):
            unmarked = ~across.any(axis=1)
            if not unmarked.any():
                break
            in_row, in_column = cells.chances_of_marks(inside, beside, pixels, least)
            across[unmarked] = (drawn[:, 4 : 4 + grid[1]] < in_column)[unmarked]
            down[unmarked] = (drawn[:, 4 + grid[1] :] < in_row)[unmarked]
            likeliest = np.argmax(in_row, axis=1)
            missed = np.flatnonzero(across.any(axis=1) & ~down.any(axis=1))
            down[missed, likeliest[missed]] = True
        found = np.asarray(across.any(axis=1))
        of_rows, of_columns = self._dark_rows(), self._dark_columns()
        ends = [
            [*_bright_ends(down[found], of_rows[found], drawn[found, :2])],
            [*_bright_ends(across[found], of_columns[found], drawn[found, 2:4])],
        ]
        regions = iter([Region(*each) for each in np.concatenate(ends).T.tolist()])
        return [
            next(regions) if is_found else Region(0, rows, 0, columns)
            for is_found in found.tolist()
        ]

    def _dark_columns(self) -> FloatArray:
        """Return the logarithm of the probability that a column has no bright pixel."""
        dark = self.span.rows * _log_dark(self.inside).mean(axis=1)
        dark += (self.size[0] - self.span.rows) * _log_dark(self.beside)
        return np.asarray(dark)

    def _dark_rows(self) -> FloatArray:
        """Return the logarithm of the probability that a row has no bright pixel."""
        rows, span = np.arange(self.size[0]), self.span
        bands = _log_dark(self.inside).sum(axis=2)
        band = (rows - span.first_row) * bands.shape[1] // max(span.rows, 1)
        dark = bands[:, np.clip(band, 0, bands.shape[1] - 1)]
        is_beside = (rows < span.first_row) | (rows >= span.last_row)
        dark[:, is_beside] = _log_dark(self.beside).sum(axis=1, keepdims=True)
        return np.asarray(dark)


def _log_dark(bright: Pixels) -> Pixels:
    return np.asarray(np.log1p(-np.minimum(bright, np.float32(_MAX_PROBABILITY))))


def _bright_ends(
    marked: BoolArray, dark: FloatArray, drawn: Pixels
) -> tuple[IndexArray, IndexArray]:
    """Draw the first row or column with a bright pixel, and the one after the last.

    They are sought in the marked cells at both ends and the cells before them.

    Parameters
    ----------
    marked : ndarray of bool, shape (images, cells)
    dark : ndarray, shape (images, rows or columns)
        Logarithm of the probability that there is no bright pixel.
    drawn : ndarray, shape (images, 2)
        Uniform random numbers.
    """
    length = dark.shape[1]
    scale = length / marked.shape[1]
    low = np.argmax(marked, axis=1)
    high = marked.shape[1] - 1 - np.argmax(marked[:, ::-1], axis=1)
    start = np.maximum(0, ((low - 1) * scale).astype(int))
    stop = np.minimum(length, np.ceil((low + 1) * scale).astype(int))
    first = start + _first_bright(dark, start, stop - start, drawn[:, 0])
    start = np.maximum(0, length - np.minimum(length, ((high + 2) * scale).astype(int)))
    stop = length - (high * scale).astype(int)
    last = length - start - _first_bright(dark[:, ::-1], start, stop - start, drawn[:, 1])
    return first, np.maximum(last, first + 1)


def _first_bright(
    dark: FloatArray, start: IndexArray, count: IndexArray, drawn: Pixels
) -> IndexArray:
    """Draw which of ``count`` places from a start on is the first bright one; one of them is."""
    place = np.arange(int(count.max(initial=1)))
    seen = np.minimum(start[:, None] + place, dark.shape[1] - 1)
    own = np.where(place < count[:, None], np.take_along_axis(dark, seen, axis=1), 0.0)
    some_bright = -np.expm1(np.cumsum(own, axis=1))
    return np.asarray(np.argmax(some_bright >= drawn[:, None] * some_bright[:, -1:], axis=1))


class _Fractions(NamedTuple):
    """Mean probability of a bright pixel in cells, and mean variance of a pixel."""

    mean: Pixels
    variance: Pixels


def _of_cells(bright: Pixels, cells: int) -> _Fractions:
    """Average over equal cells of columns, which may begin within a pixel."""
    flat = bright.reshape(-1, bright.shape[-1])
    shape = (*bright.shape[:-1], cells)

    def average(values: Pixels) -> Pixels:
        size = cells, len(values)
        means = cv2.resize(values, size, interpolation=cv2.INTER_AREA)
        return np.asarray(np.clip(means, 0.0, 1.0), dtype=np.float32).reshape(shape)

    return _Fractions(average(flat), average(flat * (np.float32(1.0) - flat)))


class _RowsOfCells:
    """The rows of a grid of cells: in bands, beside them, and partly so."""

    def __init__(self, bright: BrightPixels, rows: int) -> None:
        span = bright.span
        height = bright.size[0] / rows
        start = np.arange(rows) * height
        crossed = np.minimum(start + height, span.last_row) - np.maximum(start, span.first_row)
        part = np.clip(crossed / height, 0.0, 1.0)
        count = bright.inside.shape[1]
        middle = start + 0.5 * height - span.first_row
        band = np.clip((middle * count / span.rows).astype(int), 0, count - 1)
        band[part == 0.0] = 0
        kinds, self._kind = np.unique(np.round(part, 6) + 2.0 * band, return_inverse=True)
        self._band = (kinds // 2.0).astype(int)
        self._part = (kinds - 2.0 * self._band).astype(np.float32)[:, None]
        self._rows = np.bincount(self._kind)[:, None].astype(np.float32)

    def chances_of_marks(
        self, inside: _Fractions, beside: _Fractions, pixels: int, least: float
    ) -> tuple[Pixels, Pixels]:
        """Return the probability that a cell is marked in each row and each column of the grid.

        A cell is marked if more than a fraction ``least`` of its ``pixels`` are bright.
        """
        fraction, variance = (
            self._part * of_bands[:, self._band] + (np.float32(1.0) - self._part) * around[:, None]
            for of_bands, around in zip(inside, beside, strict=True)
        )
        is_sure = variance < _NO_VARIANCE
        if pixels >= _MANY_PIXELS:
            is_sure |= fraction > _SURELY_ENOUGH
        enough = (fraction > least).astype(np.float32)
        is_open = np.nonzero(~is_sure)
        enough[is_open] = chance_of_more_than(least, fraction[is_open].astype(np.float64), pixels)
        log_none = _log_dark(enough)
        in_row = -np.expm1(log_none.sum(axis=2))[:, self._kind]
        return in_row, -np.expm1((self._rows * log_none).sum(axis=1))


def chance_of_more_than(least: float, fraction: FloatArray, pixels: int) -> FloatArray:
    """Return the probability that a cell has more than a fraction of bright pixels."""
    most = math.floor(least * pixels)
    if pixels > _MOST_SUMMED:
        from scipy.special import bdtrc  # slow to import: not for pictures of usual sizes

        return np.asarray(bdtrc(most, pixels, fraction))
    dark = 1.0 - fraction
    too_few = sum(
        math.comb(pixels, count) * fraction**count * dark ** (pixels - count)
        for count in range(most + 1)
    )
    return np.clip(1.0 - too_few, 0.0, 1.0)
