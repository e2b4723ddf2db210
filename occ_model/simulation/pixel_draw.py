"""Drawing of pixels' grey levels by the law of their noise, one uniform number for each."""

import math
from collections.abc import Iterator
from functools import lru_cache
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, IndexArray, Pixels
from occ_model.camera.grey_law import GreyLaw

Numbers = NDArray[np.uint32]  # uniform numbers in units of 2^-32

_FEWEST_CELL_BITS = 5
_ORDERED_BITS = 12
_WHOLE = 2**32


class Scratch:
    """Arrays for drawing pixels, which are used again: new ones would be slow."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        kinds = (np.int32, np.uint32, np.bool_, np.uint8)
        self._arrays = [np.empty(shape, dtype=kind) for kind in kinds]

    def of(self, rows: int) -> list[Any]:
        """Return the arrays of some rows."""
        return [array[:rows] for array in self._arrays]


class GreyTable:
    """The law of grey levels, prepared for drawing (the alias method of A. J. Walker, 1977).

    A level has cells of equal probability, a power of two of them, and in each at most two grey
    levels. The last bits of a number tell the cell, the others which of the two. An entry of the
    table has the first of them in its last 8 bits, the way to the second in the 8 bits before, and
    then the largest number, of 16 bits, of the first.
    """

    def __init__(self, law: GreyLaw) -> None:
        first = (law.below < 0.5 / _WHOLE).sum(axis=1)
        last = (law.below < 1.0 - 0.5 / _WHOLE).sum(axis=1)
        span = int((last - first).max()) + 1
        self._bits = max(math.ceil(math.log2(span)), _FEWEST_CELL_BITS)
        ranks = np.minimum(first[:, None] + np.arange(1 << self._bits), len(law.greys) - 1)
        below = np.concatenate([law.below, np.ones((len(first), 1))], axis=1)
        ends = np.rint(np.take_along_axis(below, ranks, axis=1) * _WHOLE).astype(np.int64)
        moved, other = _fill_cells(np.diff(ends, axis=1, prepend=0), _WHOLE >> self._bits)
        greys = law.greys[ranks].ravel()
        self._entries = self._pack(greys, greys[other], (_WHOLE >> self._bits) - moved)

    def _pack(self, first: IndexArray, second: IndexArray, kept: IndexArray) -> Numbers:
        """Pack cells' two grey levels, and how many of the cell's numbers are of the first."""
        first = np.where(kept == 0, second, first)
        grey = ((second - first) & 0xFF) << 8 | first
        cell = np.arange(len(first)) & ((1 << self._bits) - 1)
        # Numbers up to those with the entry's bits, of which each 2^bits-th is of the cell.
        below = ((grey - cell) >> self._bits) + 1
        bound = np.rint((kept - below) / 2.0 ** (16 - self._bits)).astype(np.int64)
        return np.asarray(np.clip(bound, 0, 0xFFFF) << 16 | grey, dtype=np.uint32)

    def draw(
        self, levels: Pixels, numbers: Numbers, out: ByteArray, scratch: Scratch | None = None
    ) -> None:
        """Draw the grey level of each pixel; all arrays have one shape."""
        place, entry, is_second, way = (scratch or Scratch(out.shape)).of(len(out))
        np.copyto(place, levels, casting="unsafe")
        place <<= self._bits
        np.bitwise_and(numbers, np.uint32((1 << self._bits) - 1), out=entry)
        place |= entry.view(np.int32)
        self._entries.take(place, mode="wrap", out=entry)
        np.less(entry, numbers, out=is_second)
        np.copyto(out, entry, casting="unsafe")
        entry >>= np.uint32(8)
        np.copyto(way, entry, casting="unsafe")
        way *= is_second.view(np.uint8)
        out += way


class OrderedTable:
    """The law of grey levels, for pictures that are compared pixel by pixel.

    A larger number never gives a darker pixel, so that pixels of slightly other means differ only
    by what their means differ. The numbers count to 2^-12, so that this is no law for far tails.
    """

    def __init__(self, law: GreyLaw) -> None:
        middles = (np.arange(1 << _ORDERED_BITS) + 0.5) / (1 << _ORDERED_BITS)
        ranks = np.stack([np.searchsorted(below, middles) for below in law.below])
        self._greys = law.greys[np.minimum(ranks, len(law.greys) - 1)].astype(np.uint8).ravel()

    def draw(
        self,
        levels: Pixels,
        numbers: Numbers,
        out: ByteArray,
        scratch: Scratch | None = None,  # noqa: ARG002 - that of the faster table
    ) -> None:
        """Draw the grey level of each pixel; all arrays have one shape."""
        place = levels.astype(np.int64) << _ORDERED_BITS
        place |= numbers >> np.uint32(32 - _ORDERED_BITS)
        self._greys.take(place, out=out, mode="clip")


def _fill_cells(own: IndexArray, capacity: int) -> tuple[IndexArray, IndexArray]:
    """Fill each level's cells, shape (levels, cells), so that all have the same chance.

    Cells with too little are filled in turn from those with too much, and one that then has too
    little from the next (L. Huebschle-Schneider and P. Sanders, 2022). Returns how much each cell
    gets, and from which cell, shape (levels * cells,).
    """
    rows = (2 * _WHOLE) * np.arange(len(own))[:, None]
    missing, spare = np.maximum(capacity - own, 0), np.maximum(own - capacity, 0)
    filled, given = rows + missing.cumsum(axis=1), rows + spare.cumsum(axis=1)
    giving, moved = np.flatnonzero(spare), missing.ravel()
    levels, start = given.ravel()[giving], (filled - missing).ravel()
    moved[giving] = filled.ravel()[np.searchsorted(filled.ravel(), levels)] - levels
    start[giving] = levels
    source = np.searchsorted(levels, start, side="right")
    return moved, np.where(moved > 0, np.append(giving, 0)[source], np.arange(own.size))


@lru_cache(maxsize=4)
def grey_table(law: GreyLaw) -> GreyTable:
    """Return a law's table, cached."""
    return GreyTable(law)


