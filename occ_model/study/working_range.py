"""Search for the values of one parameter at which a decoder reads a scene.

The parameter is varied by itself, over the range of its slider, widened where the scene's own value
lies outside, and shortened where a decoder would take too long. A coarse search tries values in
steps of a factor ``STEP``. Success need not fall steadily: at low frequencies too few packets fit
the picture, and beyond a null the stripes come back. The answer is therefore a list of intervals. A
gap narrower than a step can be missed. The outermost ends, and those of the interval that holds the
scene's own value or is nearest to it, are found by bisection to a factor ``END_RATIO``; other gaps
are known to a step of the coarse search.

Images are spent where the rate is in doubt. A value is given up as soon as too many bits are wrong
for further images to mend, and believed after ``FEW_IMAGES`` that reach the rate. Values on both
sides of an end are then tried with images of another seed, which have not chosen them; an end that
these refute is moved: the value beyond an end surely fails, as its 95 % interval lies below the
rate. No image of a value is simulated twice. How far inside the end may lie is another question:
see :mod:`occ_model.study.sure_ends`.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import count

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.plugins import Faults
from occ_model.receiver.decoders import decoder_named
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.study.confidence import trial_of
from occ_model.study.success_rate import right_bits_of_images

STEP = 1.15  # ratio of neighbouring values in the first, coarse search
END_RATIO = 1.003  # ratio of the values on both sides of an end at which its bisection stops
READ_RATE = 99.0  # success rate in percent from which a decoder is taken to read
FEW_IMAGES = 5  # images after which a value is believed to be read, until it is reported


def working_range(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
) -> WorkingRange:
    """Find a parameter's intervals that a decoder reads; ``settings``: checked, of one decoder."""
    with Faults().counting() as faults:
        found = _Search(scene, name, rate, settings, heartbeat).working_range()
    return replace(found, faults=str(faults))


def expected_images(images: int) -> int:
    """Return how many images a search usually reads, from which its progress is estimated."""
    coarse = 25 * FEW_IMAGES + 15 + images
    ends = 2 * math.ceil(math.log2(math.log(STEP) / math.log(END_RATIO))) * FEW_IMAGES + 8 * images
    return coarse + ends


def right_bits_at(
    scene: Scene, name: str, value: float, settings: RateSettings, heartbeat: Heartbeat
) -> Iterator[int]:
    """Count the bits read correctly in each image at a value, as a decoder reads them."""
    at = scene.replace(**{name: value})
    return (right for (right,) in right_bits_of_images(at, settings, heartbeat))


class Images:
    """The bits that are read correctly in the images at one value, one image after the other."""

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


