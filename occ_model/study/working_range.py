"""Search for the values of one parameter at which a decoder reads a scene.

The parameter is varied by itself, over the range of its slider, widened where the scene's own value
lies outside. A coarse search tries values in steps of a factor ``STEP``, from that value outwards.
Success need not fall steadily: at low frequencies too few packets fit the picture, and beyond a
null the stripes come back. The answer is therefore one interval in which the coarse search saw no
failure: the one that holds the scene's own value, or else the nearest by ratio. A gap narrower than
a step can be missed. Each end is then found by bisection, to a factor ``NEAR``.

Images are spent where the rate is in doubt. A value is given up as soon as too many bits are wrong
for further images to mend, and believed after ``FEW_IMAGES`` that reach the rate; between the two
it is tried further. The values reported, on both sides of each end, are tried with all images; an
end that they refute is searched once more with all images at each value. No image of a value is
simulated twice.
"""

import math
from collections.abc import Callable, Iterator
from itertools import count

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.results import RangeEnd, RateSettings, SweepPoint, Trial, WorkingRange
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import right_bits_of_images
from occ_model.study.sweep.counts import rate_intervals

STEP = 1.15
"""Ratio of neighbouring values in the first, coarse search."""

NEAR = 1.003
"""Ratio of the values on both sides of an end of the interval at which its bisection stops."""

MARGIN = 1.01
"""Ratio between an end and the nearest value inside that is offered as one that is surely read."""

MOST_MARGINS = 5
"""How often that step is made until a value is found at which every bit is read."""

FEW_IMAGES = 3
"""Images after which a value is believed to be read, until it is reported."""


def working_range(
    scene: Scene,
    name: str,
    rate: float,
    settings: RateSettings,
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float], object] = lambda _share: None,
) -> WorkingRange:
    """Find the interval of values of a parameter at which a decoder reads a scene.

    Parameters
    ----------
    scene
        The scene.
    name
        The parameter, a quantity.
    rate
        Success rate in percent from which it counts as reading.
    settings
        Checked, with one decoder; the images are those of each value that is reported.
    heartbeat
        Called before each image; what it raises ends the search.
    progress
        Called with the share of the search that is done, from 0 to 1.

    Raises
    ------
    ProjectionError
        The scene has no picture.
    """
    return _Search(scene, name, rate, settings, heartbeat, progress).working_range()


def expected_images(images: int) -> int:
    """Return how many images a search usually reads, from which its progress is estimated."""
    coarse = 15 * FEW_IMAGES + 10
    ends = 2 * math.ceil(math.log2(math.log(STEP) / math.log(NEAR))) * 2 + 5 * images
    return coarse + ends


class _Images:
    """The bits that are read rightly in the images at one value, one image after the other."""

    def __init__(self, images: Iterator[tuple[int, ...]]) -> None:
        self._coming = images
        self._seen: list[int] = []

    def __iter__(self) -> Iterator[int]:
        for place in count():
            if place == len(self._seen):
                following = next(self._coming, None)
                if following is None:
                    return
                self._seen += following
            yield self._seen[place]


