"""What is observed of a sample of pixels, and how it changes without some of the effects."""

from collections.abc import Callable, Sequence

import numpy as np

from occ_model.arrays import FloatArray


class Observed:
    """What is observed of a sample, and how it changes without some of the effects.

    What effects change adds as it is, with its sign, where it is the same in every picture; what
    noise and a file's rounding change is independent, and its mean squares add.

    Parameters
    ----------
    names
        All effects of the scene.
    seen
        Gives what is observed with some sets of them, each value times the root of its weight:
        shape (sets, values).
    changing
        The effects whose absence changes that.

    Attributes
    ----------
    alone
        The mean square of what is independent in an effect's change, by name.
    doubt
        The mean square of what the sample may not show of it, by name.
    unsure
        Share by which any mean square may be larger.
    """

    def __init__(
        self,
        names: frozenset[str],
        seen: Callable[[Sequence[frozenset[str]]], FloatArray],
        changing: Sequence[str],
    ) -> None:
        self._names = names
        self._seen = seen
        self._place = {name: at for at, name in enumerate(changing)}
        self.alone: dict[str, float] = {}
        self.doubt: dict[str, float] = {}
        self.unsure = 0.0
        found = seen([names, *(names - {name} for name in changing)])
        self.complete = found[0]
        moved = found[1:] - found[0]
        self._products = moved @ moved.T

    def shown(self, name: str) -> float:
        """Return the mean square of what leaving out an effect changes, as the sample shows it."""
        place = self._place.get(name)
        square = 0.0 if place is None else float(self._products[place, place])
        return max(square + self.alone.get(name, 0.0), 0.0)

    def together(self, left_out: frozenset[str]) -> float:
        """Return the most of the mean square of what leaving out some together changes."""
        if not left_out:
            return 0.0
        moved = [self._place[name] for name in left_out if name in self._place]
        if len(moved) <= 1:
            square = float(self._products[moved, moved].sum())
        else:
            change = self._seen([self._names - left_out])[0] - self.complete
            square = float(change @ change)
        independent = sum(self.alone.get(name, 0.0) for name in left_out)
        doubt = max(self.doubt.get(name, 0.0) for name in left_out)
        return max(square + independent, 0.0) * (1.0 + self.unsure) + doubt

    def of_subsets(self, names: Sequence[str], members: FloatArray) -> FloatArray:
        """Return about the same for many sets of effects, as if their changes added.

        Parameters
        ----------
        names
            Effects.
        members : ndarray of float64, shape (sets, effects)
            1 where a set has an effect.
        """
        alone = np.array([self.alone.get(name, 0.0) for name in names])
        doubt = np.array([self.doubt.get(name, 0.0) for name in names])
        moving = [at for at, name in enumerate(names) if name in self._place]
        places = [self._place[names[at]] for at in moving]
        moved = members[:, moving]
        squares = ((moved @ self._products[np.ix_(places, places)]) * moved).sum(axis=1)
        sure = np.maximum(squares + members @ alone, 0.0)
        return np.asarray(sure * (1.0 + self.unsure) + (members * doubt).max(axis=1))
