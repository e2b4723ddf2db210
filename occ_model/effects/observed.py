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
        Gives what is observed with some of them, each value times the root of its weight.

    Attributes
    ----------
    alone
        The mean square of what is independent in an effect's change, by name.
    doubt
        The mean square of what the sample may not show of it, by name.
    unsure
        Share by which any mean square may be larger.
    """

    def __init__(self, names: frozenset[str], seen: Callable[[frozenset[str]], FloatArray]) -> None:
        self._names = names
        self._seen = seen
        self.alone: dict[str, float] = {}
        self.doubt: dict[str, float] = {}
        self.unsure = 0.0
        self.complete = seen(names)
        self._moved = {name: self.complete - seen(names - {name}) for name in sorted(names)}

    def together(self, left_out: frozenset[str]) -> float:
        """Return the mean square of what leaving out some effects together changes."""
        if not left_out:
            return 0.0
        if len(left_out) == 1:
            (name,) = left_out
            change = self._moved[name]
        else:
            change = self.complete - self._seen(self._names - left_out)
        independent = sum(self.alone.get(name, 0.0) for name in left_out)
        doubt = max(self.doubt.get(name, 0.0) for name in left_out)
        return max(float(change @ change) + independent, 0.0) * (1.0 + self.unsure) + doubt

    def of_subsets(self, names: Sequence[str], members: FloatArray) -> FloatArray:
        """Return about the same for many sets of effects, as if their changes added.

        Parameters
        ----------
        names
            Effects.
        members : ndarray of float64, shape (sets, effects)
            1 where a set has an effect.
        """
        moved = np.stack([self._moved[name] for name in names])
        alone = np.array([self.alone.get(name, 0.0) for name in names])
        doubt = np.array([self.doubt.get(name, 0.0) for name in names])
        products = moved @ moved.T
        squares = np.einsum("si,ij,sj->s", members, products, members, optimize=True)
        sure = np.maximum(squares + members @ alone, 0.0)
        return np.asarray(sure * (1.0 + self.unsure) + (members * doubt).max(axis=1))
