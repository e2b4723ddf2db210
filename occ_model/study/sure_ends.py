"""Compute confidence intervals of the ends of a working range.

An end lies between a value outside that fails with confidence and a value inside that is read with
confidence: their 95 % intervals lie below and above the required rate. At a rate of 99 % the value
inside takes 381 images, all of which must be read. Values inside are therefore tried in growing
steps from the end, and each is rejected at the first image that is not read. The search has found
an outer value that fails in twenty images; where the rate falls slowly, it is far from the end.
Values between the two are therefore tried with more images, until these show that the rate is not
reached. More pictures in between then narrow the interval.

The bits of a picture are lost together, so the pictures are the trials. The odds of losing a
picture are modelled as growing outwards,

o(u) = o_0 (1 + b (u - u_0) / m)^m, and 0 where the base is negative,

with u the logarithm of the value, u_0 that of the end, and o_0 the odds at the required rate. The
power m describes how losses set in: suddenly (1/2), linearly (1), accelerating (2, 4), or
logistically (infinite). An end belongs to the interval if the likelihood ratio test, with the slope
b and the power m that fit best, does not reject it (S. S. Wilks, Ann. Math. Statist. 9 (1938) 60).
A picture may lose only some of its bits: it then counts as the fraction that it loses, divided by
the typical fraction of lost pictures, (sum of squares) / sum.
"""

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice, starmap, takewhile

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.parallel.job import Heartbeat
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.confidence import TWO_SIDED_DEVIATE, count_until_refuted, trial_of
from occ_model.study.working_range import END_RATIO, ImageCounts, move_towards, right_bits_at

MOST_IMAGES = 1000  # maximum at a value inside an end; rates above 99.6 % would take more
MOST_IMAGES_OUTSIDE = 200  # maximum images at a value beyond an end
_ROUNDS, _PARTS, PICTURES = 2, (0.125, 0.375, 0.625, 0.875), 25
"""Rounds of pictures, the places as fractions of the remaining interval, and pictures at each."""


def images_to_prove(rate: float) -> int:
    """Return how many images, all of them read, prove a rate in percent; 0 if too many are needed.

    The lower end of the interval of n images is n / (n + z^2).
    """
    fraction = rate / 100.0
    if fraction >= 1.0:
        return 0
    least = math.floor(fraction * TWO_SIDED_DEVIATE**2 / (1.0 - fraction)) + 1
    return least if least <= MOST_IMAGES else 0


def estimate_end_images(rate: float) -> int:
    """Return the usual number of images that the confidence interval of an end takes."""
    images = images_to_prove(rate)
    return images and images + _ROUNDS * len(_PARTS) * PICTURES


def pair_ends(result: WorkingRange) -> list[tuple[RangeEnd, RangeEnd]]:
    """Return each end of a range's intervals, paired with the opposite end of its interval."""
    return [
        pair
        for each in result.intervals
        for pair in ((each.lowest, each.highest), (each.highest, each.lowest))
    ]


def replace_ends(result: WorkingRange, ends: Sequence[RangeEnd]) -> WorkingRange:
    """Return a range with its ends replaced, in the order of :func:`pair_ends`."""
    intervals = starmap(ReadInterval, zip(ends[::2], ends[1::2], strict=True))
    return replace(result, intervals=tuple(intervals))


def confirm_end(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    ends: tuple[RangeEnd, RangeEnd],
    heartbeat: Heartbeat,
) -> RangeEnd:
    """Find values about the first end that are read and fail with confidence, and its interval."""
    end, other = ends
    images = images_to_prove(rate)
    if not images or end.fails is None or not end.is_bisected:
        return end
    confirmation_settings = replace(settings, images=max(images, settings.images))
    pictures = _PicturesAboutEnd(scene, name, confirmation_settings, heartbeat)
    inside = _find_inside(pictures, end.value, other.value)
    fails = _find_outside(pictures, end.value, end.fails, rate)
    confirmed = replace(end, inside=inside, fails=fails)
    if inside is None:
        return confirmed
    return replace(confirmed, interval=_find_interval(pictures, rate, inside.value, fails.value))


class _PicturesAboutEnd:
    """Correct bits in pictures at values about an end, with another seed for each value.

    Pictures with the same seed start at the same parts of a packet, and would be lost together.
    """

    def __init__(
        self, scene: Scene, name: str, settings: RateSettings, heartbeat: Heartbeat
    ) -> None:
        self.bits = scene.transmitter.payload_length
        self.most = settings.images
        self._scene, self._name = scene, name
        self._settings, self._heartbeat = settings, heartbeat
        self._counts_by_value: dict[float, ImageCounts] = {}

    def take(self, value: float) -> ImageCounts:
        """Return the numbers of correct bits in the pictures at a value."""
        if value not in self._counts_by_value:
            settings_at_value = replace(self._settings, seed=_seed_at(value, self._settings.seed))
            # No other decoder tries these values, unlike those of the scan.
            right_bits = right_bits_at(
                self._scene, self._name, value, settings_at_value, self._heartbeat, is_kept=False
            )
            self._counts_by_value[value] = ImageCounts(right_bits)
        return self._counts_by_value[value]

    def lost_fractions(self) -> dict[float, list[float]]:
        """Return the fraction of bits lost in each picture, by value."""
        return {
            value: [1.0 - right / self.bits for right in images.counts]
            for value, images in self._counts_by_value.items()
        }


def _seed_at(value: float, seed: int) -> int:
    return int(np.random.SeedSequence([seed, 2, *value.as_integer_ratio()]).generate_state(1)[0])


