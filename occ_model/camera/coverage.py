"""Coverage: the fraction of each pixel that a panel covers, with any outline, sharp or blurred."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.row_interpolation import apply_weights
from occ_model.camera.row_memory import MEMORY

_BLUR_REACH = 4.0  # standard deviations at which the blur is cut off; 3e-5 of light goes farther

_CELLS_A_BLUR = 4.0  # least standard deviation of the blur in cells, which are squares of pixels
_ROWS_A_CELL = 16  # least number of a cell's rows that are used, as accurate as all of them
_ROWS_AN_OUTLINE = 4096  # least number of a high outline's rows that are used


@dataclass(frozen=True, eq=False, slots=True)
class CoveredPart:
    """Columns of some rows with light of the panel."""

    columns: slice
    # Shape (rows, columns): fraction of each pixel's light that is the panel's; None if it is 1
    fraction: Pixels | None

    def crop(self, columns: slice) -> "CoveredPart":
        """Return the part in some columns, which is empty if they are beside it."""
        start = max(self.columns.start, columns.start)
        part = slice(start, max(start, min(self.columns.stop, columns.stop)))
        if self.fraction is None:
            return CoveredPart(part, None)
        first = self.columns.start
        return CoveredPart(part, self.fraction[:, part.start - first : part.stop - first])

    def cut_out(self, spans: Sequence[slice]) -> "list[CoveredPart]":
        """Return what is left of the part without some spans of columns, from the left."""
        starts = [self.columns.start, *(span.stop for span in spans)]
        stops = [*(span.start for span in spans), self.columns.stop]
        pieces = (self.crop(slice(*ends)) for ends in zip(starts, stops, strict=True))
        return [piece for piece in pieces if piece.columns.start < piece.columns.stop]


def _split_rim(columns: slice, fraction: Pixels) -> list[CoveredPart]:
    """Split columns near the outline into the runs inside it, if it is sharp and upright there."""
    first = fraction[0]
    if not ((first == 0.0) | (first == 1.0)).all() or (fraction != first).any():
        return [CoveredPart(columns, fraction)]
    ends = np.flatnonzero(np.diff(first, prepend=0.0, append=0.0)) + columns.start
    return [CoveredPart(slice(*run), None) for run in ends.reshape(-1, 2).tolist()]


def _join_parts(parts: list[CoveredPart]) -> list[CoveredPart]:
    joined: list[CoveredPart] = []
    for part in parts:
        before = joined[-1] if joined else part
        are_covered = part.fraction is None and before.fraction is None
        if joined and are_covered and before.columns.stop == part.columns.start:
            joined[-1] = CoveredPart(slice(before.columns.start, part.columns.stop), None)
        else:
            joined.append(part)
    return joined


def _fractions(parts: list[CoveredPart]) -> list[Pixels]:
    return [part.fraction for part in parts if part.fraction is not None]


class Coverage:
    """The fraction of the light in each pixel that comes from the panel.

    A pixel belongs to the panel if its centre is inside the outline, given as the (column, row) of
    each corner in order; the outline may be concave. The blur (standard deviation in pixels) also
    brings in light from beyond the picture's edge, since the lens blurs before the sensor crops.
    """

    def __init__(self, outline: FloatArray, rows: int, columns: int, blur: float = 0.0) -> None:
        self._columns = columns
        self._key = "coverage", outline.tobytes(), rows, columns, blur
        self._starts, self._ends = outline.T, np.roll(outline, -1, axis=0).T
        self._blur = blur
        self._margin = math.ceil(_BLUR_REACH * blur)
        self._blurred_rows = blurred_rows = range(-self._margin, rows + self._margin)
        cell = max(1, int(blur / _CELLS_A_BLUR))
        # One row of each stride is used: a very wide blur needs no more of them than a narrow one.
        self._stride = max(
            1, min(cell // _ROWS_A_CELL, _count_rows(outline, blurred_rows) // _ROWS_AN_OUTLINE)
        )
        self._cell = cell - cell % self._stride
        self._coarse = self._blur_whole(rows) if self._cell > 1 else None

    @cached_property
    def _crossings(self) -> tuple[IndexArray, FloatArray, FloatArray]:
        return _find_crossings(self._starts.T, self._blurred_rows, self._stride)

    def rows(self, rows: range) -> Pixels:
        """Return some rows, shape (number of rows, columns), 0 to 1."""
        covered = np.zeros((len(rows), self._columns), dtype=np.float32)
        for part in self.parts(rows):
            covered[:, part.columns] = 1.0 if part.fraction is None else part.fraction
        return covered

    def reaches(self, rows: range) -> bool:
        """Return whether the outline with its blur may reach any of some rows."""
        reach, corner_rows = self._margin + self._cell, self._starts[1]
        return bool(corner_rows.min() - reach <= rows[-1] and corner_rows.max() + reach >= rows[0])

    def parts(self, rows: range) -> list[CoveredPart]:
        """Return the parts of some rows with light of the panel, from the left.

        They are rims, the columns near the outline, and what the panel covers between them.
        """
        return MEMORY.recall((*self._key, rows), lambda: self._compute_parts(rows), _fractions)

    def _compute_parts(self, rows: range) -> list[CoveredPart]:
        parts, before = [], 0
        for start, stop in (*self._find_rims(rows), (self._columns, self._columns)):
            if start > before and self._encloses(rows[0], before):
                parts.append(CoveredPart(slice(before, start), None))
            if stop > start:
                parts += _split_rim(slice(start, stop), self._cover_rim(rows, slice(start, stop)))
            before = stop
        return _join_parts(parts)

    def _find_rims(self, rows: range) -> list[tuple[int, int]]:
        """Find the columns near the outline in some rows, from the left."""
        (x0, y0), (x1, y1) = self._starts, self._ends
        reach = self._margin + self._cell
        low, high = rows[0] - reach, rows[-1] + reach
        is_near = (np.minimum(y0, y1) <= high) & (np.maximum(y0, y1) >= low)
        x0, y0, x1, y1 = x0[is_near], y0[is_near], x1[is_near], y1[is_near]
        ends = np.array([[0.0], [1.0]]) + np.zeros(len(x0))
        np.divide([[low], [high]] - y0, y1 - y0, out=ends, where=y0 != y1)
        x = x0 + np.clip(ends, 0.0, 1.0) * (x1 - x0)
        start = np.clip(np.floor(x.min(axis=0)) - reach, 0, self._columns)
        stop = np.clip(np.ceil(x.max(axis=0)) + reach + 1, 0, self._columns)
        order = np.argsort(start)
        order = order[stop[order] > start[order]]
        start, stop = start[order].astype(np.int64), np.maximum.accumulate(stop[order])
        is_separate = np.append(True, start[1:] > stop[:-1])[: len(start)]
        firsts = np.flatnonzero(is_separate)
        lasts = np.append(firsts[1:], len(start))[: len(firsts)] - 1
        return list(zip(start[firsts].tolist(), stop[lasts].astype(int).tolist(), strict=True))

    def _encloses(self, row: int, column: int) -> bool:
        """Return whether a pixel away from the outline is inside it."""
        (x0, y0), (x1, y1) = self._starts, self._ends
        crossed = (y0 <= row) != (y1 <= row)
        x0, y0, x1, y1 = x0[crossed], y0[crossed], x1[crossed], y1[crossed]
        x = x0 + (row - y0) / (y1 - y0) * (x1 - x0)
        return bool(np.sign(y1 - y0)[x < column].sum() != 0.0)

    def _cover_rim(self, rows: range, columns: slice) -> Pixels:
        if self._coarse is not None:
            return self._enlarge(self._coarse, rows, range(columns.start, columns.stop))
        margin, step = self._margin, rows.step
        width = 2 * margin + 1
        if not margin:
            return self._cover_sharply(np.asarray(rows), columns, 1)
        if step < width:
            lines = np.arange(rows[0] - margin, rows[-1] + margin + 1)
            chosen = slice(margin, margin + rows[-1] - rows[0] + 1, step)
        else:  # a window of rows around each
            lines = (np.asarray(rows)[:, None] + np.arange(-margin, margin + 1)).ravel()
            chosen = slice(margin, None, width)
        wide = slice(columns.start - margin, columns.stop + margin)
        blurred = cv2.GaussianBlur(self._cover_sharply(lines, wide, 1), (width, width), self._blur)
        return np.asarray(blurred[chosen, margin : margin + columns.stop - columns.start])

    def _cover_sharply(self, rows: IndexArray, columns: slice, cell: int) -> Pixels:
        """Return the fraction of each cell inside the outline; ``rows`` are their first ones."""
        row, x, sign = self._crossings
        chosen = slice(*np.searchsorted(row, (rows[0], rows[-1] + cell)).tolist())
        line = np.searchsorted(rows, row[chosen], side="right") - 1
        is_in_cell = row[chosen] < rows[line] + cell
        line, x, sign = line[is_in_cell], x[chosen][is_in_cell], sign[chosen][is_in_cell]
        width = columns.stop - columns.start
        # A step at each crossing, from outside to inside or back; their sum is the coverage.
        steps = np.zeros((len(rows), -(-width // cell) + 2), dtype=np.float32)
        start = np.ceil(np.clip(x, columns.start, columns.stop)) - columns.start
        column, part = np.divmod(start, cell)
        place = (line, column.astype(np.int64))
        fraction = part / cell
        weight = sign * (self._stride / cell)
        np.add.at(steps, place, weight * (1.0 - fraction))
        np.add.at(steps, (place[0], place[1] + 1), weight * fraction)
        np.cumsum(steps, axis=1, out=steps)
        # The sign depends on the direction of the outline.
        return np.abs(steps[:, :-2])

    def _blur_whole(self, rows: int) -> Pixels:
        """Blur the whole picture on a grid of cells, fine enough for a wide blur."""
        margin = self._margin
        lines = np.arange(-margin, rows + margin, self._cell)
        sharp = self._cover_sharply(lines, slice(-margin, self._columns + margin), self._cell)
        reach = math.ceil(self._margin / self._cell)
        size = (2 * reach + 1, 2 * reach + 1)
        # The cells' own width and the interpolation between them already blur by half a cell.
        blur = math.sqrt((self._blur / self._cell) ** 2 - 0.25)
        blurred = cv2.GaussianBlur(sharp, size, blur)
        return np.asarray(blurred, dtype=np.float32)

    def _enlarge(self, coarse: Pixels, rows: range, columns: range) -> Pixels:
        """Interpolate linearly between the centres of cells."""
        # OpenCV does not serve here, as its coordinates are short integers in many versions.
        column, right = self._find_cells(columns)
        row, below = self._find_cells(rows)
        part = coarse[row[0] : row[-1] + 2]
        wide = part[:, column] * (1.0 - right) + part[:, column + 1] * right
        weight = np.zeros((len(rows), len(part)), dtype=np.float32)
        line = np.arange(len(rows))
        weight[line, row - row[0]] = 1.0 - below
        weight[line, row - row[0] + 1] = below
        return apply_weights(weight, wide)

    def _find_cells(self, pixels: range) -> tuple[IndexArray, Pixels]:
        """Find the cell before each pixel's centre, and the distance from it in cells."""
        place = (np.asarray(pixels) + (self._margin + 0.5)) / self._cell - 0.5
        before = np.floor(place)
        return before.astype(np.int64), (place - before).astype(np.float32)


