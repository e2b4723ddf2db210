"""What the columns see of one lamp's chips: lit fractions that are blurred, and a tone curve.

Image processing blurs along the columns, and an LED that turns on faster than off (or a driver that
does) is on a little longer than its chips say.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fit.tone_curve import ToneCurve, ToneSlopes, ToneTable

BLUR_REACH = 8  # maximum distance in columns over which blur acts

_LEAST_BLUR = 0.05  # blur in columns below which a picture is sharp
_CHANGE = 1e-5  # finite difference of the blur in columns

BLUR = 3  # the blur's index among the parameters of slopes: step, exposure, middle, blur and longer

BlurShape = Literal["normal", "box", "exponential"]
"""Blur's distribution: of processing; a box, as resizing blurs; or one with long tails."""

GAMMA = 3
OF_TONE = [GAMMA, 4, 5, 6]
IN_ORDER = [0, 1, 2, 7, 8, *OF_TONE]
"""Indices of gamma, of the tone curve's parameters, and of all in the order of slopes."""


class BlurredLight:
    """The light of chips that are sent repeatedly, as blurred columns see it.

    ``chips``: shape (chips,), one period, neither all on nor all off.
    """

    def __init__(self, chips: ByteArray, columns: int) -> None:
        self._period = len(chips)
        self._columns = columns
        change = chips.astype(np.int64) - np.roll(chips, 1)
        places = np.flatnonzero(change)
        turns = np.concatenate([places - self._period, places, places + self._period])
        self._edges = turns.astype(np.float64)
        self._changes = np.tile(change[places], 3).astype(np.float64)
        # After each edge; the level before it is that of the edge before.
        self._levels = np.tile(chips[places], 3).astype(np.float64)
        self._a_period = len(places)
        # Slopes are needed where the light has just been computed.
        self._exposed = lru_cache(maxsize=1)(self._exposed_in)

    def lit_fraction(
        self,
        timing: Timing,
        blur: float,
        longer: float,
        shape: BlurShape = "normal",
    ) -> FloatArray:
        """Return the fraction of each column's exposure in which the LED is on, shape (columns,).

        ``blur``: its standard deviation in columns. ``longer``: chips by which each time on is
        longer than the chips say.
        """
        return blurred(self.sharp(timing, longer), blur_kernel(blur, shape))

    def sharp(self, timing: Timing, longer: float) -> FloatArray:
        """Return the fractions without blur, also of neighbouring columns that blur reaches."""
        return self._exposed(timing, longer).lit

    def slopes(
        self, timing: Timing, blur: float, longer: float, shape: BlurShape = "normal"
    ) -> FloatArray:
        """Return slopes over step, exposure, middle, blur and longer, shape (5, columns)."""
        slopes = blurred(self.sharp_slopes(timing, longer), blur_kernel(blur, shape))
        slopes[BLUR] = blurred(self.sharp(timing, longer), kernel_slope(blur, shape))
        return slopes

    def sharp_slopes(self, timing: Timing, longer: float) -> FloatArray:
        """Return the slopes of the fractions without blur, of which those over the blur are 0.

        The running integral's slope is the level, and the edges that were passed before are each
        early by half of what the time on is longer.
        """
        seen = self._exposed(timing, longer)
        slopes = np.empty((5, len(seen.lit)))
        slopes[:BLUR] = timing.slopes_between(seen.lit, *seen.levels)
        slopes[BLUR] = 0.0
        np.multiply(seen.edges, 0.5 / timing.exposure, out=slopes[BLUR + 1])
        return slopes

    def _exposed_in(self, timing: Timing, longer: float) -> "_Exposed":
        """Integrate the light over the exposures of all columns that blur reaches."""
        edges = self._edges - 0.5 * longer * self._changes
        # The running integral has corners at the edges; it is 0 at the first of them.
        integral = np.concatenate([[0.0], np.cumsum(self._levels[:-1] * np.diff(edges))])
        light = integral[self._a_period] - integral[0]
        column = np.arange(-BLUR_REACH, self._columns + BLUR_REACH)
        start = timing.start(self._columns) + timing.step * column
        ends = np.stack([start, start + timing.exposure])
        turns = np.floor(ends / self._period)
        ends -= turns * self._period
        passed = np.searchsorted(edges, ends.ravel()).reshape(ends.shape) - 1
        level = self._levels.take(passed)
        until = turns * light + integral.take(passed) + level * (ends - edges.take(passed))
        number = passed + turns * self._a_period
        return _Exposed(
            (until[1] - until[0]) / timing.exposure, (level[0], level[1]), number[1] - number[0]
        )


@dataclass(frozen=True, eq=False, slots=True)
class _Exposed:
    """What the columns' exposures contain, each of shape (columns and those beside,)."""

    lit: FloatArray  # The fraction of the time in which the LED is on
    levels: tuple[FloatArray, FloatArray]  # Whether it is on where an exposure starts and ends
    edges: FloatArray  # How often it turns on or off meanwhile


