"""Search for the values of a parameter at which a decoder reads a scene.

Only this parameter is varied, over the range of its slider, which is widened to include the scene's
own value and shortened where a decoder would take too long. A coarse search tries values that
differ by a factor ``STEP``. The success rate need not fall steadily: at low frequencies too few
packets fit into the picture, and beyond a null the stripes come back. The answer is therefore a
list of intervals, and a gap narrower than a step can be missed. The outermost ends, and those of
the interval that contains the scene's own value or is nearest to it, are bisected to a factor
``END_RATIO``; the other ends are known to within a step of the coarse search.

Most images are simulated where the rate is uncertain. A value fails as soon as so many bits are
wrong that further images cannot reach the rate, and is accepted after ``FEW_IMAGES`` that reach it.
Values on both sides of an end are then tried with images of another seed, which were not used to
choose them. An end that these images contradict is moved until the value beyond it fails with
confidence: its 95 % interval lies below the rate. No image is simulated twice. The confidence of
the value inside an end is computed in :mod:`occ_model.study.sure_ends`.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import count

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decode import decoder_named
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.study.confidence import trial_of
from occ_model.study.success_rate import right_bits_of_images

STEP = 1.15  # ratio of neighbouring values in the first, coarse search
END_RATIO = 1.003  # ratio of the values on both sides of an end at which bisection stops
READ_RATE = 99.0  # success rate in percent from which a scene counts as read
FEW_IMAGES = 5  # images that suffice to accept a value, unless it is reported


def working_range(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
) -> WorkingRange:
    """Find the intervals of a parameter that are read, by checked settings of one decoder."""
    with Faults().counting() as faults:
        found = _RangeSearch(scene, name, rate, settings, heartbeat).working_range()
    return replace(found, faults=str(faults))


def expected_images(images: int) -> int:
    """Return the usual number of images of a search, from which its progress is estimated."""
    coarse = 25 * FEW_IMAGES + 15 + images
    ends = 2 * math.ceil(math.log2(math.log(STEP) / math.log(END_RATIO))) * FEW_IMAGES + 8 * images
    return coarse + ends


def right_bits_at(
    scene: Scene, name: str, value: float, settings: RateSettings, heartbeat: Heartbeat
) -> Iterator[int]:
    """Yield the number of bits read correctly in each image at a value, computed on demand."""
    at = scene.replace(**{name: value})
    return (right for (right,) in right_bits_of_images(at, settings, heartbeat))


class ImageCounts:
    """The numbers of bits read correctly in the images at a value, computed once, on demand."""

    def __init__(self, images: Iterator[int]) -> None:
        self._coming = images
        self.seen: list[int] = []

    def __iter__(self) -> Iterator[int]:
        for place in count():
            if place == len(self.seen):
                following = next(self._coming, None)
                if following is None:
                    return
                self.seen.append(following)
            yield self.seen[place]


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
        self._own = float(scene.value(name))
        self._bits = scene.transmitter.payload_length
        low, high = parameter.slider
        chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
        longest = decoder_named(settings.decoders[0]).searched_chips
        slow = float(f"{self._own * longest / chips:.4g}")
        self._most_chips = max(longest, chips) if max(slow, self._own) < high else None
        high = min(high, slow)
        self._low, self._high = min(low, self._own), max(high, self._own)
        self._values = self._coarse_values()
        self._fresh = replace(settings, seed=other_seed(settings.seed))
        self._images: dict[tuple[float, int], ImageCounts] = {}
        self._refuted: set[int] = set()

    def working_range(self) -> WorkingRange:
        values = self._values
        searched = (values[0], values[-1])
        own = self._try_all_images(self._own, self._settings)
        while True:
            runs = self._find_runs()
            intervals = [self._find_interval(run, runs) for run in runs]
            found = tuple(interval for interval in intervals if interval is not None)
            if len(found) == len(runs):
                break
        if found:
            return WorkingRange(self._name, searched, STEP, own, found, most_chips=self._most_chips)
        best = max((self._try(value) for value in values), key=lambda trial: trial.rate)
        best = self._try_all_images(best.value, self._settings)
        failure = self._describe_failure(searched, best)
        return WorkingRange(self._name, searched, STEP, own, (), failure, best, self._most_chips)

    def _find_runs(self) -> list[tuple[int, int]]:
        """Return the indices of the first and the last coarse value of each interval."""
        runs: list[tuple[int, int]] = []
        for place, value in enumerate(self._values):
            if place in self._refuted or not self._is_read(self._try(value)):
                continue
            if runs and runs[-1][1] == place - 1:
                runs[-1] = (runs[-1][0], place)
            else:
                runs.append((place, place))
        return runs

    def _find_interval(
        self, run: tuple[int, int], runs: list[tuple[int, int]]
    ) -> ReadInterval | None:
        """Return an interval; None, and note it, if one of its ends is refuted."""
        first, last = run
        is_own = run == min(runs, key=self._distance_from_own)
        lowest = self._find_end(first, first - 1, is_own or run == runs[0])
        highest = self._find_end(last, last + 1, is_own or run == runs[-1])
        if lowest is None or highest is None:
            return None
        return ReadInterval(*(
            replace(end, inside=None)
            if end.inside and not lowest.value <= end.inside.value <= highest.value
            else end
            for end in (lowest, highest)
        ))  # fmt: skip

    def _distance_from_own(self, run: tuple[int, int]) -> float:
        """Return an interval's distance from the scene's own value, as a logarithm."""
        low, high = (math.log(self._values[place] / self._own) for place in run)
        return max(low, -high, 0.0)

    def _coarse_values(self) -> list[float]:
        """Return values at equal ratios from the scene's own value to both ends of the range."""
        down = self._steps_towards(self._low)
        return [*reversed(down), self._own, *self._steps_towards(self._high)]

    def _steps_towards(self, end: float) -> list[float]:
        steps = math.ceil(abs(math.log(end / self._own)) / math.log(STEP))
        if not steps:
            return []
        between = np.geomspace(self._own, end, steps + 1)[1:-1]
        # Few digits, so that a reported value can be typed in again.
        return [*(float(f"{value:.5g}") for value in between.tolist()), end]

    def _find_end(self, place: int, beyond: int, is_wanted: bool) -> RangeEnd | None:
        """Find the end next to the outermost coarse value that is read; None if that is refuted."""
        works = first = self._values[place]
        fails = outer = self._values[beyond] if 0 <= beyond < len(self._values) else None
        if fails is not None and is_wanted:
            works, fails = self._bisect(works, fails)
        confirmed = self._confirm(works, first)
        if confirmed is None:
            self._refuted.add(place)
            return None
        trial, failing = confirmed
        if (
            fails is not None
            and outer is not None
            and (failing is None or not self._surely_fails(failing))
        ):
            failing = self._find_failing(fails, self._find_last_unread(beyond, beyond - place))
        if failing is None:
            return RangeEnd(trial, None, trial if trial.whole == trial.images else None)
        return RangeEnd(trial, failing, is_bisected=is_wanted)

    def _find_last_unread(self, place: int, direction: int) -> float:
        """Return the last coarse value of a gap, searched in a direction from one of its values."""
        while (
            0 <= place + direction < len(self._values)
            and not self._is_read(self._try(self._values[place + direction]))
        ):  # fmt: skip
            place += direction
        return self._values[place]

    def _bisect(self, works: float, fails: float) -> tuple[float, float]:
        """Bisect, by ratio, between a value that is read and one that is not."""
        first, enough = works, FEW_IMAGES
        while True:
            while max(works, fails) / min(works, fails) > END_RATIO:
                middle = float(f"{math.sqrt(works * fails):.5g}")
                if middle in (works, fails):
                    break
                reads = self._is_read(self._try(middle, enough))
                works, fails = (middle, fails) if reads else (works, middle)
            if works == first or self._is_read(self._try(works, self._settings.images)):
                return works, fails
            # Where the rate falls slowly a few images mislead: repeat the bisection with all
            # images.
            works, fails, enough = first, works, self._settings.images

    def _confirm(self, works: float, inner: float) -> tuple[Trial, Trial | None] | None:
        """Return the nearest value that is read in new images too, and the last one refuted."""
        refuted, step = None, END_RATIO
        while True:
            trial = self._try(works, self._settings.images, self._fresh)
            if self._is_read(trial):
                return trial, refuted and self._try_all_images(refuted.value, self._fresh)
            if works == inner:
                return None
            refuted = trial
            works, step = move_towards(works, inner, step), step * step

    def _find_failing(self, fails: float, outer: float) -> Trial:
        """Return the nearest value beyond an end that fails with confidence in new images.

        If none does up to the end of the gap, return that end, with the images that were used to
        choose it if the new ones are read.
        """
        step = END_RATIO
        while True:
            trial = self._try_all_images(fails, self._fresh)
            if self._surely_fails(trial):
                return trial
            if fails == outer:
                return (
                    trial
                    if not self._is_read(trial)
                    else self._try_all_images(fails, self._settings)
                )
            fails, step = move_towards(fails, outer, step), step * step

    def _try_all_images(self, value: float, settings: RateSettings) -> Trial:
        """Return a trial of all images: the interval does not hold for a count that stops early."""
        return trial_of(value, list(self._take_images(value, settings)), self._bits)

    def _try(
        self, value: float, enough: int = FEW_IMAGES, settings: RateSettings | None = None
    ) -> Trial:
        """Count correct bits until enough images reach the rate or it can no longer be reached."""
        images, bits = self._settings.images, self._bits
        counts: list[int] = []
        for right in self._take_images(value, settings or self._settings):
            counts.append(right)
            read, all_right = len(counts), sum(counts)
            if 100.0 * (all_right + (images - read) * bits) < self._rate * images * bits:
                break
            if read >= enough and 100.0 * all_right >= self._rate * read * bits:
                break
        return trial_of(value, counts, self._bits)

    def _take_images(self, value: float, settings: RateSettings) -> ImageCounts:
        key = value, settings.seed
        if key not in self._images:
            self._images[key] = ImageCounts(
                right_bits_at(self._scene, self._name, value, settings, self._heartbeat)
            )
        return self._images[key]

    def _is_read(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _surely_fails(self, trial: Trial) -> bool:
        return trial.high < self._rate

    def _describe_failure(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._settings.decoders[0]} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.in_sentence} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )


def move_towards(value: float, end: float, ratio: float) -> float:
    """Move a value towards an end by a ratio, and no further than the end."""
    moved = value * ratio if end > value else value / ratio
    moved = float(f"{moved:.5g}")
    return end if (moved - end) * (value - end) <= 0.0 else moved


def other_seed(seed: int) -> int:
    """Return the seed of images that are independent of those of a seed."""
    return int(np.random.SeedSequence([seed, 1]).generate_state(1)[0])