def _count_rows(outline: FloatArray, rows: range) -> int:
    """Count those of some rows that are between the outline's first and last row."""
    low, high = np.clip(outline[:, 1], rows.start, rows.stop).min(), outline[:, 1].max()
    return int(min(float(high), float(rows.stop)) - low)


def _find_crossings(
    outline: FloatArray, rows: range, stride: int
) -> tuple[IndexArray, FloatArray, FloatArray]:
    """Return where the outline crosses rows: row, column, and the sign of the row's change.

    Of ``rows``, only the middle one of every ``stride`` is used.
    """
    (x0, y0), (x1, y1) = outline.T, np.roll(outline, -1, axis=0).T
    # Half open, so that only one of the two edges at a corner crosses its row.
    start, stop = (_first_rows(y, rows) for y in (np.minimum(y0, y1), np.maximum(y0, y1)))
    start += (rows.start + stride // 2 - start) % stride
    counts = np.maximum(-(-(stop - start) // stride), 0)
    edge = np.repeat(np.arange(len(outline)), counts)
    before = np.cumsum(counts) - counts
    row = start[edge] + (np.arange(len(edge)) - before[edge]) * stride
    x0, y0, x1, y1 = x0[edge], y0[edge], x1[edge], y1[edge]
    along = (row - y0) / (y1 - y0)
    # Clipped to the edge's ends, since rounding would move some rows of an upright edge.
    column = np.clip(x0 * (1.0 - along) + x1 * along, np.minimum(x0, x1), np.maximum(x0, x1))
    order = np.argsort(row, kind="stable")
    return row[order], column[order], np.where(y1 > y0, 1.0, -1.0)[order]


def column_spans(outline: FloatArray, rows: int, columns: int) -> tuple[IndexArray, IndexArray]:
    """Return each column's first row inside an outline and the row after the last; equal if none.

    ``outline`` is the (column, row) of each corner, in order.
    """
    column, row, _ = _find_crossings(outline[:, ::-1], range(columns), 1)
    top, bottom = np.full(columns, np.inf), np.full(columns, -np.inf)
    np.minimum.at(top, column, row)
    np.maximum.at(bottom, column, row)
    first, last = (np.clip(np.ceil(end), 0, rows).astype(np.int64) for end in (top, bottom))
    return first, np.maximum(first, last)


def rows_inside(outline: FloatArray, ends: FloatArray, columns: int) -> FloatArray:
    """Count each column's rows inside an outline from one end to the next: (ends - 1, columns)."""
    column, row, sign = _find_crossings(outline[:, ::-1], range(columns), 1)
    first = np.ceil(row)
    before = [np.bincount(column, sign * np.minimum(first, end), columns) for end in ends]
    return np.abs(np.diff(before, axis=0))


def _first_rows(y: FloatArray, rows: range) -> IndexArray:
    return np.ceil(np.clip(y, rows.start, rows.stop)).astype(np.int64)
