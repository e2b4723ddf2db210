"""The rectangle that a receiver finds round a level panel, drawn without the picture's pixels.

:func:`occ_model.receiver.signal.locate` takes the cells of a grid with enough bright pixels, and
then the bright pixels in and beside them. Pixels err independently, so that both can be drawn from
each column's probability of a bright pixel, on the panel and beside it: noise of a dark picture may
be bright anywhere.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.receiver.signal import grid_size_of, least_bright_fraction
from occ_model.results.decoding import Region

_MAX_PROBABILITY = 1.0 - 1e-12  # largest probability of a bright pixel, for its logarithm


@dataclass(frozen=True, eq=False, slots=True)
class BrightFractions:
    """The probability that a pixel counts as bright."""

    rows: int
    span: Region
    # Shape (columns,): for a pixel of each column on the panel and beside it; of ``panel`` the
    # columns of the rectangle count
    panel: FloatArray
    around: FloatArray

    def draw_region(self, random: np.random.Generator) -> Region:
        """Draw the rectangle that is found; the whole picture where no pixel is bright."""
        columns = len(self.around)
        whole = Region(0, self.rows, 0, columns)
        grid = grid_size_of(self.rows, columns)
        for least in (least_bright_fraction(), 0.5 / 255.0):
            marked = self._marked_cells(grid, least, random)
            if marked.any():
                pixels = round(self.rows / grid[0] * columns / grid[1])
                return self._bright_bounds(marked, math.floor(least * pixels) + 1, random)
        return whole

    def _crossed(self) -> FloatArray:
        """Return the probabilities in a row that crosses the panel."""
        mixed = self.around.copy()
        seen = slice(self.span.first_column, self.span.last_column)
        mixed[seen] = self.panel[seen]
        return mixed

    def _marked_cells(
        self, grid: tuple[int, int], least: float, random: np.random.Generator
    ) -> BoolArray:
        """Draw which cells have more than a fraction of bright pixels, shape (rows, columns)."""
        on_panel = np.zeros(self.rows)
        on_panel[self.span.first_row : self.span.last_row] = 1.0
        kinds, kind = np.unique(_of_cells(on_panel, grid[0]), return_inverse=True)
        pixels = round(self.rows / grid[0] * len(self.around) / grid[1])
        crossed, around = self._crossed(), self.around
        fraction, variance = (
            kinds[:, None] * _of_cells(at_panel, grid[1])
            + (1.0 - kinds[:, None]) * _of_cells(beside, grid[1])
            for at_panel, beside in (
                (crossed, around),
                (crossed * (1.0 - crossed), around * (1.0 - around)),
            )
        )
        enough = np.where(
            variance > 0.0,
            _more_than(least, fraction, pixels),
            (fraction > least).astype(np.float64),
        )
        # Compared in single precision, by the next such number up: the same cells, twice as fast.
        limits = enough.astype(np.float32)
        limits[limits < enough] = np.nextafter(limits[limits < enough], np.float32(2.0))
        return np.asarray(random.random(grid, dtype=np.float32) < limits[kind])

    def _bright_bounds(self, marked: BoolArray, least: int, random: np.random.Generator) -> Region:
        """Draw the rows and the columns from the first bright pixel to the last.

        ``marked``: cells with at least ``least`` bright pixels; in and beside them further ones
        count.
        """
        span = self.span
        top, bottom = _marked_ends(np.any(marked, axis=1), self.rows)
        left, right = _marked_ends(np.any(marked, axis=0), len(self.around))
        rows, seen = bottom.beyond - top.beyond, slice(left.beyond, right.beyond)
        dark_crossed = np.log1p(-np.minimum(self._crossed()[seen], _MAX_PROBABILITY))
        dark_around = np.log1p(-np.minimum(self.around[seen], _MAX_PROBABILITY))
        first, last = np.clip((span.first_row, span.last_row), top.beyond, bottom.beyond).tolist()
        dark_column = (last - first) * dark_crossed + (rows - last + first) * dark_around
        dark_row = np.full(rows, dark_around.sum())
        dark_row[first - top.beyond : last - top.beyond] = dark_crossed.sum()
        ends = []
        for low, high, dark in ((top, bottom, dark_row), (left, right, dark_column)):
            bright = -np.expm1(dark)
            drawn = random.random(len(bright)) < bright
            for end in (low, high):
                cell = slice(end.first - low.beyond, end.last - low.beyond)
                weights = bright[cell] / bright[cell].sum() if bright[cell].any() else None
                drawn[cell.start + random.choice(end.last - end.first, least, p=weights)] = True
            found = np.flatnonzero(drawn)
            ends += [low.beyond + int(found[0]), low.beyond + int(found[-1]) + 1]
        return Region(*ends)


class _Cell(NamedTuple):
    """The pixels of a marked cell along one axis, and where the cell beside it ends."""

    first: int
    last: int
    beyond: int


def _marked_ends(marked: BoolArray, length: int) -> tuple[_Cell, _Cell]:
    """Return the first marked cell along an axis of some pixels, and the last."""
    scale = length / len(marked)
    low, high = np.flatnonzero(marked)[[0, -1]].tolist()
    return (
        _Cell(int(low * scale), math.ceil((low + 1) * scale), max(0, int((low - 1) * scale))),
        _Cell(int(high * scale), min(length, math.ceil((high + 1) * scale)),
              min(length, int((high + 2) * scale))),
    )  # fmt: skip


def _of_cells(values: FloatArray, cells: int) -> FloatArray:
    """Average values over equal cells, which may begin within a pixel."""
    sums = np.concatenate([[0.0], np.cumsum(values)])
    edges = np.linspace(0.0, len(values), cells + 1)
    means = np.diff(np.interp(edges, np.arange(len(sums)), sums)) * (cells / len(values))
    return np.asarray(np.clip(means, 0.0, 1.0))


_MOST_SUMMED = 1000  # pixels of a cell, of which there are more sets than a float holds


def _more_than(least: float, fraction: FloatArray, pixels: int) -> FloatArray:
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
