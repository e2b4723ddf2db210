"""The observable of a sample of pixels, and its changes without some of the effects."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from occ_model.arrays import FloatArray

LIMIT_ALLOWANCE = 1.3
"""Factor from the change that a sample shows to its limit, which keeps a plan's promise."""

_SURE_DEVIATIONS = 3.5
"""Standard deviations by which the root mean square of finite noise may exceed its expectation."""


class Observed:
    """The observable of a sample, and its changes without some of the effects.

    What is the same in every picture adds with its sign; what noise and a file's rounding change is
    independent, and its mean squares add.
    """

    def __init__(
        self,
        names: frozenset[str],
        seen: Callable[[Sequence[frozenset[str]]], FloatArray],
        changing: Sequence[str],
    ) -> None:
        """Observe all effects, and without each that changes the observable.

        ``seen`` returns values times the roots of their weights, (sets, values), for sets of
        effects.
        """
        self._names = names
        self._seen = seen
        self._place = {name: at for at, name in enumerate(changing)}
        self.alone: dict[str, float] = {}
        """Mean square of the independent part of an effect's change."""
        self.doubt: dict[str, float] = {}
        """Mean square of what the sample may not show of an effect."""
        self.known: dict[str, float] = {}
        """Factor on the root of ``alone`` for the largest change, where its law is known."""
        self.unsure = 0.0  # fraction by which any mean square may be larger
        found = seen([names, *(names - {name} for name in changing)])
        self.complete = found[0]
        self._moved = moved = found[1:] - found[0]
        self._products = moved @ moved.T

    def add_noise(self, squares: Mapping[str, float], values: int) -> None:
        """Add the mean squares of noise whose law is known, over so many independent values.

        The root mean square of n normal numbers deviates by 1 / sqrt(2 n) of theirs.
        """
        self.alone.update(squares)
        self.known.update(dict.fromkeys(squares, 1.0 + _SURE_DEVIATIONS / math.sqrt(2.0 * values)))

    def add_doubt(self, names: Iterable[str], square: float) -> None:
        """Add a mean square that the sample may not show, to some effects."""
        for name in names:
            self.doubt[name] = self.doubt.get(name, 0.0) + square

    def shown(self, name: str) -> float:
        """Return the mean square of an effect's change, as the sample shows it."""
        place = self._place.get(name)
        square = 0.0 if place is None else float(self._products[place, place])
        return max(square + self.alone.get(name, 0.0), 0.0)

    def sampling_error(self, name: str, values: int) -> float:
        """Return the standard error of :meth:`shown` where the sample is a part of ``values``."""
        squares = self._moved[self._place[name]] ** 2
        left = max(1.0 - len(squares) / values, 0.0)
        return math.sqrt(left * float((squares**2).sum()))

    def together(self, sets: Sequence[frozenset[str]]) -> FloatArray:
        """Return the largest mean squares of changes by leaving out sets of effects."""
        moved = [
            [self._place[name] for name in left_out if name in self._place] for left_out in sets
        ]
        squares = np.array([self._products[places, places].sum() for places in moved])
        several = [at for at, places in enumerate(moved) if len(places) > 1]
        if several:
            changes = self._seen([self._names - sets[at] for at in several]) - self.complete
            squares[several] = np.einsum("sv,sv->s", changes, changes)
        names = sorted(self._names)
        members = np.array([[float(name in left_out) for name in names] for left_out in sets])
        return self._most(names, members, squares)

    def of_subsets(self, names: Sequence[str], members: FloatArray) -> FloatArray:
        """Return about :meth:`together` for many sets of effects, as if their changes added.

        ``members``: 1 where a set has an effect, shape (sets, effects).
        """
        moving = [at for at, name in enumerate(names) if name in self._place]
        places = [self._place[names[at]] for at in moving]
        moved = members[:, moving]
        squares = ((moved @ self._products[np.ix_(places, places)]) * moved).sum(axis=1)
        return self._most(names, members, squares)

    def _most(self, names: Sequence[str], members: FloatArray, squares: FloatArray) -> FloatArray:
        """Add to mean squares the independent and the doubtful ones, with the allowances."""
        alone = np.array([self.alone.get(name, 0.0) for name in names])
        known = np.array([self.known.get(name, 0.0) for name in names])
        doubt = np.array([self.doubt.get(name, 0.0) for name in names])
        # Sums along rows, which are the same for one set and for many: a product's need not be.
        sure = squares + (members * np.where(known, 0.0, alone)).sum(axis=1)
        most = np.maximum(sure, 0.0) * (1.0 + self.unsure)
        most += (members * doubt).max(axis=1, initial=0.0)
        return np.asarray(most * LIMIT_ALLOWANCE**2 + (members * alone * known**2).sum(axis=1))
