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
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import count, islice, pairwise

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.study.confidence import count_until_refuted, trial_of
from occ_model.study.range_end import MOST_PROVEN, Bracket, EndSearch
from occ_model.study.success_rate import ImageSeries, read_ahead, right_bits_of_images

STEP = 1.036  # ratio of neighbouring values in the scan
READ_RATE = 99.0  # success rate in percent from which a scene counts as read
FEW_IMAGES = 5  # images that suffice to accept a value, unless it is reported
GAP_IMAGES = 60  # most images at a value that is not read between others that are, or reversely
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


class _ImageCounts:
    """The numbers of bits read correctly in the images at a value, computed once, on demand."""

    def __init__(self, remaining: Iterator[int], known: Sequence[int] = ()) -> None:
        self._remaining = remaining
        self.counts = list(known)

    def __iter__(self) -> Iterator[int]:
        for index in count():
            if index == len(self.counts):
                next_count = next(self._remaining, None)
                if next_count is None:
                    return
                self.counts.append(next_count)
            yield self.counts[index]


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
        self._scene = scene
        self._name = name
        self._rate = rate
        self._settings = settings
        self._heartbeat = heartbeat
        parameter = PARAMETERS[name]
        assert isinstance(parameter, Quantity)  # noqa: S101 - both searched parameters are
        self._parameter = parameter
        self._scene_value = float(scene.value(name))
        self._bits = scene.transmitter.payload_length
        low, high = parameter.slider
        chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
        longest = decoder_named(settings.decoders[0]).searched_chips
        slow = float(f"{self._scene_value * longest / chips:.4g}")
        self._most_chips = max(longest, chips) if max(slow, self._scene_value) < high else None
        high = min(high, slow)
        self._low, self._high = min(low, self._scene_value), max(high, self._scene_value)
        self._values = self._coarse_values()
        self._known: dict[float, list[int]] = {}  # right bits of the first images, by value
        self._images: dict[float, _ImageCounts] = {}
        self._refuted: set[int] = set()
        self._refuted_values: dict[float, bool] = {}
        self._ends = EndSearch(self._measure_lost, rate, settings.images)
        self._found: dict[tuple[int, int, int, bool], RangeEnd | None] = {}

    def find(self) -> WorkingRange:
        values = self._values
        self._scan()
        scene_trial = self._try_all_images(self._scene_value)
        while True:
            runs = self._find_runs(self._find_read_values())
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
        best = max((self._try(value) for value in values), key=lambda trial: trial.rate)
        best = self._try_all_images(best.value)
        return replace(found, failure=self._describe_failure(found.searched, best), best=best)

    def find_roughly(self) -> WorkingRange:
        """Return the values of the scan of which the first image is read."""
        self._read_ahead(self._values, range(1))
        trials = [trial_of(value, self._known[value], self._bits) for value in self._values]
        is_read = [self._is_read(trial) for trial in trials]
        for wanted in (True, False):
            for narrow in _narrow_runs(is_read, wanted):
                for index in narrow:
                    is_read[index] = not wanted
        runs = self._find_runs(is_read)
        intervals = []
        for run in runs:
            lowest, highest = (RangeEnd(trials[at].value, trials[at], trials[at]) for at in run)
            intervals.append(ReadInterval(lowest, highest))
        searched = self._values[0], self._values[-1]
        own = trials[self._values.index(self._scene_value)]
        return WorkingRange(self._name, searched, STEP, own, tuple(intervals))

    def _scan(self) -> None:
        """Read the first image of all values at once, and the next few where it is read."""
        if self._settings.path == "image":  # takes as long for each image
            return
        self._read_ahead(self._values, range(1))
        read = [value for value in self._values if self._known[value] == [self._bits]]
        self._read_ahead(read, range(1, min(FEW_IMAGES, self._settings.images)))

    def _read_ahead(self, values: Sequence[float], numbers: range) -> None:
        if numbers:
            seed = self._settings.seed
            series = [
                ImageSeries(self._scene.replace(**{self._name: value}), seed, numbers)
                for value in values
            ]
            read = read_ahead(series, self._settings, self._heartbeat)
            for value, counts in zip(values, read, strict=True):
                self._known.setdefault(value, []).extend(counts)

    def _measure_lost(self, values: Sequence[float], images: int) -> Iterator[list[float]]:
        """Yield the fractions of lost bits in further images at values, which no scan has read."""
        series = []
        for value in values:
            first = len(self._ends.lost.get(value, ()))
            scene = self._scene.replace(**{self._name: value})
            seed = _seed_at(value, self._settings.seed)
            series.append(ImageSeries(scene, seed, range(first, first + images)))
        for counts in read_ahead(series, self._settings, self._heartbeat):
            yield [1.0 - right / self._bits for right in counts]

    def _find_read_values(self) -> list[bool]:
        """Return which values of the scan are read; narrow gaps only if images refute the rate."""
        is_read = [
            index not in self._refuted and self._is_read(self._try(value))
            for index, value in enumerate(self._values)
        ]
        # Islands first, so that an accidental one does not divide a gap.
        for wanted in (True, False):
            for run in _narrow_runs(is_read, wanted):
                if self._refuted.isdisjoint(run):
                    is_refuted = any(self._is_refuted(self._values[index]) for index in run)
                    for index in run:
                        is_read[index] = not is_refuted
        return is_read

    def _is_refuted(self, value: float) -> bool:
        """Return whether images at a value refute that the rate is reached."""
        if value not in self._refuted_values:
            counts = self._take_images(value, GAP_IMAGES)
            is_refuted = count_until_refuted(counts, self._bits, self._rate / 100.0) is not None
            self._refuted_values[value] = is_refuted
        return self._refuted_values[value]

    def _find_runs(self, is_read: Sequence[bool]) -> list[tuple[int, int]]:
        """Return the indices of the first and the last coarse value of each interval."""
        runs: list[tuple[int, int]] = []
        for index in np.flatnonzero(is_read).tolist():
            if runs and runs[-1][1] == index - 1:
                runs[-1] = (runs[-1][0], index)
            else:
                runs.append((index, index))
        return runs

    def _find_interval(
        self, run: tuple[int, int], runs: list[tuple[int, int]]
    ) -> ReadInterval | None:
        """Return an interval; None if one of its ends is refuted, which is noted."""
        place = runs.index(run)
        before = runs[place - 1][1] if place else -1
        after = runs[place + 1][0] if place + 1 < len(runs) else len(self._values)
        nearest, widest = min(runs, key=self._distance_from_scene), max(runs, key=self._width)
        first, last = run
        is_sought = run in (nearest, widest)
        lowest = self._find_end(first, last, before, is_sought)
        highest = self._find_end(last, first, after, is_sought)
        if lowest is None or highest is None:
            return None
        if lowest.value > highest.value:
            self._refuted |= {first, last}
            return None
        return ReadInterval(lowest, highest)

    def _width(self, run: tuple[int, int]) -> float:
        return self._values[run[1]] / self._values[run[0]]

    def _distance_from_scene(self, run: tuple[int, int]) -> float:
        """Return an interval's distance from the scene's own value, as a logarithm."""
        low, high = (math.log(self._values[index] / self._scene_value) for index in run)
        return max(low, -high, 0.0)

    def _coarse_values(self) -> list[float]:
        """Return values at equal ratios from the scene's own value to both ends of the range."""
        down = self._steps_towards(self._low)
        return [*reversed(down), self._scene_value, *self._steps_towards(self._high)]

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
        values, direction = self._values, 1 if beyond > index else -1
        inside, next_index = values[index], index + direction
        if not 0 <= next_index < len(values):
            works = self._try_at_end(inside)
            return RangeEnd(inside, works, None) if self._is_read(works) else None
        if is_sought:
            last_lost = values[beyond - direction]
            end = self._ends.find(Bracket(inside, values[next_index], values[opposite], last_lost))
            if end is not None:
                works, fails = self._try_at_end(end.sure), self._try_at_end(end.refuted)
                if self._rate > MOST_PROVEN:
                    return RangeEnd(end.sure, works, fails)
                return RangeEnd(end.interval[0], works, fails, end.interval)
        works = self._try_at_end(inside)
        if not self._is_read(works):
            return None
        return RangeEnd(inside, works, self._try_at_end(values[next_index]))

    def _try_at_end(self, value: float) -> Trial:
        """Return the trial at a value, of all images at least: they were not used to choose it."""
        missing = self._settings.images - len(self._ends.lost.get(value, ()))
        if missing > 0:
            self._ends.take([value], missing)
        counts = [round((1.0 - lost) * self._bits) for lost in self._ends.lost[value]]
        return trial_of(value, counts, self._bits)

    def _try_all_images(self, value: float) -> Trial:
        """Return a trial of all images, because no interval holds for a count that stops early."""
        return trial_of(value, list(self._take_images(value)), self._bits)

    def _try(self, value: float) -> Trial:
        """Count correct bits until enough images reach the rate or it can no longer be reached."""
        images, bits = self._settings.images, self._bits
        counts: list[int] = []
        for right in self._take_images(value):
            counts.append(right)
            image_count, right_bits = len(counts), sum(counts)
            if 100.0 * (right_bits + (images - image_count) * bits) < self._rate * images * bits:
                break
            if image_count >= FEW_IMAGES and 100.0 * right_bits >= self._rate * image_count * bits:
                break
        return trial_of(value, counts, bits)

    def _take_images(self, value: float, most: int | None = None) -> Iterator[int]:
        if value not in self._images:
            at = self._scene.replace(**{self._name: value})
            enough = replace(self._settings, images=max(self._settings.images, GAP_IMAGES))
            known = self._known.get(value, ())
            read = right_bits_of_images(at, enough, self._heartbeat, first=len(known))
            self._images[value] = _ImageCounts((right for (right,) in read), known)
        return islice(self._images[value], most or self._settings.images)

    def _is_read(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _describe_failure(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._settings.decoders[0]} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.in_sentence} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )


def _narrow_runs(is_read: Sequence[bool], wanted: bool) -> list[range]:
    """Return the runs of few values that are read, or are not, between others."""
    changes = [index for index in range(1, len(is_read)) if is_read[index] != is_read[index - 1]]
    return [
        range(start, stop)
        for start, stop in pairwise(changes)
        if is_read[start] == wanted and stop - start <= _NARROW
    ]


def _seed_at(value: float, seed: int) -> int:
    """Return the seed of the images about an end at a value.

    Images with the same seed start at the same parts of a packet, and would be lost together.
    """
    return int(np.random.SeedSequence([seed, 2, *value.as_integer_ratio()]).generate_state(1)[0])
