"""Drawing of pixels' grey levels by the law of their noise, one uniform number for each.

A pixel's level is the quantile of its law at a number between 0 and 1, so that a pixel of a picture
stays the same, or nearly so, when its mean changes a little. Quantiles are looked up (the indexed
search of L. Devroye, *Non-Uniform Random Variate Generation*, 1986, chapter III.2): the first bits
of a number tell a cell of the table, in which usually at most one grey level ends.
"""

from collections.abc import Iterator
from functools import lru_cache
from statistics import NormalDist
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, IndexArray, Pixels
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.pixel_noise import GREYS

Numbers = NDArray[np.uint32]  # uniform numbers in units of 2^-32

_CELL_BITS = 7
_WHOLE = 2**32
_SEVERAL = np.uint32(_WHOLE - 1)  # entry of a cell in which several grey levels end


class Scratch:
    """Arrays for drawing pixels, which are used again: new ones would be slow."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        kinds = (np.int32, np.int64, np.uint32, np.bool_)
        self._arrays = [np.empty(shape, dtype=kind) for kind in kinds]

    def of(self, rows: int) -> list[Any]:
        """Return the arrays of some rows."""
        return [array[:rows] for array in self._arrays]


class GreyTable:
    """The quantiles of a law's grey levels."""

    def __init__(self, law: GreyLaw) -> None:
        self._greys = np.pad(law.greys, (0, GREYS - len(law.greys))).astype(np.uint8)
        self._is_whole = len(law.greys) == GREYS
        ends = np.full((len(law.below), GREYS), _WHOLE - 1, dtype=np.int64)
        ends[:, : law.below.shape[1]] = np.minimum(np.rint(law.below * _WHOLE), _WHOLE - 1)
        self._ends = ends.astype(np.uint32)
        self._entries = self._index_cells(ends)

    @staticmethod
    def _index_cells(ends: IndexArray) -> Numbers:
        """Return for each level and cell: its first grey level, and where in it that one ends."""
        cells, shift = 1 << _CELL_BITS, 32 - _CELL_BITS
        row = (cells + 1) * np.arange(len(ends))[:, None]
        cell = np.where(ends < _WHOLE - 1, (ends + (1 << shift) - 1) >> shift, cells)
        counts = np.bincount((row + cell).ravel(), minlength=row.size * (cells + 1))
        # Grey levels that end at or before the start of each cell.
        first = np.cumsum(counts.reshape(len(ends), cells + 1)[:, :-1], axis=1)
        after = np.concatenate([first[:, 1:], (ends < _WHOLE - 1).sum(axis=1)[:, None]], axis=1)
        ended = np.take_along_axis(ends, np.minimum(first, GREYS - 1), axis=1)
        bound = np.minimum((ended << _CELL_BITS) - (np.arange(cells) << 32), _WHOLE - 1)
        bound[after == first] = _WHOLE - 1
        entries = (bound & ~0xFF | np.minimum(first, GREYS - 1)).astype(np.uint32)
        entries[after > first + 1] = _SEVERAL
        return entries.ravel()

    def draw(
        self, levels: Pixels, numbers: Numbers, out: ByteArray, scratch: Scratch | None = None
    ) -> None:
        """Draw the grey level of each pixel; all arrays have one shape.

        ``numbers`` are overwritten.
        """
        place, wide, entry, is_above = (scratch or Scratch(out.shape)).of(len(out))
        np.copyto(place, levels, casting="unsafe")
        place <<= _CELL_BITS
        np.right_shift(numbers, np.uint32(32 - _CELL_BITS), out=entry)
        place |= entry.view(np.int32)
        np.copyto(wide, place)
        self._entries.take(wide, mode="wrap", out=entry)
        np.copyto(out, entry, casting="unsafe")
        several = np.flatnonzero(np.equal(entry, _SEVERAL, out=is_above))
        if several.size:
            found = self._search(wide.ravel()[several] >> _CELL_BITS, numbers.ravel()[several])
        numbers <<= np.uint32(_CELL_BITS)
        out += np.less(entry, numbers, out=is_above).view(np.uint8)
        if several.size:
            out.flat[several] = found
        if not self._is_whole:
            cv2.LUT(out, self._greys, dst=out)

    def _search(self, level: IndexArray, numbers: Numbers) -> IndexArray:
        """Return the rank of the grey level at a number, by bisection."""
        flat, start = self._ends.ravel(), level * GREYS
        rank = np.zeros(len(level), dtype=np.int64)
        step = GREYS // 2
        while step:
            rank += step * (flat.take(start + (rank + step - 1)) <= numbers)
            step //= 2
        return rank


@lru_cache(maxsize=4)
def grey_table(law: GreyLaw) -> GreyTable:
    """Return a law's table, cached."""
    return GreyTable(law)


class PictureNumbers:
    """A picture's uniform numbers, which depend on the seed and a pixel's place alone."""

    has_pattern = True

    def __init__(self, seed: int, columns: int) -> None:
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
        self._plane, self._step = _gain_plane(variation, power, seed, size)

    def vary(self, rows: range, values: Pixels, out: Pixels, columns: slice = slice(None)) -> None:
        """Multiply values in some rows and columns by the powers of the gains.

        If all rows are equal, ``values`` may have one.
        """
        plane = self._plane[rows.start : rows.stop : rows.step, columns]
        np.multiply(plane, values * self._step, out=out)
        out += values


@lru_cache(maxsize=2)
def _gain_plane(
    variation: float, power: float, seed: int, size: tuple[int, int]
) -> tuple[NDArray[np.int8], np.float32]:
    """Return the relative change of each pixel's gain, in steps, and the step."""
    normal = NormalDist()
    quantiles = np.array([normal.inv_cdf((place + 0.5) / 2**12) for place in range(2**12)])
    change = np.maximum(1.0 + variation * quantiles, 0.0) ** power - 1.0
    step = float(np.abs(change).max()) / 127.0
    table = np.rint(change / max(step, 1e-30)).astype(np.int8)
    plane = np.empty(size, dtype=np.int8)
    random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
    for row in plane:
        row[:] = table[random.integers(0, 2**12, size[1], dtype=np.uint16)]
    return plane, np.float32(step)
