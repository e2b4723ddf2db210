"""Search for the values of a parameter at which a decoder reads a scene.

Only this parameter is varied, over the range of its slider, which is widened to include the scene's
own value and shortened where a decoder would take too long. A scan tries values that differ by a
factor ``STEP``. The success rate need not fall monotonically: at low frequencies too few packets
fit into the picture, and beyond a null the stripes come back. The answer is therefore a list of
intervals. The outermost ends, and those of the interval that contains the scene's own value or is
nearest to it, are bisected to a factor ``END_RATIO``; the others are known to a step of the scan.

Most images are simulated where the rate is uncertain. A value fails as soon as further images
cannot reach the rate, and is accepted after ``FEW_IMAGES`` that reach it. A gap as wide as a step
is thus missed if all of them are read in it. A gap of one or two values is listed if up to
``GAP_IMAGES`` images refute the rate at one of them, and an island if they do at none.
Values on both sides of an end are then tried with images of another seed, which were not used to
choose them. An end that these images contradict is moved until the value beyond it fails with
confidence: its 95 % interval lies below the rate. No image is simulated twice. The confidence of
the value inside an end is computed in :mod:`occ_model.study.sure_ends`.
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
from occ_model.study.success_rate import read_ahead, right_bits_of_images

STEP = 1.036  # ratio of neighbouring values in the scan
END_RATIO = 1.003  # ratio of the values on both sides of an end at which bisection stops
READ_RATE = 99.0  # success rate in percent from which a scene counts as read
FEW_IMAGES = 5  # images that suffice to accept a value, unless it is reported
GAP_IMAGES = 60  # most images at a value that is not read between others that are, or reversely
_NARROW = 2  # most values of a gap or an island that is doubted


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


def estimate_range_images(images: int) -> int:
    """Return the usual number of images of a search, from which its progress is estimated."""
    coarse = 100 * FEW_IMAGES // 2 + 15 + images
    ends = 2 * math.ceil(math.log2(math.log(STEP) / math.log(END_RATIO))) * FEW_IMAGES + 8 * images
    return coarse + ends


def right_bits_at(
    scene: Scene,
    name: str,
    value: float,
    settings: RateSettings,
    heartbeat: Heartbeat,
    *,
    first: int = 0,
    is_kept: bool = True,
) -> Iterator[int]:
    """Yield the number of bits read correctly in each image at a value, computed on demand."""
    at = scene.replace(**{name: value})
    counts = right_bits_of_images(at, settings, heartbeat, is_kept=is_kept, first=first)
    return (right for (right,) in counts)


class ImageCounts:
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
        self._confirmation_settings = replace(settings, seed=derive_seed(settings.seed))
        self._known: dict[float, list[int]] = {}  # right bits of the first images, by value
        self._images: dict[tuple[float, int], ImageCounts] = {}
        self._refuted: set[int] = set()
        self._refuted_values: dict[float, bool] = {}

    def find(self) -> WorkingRange:
        values = self._values
        searched_ends = (values[0], values[-1])
        self._scan()
        scene_trial = self._try_all_images(self._scene_value, self._settings)
        while True:
            runs = self._find_runs()
            intervals = [self._find_interval(run, runs) for run in runs]
            read_intervals = tuple(interval for interval in intervals if interval is not None)
            if len(read_intervals) == len(runs):
                break
        if read_intervals:
            return WorkingRange(
                self._name,
                searched_ends,
                STEP,
                scene_trial,
                read_intervals,
                most_chips=self._most_chips,
            )
        best = max((self._try(value) for value in values), key=lambda trial: trial.rate)
        best = self._try_all_images(best.value, self._settings)
        failure = self._describe_failure(searched_ends, best)
        return WorkingRange(
            self._name, searched_ends, STEP, scene_trial, (), failure, best, self._most_chips
        )

    def _scan(self) -> None:
        """Read the first image of all values at once, and the next few where it is read."""
        if self._settings.path == "image":  # takes as long for each image
            return
        self._read_ahead(self._values, range(1))
        read = [value for value in self._values if self._known[value] == [self._bits]]
        self._read_ahead(read, range(1, min(FEW_IMAGES, self._settings.images)))

    def _read_ahead(self, values: Sequence[float], numbers: range) -> None:
        if numbers:
            scenes = [self._scene.replace(**{self._name: value}) for value in values]
            read = read_ahead(scenes, self._settings, numbers, self._heartbeat)
            for value, counts in zip(values, read, strict=True):
                self._known.setdefault(value, []).extend(counts)

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
            counts = self._take_images(value, self._settings, GAP_IMAGES)
            is_refuted = count_until_refuted(counts, self._bits, self._rate / 100.0) is not None
            self._refuted_values[value] = is_refuted
        return self._refuted_values[value]

    def _find_runs(self) -> list[tuple[int, int]]:
        """Return the indices of the first and the last coarse value of each interval."""
        runs: list[tuple[int, int]] = []
        for index, is_read in enumerate(self._find_read_values()):
            if not is_read:
                continue
            if runs and runs[-1][1] == index - 1:
                runs[-1] = (runs[-1][0], index)
            else:
                runs.append((index, index))
        return runs

    def _find_interval(
        self, run: tuple[int, int], runs: list[tuple[int, int]]
    ) -> ReadInterval | None:
        """Return an interval; None if one of its ends is refuted, which is noted."""
        first, last = run
        is_nearest = run == min(runs, key=self._distance_from_scene)
        lowest = self._find_end(first, first - 1, is_nearest or run == runs[0])
        highest = self._find_end(last, last + 1, is_nearest or run == runs[-1])
        if lowest is None or highest is None:
            return None
        return ReadInterval(*(
            replace(end, inside=None)
            if end.inside and not lowest.value <= end.inside.value <= highest.value
            else end
            for end in (lowest, highest)
        ))  # fmt: skip

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

    def _find_end(self, index: int, index_outside: int, is_bisected: bool) -> RangeEnd | None:
        """Find the end next to the outermost coarse value that is read; None if it is refuted."""
        inside = inner = self._values[index]
        outside = outermost = (
            self._values[index_outside] if 0 <= index_outside < len(self._values) else None
        )
        if outside is not None and is_bisected:
            inside, outside = self._bisect(inside, outside)
        confirmation = self._confirm(inside, inner)
        if confirmation is None:
            self._refuted.add(index)
            return None
        trial, outer_trial = confirmation
        if (
            outside is not None
            and outermost is not None
            and (outer_trial is None or not self._fails_with_confidence(outer_trial))
        ):
            outer_trial = self._find_failing(
                outside, self._find_last_unread(index_outside, index_outside - index)
            )
        if outer_trial is None:
            return RangeEnd(trial, None, trial if trial.whole == trial.images else None)
        return RangeEnd(trial, outer_trial, is_bisected=is_bisected)

    def _find_last_unread(self, index: int, direction: int) -> float:
        """Return the last coarse value of a gap in a direction from one of its values."""
        while (
            0 <= index + direction < len(self._values)
            and not self._is_read(self._try(self._values[index + direction]))
        ):  # fmt: skip
            index += direction
        return self._values[index]

    def _bisect(self, inside: float, outside: float) -> tuple[float, float]:
        """Bisect, by ratio, between a value that is read and one that is not."""
        start, images = inside, FEW_IMAGES
        while True:
            while max(inside, outside) / min(inside, outside) > END_RATIO:
                middle = float(f"{math.sqrt(inside * outside):.5g}")
                if middle in (inside, outside):
                    break
                is_read = self._is_read(self._try(middle, images))
                inside, outside = (middle, outside) if is_read else (inside, middle)
            if inside == start or self._is_read(self._try(inside, self._settings.images)):
                return inside, outside
            # Where the rate falls slowly, few images mislead: repeat with all images.
            inside, outside, images = start, inside, self._settings.images

    def _confirm(self, inside: float, inner: float) -> tuple[Trial, Trial | None] | None:
        """Return the nearest value that new images confirm, and the last one that they refute."""
        refuted, step = None, END_RATIO
        while True:
            trial = self._try(inside, self._settings.images, self._confirmation_settings)
            if self._is_read(trial):
                return trial, refuted and self._try_all_images(
                    refuted.value, self._confirmation_settings
                )
            if inside == inner:
                return None
            refuted = trial
            inside, step = move_towards(inside, inner, step), step * step

    def _find_failing(self, value: float, end: float) -> Trial:
        """Return the nearest value beyond an end that fails with confidence in new images.

        If none does up to the end of the gap, return that end, with the images that were used to
        choose it if the new ones are read.
        """
        step = END_RATIO
        while True:
            trial = self._try_all_images(value, self._confirmation_settings)
            if self._fails_with_confidence(trial):
                return trial
            if value == end:
                return (
                    trial
                    if not self._is_read(trial)
                    else self._try_all_images(value, self._settings)
                )
            value, step = move_towards(value, end, step), step * step

    def _try_all_images(self, value: float, settings: RateSettings) -> Trial:
        """Return a trial of all images, because no interval holds for a count that stops early."""
        return trial_of(value, list(self._take_images(value, settings)), self._bits)

    def _try(
        self, value: float, enough: int = FEW_IMAGES, settings: RateSettings | None = None
    ) -> Trial:
        """Count correct bits until enough images reach the rate or it can no longer be reached."""
        images, bits = self._settings.images, self._bits
        counts: list[int] = []
        for right in self._take_images(value, settings or self._settings):
            counts.append(right)
            image_count, right_bits = len(counts), sum(counts)
            if 100.0 * (right_bits + (images - image_count) * bits) < self._rate * images * bits:
                break
            if image_count >= enough and 100.0 * right_bits >= self._rate * image_count * bits:
                break
        return trial_of(value, counts, self._bits)

    def _take_images(
        self, value: float, settings: RateSettings, most: int | None = None
    ) -> Iterator[int]:
        key = value, settings.seed
        if key not in self._images:
            enough = replace(settings, images=max(settings.images, GAP_IMAGES))
            known = self._known.get(value, ()) if settings is self._settings else ()
            remaining = right_bits_at(
                self._scene, self._name, value, enough, self._heartbeat, first=len(known)
            )
            self._images[key] = ImageCounts(remaining, known)
        return islice(self._images[key], most or settings.images)

    def _is_read(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _fails_with_confidence(self, trial: Trial) -> bool:
        return trial.high < self._rate

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


def move_towards(value: float, end: float, ratio: float) -> float:
    """Move a value towards an end by a ratio, but not beyond the end."""
    moved = value * ratio if end > value else value / ratio
    moved = float(f"{moved:.5g}")
    return end if (moved - end) * (value - end) <= 0.0 else moved


def derive_seed(seed: int) -> int:
    """Return the seed of images that are independent of those of a seed."""
    return int(np.random.SeedSequence([seed, 1]).generate_state(1)[0])
