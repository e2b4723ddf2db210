"""The observable of a sample of pixels, and its change without some of the effects."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

LIMIT_ALLOWANCE = 1.3
"""Factor from the change in the sample to the upper bound of the true change."""

SURE_DEVIATIONS = 3.5
"""Standard deviations by which the mean square of few random values may exceed its mean."""


@dataclass(frozen=True, slots=True)
class RandomSquare:
    """The mean square change of pixels that move by whole grey levels at random."""

    mean: float = 0.0
    mean_of_squares: float = 0.0  # Mean over the pixels of the square of each one's mean square
    mean_fourth: float = 0.0  # Mean fourth power of the changes

    def doubt(self, values: int, pixels: int = 1) -> float:
        """Return how far it may be exceeded in one picture of ``values``.

        Each of these is the mean of some ``pixels``.
        """
        variance = 2.0 * self.mean_of_squares + self.mean_fourth / pixels
        return SURE_DEVIATIONS * math.sqrt(variance / values) / pixels

    def relative_doubt(self, values: int, pixels: int = 1) -> float:
        """Return :meth:`doubt` as a fraction of the mean."""
        return self.doubt(values, pixels) * pixels / self.mean if self.mean else 0.0


class SampledObservable:
    """The observable of a sample, and its change without some of the effects.

    Changes that are the same in every picture add with their signs. Changes by noise and by a
    file's rounding are independent, so that their mean squares add.
    """

    def __init__(
        self,
        names: frozenset[str],
        observe: Callable[[Sequence[frozenset[str]]], FloatArray],
        changing: Sequence[str],
    ) -> None:
        """Observe the sample with all effects, and without each of ``changing``.

        ``observe`` maps sets of effects to the observed values times the square roots of their
        weights, (sets, values).
        """
        self._names = names
        self._observe = observe
        self._place = {name: at for at, name in enumerate(changing)}
        self.independent: dict[str, float] = {}
        """Mean square of the independent part of each effect's change."""
        self.doubt: dict[str, float] = {}
        """Mean square of each effect's change that the sample may have missed."""
        self.bound_factors: dict[str, float] = {}
        """Factor from the root of ``independent`` to its upper bound, for noise of a known law."""
        self.uncertainty = 0.0  # relative amount by which any mean square may be larger
        values = observe([names, *(names - {name} for name in changing)])
        self.complete = values[0]
        self._moved = moved = values[1:] - values[0]
        self._products = moved @ moved.T

    def add_doubt(self, names: Iterable[str], square: float) -> None:
        """Add a mean square that the sample may have missed to each of some effects."""
        for name in names:
            self.doubt[name] = self.doubt.get(name, 0.0) + square

    def sampled_square(self, name: str) -> float:
        """Return the mean square of the sample's change without an effect."""
        place = self._place.get(name)
        square = 0.0 if place is None else float(self._products[place, place])
        return max(square + self.independent.get(name, 0.0), 0.0)

    def sampling_error(self, name: str, values: int) -> float:
        """Return the standard error of :meth:`sampled_square` as a mean over ``values``."""
        squares = self._moved[self._place[name]] ** 2
        unsampled = max(1.0 - len(squares) / values, 0.0)
        return math.sqrt(unsampled * float((squares**2).sum()))

    def largest_squares(self, sets: Sequence[frozenset[str]]) -> FloatArray:
        """Return upper bounds of the mean square changes without each set of effects."""
        places_of_sets = [
            [self._place[name] for name in left_out if name in self._place] for left_out in sets
        ]
        squares = np.array([self._products[places, places].sum() for places in places_of_sets])
        larger_sets = [at for at, places in enumerate(places_of_sets) if len(places) > 1]
        if larger_sets:
            changes = self._observe([self._names - sets[at] for at in larger_sets]) - self.complete
            squares[larger_sets] = np.einsum("sv,sv->s", changes, changes)
        names = sorted(self._names)
        members = np.array([[float(name in left_out) for name in names] for left_out in sets])
        return self._add_allowances(names, members, squares)

    def largest_squares_if_added(self, names: Sequence[str], members: FloatArray) -> FloatArray:
        """Approximate :meth:`largest_squares` for many sets, assuming that changes add.

        ``members`` is 1 where a set has an effect, shape (sets, effects).
        """
        moving = [at for at, name in enumerate(names) if name in self._place]
        places = [self._place[names[at]] for at in moving]
        subset = members[:, moving]
        squares = ((subset @ self._products[np.ix_(places, places)]) * subset).sum(axis=1)
        return self._add_allowances(names, members, squares)

    def _add_allowances(
        self, names: Sequence[str], members: FloatArray, squares: FloatArray
    ) -> FloatArray:
        """Add the independent and the possibly missed changes to mean squares, with allowances."""
        independent = np.array([self.independent.get(name, 0.0) for name in names])
        factors = np.array([self.bound_factors.get(name, 0.0) for name in names])
        doubt = np.array([self.doubt.get(name, 0.0) for name in names])
        # A sum along rows is the same for one set and for many, which a matrix product need not be.
        sampled = squares + (members * np.where(factors, 0.0, independent)).sum(axis=1)
        bounds = np.maximum(sampled, 0.0) * (1.0 + self.uncertainty)
        bounds += (members * doubt).max(axis=1, initial=0.0)
        return np.asarray(
            bounds * LIMIT_ALLOWANCE**2 + (members * independent * factors**2).sum(axis=1)
        )
