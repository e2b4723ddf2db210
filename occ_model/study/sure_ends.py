"""How surely the ends of a working range are known.

An end lies between a value beyond it that surely fails and a value inside that is surely read:
their 95 % intervals lie on either side of the rate asked for. At a rate of 99 % the latter takes
381 images, all of them read. So values inside are tried in growing steps from the end, each until a
first image is not read. The search has found a value that fails in twenty images, which is far out
where the rate falls slowly: values between it and the end are tried with more images, each until it
is refuted that the rate is reached there.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import islice, takewhile

from occ_model.parallel.job import Heartbeat
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.confidence import TWO_SIDED, trial_of
from occ_model.study.working_range import NEAR, moved, other_seed, right_bits_at

MOST_IMAGES = 1000
"""Images at a value beyond which it is not shown to be read: at rates above 99.6 %."""


OUTSIDE = 200
"""Most images at a value beyond an end."""

_CHANCE = 0.025
"""Chance to refute a rate that is reached: that of one side of a 95 % interval."""

_STAKES = (0.03, 0.1, 0.3)
"""What is staked on each image, as shares of the most that can be: small ones win by small lacks.
"""


def images_to_be_sure(rate: float) -> int:
    """Return how many images, all of them read, show a rate in percent; 0 where too many would.

    The lower end of the interval of n images is n / (n + z^2).
    """
    share = rate / 100.0
    if share >= 1.0:
        return 0
    least = math.floor(share * TWO_SIDED**2 / (1.0 - share)) + 1
    return least if least <= MOST_IMAGES else 0


def with_sure_ends(
    scene: Scene,
    found: WorkingRange,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
) -> WorkingRange:
    """Find, for each bisected end, a value inside that is surely read, and the nearest that fails.

    Parameters
    ----------
    scene, rate, settings
        Those of the search.
    found
        What it has found.
    heartbeat
        Called before each image; what it raises ends the search.
    """
    images = images_to_be_sure(rate)
    if not images or not found.intervals:
        return found
    own = replace(settings, images=max(images, settings.images), seed=other_seed(settings.seed))

    def sure(end: RangeEnd, other: RangeEnd) -> RangeEnd:
        if end.fails is None or not end.is_bisected:
            return end
        inside = _inside(scene, found.parameter, end.value, other.value, own, heartbeat)
        fails = _outside(scene, found.parameter, end, rate, own, heartbeat)
        return replace(end, inside=inside, fails=fails)

    return replace(
        found,
        intervals=tuple(
            ReadInterval(sure(each.lowest, each.highest), sure(each.highest, each.lowest))
            for each in found.intervals
        ),
    )


def _inside(
    scene: Scene,
    name: str,
    end: float,
    other: float,
    settings: RateSettings,
    heartbeat: Heartbeat,
) -> Trial | None:
    """Find the value nearest to an end of which every image is read."""
    value, step, bits = end, NEAR, scene.transmitter.payload_length
    while value != other:
        value, step = moved(value, other, step), step * step
        counts = right_bits_at(scene, name, value, settings, heartbeat)
        read = takewhile(lambda right: right == bits, counts)
        trial = trial_of(value, list(read), bits)
        if trial.images == settings.images:
            return trial
    return None


def _outside(
    scene: Scene,
    name: str,
    end: RangeEnd,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat,
) -> Trial | None:
    """Halve the distance from an end to a value that fails, as long as the rate is refuted."""
    fails, bits = end.fails, scene.transmitter.payload_length
    while fails is not None:
        low, high = sorted((end.value, fails.value))
        value = float(f"{math.sqrt(low * high):.5g}")
        if high / low <= NEAR * NEAR or value in (low, high):
            break
        counts = right_bits_at(scene, name, value, settings, heartbeat)
        refuting = _until_refuted(islice(counts, OUTSIDE), bits, rate / 100.0)
        if refuting is None:
            break
        trial = trial_of(value, refuting, bits)
        if trial.high >= rate:
            break
        fails = trial
    return fails


def _until_refuted(counts: Iterable[int], bits: int, least: float) -> list[int] | None:
    """Count right bits until they refute that a share of them is read; None if they do not.

    Whoever stakes on each image that less is read, at odds that are fair if the share is reached,
    has c times the first stake at any time with a chance of at most 1 / c (J. Ville, *Etude
    critique de la notion de collectif*, 1939): the images may be ended by their own result.
    """
    wealth, seen = [1.0] * len(_STAKES), []
    for right in counts:
        seen.append(right)
        won = (least - right / bits) / (1.0 - least)
        wealth = [had * (1.0 + stake * won) for had, stake in zip(wealth, _STAKES, strict=True)]
        if sum(wealth) * _CHANCE >= len(_STAKES):
            return seen
    return None
