"""How surely the ends of a working range are known.

An end lies between a value beyond it that surely fails and a value inside that is surely read:
their 95 % intervals lie on either side of the required rate. At a rate of 99 % the latter takes
381 images, all of them read. So values inside are tried in growing steps from the end, each until a
first image is not read. The search has found a value that fails in twenty images, which is far out
where the rate falls slowly: values between it and the end are tried with more images, each until it
is refuted that the rate is reached there. More pictures in between narrow the end down.

The bits of a picture are lost together, so that pictures are the trials. Outward, the odds that one
is lost are taken to grow as

o(u) = o_0 (1 + b (u - u_0) / m)^m, and to be nothing where the base is negative,

with the logarithm u of the value, u_0 that of the end, and the odds o_0 at the required rate. The
power m tells how losses set in: suddenly (1/2), linearly (1), accelerating (2, 4), or logistically
(infinite). An end is in the interval if, with the slope b and the power m that suit it best, it is
not refuted by the ratio of its likelihood to the greatest of all (S. S. Wilks, Ann. Math. Statist.
9 (1938) 60). A lost picture may lose a part of its bits alone: it counts as one by what it loses
over what lost pictures lose, (sum of squares) / sum.
"""

import math
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice, starmap, takewhile

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.parallel.job import Heartbeat
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.confidence import TWO_SIDED, trial_of
from occ_model.study.working_range import END_RATIO, Images, moved, right_bits_at

MOST_IMAGES = 1000  # maximum at a value inside an end; a rate above 99.6 % would take more
OUTSIDE = 200  # maximum images at a value beyond an end
_ROUNDS, _PARTS, PICTURES = 2, (0.125, 0.375, 0.625, 0.875), 25
"""Pictures at parts of what is left of an interval, in rounds."""

_REFUTING_PROBABILITY = 0.025  # of wrongly refuting a rate: one side of a 95 % interval
_STAKES = (0.03, 0.1, 0.3)  # of the betting test, of the maximum: small ones detect small deficits


def images_to_be_sure(rate: float) -> int:
    """Return how many images show a rate in percent if all are read; 0 where too many would.

    The lower end of the interval of n images is n / (n + z^2).
    """
    fraction = rate / 100.0
    if fraction >= 1.0:
        return 0
    least = math.floor(fraction * TWO_SIDED**2 / (1.0 - fraction)) + 1
    return least if least <= MOST_IMAGES else 0


def images_about_an_end(rate: float) -> int:
    """Return how many images the confidence of an end usually takes."""
    sure = images_to_be_sure(rate)
    return sure and sure + _ROUNDS * len(_PARTS) * PICTURES


def pairs_of(found: WorkingRange) -> list[tuple[RangeEnd, RangeEnd]]:
    """Return each end of a range's intervals, with the other end of its interval."""
    return [
        pair
        for each in found.intervals
        for pair in ((each.lowest, each.highest), (each.highest, each.lowest))
    ]


def with_ends(found: WorkingRange, ends: Sequence[RangeEnd]) -> WorkingRange:
    """Return a range with other ends, in the order of :func:`pairs_of`."""
    intervals = starmap(ReadInterval, zip(ends[::2], ends[1::2], strict=True))
    return replace(found, intervals=tuple(intervals))


def sure_end(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    ends: tuple[RangeEnd, RangeEnd],
    heartbeat: Heartbeat,
) -> RangeEnd:
    """Find values on both sides of the first end that are sure, and its interval."""
    end, other = ends
    images = images_to_be_sure(rate)
    if not images or end.fails is None or not end.is_bisected:
        return end
    own = replace(settings, images=max(images, settings.images))
    taken = _Pictures(scene, name, own, heartbeat)
    inside = _inside(taken, end.value, other.value)
    fails = _outside(taken, end.value, end.fails, rate)
    known = replace(end, inside=inside, fails=fails)
    if inside is None:
        return known
    return replace(known, interval=_interval(taken, rate, inside.value, fails.value))


class _Pictures:
    """What is read in pictures at values about an end, others at each value.

    Pictures of one seed begin at the same parts of a packet, and are lost together.
    """

    def __init__(
        self, scene: Scene, name: str, settings: RateSettings, heartbeat: Heartbeat
    ) -> None:
        self.bits = scene.transmitter.payload_length
        self.most = settings.images
        self._scene, self._name = scene, name
        self._settings, self._heartbeat = settings, heartbeat
        self._at: dict[float, Images] = {}

    def at(self, value: float) -> Images:
        """Return the right bits of each picture at a value."""
        if value not in self._at:
            own = replace(self._settings, seed=_seed_at(value, self._settings.seed))
            coming = right_bits_at(self._scene, self._name, value, own, self._heartbeat)
            self._at[value] = Images(coming)
        return self._at[value]

    def lost(self) -> dict[float, list[float]]:
        """Return the fractions of bits that were lost, by the value."""
        return {
            value: [1.0 - right / self.bits for right in images.seen]
            for value, images in self._at.items()
        }


def _seed_at(value: float, seed: int) -> int:
    return int(np.random.SeedSequence([seed, 2, *value.as_integer_ratio()]).generate_state(1)[0])


def _inside(taken: _Pictures, end: float, other: float) -> Trial | None:
    """Find the value nearest to an end of which every image is read."""
    value, step = end, END_RATIO
    while value != other:
        value, step = moved(value, other, step), step * step
        read = list(takewhile(lambda right: right == taken.bits, taken.at(value)))
        if len(read) == taken.most:
            return trial_of(value, read, taken.bits)
    return None


def _outside(taken: _Pictures, end: float, fails: Trial, rate: float) -> Trial:
    """Halve the distance from an end to a value that fails, as long as the rate is refuted."""
    while True:
        low, high = sorted((end, fails.value))
        value = _between(low, high, 0.5)
        if high / low <= END_RATIO * END_RATIO or value in (low, high):
            return fails
        refuting = until_refuted(islice(taken.at(value), OUTSIDE), taken.bits, rate / 100.0)
        trial = refuting and trial_of(value, refuting, taken.bits)
        if not trial or trial.high >= rate:
            return fails
        fails = trial


def _interval(taken: _Pictures, rate: float, inside: float, outside: float) -> tuple[float, float]:
    """Take pictures between two values, nearer to the end each time, and return its interval."""
    first, last = inside, outside
    for _ in range(_ROUNDS):
        for part in _PARTS:
            deque(islice(taken.at(_between(first, last, part)), PICTURES), maxlen=0)
        first, last = interval_of_end(taken.lost(), rate, inside, outside)
    low, high = sorted((first, last))
    return low, high


def _between(first: float, last: float, part: float) -> float:
    return float(f"{first * (last / first) ** part:.5g}")


def until_refuted(counts: Iterable[int], bits: int, least: float) -> list[int] | None:
    """Count right bits until they refute that a fraction of them is read; None if they do not.

    Whoever stakes on each image that less is read, at odds that are fair if the fraction is
    reached, has c times the first stake at any time with a chance of at most 1 / c (J. Ville,
    *Etude critique de la notion de collectif*, 1939): the images may be ended by their own result.
    """
    wealth, seen = [1.0] * len(_STAKES), []
    for right in counts:
        seen.append(right)
        won = (least - right / bits) / (1.0 - least)
        wealth = [had * (1.0 + stake * won) for had, stake in zip(wealth, _STAKES, strict=True)]
        if sum(wealth) * _REFUTING_PROBABILITY >= len(_STAKES):
            return seen
    return None


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