def _find_inside(pictures: _PicturesAboutEnd, end: float, other: float) -> Trial | None:
    """Find the nearest value inside an end at which every image is read."""
    value, step = end, END_RATIO
    while value != other:
        value, step = move_towards(value, other, step), step * step
        counts = list(takewhile(lambda right: right == pictures.bits, pictures.take(value)))
        if len(counts) == pictures.most:
            return trial_of(value, counts, pictures.bits)
    return None


def _find_outside(pictures: _PicturesAboutEnd, end: float, fails: Trial, rate: float) -> Trial:
    """Halve the distance from an end to a failing value as long as the middle fails as well."""
    while True:
        low, high = sorted((end, fails.value))
        value = _interpolate(low, high, 0.5)
        if high / low <= END_RATIO * END_RATIO or value in (low, high):
            return fails
        refuting = count_until_refuted(
            islice(pictures.take(value), MOST_IMAGES_OUTSIDE), pictures.bits, rate / 100.0
        )
        trial = refuting and trial_of(value, refuting, pictures.bits)
        if not trial or trial.high >= rate:
            return fails
        fails = trial


def _find_interval(
    pictures: _PicturesAboutEnd, rate: float, inside: float, outside: float
) -> tuple[float, float]:
    """Take pictures between two values, closer to the end in each round; return its interval."""
    first, last = inside, outside
    for _ in range(_ROUNDS):
        for part in _PARTS:
            deque(islice(pictures.take(_interpolate(first, last, part)), PICTURES), maxlen=0)
        first, last = interval_of_end(pictures.lost_fractions(), rate, inside, outside)
    low, high = sorted((first, last))
    return low, high


def _interpolate(first: float, last: float, part: float) -> float:
    return float(f"{first * (last / first) ** part:.5g}")


_POWERS = (0.5, 1.0, 2.0, 4.0, math.inf)

_ENDS, _SLOPES = 81, 32  # numbers of ends and slopes to try
_FLATTEST, _STEEPEST = 0.3, 1e5  # of the log-odds at the end, over the whole bracket
_MAX_LOST_FRACTION = 0.999  # maximum fraction of pictures lost at the end


def interval_of_end(
    lost: Mapping[float, Sequence[float]], rate: float, inside: float, outside: float
) -> tuple[float, float]:
    """Return the 95 % interval of an end between two values, its limit nearer to ``inside`` first.

    ``lost``: the fraction of bits lost in each picture, by value. ``rate``: the success rate in
    percent that is reached inside.
    """
    direction = math.copysign(1.0, outside - inside)
    span = abs(math.log(outside / inside))
    log_distances = direction * np.log(np.array(list(lost)) / inside)
    fractions = np.concatenate([np.asarray(part, dtype=float) for part in lost.values()])
    typical_fraction = float((fractions**2).sum() / fractions.sum()) if fractions.any() else 1.0
    pictures = np.array([float(len(part)) for part in lost.values()])
    pictures_lost = np.array([math.fsum(part) for part in lost.values()]) / typical_fraction
    ends = np.linspace(0.0, span, _ENDS)
    likelihood = _likelihoods(
        log_distances - ends[:, None], pictures, np.minimum(pictures_lost, pictures),
        min((1.0 - rate / 100.0) / typical_fraction, _MAX_LOST_FRACTION), span,
    )  # fmt: skip
    ratio = 2.0 * (likelihood.max() - likelihood)
    accepted = np.flatnonzero(ratio <= _student_deviate(int(np.count_nonzero(fractions))) ** 2)
    # One step outwards, because the limit of the interval lies between two ends that were tried.
    first, last = ends[max(accepted[0] - 1, 0)], ends[min(accepted[-1] + 1, _ENDS - 1)]
    return inside * math.exp(direction * first), inside * math.exp(direction * last)


def _likelihoods(
    log_distances: FloatArray,
    pictures: FloatArray,
    pictures_lost: FloatArray,
    fraction: float,
    span: float,
) -> FloatArray:
    """Return the logarithm of each end's maximum likelihood.

    ``log_distances``, shape (ends, values): of each value from each end. ``pictures_lost``: at each
    value. ``fraction``: fraction of the pictures that are lost at the end.
    """
    log_odds_at_end = math.log(fraction / (1.0 - fraction))
    scaled = np.geomspace(_FLATTEST, _STEEPEST, _SLOPES)[:, None] / span * log_distances[:, None]
    best = np.full(len(log_distances), -np.inf)
    for power in _POWERS:
        increase = scaled
        if math.isfinite(power):
            with np.errstate(divide="ignore"):
                increase = power * np.log(np.maximum(1.0 + scaled / power, 0.0))
        log_read = -np.logaddexp(0.0, log_odds_at_end + increase)
        with np.errstate(invalid="ignore"):  # no picture is lost where none can be
            log_likelihood_lost = np.where(
                pictures_lost > 0.0, pictures_lost * (log_odds_at_end + increase + log_read), 0.0
            )
        likelihoods = (
            (log_likelihood_lost + (pictures - pictures_lost) * log_read).sum(axis=2).max(axis=1)
        )
        best = np.maximum(best, likelihoods)
    return best


def _student_deviate(pictures: int) -> float:
    """Return the two-sided 95 % quantile of Student's t distribution for this many pictures."""
    from scipy.special import stdtrit  # slow to import

    return float(stdtrit(max(pictures - 2, 2), 0.975))