def blurred(rows: FloatArray, kernel: FloatArray) -> FloatArray:
    """Blur a row, or several, along the columns, and leave out those that only blur reaches."""
    found = cv2.filter2D(np.atleast_2d(rows), -1, kernel[None])[:, BLUR_REACH:-BLUR_REACH]
    return np.asarray(found, dtype=np.float64).reshape(*rows.shape[:-1], -1)


@lru_cache(maxsize=8)
def blur_kernel(blur: float, shape: BlurShape = "normal") -> FloatArray:
    """Return the weights of blur of the standard deviation ``blur``, in columns, around a column.

    A box of the half width sqrt(3) blur gives each column the fraction of it that the column
    covers; exponential tails decay by the same ratio from column to column.
    """
    off = np.abs(np.arange(-BLUR_REACH, BLUR_REACH + 1)).astype(np.float64)
    blur = max(blur, _LEAST_BLUR)
    if shape == "box":
        half = math.sqrt(3.0) * blur
        kernel = np.clip(np.minimum(off + 0.5, half) - np.maximum(off - 0.5, -half), 0.0, None)
    elif shape == "exponential":
        # Of weights r^|i| the variance is 2 r / (1 - r)^2.
        middle = 1.0 + 1.0 / blur**2
        kernel = (middle - math.sqrt(middle**2 - 1.0)) ** off
    else:
        kernel = np.exp(-0.5 * (off / blur) ** 2)
    weights = np.asarray(kernel / kernel.sum(), dtype=np.float64)
    weights.flags.writeable = False
    return weights


@lru_cache(maxsize=8)
def kernel_slope(blur: float, shape: BlurShape = "normal") -> FloatArray:
    """Return the slope of the weights of blur over its standard deviation."""
    more, less = (blur_kernel(blur + change, shape) for change in (_CHANGE, -_CHANGE))
    slope = np.asarray((more - less) / (2.0 * _CHANGE))
    slope.flags.writeable = False
    return slope


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """What the columns see: lit fractions, blurred, or sharp and blurred as pixel values."""

    lit: FloatArray
    table: ToneTable
    sharp: FloatArray | None  # also of the columns beside that blur reaches
    kernel: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class SeenSlopes:
    # Shape (light's parameters, columns); of the blurred lit fractions. Where pixel values are
    # blurred, of the sharp ones, also of the columns beside that blur reaches.
    lit: FloatArray
    tone: ToneSlopes  # of the tone curve, over its own parameters
    kernel: FloatArray  # shape (weights,); of the blur's weights, over the blur


class SeenStripes:
    def __init__(
        self, chips: ByteArray, columns: int, gamma: float, *, values_blurred: bool
    ) -> None:
        self._light = BlurredLight(chips, columns)
        self._gamma, self._values_blurred = gamma, values_blurred
        # Slopes are needed where the residual has just been computed.
        self._last = lru_cache(maxsize=1)(self._by)

    def by(self, values: FloatArray, shape: BlurShape = "normal") -> Seen:
        """Return what is seen by nine parameters, and the blur's shape."""
        return self._last(tuple(values.tolist()), shape)

    def slopes(self, values: FloatArray, shape: BlurShape, of_tone: bool = True) -> SeenSlopes:
        """Return the slopes of what is seen, those of the tone over gamma itself, or none."""
        timing, curve, blur, longer = self._parts(values.tolist())
        table = self.by(values, shape).table
        if self._values_blurred:
            lit = self._light.sharp_slopes(timing, longer)
        else:
            lit = self._light.slopes(timing, blur, longer, shape)
        tone = curve.slopes(table) if of_tone else ToneSlopes(table)
        return SeenSlopes(lit, tone, kernel_slope(blur, shape))

    def gamma(self, values: FloatArray | Sequence[float]) -> float:
        """Return the gamma, of which the parameters hold the logarithm over the usual one."""
        return self._gamma * math.exp(values[GAMMA])

    def _by(self, values: Sequence[float], shape: BlurShape) -> Seen:
        timing, curve, blur, longer = self._parts(values)
        sharp = self._light.sharp(timing, longer) if self._values_blurred else None
        return Seen(
            self._light.lit_fraction(timing, blur, longer, shape),
            curve.table(),
            sharp,
            blur_kernel(blur, shape),
        )

    def _parts(self, values: Sequence[float]) -> tuple[Timing, ToneCurve, float, float]:
        step, exposure, middle, _, offset, shoulder, contrast, blur, longer = values
        curve = ToneCurve(self.gamma(values), offset, shoulder, contrast)
        return Timing(step, exposure, middle, self._gamma), curve, blur, longer