class _Search:
    """A search for the values of one parameter at which a scene is read."""

    def __init__(
        self,
        scene: Scene,
        name: str,
        rate: float,
        settings: RateSettings,
        heartbeat: Heartbeat,
        progress: Callable[[float], object],
    ) -> None:
        self._scene = scene
        self._name = name
        self._rate = rate
        self._settings = settings
        self._heartbeat = heartbeat
        self._progress = progress
        parameter = PARAMETERS[name]
        assert isinstance(parameter, Quantity)  # noqa: S101 - the two that are searched are
        self._parameter = parameter
        self._own = float(scene.value(name))
        low, high = parameter.slider
        self._low, self._high = min(low, self._own), max(high, self._own)
        self._values = self._coarse_values()
        self._images: dict[float, _Images] = {}
        self._coarse: dict[int, Trial] = {}
        self._spent = 0

    def working_range(self) -> WorkingRange:
        """Find the interval of values."""
        values = self._values
        searched = (values[0], values[-1])
        while (interval := self._interval()) is not None:
            for place in interval:
                self._coarse[place] = self._sure(self._coarse[place])
            if all(self._reads(self._coarse[place]) for place in interval):
                break
        if interval is None:
            best = self._whole(max(self._trials_in_order(), key=lambda trial: trial.rate))
            self._progress(1.0)
            failure = self._nowhere(searched, best)
            return WorkingRange(self._name, searched, None, None, failure, best)
        first, last = interval
        below = self._trial(first - 1) if first > 0 else None
        above = self._trial(last + 1) if last < len(values) - 1 else None
        lowest = self._range_end(self._coarse[first], below)
        highest = self._range_end(self._coarse[last], above)
        self._progress(1.0)
        return WorkingRange(self._name, searched, lowest, highest)

    def _trials_in_order(self) -> list[Trial]:
        return [self._trial(place) for place in range(len(self._values))]

    def _trial(self, place: int) -> Trial:
        """Try a value of the coarse search, once."""
        if place not in self._coarse:
            self._coarse[place] = self._try(self._values[place])
        return self._coarse[place]

    def _interval(self) -> tuple[int, int] | None:
        """Return the first and the last value of the interval that is read, by their places."""
        places = range(len(self._values))
        outwards = sorted(places, key=lambda at: abs(math.log(self._values[at] / self._own)))
        nearest = next((at for at in outwards if self._reads(self._trial(at))), None)
        if nearest is None:
            return None
        first = last = nearest
        while first > 0 and self._reads(self._trial(first - 1)):
            first -= 1
        while last < len(places) - 1 and self._reads(self._trial(last + 1)):
            last += 1
        return first, last

    def _coarse_values(self) -> list[float]:
        """Give values in even ratios from the scene's own to both ends."""
        down = self._towards(self._low)
        return [*reversed(down), self._own, *self._towards(self._high)]

    def _towards(self, end: float) -> list[float]:
        steps = math.ceil(abs(math.log(end / self._own)) / math.log(STEP))
        if not steps:
            return []
        between = np.geomspace(self._own, end, steps + 1)[1:-1]
        # Few digits, so that a value that is reported can be typed in again.
        return [*(float(f"{value:.5g}") for value in between.tolist()), end]

    def _range_end(self, works: Trial, fails: Trial | None) -> RangeEnd:
        """Bisect, by ratio, between a value that surely works and one that fails."""
        believed, enough = works, FEW_IMAGES
        while fails is not None:
            middle = float(f"{math.sqrt(believed.value * fails.value):.5g}")
            values = believed.value, fails.value
            if max(values) / min(values) > NEAR and middle not in values:
                trial = self._try(middle, enough)
                believed, fails = (trial, fails) if self._reads(trial) else (believed, trial)
                continue
            believed = self._sure(believed)
            if self._reads(believed):
                break
            # Few images mislead here: the rate falls slowly. Between sure values again, with all.
            believed, fails, enough = works, believed, self._settings.images
        works = believed
        if fails is None:
            return RangeEnd(works, None, self._inside(works, 0))
        fails = self._whole(fails)
        return RangeEnd(works, fails, self._inside(works, 1 if fails.value < works.value else -1))

    def _inside(self, works: Trial, direction: int) -> Trial | None:
        """Find a value at which every bit of all images is read, in small steps from an end."""
        value = works.value
        for _ in range(MOST_MARGINS):
            value = float(f"{value * MARGIN**direction:.4g}")
            trial = self._sure(works if value == works.value else self._try(value))
            if trial.right == trial.sent and trial.images == self._settings.images:
                return trial
            direction = direction or (1 if value <= self._low else -1)
        return None

    def _sure(self, trial: Trial) -> Trial:
        """Return a trial of all images, or of as many as make it sure that it fails."""
        return self._try(trial.value, self._settings.images) if self._reads(trial) else trial

    def _whole(self, trial: Trial) -> Trial:
        """Return a trial of all images.

        A count that was ended by its own result would not have the interval that is stated.
        """
        counts = list(self._images_at(trial.value))
        return self._trial_of(trial.value, sum(counts), len(counts))

    def _try(self, value: float, enough: int = FEW_IMAGES) -> Trial:
        """Count right bits until the rate cannot be reached, or is reached by enough images."""
        images, bits = self._settings.images, self._scene.transmitter.payload_length
        right = read = 0
        for read, count_of_image in enumerate(self._images_at(value), 1):
            right += count_of_image
            most = right + (images - read) * bits
            if 100.0 * most < self._rate * images * bits:
                break
            if read >= enough and 100.0 * right >= self._rate * read * bits:
                break
        return self._trial_of(value, right, read)

    def _trial_of(self, value: float, right: int, images: int) -> Trial:
        sent = images * self._scene.transmitter.payload_length
        ((low, high),) = rate_intervals(SweepPoint(0, sent, (right,)))
        return Trial(value, right, sent, low, high, images)

    def _images_at(self, value: float) -> _Images:
        if value not in self._images:
            scene = self._scene.replace(**{self._name: value})
            counts = right_bits_of_images(scene, self._settings, self._on_image)
            self._images[value] = _Images(counts)
        return self._images[value]

    def _on_image(self) -> None:
        self._heartbeat()
        self._spent += 1
        self._progress(min(self._spent / expected_images(self._settings.images), 0.99))

    def _reads(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _nowhere(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._settings.decoders[0]} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.label.lower()} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )
