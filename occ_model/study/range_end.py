"""Find an end of a working range, with its 95 % interval.

An end is where the success rate crosses the required rate. Pictures narrow it down, then it is
sought between a value at which many pictures are read without a wrong bit and the next one beyond
at which pictures refute the rate. Pictures in between narrow the interval. The bits of a picture
are lost together, so the pictures are the trials. The odds of losing one are modelled as

o(u) = o_0 (1 + b (u - u_0) / m)^m, growing outwards,

with u the logarithm of the value, u_0 that of the end, and o_0 the odds at the required rate. The
power m describes how losses set in: suddenly (1), logistically (infinite), or with a longer tail
inside the end (-4, -2). How steeply they do is unknown, and a second cause may soon add losses: in
half of the curves, the rates beyond a cliff anywhere outside the end follow no law, and each is
evenly likely. The end's probability is the mean of its likelihood over all slopes b, evenly in
their logarithm, over the powers, and over no cliff and all cliffs; the interval leaves 2.5 % of it
on each side. Unlike the curve that fits best, the mean counts what few pictures leave open. Values
beyond the first that refutes the rate are left out, as the curve need not hold there.
A picture may lose only some of its bits: it then counts as the fraction that it loses, divided by
the typical fraction of lost pictures, (sum of squares) / sum.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import lgamma
from typing import TypeAlias

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.study.confidence import count_until_refuted

END_RATIO = 1.003  # ratio of an interval's ends at which no more pictures narrow it
_WIDE_RATIO = 1.02  # ratio above which more pictures are taken where all are read
_PARTS = (0.125, 0.375, 0.625, 0.875)  # places within an interval at which pictures narrow it
_ROUNDS = 3  # times an interval is narrowed at these places
_LEAST_IMAGES = 5  # fewest pictures at a value
_MOST_OUTSIDE = 100  # most pictures at a value beyond an end
MOST_PROVEN = 99.6  # largest rate in percent of which an end has an interval
_LEAST_LOST_FRACTION = 1.0 - MOST_PROVEN / 100.0

Measure: TypeAlias = Callable[[Sequence[float], int], Iterable[list[float]]]
"""Return the fractions of lost bits in so many further pictures at each value."""


@dataclass(frozen=True, slots=True)
class Bracket:
    """Neighbouring values of a scan between which reading ends."""

    read: float
    lost: float
    innermost: float  # The last value inside that is read
    outermost: float  # The last value beyond that is not read


@dataclass(frozen=True, slots=True)
class FoundEnd:
    interval: tuple[float, float]  # The 95 % interval, its limit nearer to the range first
    sure: float  # A value inside at which no picture lost a bit
    refuted: float  # A value beyond at which pictures refute the rate


def images_to_prove(rate: float) -> int:
    """Return how many pictures without a wrong bit prove a rate in percent with 95 % confidence."""
    fraction = 1.0 - max(1.0 - rate / 100.0, _LEAST_LOST_FRACTION)
    return math.ceil(math.log(0.05) / math.log(fraction))


class EndSearch:
    """A search for ends of one decoder's ranges; pictures are kept by the value they show."""

    def __init__(self, measure: Measure, rate: float, images: int) -> None:
        self._measure, self._rate = measure, rate
        self._each = max(images // 2, _LEAST_IMAGES)
        self._proof = max(images_to_prove(rate), 5 * images)
        self.lost: dict[float, list[float]] = {}
        """The fractions of lost bits by value."""

    def take(self, values: Sequence[float], count: int) -> None:
        for value, lost in zip(values, self._measure(values, count), strict=True):
            self.lost.setdefault(value, []).extend(lost)

    def find(self, bracket: Bracket) -> FoundEnd | None:
        """Find an end; None if there is no value inside at which all pictures are read."""
        inside = self._narrow(bracket.read, bracket.lost)
        sure = self._find_sure(inside, bracket.innermost, self._proof // 3)
        for count in range(_ROUNDS + 2):
            if sure is None:
                break
            refuted = self._find_refuted(sure, bracket)
            interval = interval_of_end(self.lost, self._rate, sure, refuted)
            ratio = _ratio(*interval)
            if ratio <= (_WIDE_RATIO if count == _ROUNDS else END_RATIO) or count > _ROUNDS:
                inner = sorted((interval[0], bracket.innermost, bracket.outermost))[1]
                return FoundEnd((inner, interval[1]), sure, refuted)
            if count == _ROUNDS:
                sure = self._find_sure(sure, bracket.innermost, self._proof)
            else:
                self.take([between(*interval, part) for part in _PARTS], self._each)
        return None

    def _narrow(self, inside: float, outside: float) -> float:
        """Return the last of some values before pictures are lost, found with few of them."""
        for _ in range(2):
            if _ratio(inside, outside) <= END_RATIO:
                break
            values = [between(inside, outside, part) for part in (0.25, 0.5, 0.75)]
            self.take(values, _LEAST_IMAGES)
            for value in values:
                if any(self.lost[value]):
                    outside = value
                    break
                inside = value
        return inside

    def _find_sure(self, value: float, innermost: float, images: int) -> float | None:
        """Return the nearest value inside an end at which so many pictures are all read."""
        step = END_RATIO
        while True:
            lost, at_once = self.lost.setdefault(value, []), self._each
            while len(lost) < images and not any(lost):
                self.take([value], min(at_once, images - len(lost)))
                at_once *= 4
            if not any(lost):
                return value
            if value == innermost:
                return None
            value, step = move_towards(value, innermost, step), step * step

    def _find_refuted(self, sure: float, bracket: Bracket) -> float:
        """Return the nearest value beyond an end at which pictures refute the rate.

        It is the last value that is not read if they do so nowhere.
        """
        direction = math.copysign(1.0, bracket.lost - bracket.read)
        for value in sorted(self.lost, key=lambda value: direction * value):
            if direction * (value - sure) > 0.0 and self._is_refuted(value):
                return value
        value, step = bracket.lost, _ratio(bracket.read, bracket.lost)
        while True:
            while len(self.lost.setdefault(value, [])) < _MOST_OUTSIDE:
                self.take([value], 2 * self._each)
                if self._is_refuted(value):
                    return value
            if value == bracket.outermost:
                return value
            value, step = move_towards(value, bracket.outermost, step), step * step

    def _is_refuted(self, value: float) -> bool:
        right = (1.0 - lost for lost in self.lost[value])
        return count_until_refuted(right, 1, self._rate / 100.0) is not None


def between(first: float, last: float, part: float) -> float:
    """Return a value at a part of the way between two others, by ratio, of few digits."""
    return float(f"{first * (last / first) ** part:.5g}")


def move_towards(value: float, end: float, ratio: float) -> float:
    """Move a value towards an end by a ratio, but not beyond the end."""
    moved = value * ratio if end > value else value / ratio
    moved = float(f"{moved:.5g}")
    return end if (moved - end) * (value - end) <= 0.0 else moved


def _ratio(first: float, last: float) -> float:
    return max(first, last) / min(first, last)


_POWERS = (1.0, math.inf, -4.0, -2.0)
_SLOPES: FloatArray = np.geomspace(0.3, 1e3, 20)  # growth of the log-odds over the bracket
_ENDS = 81  # values to try: those within the bracket, and as many inside it
_LEAST_BASE = 1e-9  # replaces the bases of powers that are not positive
_TAIL = 0.025  # probability on each side of the interval


def interval_of_end(
    lost: dict[float, list[float]], rate: float, inside: float, outside: float
) -> tuple[float, float]:
    """Return the 95 % interval of an end about two values, its limit nearer to the range first.

    Parameters
    ----------
    lost
        The fractions of lost bits in the pictures at each value; those beyond ``outside`` are not
        used.
    rate
        The success rate in percent that is reached inside.
    inside, outside
        The end is before the second value, and beyond the first by their logarithmic distance at
        most.
    """
    width = math.log(outside / inside)
    within = {
        math.log(value / inside) / width: pictures
        for value, pictures in sorted(lost.items(), reverse=outside < inside)
        if pictures and (value - outside) * (outside - inside) <= 0.0
    }
    fractions = np.concatenate([np.asarray(pictures) for pictures in within.values()])
    typical_fraction = float((fractions**2).sum() / fractions.sum()) if fractions.any() else 1.0
    images = np.array([float(len(pictures)) for pictures in within.values()])
    images_lost = np.array([math.fsum(each) for each in within.values()]) / typical_fraction
    at_end = max(1.0 - rate / 100.0, _LEAST_LOST_FRACTION) / typical_fraction
    ends = np.linspace(-1.0, 1.0, _ENDS)
    likelihood = _likelihoods(
        np.array(list(within)) - ends[:, None], images, np.minimum(images_lost, images),
        min(at_end, 1.0 - _LEAST_LOST_FRACTION),
    )  # fmt: skip
    cumulated = np.cumsum(likelihood) / likelihood.sum()
    # One step outwards, because the limit of the interval lies between two ends that were tried.
    first = max(int(np.searchsorted(cumulated, _TAIL)) - 1, 0)
    last = min(int(np.searchsorted(cumulated, 1.0 - _TAIL)) + 1, _ENDS - 1)
    low, high = (inside * math.exp(width * float(ends[index])) for index in (first, last))
    return low, high


def _likelihoods(
    distances: FloatArray, images: FloatArray, images_lost: FloatArray, at_end: float
) -> FloatArray:
    """Return each end's likelihood, the mean over all curves, up to a common factor.

    ``distances``, shape (ends, values), rising: of each value from each end. ``at_end``: fraction
    of the images that are lost at the end.
    """
    log_odds_at_end = math.log(at_end / (1.0 - at_end))
    scaled = _SLOPES[:, None, None] * distances
    beyond_cliff = _log_mean_likelihoods(images, images_lost)
    after_each = np.append(np.cumsum(beyond_cliff[:0:-1])[::-1], 0.0)
    log_weights = _log_weights_of_cliffs(distances)
    logarithms = []
    for power in _POWERS:
        increase = scaled
        if math.isfinite(power):
            increase = power * np.log(np.maximum(1.0 + scaled / power, _LEAST_BASE))
        log_odds = log_odds_at_end + increase
        log_read = -np.logaddexp(0.0, log_odds)
        up_to_each = np.cumsum(images_lost * log_odds + images * log_read, axis=2)
        logarithms.append(up_to_each + after_each + log_weights)
    every = np.concatenate(logarithms)
    return np.asarray(np.exp(every - every.max()).sum(axis=(0, 2)))


def _log_weights_of_cliffs(distances: FloatArray) -> FloatArray:
    """Return, for each end, the logarithm of the fraction of curves with a cliff after each value.

    Cliffs are evenly spread over the values' range. Half of the curves have none before its end.
    """
    gaps = np.diff(distances[0])
    is_outside = distances[:, 1:] >= 0.0
    weights = np.full(distances.shape, 0.5)
    weights[:, :-1] = 0.5 * is_outside * gaps / gaps.sum()
    return np.asarray(np.log(np.maximum(weights, np.finfo(float).tiny)))


def _log_mean_likelihoods(images: FloatArray, images_lost: FloatArray) -> FloatArray:
    """Return the logarithm of the mean likelihood over all rates: Euler's beta function."""
    counts = zip(images.tolist(), images_lost.tolist(), strict=True)
    return np.array([
        lgamma(lost + 1.0) + lgamma(count - lost + 1.0) - lgamma(count + 2.0)
        for count, lost in counts
    ])  # fmt: skip
