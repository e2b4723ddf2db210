"""Drawing of grey levels by their law, with one uniform number for each pixel.

A pixel's grey level is the quantile of its law at the number, so that it stays the same, or nearly
so, when the pixel's mean changes a little. Quantiles are looked up (the indexed search of L.
Devroye, *Non-Uniform Random Variate Generation*, 1986, chapter III.2) in cells: intervals of
numbers that are narrower towards both tails, so that hardly ever two grey levels end in one. A
number's cell is told by its sign, its exponent and the first bits of its mantissa in floating
point, where a number of the upper half, from 2^31 on, is taken less 2^32 and so is negative.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, IndexArray, Pixels
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.pixel_noise import GREYS

Numbers = NDArray[np.uint32]  # uniform numbers in units of 2^-32

_WHOLE = 2**32
_OCTAVES = 21  # octaves of numbers that have cells, from the median down to either tail
_FEWEST_BITS, _MOST_BITS = 2, 5  # binary logarithm of the number of an octave's cells
_GREYS_TO_CELL = 12  # an octave has at least a cell for so many of a pixel's grey levels
_SEVERAL = np.uint32(_WHOLE - 1)  # entry of a cell in which several grey levels end

_SIGN, _MANTISSA_BITS, _BIAS = 256, 23, 127  # single precision; the sign in units of exponents
_APART = 96  # exponents from a level's cells to the next level's, so that no two cells coincide
_SPAN = 288  # exponents from the lowest of a negative number to the highest of a positive one


def make_scratch(shape: tuple[int, ...]) -> list[NDArray[Any]]:
    """Return arrays for drawing pixels, which are used again: new ones would be slow."""
    return [np.empty(shape, dtype=kind) for kind in (np.int32, np.uint32, np.float32, np.bool_)]


class GreyTable:
    """The quantiles of a law's grey levels.

    The entry of a cell is the largest number of the first grey level in it, but for the last 8
    bits, which are the rank of that grey level.
    """

    def __init__(self, law: GreyLaw) -> None:
        self._greys = np.pad(law.greys, (0, GREYS - len(law.greys))).astype(np.uint8)
        self._is_whole = len(law.greys) == GREYS
        ends = np.rint(law.below * _WHOLE).astype(np.int64)
        self._ends = (ends + _starts(len(ends))).ravel()
        self._most_ends = ends.shape[1]
        lowest = (ends == 0).sum(axis=1)[:, None]
        span = int(((ends < _WHOLE).sum(axis=1)[:, None] - lowest).max()) + 1
        bits = min(max(math.ceil(math.log2(span / _GREYS_TO_CELL)), _FEWEST_BITS), _MOST_BITS)
        self._shift, self._stride = _MANTISSA_BITS - bits, _APART << bits
        self._entries = np.full((len(ends) - 1) * self._stride + (_SPAN << bits), _SEVERAL)
        place = np.arange(len(ends))[:, None] * self._stride + _cells(bits)[0]
        place[:2] %= len(self._entries)  # as they are looked up: from the end if negative
        self._entries[place] = _fill_cells(ends, lowest, span, bits)

    def draw(
        self,
        levels: Pixels,
        numbers: Numbers,
        out: ByteArray,
        scratch: Sequence[NDArray[Any]] | None = None,
    ) -> None:
        """Draw each pixel's grey level, from the level of its mean value and a uniform number.

        All arrays have one shape, or more rows in scratch.
        """
        arrays = scratch or make_scratch(out.shape)
        place, entry, signed, is_above = (array[: len(out)] for array in arrays)
        np.copyto(signed, numbers.view(np.int32), casting="unsafe")
        cell = signed.view(np.int32)
        cell >>= self._shift
        np.copyto(place, levels, casting="unsafe")
        place *= self._stride
        place += cell
        self._entries.take(place, mode="wrap", out=entry)
        np.copyto(out, entry, casting="unsafe")
        out += np.less(entry, numbers, out=is_above).view(np.uint8)
        if entry.max() == _SEVERAL:
            several = np.nonzero(entry == _SEVERAL)
            out[several] = self._search(levels[several].astype(np.int64), numbers[several])
        if not self._is_whole:
            cv2.LUT(out, self._greys, dst=out)

    def _search(self, level: IndexArray, numbers: Numbers) -> IndexArray:
        """Return the rank of the grey level at each number."""
        place = np.searchsorted(self._ends, 2 * _WHOLE * level + numbers, side="right")
        return np.asarray(place - level * self._most_ends)


def _starts(levels: int) -> IndexArray:
    """Return an offset of each level's numbers, with which one search covers all levels."""
    return 2 * _WHOLE * np.arange(levels)[:, None]


def _cells(bits: int) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Return each cell's index, its first number, and the number after its last one."""
    exponent, part = np.arange(31 - _OCTAVES, 31)[:, None], np.arange(1 << bits)
    index = ((exponent + _BIAS << bits) + part).ravel()
    start = np.append(part + (1 << bits) << exponent - bits, _WHOLE // 2)
    first = np.concatenate([start[:-1], _WHOLE - start[:0:-1]])
    after = np.concatenate([start[1:], _WHOLE - start[-2::-1]])
    return np.concatenate([index, index[::-1] - (_SIGN << bits)]), first, after


def _fill_cells(ends: IndexArray, lowest: IndexArray, span: int, bits: int) -> Numbers:
    """Return the entries of all cells, shape (levels, cells).

    ``ends``, shape (levels, greys - 1), are the numbers after the last one of each grey level. A
    level's pixels have at most ``span`` grey levels, from rank ``lowest``, shape (levels, 1), on.
    """
    _, first, after = _cells(bits)
    levels, cells = len(ends), len(first)
    most = ends.shape[1]
    own = np.minimum(lowest + np.arange(span + 1), most)
    own = np.take_along_axis(np.pad(ends, ((0, 0), (0, 1)), constant_values=_WHOLE), own, axis=1)
    starts = (span + 1) * np.arange(levels)[:, None]
    # Grey levels that end at or before the start of each cell.
    cell = np.searchsorted(first, own) + (cells + 1) * np.arange(levels)[:, None]
    counts = np.bincount(cell.ravel(), minlength=levels * (cells + 1))
    rank = np.minimum(np.cumsum(counts.reshape(levels, -1)[:, :-1], axis=1), span)
    end = own.ravel().take(starts + rank)
    next_end = own.ravel().take(starts + np.minimum(rank + 1, span))
    grey = np.minimum(rank + lowest, most)
    # The bits before the rank with which the entry is nearest to the grey level's last number.
    bound = np.minimum(np.maximum(end - 1 - grey + GREYS // 2, 0) // GREYS, _WHOLE // GREYS - 1)
    is_several = (end < after) & (next_end < after)
    return np.where(is_several, _SEVERAL, bound * GREYS + grey).astype(np.uint32)


@lru_cache(maxsize=4)
def grey_table(law: GreyLaw) -> GreyTable:
    """Return a law's table, cached."""
    return GreyTable(law)