@lru_cache(maxsize=4)
def ordered_table(law: GreyLaw) -> OrderedTable:
    """Return a law's ordered table, cached."""
    return OrderedTable(law)


class PictureNumbers:
    """A picture's uniform numbers, which depend on the seed and a pixel's place alone."""

    has_pattern = True

    def __init__(self, seed: int, columns: int, *, is_ordered: bool = False) -> None:
        self.is_ordered = is_ordered
        self._seed = np.random.SeedSequence(seed, spawn_key=(1,))
        self._columns = columns

    def of(
        self,
        rows: range,
        place: slice,  # noqa: ARG002 - a row has its numbers wherever it is exposed
        height: int,
    ) -> Iterator[Numbers]:
        """Yield the numbers of some rows, ``height`` of them at a time."""
        words = -(-self._columns // 2)
        source = np.random.PCG64(self._seed)
        source.advance(rows.start * words)
        for start in range(0, len(rows), height):
            count = min(height, len(rows) - start)
            if rows.step == 1:
                drawn = source.random_raw(count * words).reshape(count, words)
            else:
                drawn = np.empty((count, words), dtype=np.uint64)
                for row in drawn:
                    row[:] = source.random_raw(words)
                    source.advance((rows.step - 1) * words)
            yield drawn.view(np.uint32)[:, : self._columns]


_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
_DITHERED_ROWS = 32


def dither(rows: range, columns: int) -> Pixels:
    """Return numbers from 0 to 1, spread evenly over rows and columns, shape (rows, columns).

    They decide between the levels next to a pixel's own.
    """
    row = np.arange(rows.start, rows.stop, rows.step) % _DITHERED_ROWS
    if rows.step == 1 and len(rows) <= _DITHERED_ROWS and row[-1] >= row[0]:
        return _dither_plane(columns)[row[0] : row[-1] + 1]
    return _dither_plane(columns)[row]


@lru_cache(maxsize=2)
def _dither_plane(columns: int) -> Pixels:
    """Return golden-ratio steps down each column, with a random start."""
    start = np.random.default_rng(0).random(columns)
    steps = (start + _GOLDEN * np.arange(_DITHERED_ROWS)[:, None]) % 1.0
    return np.asarray(np.minimum(steps, 1.0 - 2.0**-12), dtype=np.float32)


class GainPattern:
    """The fixed pattern of a sensor's gains, raised to a power.

    A pixel's gain is 1 + p z, where z is normal and the same in every picture of the sensor.
    """

    def __init__(self, variation: float, power: float, seed: int, size: tuple[int, int]) -> None:
        """Prepare the pattern of a picture's ``size``, its rows and columns."""
        self._plane, self.step = _gain_plane(variation, power, seed, size)

    def vary(self, rows: range, values: Pixels, out: Pixels, columns: slice) -> None:
        """Multiply values in some rows and columns by the powers of the gains.

        ``values`` are multiplied by ``step`` already. If all rows are equal, they may have one.
        """
        np.copyto(out, self._plane[rows.start : rows.stop : rows.step, columns])
        out *= values


@lru_cache(maxsize=2)
def _gain_plane(
    variation: float, power: float, seed: int, size: tuple[int, int]
) -> tuple[NDArray[np.int16], np.float32]:
    """Return the powers of the pixels' gains in steps, and the step."""
    normal = NormalDist()
    quantiles = np.array([normal.inv_cdf((place + 0.5) / 2**12) for place in range(2**12)])
    gains = np.maximum(1.0 + variation * quantiles, 0.0) ** power
    step = float(gains.max()) / np.iinfo(np.int16).max
    table = np.rint(gains / step).astype(np.int16)
    plane = np.empty(size, dtype=np.int16)
    random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
    for row in plane:
        row[:] = table[random.integers(0, 2**12, size[1], dtype=np.uint16)]
    return plane, np.float32(step)
