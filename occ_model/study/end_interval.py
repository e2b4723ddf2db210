"""The 95 % interval of an end of a working range, from what is lost in pictures about it.

The bits of a picture are lost together, so that pictures are the trials. Outward, the odds that one
is lost are taken to grow as

o(u) = o_0 (1 + b (u - u_0) / m)^m, and to be nothing where the base is negative,

with the logarithm u of the value, u_0 that of the end, and the odds o_0 at the rate asked for. The
power m tells how losses set in: suddenly (1/2), linearly (1), accelerating (2, 4), or logistically
(infinite). An end is in the interval if, with the slope b and the power m that suit it best, it is
not refuted by the ratio of its likelihood to the greatest of all (S. S. Wilks, Ann. Math. Statist.
9 (1938) 60). A lost picture may lose a part of its bits alone: it counts as one by what it loses
over what lost pictures lose, (sum of squares) / sum.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from occ_model.arrays import FloatArray

_POWERS = (0.5, 1.0, 2.0, 4.0, math.inf)

_ENDS, _SLOPES = 81, 32  # ends and slopes that are tried
_FLATTEST, _STEEPEST = 0.3, 1e5  # of the log-odds at the end, over the whole bracket
_MAX_LOST_FRACTION = 0.999  # of pictures at the end, where each loses no more than the rate allows


def interval_of_end(
    lost: Mapping[float, Sequence[float]], rate: float, inside: float, outside: float
) -> tuple[float, float]:
    """Return the 95 % interval of an end, between two values, the nearer to ``inside`` first.

    ``lost``: the fraction of bits lost in each picture, by value; ``rate``: the success
    rate in percent that is reached inside.
    """
    direction = math.copysign(1.0, outside - inside)
    span = abs(math.log(outside / inside))
    tried = direction * np.log(np.array(list(lost)) / inside)
    each = np.concatenate([np.asarray(part, dtype=float) for part in lost.values()])
    of_one = float((each**2).sum() / each.sum()) if each.any() else 1.0
    pictures = np.array([float(len(part)) for part in lost.values()])
    gone = np.array([math.fsum(part) for part in lost.values()]) / of_one
    ends = np.linspace(0.0, span, _ENDS)
    likelihood = _likelihoods(
        tried - ends[:, None], pictures, np.minimum(gone, pictures),
        min((1.0 - rate / 100.0) / of_one, _MAX_LOST_FRACTION), span,
    )  # fmt: skip
    ratio = 2.0 * (likelihood.max() - likelihood)
    kept = np.flatnonzero(ratio <= _deviate(int(np.count_nonzero(each))) ** 2)
    # Outward by a step, as the end of the interval lies between two that were tried.
    first, last = ends[max(kept[0] - 1, 0)], ends[min(kept[-1] + 1, _ENDS - 1)]
    return inside * math.exp(direction * first), inside * math.exp(direction * last)


def _likelihoods(
    beyond: FloatArray, pictures: FloatArray, gone: FloatArray, fraction: float, span: float
) -> FloatArray:
    """Return the logarithm of each end's greatest likelihood.

    ``beyond``, shape (ends, values): log distance of values from an end. ``gone``: lost pictures at
    each value. ``fraction``: of the pictures that are lost at the end.
    """
    at_end = math.log(fraction / (1.0 - fraction))
    scaled = np.geomspace(_FLATTEST, _STEEPEST, _SLOPES)[:, None] / span * beyond[:, None]
    best = np.full(len(beyond), -np.inf)
    for power in _POWERS:
        grown = scaled
        if math.isfinite(power):
            with np.errstate(divide="ignore"):
                grown = power * np.log(np.maximum(1.0 + scaled / power, 0.0))
        kept = -np.logaddexp(0.0, at_end + grown)
        with np.errstate(invalid="ignore"):  # nothing is lost where nothing can be
            of_gone = np.where(gone > 0.0, gone * (at_end + grown + kept), 0.0)
        found = (of_gone + (pictures - gone) * kept).sum(axis=2).max(axis=1)
        best = np.maximum(best, found)
    return best


def _deviate(pictures: int) -> float:
    """Return Student's deviate that 95 % lie within, of so many pictures less two."""
    from scipy.special import stdtrit  # slow to import

    return float(stdtrit(max(pictures - 2, 2), 0.975))
