"""Search for the switching frequencies and exposure times at which a decoder reads a scene.

Each parameter is varied by itself, over the range of its slider, widened where the scene's own
value lies outside. A coarse search tries values in steps of a factor ``STEP`` up and down from that
value. Success need not fall steadily: at low frequencies too few packets fit the picture, and
beyond a null the stripes come back. The answer is therefore one interval in which the coarse search
saw no failure: the one that holds the scene's own value, or else the nearest by ratio. A gap
narrower than a step can be missed. Each end is then found by bisection, to a factor ``NEAR``.

Images are spent where the rate is in doubt: a value at which too many bits are wrong for further
images to mend is given up at once, and the coarse search takes few images. The values reported, on
both sides of each end, are tried with all of them.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from numbers import Real

import numpy as np

from occ_model.errors import ParameterError, shown
from occ_model.parallel.job import Heartbeat
from occ_model.receiver.decoders import PAPER_DECODER
from occ_model.results import (
    Limits,
    RangeEnd,
    RateSettings,
    SignalPath,
    SweepPoint,
    Trial,
    WorkingRange,
)
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, check_scene
from occ_model.scene.simulation_settings import TOLERANCE
from occ_model.study.success_rate import check_rate, right_bits_of_images
from occ_model.study.sweep.counts import rate_intervals

STEP = 1.15
"""Ratio of neighbouring values in the first, coarse search."""

NEAR = 1.003
"""Ratio of the values on both sides of an end of the interval at which its bisection stops."""


MARGIN = 1.01
"""Ratio between an end and the nearest value inside that is offered as one that is surely read."""

MOST_MARGINS = 5
"""How often that step is made until a value is found at which every bit is read."""

COARSE_IMAGES = 5
"""Images at each value of the coarse search."""


def limits(  # noqa: PLR0913 - a study's settings, most of them optional
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    rate: float = 99.0,
    images: int = 20,
    seed: int = 1,
    tolerance: float = TOLERANCE.default,
    force: Mapping[str, bool] | None = None,
    path: SignalPath = "auto",
    heartbeat: Heartbeat = lambda: None,
    progress: Callable[[float, str], object] = lambda _share, _what: None,
) -> Limits:
    """Find the switching frequencies and the exposure times at which a decoder reads a scene.

    Each answer is the interval that holds the scene's own value, or else the nearest by ratio. Its
    ends are found by bisection; a gap narrower than a step of ``STEP`` can be missed.

    Parameters
    ----------
    scene
        The scene.
    decoder
        The decoder's name.
    rate
        Success rate in percent from which it counts as reading, above 0.
    images
        Images at each value: the more of them, the narrower the confidence interval of each end.
    seed
        Seed of each value's start times and noise.
    tolerance, force, path
        As for :func:`occ_model.success_rate`. The profile path takes a second, a sample of the rows
        some ten, whole images minutes.
    heartbeat
        Called before each image; what it raises ends the search.
    progress
        Called with the share of the search that is done, from 0 to 1, and what is being searched.

    Raises
    ------
    ParameterError
        The rate is not from above 0 to 100 %, or another argument is not allowed.
    ProjectionError
        The scene has no picture.
    """
    check_scene(scene)
    settings = RateSettings(images, (decoder,), seed, tolerance, force or {}, path)
    check_rate(scene, settings)
    wanted = _checked(rate)
    frequency, exposure = (
        _Search(
            scene, name, wanted, settings, heartbeat, partial(_report, progress, place)
        ).working_range()
        for place, name in enumerate(_SEARCHED)
    )
    progress(1.0, "")
    return Limits(scene, decoder, wanted, images, seed, frequency, exposure)


_SEARCHED = ("switching_frequency", "exposure_time")


def _report(progress: Callable[[float, str], object], place: int, share: float) -> None:
    label = PARAMETERS[_SEARCHED[place]].label.lower()
    progress((place + share) / len(_SEARCHED), label)


def _checked(rate: object) -> float:
    number = isinstance(rate, Real) and not isinstance(rate, bool)
    if not number or not 0.0 < rate <= 100.0:  # type: ignore[operator]
        raise ParameterError(f"rate is {shown(rate)} %; allowed: above 0 % to 100 %.")
    return float(rate)  # type: ignore[arg-type]


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
        few = min(COARSE_IMAGES, settings.images)
        bisections = 2 * math.ceil(math.log2(math.log(STEP) / math.log(NEAR)))
        self._expected = len(self._values) * few + (2 + bisections) * settings.images
        self._spent = 0

    def working_range(self) -> WorkingRange:
        """Find the interval of values."""
        values = self._values
        few = min(COARSE_IMAGES, self._settings.images)
        trials = [self._try(value, few) for value in values]
        searched = (values[0], values[-1])
        while (interval := self._interval(trials)) is not None:
            ends = sorted(set(interval))
            for place in ends:
                if trials[place].images < self._settings.images:
                    trials[place] = self._try(values[place], self._settings.images)
            if all(self._reads(trials[place]) for place in ends):
                break
        if interval is None:
            best = self._whole(max(trials, key=lambda trial: trial.rate))
            failure = self._nowhere(searched, best)
            return WorkingRange(self._name, searched, None, None, failure, best)
        first, last = interval
        below = trials[first - 1] if first > 0 else None
        above = trials[last + 1] if last < len(values) - 1 else None
        lowest = self._range_end(trials[first], below)
        highest = self._range_end(trials[last], above)
        self._progress(1.0)
        return WorkingRange(self._name, searched, lowest, highest)

    def _interval(self, trials: Sequence[Trial]) -> tuple[int, int] | None:
        """Return the first and the last value of the interval that is read, by their places."""
        works = [self._reads(trial) for trial in trials]
        nearest = min(
            (place for place, good in enumerate(works) if good),
            key=lambda place: abs(math.log(self._values[place] / self._own)),
            default=None,
        )
        if nearest is None:
            return None
        first = last = nearest
        while first > 0 and works[first - 1]:
            first -= 1
        while last < len(works) - 1 and works[last + 1]:
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
        """Bisect, by ratio, between a value that works and one that fails."""
        while fails is not None:
            middle = float(f"{math.sqrt(works.value * fails.value):.5g}")
            ratio = max(works.value, fails.value) / min(works.value, fails.value)
            if ratio <= NEAR or middle in (works.value, fails.value):
                break
            trial = self._try(middle, self._settings.images)
            works, fails = (trial, fails) if self._reads(trial) else (works, trial)
        if fails is None:
            return RangeEnd(works, None, self._inside(works, 0))
        fails = self._whole(fails)
        return RangeEnd(works, fails, self._inside(works, 1 if fails.value < works.value else -1))

    def _inside(self, works: Trial, direction: int) -> Trial | None:
        """Find a value at which every bit of all images is read, in small steps from an end."""
        value = works.value
        for _ in range(MOST_MARGINS):
            value = float(f"{value * MARGIN**direction:.4g}")
            trial = works if value == works.value else self._count(value)
            if trial.right == trial.sent:
                return trial
            direction = direction or (1 if value <= self._low else -1)
        return None

    def _whole(self, trial: Trial) -> Trial:
        """Return a trial of all images.

        A count that was ended by its own result would not have the interval that is stated.
        """
        return trial if trial.images == self._settings.images else self._count(trial.value)

    def _try(self, value: float, images: int) -> Trial:
        """Count right bits, until all images are read or the rate can no longer be reached."""
        trial = self._count(value, images, self._rate / 100.0)
        self._spent += images
        self._progress(min(self._spent / self._expected, 1.0))
        return trial

    def _count(self, value: float, images: int | None = None, least_share: float = 0.0) -> Trial:
        """Count right bits in some images, all if not said, as long as a share can be reached."""
        images = images or self._settings.images
        scene = self._scene.replace(**{self._name: value})
        bits = scene.transmitter.payload_length
        least = least_share * images * bits
        right = read = 0
        settings = replace(self._settings, images=images)
        for (count,) in right_bits_of_images(scene, settings, self._heartbeat):
            right, read = right + count, read + 1
            if right + (images - read) * bits < least:
                break
        ((low, high),) = rate_intervals(SweepPoint(0, read * bits, (right,)))
        return Trial(value, right, read * bits, low, high, read)

    def _reads(self, trial: Trial) -> bool:
        return 100.0 * trial.right >= self._rate * trial.sent

    def _nowhere(self, searched: tuple[float, float], best: Trial) -> str:
        write = self._parameter.format
        return (
            f"The {self._settings.decoders[0]} decoder reads {self._rate:g} % of the bits at no "
            f"{self._parameter.label.lower()} from {write(searched[0])} to {write(searched[1])}; "
            f"the most it reads is {best.right} of {best.sent} bits, at {write(best.value)}."
        )
