"""Drawing of grey levels by their law, with one uniform number for each pixel.

A pixel's level is the quantile of its law at the number, so that it stays the same, or nearly so,
when the pixel's mean changes a little. Quantiles are looked up (the indexed search of L. Devroye,
*Non-Uniform Random Variate Generation*, 1986, chapter III.2) in cells of numbers, in which hardly
ever more than one grey level ends, as they become narrower towards both tails. Numbers of the upper
half count as negative; then sign, exponent and first bits of a floating-point number tell the cell.
"""

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
_OCTAVES = 24  # of numbers that have cells, from the median down to either tail
_CELL_BITS = range(2, 7)  # bits of the cells of an octave
_FEW = 1e-3  # fraction of pixels whose levels may be searched for
_SEVERAL = np.uint32(_WHOLE - 1)  # entry of a cell in which several grey levels end

_SIGN, _MANTISSA_BITS, _BIAS = 256, 23, 127  # of single precision; the sign in units of exponents
_APART = 96  # exponents from level to level, at which the cells of none overlap those of another
_SPAN = 288  # exponents from the lowest of a negative number to the highest


class Scratch:
    """Arrays for drawing pixels, which are used again: new ones would be slow."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        kinds = (np.int32, np.uint32, np.float32, np.bool_)
        self._arrays = [np.empty(shape, dtype=kind) for kind in kinds]

    def of(self, rows: int) -> list[Any]:
        """Return the arrays of some rows."""
        return [array[:rows] for array in self._arrays]


class GreyTable:
    """The quantiles of a law's grey levels.

    The entry of a cell has its first grey level, by rank, in the last 8 bits, and in the others the
    largest number of that level.
    """

    def __init__(self, law: GreyLaw) -> None:
        self._greys = np.pad(law.greys, (0, GREYS - len(law.greys))).astype(np.uint8)
        self._is_whole = len(law.greys) == GREYS
        ends = np.rint(law.below * _WHOLE).astype(np.int64)
        self._ends = (ends + _starts(len(ends))).ravel()
        self._most_ends = ends.shape[1]
        for bits in _CELL_BITS:
            entries, searched = _fill_cells(ends, bits)
            if searched < _FEW:
                break
        self._shift, self._stride = _MANTISSA_BITS - bits, _APART << bits
        self._entries = np.full((len(ends) - 1) * self._stride + (_SPAN << bits), _SEVERAL)
        place = np.arange(len(ends))[:, None] * self._stride + _cells(bits)[0]
        self._entries[place % len(self._entries)] = entries

    def draw(
        self, levels: Pixels, numbers: Numbers, out: ByteArray, scratch: Scratch | None = None
    ) -> None:
        """Draw the grey level of each pixel; all arrays have one shape."""
        place, entry, signed, is_above = (scratch or Scratch(out.shape)).of(len(out))
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
    """Return what is added to the numbers of each level, so that all levels' are in order."""
    return 2 * _WHOLE * np.arange(levels)[:, None]


def _cells(bits: int) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Return each cell's index, its first number, and the number after its last one."""
    exponent, part = np.arange(31 - _OCTAVES, 31)[:, None], np.arange(1 << bits)
    index = ((exponent + _BIAS << bits) + part).ravel()
    start = np.append(part + (1 << bits) << exponent - bits, _WHOLE // 2)
    first = np.concatenate([start[:-1], _WHOLE - start[:0:-1]])
    after = np.concatenate([start[1:], _WHOLE - start[-2::-1]])
    return np.concatenate([index, index[::-1] - (_SIGN << bits)]), first, after


def _fill_cells(ends: IndexArray, bits: int) -> tuple[Numbers, float]:
    """Return the entries, shape (levels, cells), and the mean fraction of numbers without one.

    ``ends``, shape (levels, greys - 1), are the numbers after the last of each grey level.
    """
    _, first, after = _cells(bits)
    lowest = (ends == 0).sum(axis=1)[:, None]
    span = int(((ends < _WHOLE).sum(axis=1) - lowest[:, 0]).max()) + 1
    ranks = np.minimum(lowest + np.arange(span + 1), ends.shape[1])
    own = np.take_along_axis(np.pad(ends, ((0, 0), (0, 1)), constant_values=_WHOLE), ranks, axis=1)
    starts = _starts(len(own))
    rank = np.searchsorted((own + starts).ravel(), (first + starts).ravel(), side="right")
    rank = np.minimum(rank.reshape(len(own), -1) - np.arange(len(own))[:, None] * (span + 1), span)
    end = np.take_along_axis(own, rank, axis=1)
    next_end = np.take_along_axis(own, np.minimum(rank + 1, span), axis=1)
    is_several = (end < after) & (next_end < after)
    grey = np.minimum(rank + lowest, ends.shape[1])
    bound = np.clip(np.rint((end - 1 - grey) / GREYS), 0, _WHOLE // GREYS - 1).astype(np.int64)
    entries = np.where(is_several, _SEVERAL, bound * GREYS + grey).astype(np.uint32)
    return entries, float((is_several @ (after - first)).mean() / _WHOLE)


@lru_cache(maxsize=4)
def grey_table(law: GreyLaw) -> GreyTable:
    """Return a law's table, cached."""
    return GreyTable(law)