class _Search:
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
        assert isinstance(parameter, Quantity)  # noqa: S101 - the two that are searched are
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
        self._images: dict[tuple[float, int], Images] = {}
        self._refuted: set[int] = set()

    def working_range(self) -> WorkingRange:
        values = self._values
        searched = (values[0], values[-1])
        own = self._whole(self._own, self._settings)
        while True:
            runs = self._runs()
            intervals = [self._interval(run, runs) for run in runs]
            found = tuple(interval for interval in intervals if interval is not None)
            if len(found) == len(runs):
                break
        if found:
            return WorkingRange(self._name, searched, STEP, own, found, most_chips=self._most_chips)
        best = max((self._try(value) for value in values), key=lambda trial: trial.rate)
        best = self._whole(best.value, self._settings)
        failure = self._nowhere(searched, best)
        return WorkingRange(self._name, searched, STEP, own, (), failure, best, self._most_chips)

    def _runs(self) -> list[tuple[int, int]]:
        """Return the indices of the first and the last coarse value of each interval."""
        runs: list[tuple[int, int]] = []
        for place, value in enumerate(self._values):
            if place in self._refuted or not self._reads(self._try(value)):
                continue
            if runs and runs[-1][1] == place - 1:
                runs[-1] = (runs[-1][0], place)
            else:
                runs.append((place, place))
        return runs

    def _interval(self, run: tuple[int, int], runs: list[tuple[int, int]]) -> ReadInterval | None:
        """Return an interval; None where an end of it is refuted, which is noted."""
        first, last = run
        is_own = run == min(runs, key=self._away)
        lowest = self._end(first, first - 1, is_own or run == runs[0])
        highest = self._end(last, last + 1, is_own or run == runs[-1])
        if lowest is None or highest is None:
            return None
        return ReadInterval(*(
            replace(end, inside=None)
            if end.inside and not lowest.value <= end.inside.value <= highest.value
            else end
            for end in (lowest, highest)
        ))  # fmt: skip

    def _away(self, run: tuple[int, int]) -> float:
        """Return an interval's distance from the scene's own value, as a logarithm."""
        low, high = (math.log(self._values[place] / self._own) for place in run)
        return max(low, -high, 0.0)

    def _coarse_values(self) -> list[float]:
        """Return values in even ratios from the scene's own to both ends."""
        down = self._towards(self._low)
        return [*reversed(down), self._own, *self._towards(self._high)]

    def _towards(self, end: float) -> list[float]:
        steps = math.ceil(abs(math.log(end / self._own)) / math.log(STEP))
        if not steps:
            return []
        between = np.geomspace(self._own, end, steps + 1)[1:-1]
        # Few digits, so that a value that is reported can be typed in again.
        return [*(float(f"{value:.5g}") for value in between.tolist()), end]

    def _end(self, place: int, beyond: int, is_wanted: bool) -> RangeEnd | None:
        """Find an end after the last coarse value read; None if that is refuted."""
        works = first = self._values[place]
        fails = outer = self._values[beyond] if 0 <= beyond < len(self._values) else None
        if fails is not None and is_wanted:
            works, fails = self._bisected(works, fails)
        confirmed = self._confirmed(works, first)
        if confirmed is None:
            self._refuted.add(place)
            return None
        trial, failing = confirmed
        if (
            fails is not None
            and outer is not None
            and (failing is None or not self._fails(failing))
        ):
            failing = self._failing(fails, self._furthest(beyond, beyond - place))
        if failing is None:
            return RangeEnd(trial, None, trial if trial.whole == trial.images else None)
        return RangeEnd(trial, failing, is_bisected=is_wanted)

    def _furthest(self, place: int, direction: int) -> float:
        """Return the last coarse value of a gap, from one of its values on."""
        while (
            0 <= place + direction < len(self._values)
            and not self._reads(self._try(self._values[place + direction]))
        ):  # fmt: skip
            place += direction
        return self._values[place]

    def _bisected(self, works: float, fails: float) -> tuple[float, float]:
        """Bisect, by ratio, between a value that surely works and one that fails."""
        first, enough = works, FEW_IMAGES
        while True:
            while max(works, fails) / min(works, fails) > END_RATIO:
                middle = float(f"{math.sqrt(works * fails):.5g}")
                if middle in (works, fails):
                    break
                reads = self._reads(self._try(middle, enough))
                works, fails = (middle, fails) if reads else (works, middle)
            if works == first or self._reads(self._try(works, self._settings.images)):
                return works, fails
            # Few images mislead here: the rate falls slowly. Between sure values again, with all.
            works, fails, enough = first, works, self._settings.images

    def _confirmed(self, works: float, inner: float) -> tuple[Trial, Trial | None] | None:
        """Return the nearest value at which other images are read too, and the last refuted one."""
        refuted, step = None, END_RATIO
        while True:
            trial = self._try(works, self._settings.images, self._fresh)
            if self._reads(trial):
                return trial, refuted and self._whole(refuted.value, self._fresh)
            if works == inner:
                return None
            refuted = trial
            works, step = moved(works, inner, step), step * step

    def _failing(self, fails: float, outer: float) -> Trial:
        """Return the nearest value beyond an end that other images show to fail surely.

        Where none does up to the end of the gap, that is returned by the images that chose it.
        """
        step = END_RATIO
        while True:
            trial = self._whole(fails, self._fresh)
            if self._fails(trial):
                return trial
            if fails == outer:
                return trial if not self._reads(trial) else self._whole(fails, self._settings)
            fails, step = moved(fails, outer, step), step * step

    def _whole(self, value: float, settings: RateSettings) -> Trial:
        """Return a trial of all images: a count ended by its own result has another interval."""
        return trial_of(value, list(self._images_at(value, settings)), self._bits)

    def _try(
        self, value: float, enough: int = FEW_IMAGES, settings: RateSettings | None = None
    ) -> Trial:
        """Count right bits until the rate cannot be reached, or is reached by enough images."""
        images, bits = self._settings.images, self._bits
        counts: list[int] = []
        for right in self._images_at(value, settings or self._settings):
            counts.append(right)
            read, all_right = len(counts), sum(counts)
            if 100.0 * (all_right + (images - read) * bits) < self._rate * images * bits:
                break
            if read >= enough and 100.0 * all_right >= self._rate * read * bits:
                break
        return trial_of(value, counts, self._bits)

    def _images_at(self, value: float, settings: RateSettings) -> Images:
        key = value, settings.seed
        if key not in self._images:
            self._images[key] = Images(
                right_bits_at(self._scene, self._name, value, settings, self._heartbeat)
            )
        return self._images[key]

    def _reads(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _fails(self, trial: Trial) -> bool:
        return trial.high < self._rate

    def _nowhere(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._settings.decoders[0]} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.in_sentence} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )


def moved(value: float, end: float, ratio: float) -> float:
    """Move a value towards an end by a ratio, and no further than the end."""
    moved = value * ratio if end > value else value / ratio
    moved = float(f"{moved:.5g}")
    return end if (moved - end) * (value - end) <= 0.0 else moved


def other_seed(seed: int) -> int:
    """Return the seed of images that have nothing in common with those of a seed."""
    return int(np.random.SeedSequence([seed, 1]).generate_state(1)[0])
