"""The profile of a lamp in a photo, which the model is fitted to."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occ_model.arrays import BoolArray, FloatArray

_CLIPPED = 0.98  # least value of a clipped sample, as a fraction of white
_CLIPPED_PART = 0.02  # fraction of clipped samples above which a column's mean is too dark
_GROUPS = (8, 4, 3, 2)  # lines that a sensor may read together
_MOST_STEP_RATIO = 0.35  # largest ratio of steps within groups of lines to steps between groups
_NOTABLE_STEP, _LEAST_RAMPS = 0.1, 4
"""Least ratio of a notable step to the largest one, and how many notable steps must follow another
one: edges without ramps can be whole groups apart by chance."""
_MOST_COLUMNS = 640  # columns of a profile that is fitted
_ROWS_AT_ONCE = 32  # rows that are averaged at once, to fit the processor's cache
_LEAST_PERIOD = 48.0  # columns that a period has at least after columns are averaged


@dataclass(frozen=True, eq=False)
class LampProfile:
    """Column means of a lamp's pixels, as fractions of white."""

    values: FloatArray  # Shape (columns,)
    variances: FloatArray  # Shape (columns,): of the noise of each mean
    clipped: BoolArray  # Shape (columns,): columns with clipped pixels, whose mean is too dark

    @classmethod
    def of(cls, pixels: FloatArray, shown: BoolArray) -> "LampProfile":
        """Average a lamp's pixels, shapes (rows, columns), over its rows.

        The noise is estimated from neighbouring rows, which show the same stripes.
        """
        sums, squares, whole, pairs, bright = np.zeros((5, pixels.shape[1]))
        for first in range(0, len(pixels), _ROWS_AT_ONCE):
            rows = slice(first, first + _ROWS_AT_ONCE + 1)
            part, seen = pixels[rows], shown[rows]
            both = seen[1:] & seen[:-1]
            steps = np.diff(part, axis=0) * both
            squares += np.einsum("ij,ij->j", steps, steps, dtype=np.float64)
            pairs += np.count_nonzero(both, axis=0)
            part, seen = part[:_ROWS_AT_ONCE], seen[:_ROWS_AT_ONCE]
            sums += (part * seen).sum(axis=0, dtype=np.float64)
            whole += np.count_nonzero(seen, axis=0)
            bright += np.count_nonzero(seen & (part >= _CLIPPED), axis=0)
        count = np.maximum(whole, 1.0)
        noise = squares / (2.0 * np.maximum(pairs, 1.0) * count)
        clipped = bright > _CLIPPED_PART * count
        means = sums / count
        return cls(means, np.maximum(noise, 1e-12), clipped)

    @property
    def columns(self) -> FloatArray:
        return np.arange(len(self.values), dtype=np.float64)

    @cached_property
    def swing(self) -> float:
        low, high = np.quantile(self.values, (0.05, 0.95))
        return float(high - low)

    def excess(self, levels: FloatArray) -> FloatArray:
        """Return levels less the values, 0 where a clipped column may be as bright."""
        excess = levels - self.values
        return np.where(self.clipped, np.minimum(excess, 0.0), excess)

    def lines_at_once(self) -> tuple[int, int]:
        """Return how many lines the sensor reads together, and the first that begins a group."""
        return next(
            ((count, first) for count, first, has_ramps in self._groups() if has_ramps), (1, 0)
        )

    def most_lines_at_once(self) -> int:
        """Return how many lines the sensor may read together, if edges are too sharp to tell."""
        return max((count for count, _, has_ramps in self._groups() if not has_ramps), default=1)

    def _groups(self) -> Iterator[tuple[int, int, bool]]:
        """Yield sizes of groups of lines between which the profile steps, but not within them.

        Each comes with the first line that begins a group, and with whether ramps prove it: sharp
        edges can be whole groups apart by chance.
        """
        steps = np.square(np.diff(self.values))
        for count in _GROUPS:
            if len(steps) < 8 * count:
                continue
            whole = len(steps) // count * count
            means = steps[:whole].reshape(-1, count).mean(axis=0)
            largest = int(means.argmax())
            others = np.delete(means, largest)
            between = steps[largest:whole:count]
            notable = between > _NOTABLE_STEP**2 * between.max()
            has_ramps = int(np.count_nonzero(notable[1:] & notable[:-1])) >= _LEAST_RAMPS
            if others.max() < _MOST_STEP_RATIO**2 * means[largest]:
                yield count, (largest + 1) % count, has_ramps

    def average(self, count: int, first: int) -> "LampProfile":
        """Average every ``count`` columns from the column ``first`` on."""
        if count == 1:
            return self
        whole = first + (len(self.values) - first) // count * count
        values, variances, clipped = (
            each[first:whole].reshape(-1, count)
            for each in (self.values, self.variances, self.clipped)
        )
        return LampProfile(
            values.mean(axis=1), variances.mean(axis=1) / count, np.asarray(clipped.any(axis=1))
        )

    def reduction(self, shortest: float) -> int:
        """Return how many columns can be averaged where ``shortest`` is the shortest period."""
        most = max(1, int(shortest / _LEAST_PERIOD))
        return min(most, max(1, -(-len(self.values) // _MOST_COLUMNS)))
