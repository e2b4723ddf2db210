"""How surely the ends of a working range are known.

An end lies between a value beyond it that surely fails, which the search has found, and a value
inside that is surely read: their 95 % intervals lie on either side of the rate asked for. At a rate
of 99 % that takes 381 images, all of them read. So values inside are tried in growing steps from
the end, each until a first image is not read.
"""

import math
from dataclasses import replace
from itertools import takewhile

from occ_model.parallel.job import Heartbeat
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study.confidence import TWO_SIDED, trial_of
from occ_model.study.working_range import NEAR, moved, other_seed, right_bits_at

MOST_IMAGES = 1000
"""Images at a value beyond which it is not shown to be read: at rates above 99.6 %."""


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
    """Find, for each end that was bisected, a value inside that is surely read.

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
        return replace(end, inside=inside)

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
