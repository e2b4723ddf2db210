"""What makes the pixels of pictures differ: uniform numbers, dither, and the sensor's gains."""

from collections.abc import Iterator
from functools import lru_cache
from statistics import NormalDist

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.row_memory import MEMORY
from occ_model.simulation.grey_table import Numbers


class PictureNumbers:
    """A picture's uniform numbers, which depend on the seed and a pixel's place alone."""

    def __init__(self, seed: int, columns: int) -> None:
        self._seed = np.random.SeedSequence(seed, spawn_key=(1,))
        self._columns = columns

    def of(self, rows: range, height: int) -> Iterator[Numbers]:
        """Yield the numbers of some rows, ``height`` of them at a time."""
        words = -(-self._columns // 2)
        source = np.random.PCG64(self._seed)
        source.advance(rows.start * words)

        def draw(count: int) -> NDArray[np.uint64]:
            return np.asarray(source.random_raw(count * words)).reshape(count, words)

        def draw_each() -> NDArray[np.uint64]:
            drawn = np.empty((len(rows), words), dtype=np.uint64)
            for row in drawn:
                row[:] = draw(1)
                source.advance((rows.step - 1) * words)
            return drawn

        starts = range(0, len(rows), height)
        parts = (draw(min(height, len(rows) - start)) for start in starts)
        if rows.step > 1:  # the next draft has the same
            key = "numbers", self._seed.entropy, words, rows
            each = MEMORY.recall(key, draw_each, lambda drawn: (drawn,))
            parts = (each[start : start + height] for start in starts)
        for part in parts:
            yield part.view(np.uint32)[:, : self._columns]


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

    def column_means(self, first_row: int, last_row: int) -> FloatArray:
        """Return the means over some rows of the powers of the gains, shape (columns,)."""
        rows = self._plane[first_row:last_row]
        total = cv2.reduce(rows, 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)[0]
        return np.asarray(total * (float(self.step) / len(rows)))


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
