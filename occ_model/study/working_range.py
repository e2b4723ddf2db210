"""Search for the values of a parameter at which a decoder reads a scene.

Only this parameter is varied, over the range of its slider, which is widened to include the scene's
own value and shortened where a decoder would take too long. A scan tries values that differ by a
factor ``STEP``. The success rate need not fall monotonically: at low frequencies too few packets
fit into the picture, and beyond a null the stripes come back. The answer is therefore a list of
intervals. The ends of the widest one, and of the one that contains the scene's own value or is
nearest to it, have 95 % intervals, see :mod:`occ_model.study.range_end`; the others are known to a
step of the scan.

Most images are simulated where the rate is uncertain. A value fails as soon as further images
cannot reach the rate, and is accepted after ``FEW_IMAGES`` that reach it. A gap as wide as a step
is thus missed if all of them are read in it. A gap of one or two values is listed if up to
``GAP_IMAGES`` images refute the rate at one of them, and an island if they do at none. The images
of the ends have other seeds, so that they were not used to choose them: an end that is known to a
step, and that they contradict, is moved inwards.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.range_end import MOST_PROVEN, Bracket
from occ_model.study.value_images import FEW_IMAGES, ValueImages

STEP = 1.036  # ratio of neighbouring values in the scan
READ_RATE = 99.0  # success rate in percent from which a scene counts as read
_NARROW = 2  # most values of a gap or an island that is doubted
_END_IMAGES = 250  # usual images about an end with a 95 % interval


def working_range(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
) -> WorkingRange:
    """Find the intervals of a parameter that are read, by checked settings of one decoder."""
    with Faults().counting() as faults:
        result = _RangeSearch(scene, name, rate, settings, heartbeat).find()
    return replace(result, faults=str(faults))


def rough_range(scene: Scene, name: str, rate: float, settings: RateSettings) -> WorkingRange:
    """Return what one image at each value of the scan shows, without narrow gaps and islands."""
    return _RangeSearch(scene, name, rate, settings, lambda: None).find_roughly()


def estimate_range_images(images: int) -> int:
    """Return the usual number of images of a search, from which its progress is estimated."""
    return 100 * FEW_IMAGES // 2 + 15 + images + _END_IMAGES


class _RangeSearch:
    """A search for the values of one parameter at which a scene is read."""

    def __init__(
        self,
        scene: Scene,
        name: str,
        rate: float,
        settings: RateSettings,
        heartbeat: Heartbeat,
    ) -> None:
        self._name, self._rate, self._decoder = name, rate, settings.decoders[0]
        self._parameter = quantity(name)
        self._scene_value = float(scene.value(name))
        low, high = self._parameter.slider
        chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
        longest = decoder_named(self._decoder).searched_chips
        slow = float(f"{self._scene_value * longest / chips:.4g}")
        self._most_chips = max(longest, chips) if max(slow, self._scene_value) < high else None
        low, high = min(low, self._scene_value), max(min(high, slow), self._scene_value)
        down, up = self._steps_towards(low), self._steps_towards(high)
        self._values = [*reversed(down), self._scene_value, *up]
        self._images = ValueImages(scene, name, rate, settings, heartbeat)
        self._refuted: set[int] = set()
        self._found: dict[tuple[int, int, int, bool], RangeEnd | None] = {}

    def find(self) -> WorkingRange:
        values = self._values
        self._images.scan(values)
        scene_trial = self._images.try_all(self._scene_value)
        while True:
            is_read = self._find_read_values()
            runs = [run for run in _runs_of(is_read) if is_read[run[0]]]
            intervals = [self._find_interval(run, runs) for run in runs]
            read_intervals = tuple(interval for interval in intervals if interval is not None)
            if len(read_intervals) == len(runs):
                break
        found = WorkingRange(
            self._name, (values[0], values[-1]), STEP, scene_trial, read_intervals,
            most_chips=self._most_chips,
        )  # fmt: skip
        if read_intervals:
            return found
        best = max(map(self._images.try_few, values), key=lambda trial: trial.rate)
        best = self._images.try_all(best.value)
        return replace(found, failure=self._describe_failure(found.searched, best), best=best)

    def find_roughly(self) -> WorkingRange:
        """Return the values of the scan of which the first image is read."""
        trials = self._images.try_first(self._values)
        is_read = [self._images.is_read(trial) for trial in trials]
        for wanted in (True, False):
            for narrow in _narrow_runs(is_read, wanted):
                for index in narrow:
                    is_read[index] = not wanted
        ends = [RangeEnd(trial.value, trial, trial) for trial in trials]
        intervals = tuple(
            ReadInterval(ends[run[0]], ends[run[-1]])
            for run in _runs_of(is_read)
            if is_read[run[0]]
        )
        searched = self._values[0], self._values[-1]
        own = trials[self._values.index(self._scene_value)]
        return WorkingRange(self._name, searched, STEP, own, intervals)

    def _find_read_values(self) -> list[bool]:
        """Return which values of the scan are read; narrow gaps only if images refute the rate."""
        is_read = [
            index not in self._refuted and self._images.is_read(self._images.try_few(value))
            for index, value in enumerate(self._values)
        ]
        # Islands first, so that an accidental one does not divide a gap.
        for wanted in (True, False):
            for run in _narrow_runs(is_read, wanted):
                if self._refuted.isdisjoint(run):
                    is_refuted = any(self._images.is_refuted(self._values[index]) for index in run)
                    for index in run:
                        is_read[index] = not is_refuted
        return is_read

    def _find_interval(self, run: range, runs: list[range]) -> ReadInterval | None:
        """Return the interval of a run of values; None if an end is refuted, which is noted."""
        place = runs.index(run)
        before = runs[place - 1][-1] if place else -1
        after = runs[place + 1][0] if place + 1 < len(runs) else len(self._values)
        nearest, widest = min(runs, key=self._distance_from_scene), max(runs, key=self._width)
        first, last = run[0], run[-1]
        is_sought = run in (nearest, widest)
        lowest = self._find_end(first, last, before, is_sought)
        highest = self._find_end(last, first, after, is_sought)
        if lowest is None or highest is None:
            return None
        if lowest.value > highest.value:
            self._refuted |= {first, last}
            return None
        return ReadInterval(lowest, highest)

    def _width(self, run: range) -> float:
        return self._values[run[-1]] / self._values[run[0]]

    def _distance_from_scene(self, run: range) -> float:
        """Return an interval's distance from the scene's own value, as a logarithm."""
        low, high = (
            math.log(self._values[index] / self._scene_value) for index in (run[0], run[-1])
        )
        return max(low, -high, 0.0)

    def _steps_towards(self, end: float) -> list[float]:
        steps = math.ceil(abs(math.log(end / self._scene_value)) / math.log(STEP))
        if not steps:
            return []
        between = np.geomspace(self._scene_value, end, steps + 1)[1:-1]
        # Few digits, so that a reported value can be typed in again.
        return [*(float(f"{value:.5g}") for value in between.tolist()), end]

    def _find_end(self, index: int, opposite: int, beyond: int, is_sought: bool) -> RangeEnd | None:
        """Find the end next to a coarse value that is read; None if it is refuted.

        ``opposite``: the value at the other end of the interval. ``beyond``: the next value that is
        read, or one past the last value. ``is_sought``: whether a 95 % interval is sought.
        """
        key = index, opposite, beyond, is_sought
        if key not in self._found:
            self._found[key] = self._confirm_end(*key)
        if self._found[key] is None:
            self._refuted.add(index)
        return self._found[key]

    def _confirm_end(
        self, index: int, opposite: int, beyond: int, is_sought: bool
    ) -> RangeEnd | None:
        values, images, direction = self._values, self._images, 1 if beyond > index else -1
        inside, next_index = values[index], index + direction
        if not 0 <= next_index < len(values):
            works = images.try_at_end(inside)
            return RangeEnd(inside, works, None) if images.is_read(works) else None
        if is_sought:
            last_lost = values[beyond - direction]
            end = images.ends.find(Bracket(inside, values[next_index], values[opposite], last_lost))
            if end is not None:
                works, fails = images.try_at_end(end.sure), images.try_at_end(end.refuted)
                if self._rate > MOST_PROVEN:
                    return RangeEnd(end.sure, works, fails)
                return RangeEnd(end.interval[0], works, fails, end.interval)
        works = images.try_at_end(inside)
        if not images.is_read(works):
            return None
        return RangeEnd(inside, works, images.try_at_end(values[next_index]))

    def _describe_failure(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._decoder} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.in_sentence} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )


def _runs_of(is_read: Sequence[bool]) -> list[range]:
    """Return the indices of each run of values that are read, or are not."""
    changes = [index for index in range(1, len(is_read)) if is_read[index] != is_read[index - 1]]
    return [range(*ends) for ends in pairwise([0, *changes, len(is_read)])]


def _narrow_runs(is_read: Sequence[bool], wanted: bool) -> list[range]:
    """Return the runs of few values that are read, or are not, between others."""
    inner = _runs_of(is_read)[1:-1]
    return [run for run in inner if is_read[run[0]] == wanted and len(run) <= _NARROW]
