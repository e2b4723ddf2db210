"""Fit the exposure model to a profile of stripes by least squares.

A profile is low(i) + swing(i) x response(lit(i)): the lit fraction of the exact exposure integral,
through the camera's response, between two levels that vary slowly along the columns. For a given
timing the levels are a linear fit, so that the search is over the timing alone (variable
projection: Golub and Pereyra, SIAM J. Numer. Anal. 10:413, 1973).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import FLAT_SPAN, WHITE
from occ_model.photo.fit.camera_response import PixelResponse
from occ_model.photo.fit.damped_least_squares import Bounds, minimize_squares
from occ_model.photo.fit.levels import LevelShapes, LitColumns
from occ_model.photo.fit.timing import SHORTEST_EXPOSURE, ChipLight, Timing
from occ_model.photo.stripes.envelope import LEAST_SWING, weighted_correlation
from occ_model.photo.stripes.period import correlated_columns
from occ_model.products import combine, dot, row_products
from occ_model.scene.parameters import quantity

_SATURATED_LEVEL = WHITE - 0.5
_LEAST_KEPT = 0.4  # minimum unsaturated fraction for saturated columns to be left out

_MOST_ROUNDS = 25
_LEAST_GAIN = 1e-6  # minimum relative decrease of the sum of squares for a further iteration

_REGULARIZATION = 1e-4
"""Regularization of the covariance: a parameter on which no column depends gets a standard
deviation of a hundred of its scales."""

_SINGULAR = 1e-13  # fraction of the largest sum of squares below which one is rounding error

_CHIPS_PER_SHAPE, _SHAPES = 6, (4, 8)
"""Chips in view for each polynomial of a level, and limits of their number: hot spots need four."""

_UNKNOWN_BLUR = 0.4  # standard deviation in columns of the blur that this model does not fit
_LEAST_DARK_LEVEL = -0.1  # minimum dark level relative to the swing: pixel values are not negative


@dataclass(frozen=True, eq=False, slots=True)
class StripeFit:
    timing: Timing
    # Shape (4, 4); the covariance of the timing's fields in their order; 0 for gamma where it was
    # given.
    covariance: FloatArray
    low: FloatArray  # shape (columns,); low, swing: the levels in grey levels
    swing: FloatArray
    profile: FloatArray  # shape (columns,); the model in grey levels
    correlation: float  # correlation of data and model, both without the uneven light
    residual: float  # sum of the squared differences of data and model
    # Whether the levels can be a picture's: lit above dark, and dark not negative.
    is_possible: bool


class StripeModel:
    """The model of one profile, for one sequence of chips and one response of the camera.

    ``response``: None for a profile of light, which is linear in the lit fractions. ``step``: chips
    per column, roughly: the number of chips limits the degrees of freedom of the levels. What
    ``check`` raises ends a fit.
    """

    def __init__(
        self,
        profile: FloatArray,
        chips: ByteArray,
        response: PixelResponse | None,
        step: float,
        check: Callable[[], object] = lambda: None,
    ) -> None:
        self._profile, self._check = profile, check
        self._light = ChipLight(chips, len(profile))
        self._response = response or PixelResponse()
        self._step = step
        # The same number for both levels, or else the mean would fit better than the swing.
        freedom = level_freedom(step * len(profile))
        kept: NDArray[np.bool_] = profile < _SATURATED_LEVEL
        self._kept = kept if kept.mean() > _LEAST_KEPT else np.ones_like(kept)
        self._shapes = LevelShapes(len(profile), freedom, self._kept)
        self._kept_profile = profile[self._kept]
        # Slopes are needed where the residual has just been computed.
        self._at = lru_cache(maxsize=1)(self._fitted_at)

    def levels(self, timing: Timing) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Fit the levels for a given timing.

        ``low``, ``swing`` and the model's profile, limited to white, each of shape (columns,).
        """
        _, values, low, swing = self._at(timing)
        return low, swing, np.minimum(low + swing * values, WHITE)

    def _fitted_at(self, timing: Timing) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        self._check()
        lit = self._light.expose(timing).lit
        values = self._response(lit, timing.gamma)
        low, swing = combine(
            self._fit_levels(values, self._kept_profile).reshape(2, -1), self._shapes.all
        )
        return lit, values, low, swing

    def _fit_levels(self, values: FloatArray, data: FloatArray) -> FloatArray:
        """Return the levels that explain data of the kept columns, shape (kept,) or (any, kept)."""
        lit = values[self._kept]
        return self._shapes.fit(lit, np.ones_like(lit), data)

    def slopes(self, timing: Timing) -> FloatArray:
        """Return the residual's slopes over the timing's fields, shape (columns, 4).

        What has the residual as a factor is left out (Kaufman, BIT 15:49, 1975).
        """
        lit, values, low, swing = self._at(timing)
        by_timing = self._light.expose(timing).slopes()
        changes = swing * self._response.slopes(lit, timing.gamma, by_timing)
        levels = self._fit_levels(values, changes[:, self._kept])
        slopes = LitColumns(self._shapes.all, values).light(levels) - changes
        slopes[:, low + swing * values > WHITE] = 0.0
        return np.asarray(slopes.T)

    def fit(
        self,
        start: Timing,
        with_gamma: bool = False,
        rounds: int = _MOST_ROUNDS,
        hopeless: float = math.inf,
    ) -> StripeFit:
        """Fit from a first guess; only begin it where the residual stays above a hopeless one."""
        columns = len(self._profile)
        gamma = quantity("gamma")
        low = np.array([0.5 * start.step, SHORTEST_EXPOSURE, -np.inf, gamma.low])
        high = np.array([2.0 * start.step, np.inf, np.inf, gamma.high])
        first = np.array([start.step, start.exposure, start.middle, start.gamma])
        free = np.flatnonzero([True, True, True, with_gamma])
        scale = (self._step * np.array([1.0 / columns, 1.0, 1.0, 1.0]))[free]

        def timing_of(place: FloatArray) -> Timing:
            values = first.copy()
            values[free] = place
            return Timing(*values.tolist())

        def slopes(place: FloatArray) -> FloatArray:
            return self.slopes(timing_of(place))[:, free]

        found, residual = minimize_squares(
            lambda place: self._profile - self.levels(timing_of(place))[2],
            slopes,
            np.clip(first, low, high)[free],
            rounds,
            bounds=Bounds(low[free], high[free]),
            fraction=_LEAST_GAIN,
            hopeless=hopeless,
        )
        covariance = np.zeros((4, 4))
        covariance[np.ix_(free, free)] = _covariance(slopes(found) * scale, residual) * np.outer(
            scale, scale
        )
        timing = timing_of(found)
        blur = exposure_deviation((_UNKNOWN_BLUR * timing.step) ** 2, timing.exposure)
        covariance[1, 1] += blur**2
        return self.describe(timing, covariance)

    def describe(self, timing: Timing, covariance: FloatArray) -> StripeFit:
        """Return the fit of a timing with a covariance, shape (4, 4), of its fields."""
        low, swing, profile = self.levels(timing)
        possible = _can_be_levels(low, swing)
        # Bounded below, since flattening divides by it.
        swing = np.maximum(swing, LEAST_SWING * max(float(swing.max()), FLAT_SPAN))
        data, model = (self._profile - low) / swing, (profile - low) / swing
        correlation = weighted_correlation(data, model, swing**2)
        residual = self._profile - profile
        power = dot(residual, residual)
        return StripeFit(timing, covariance, low, swing, profile, correlation, power, possible)


def _can_be_levels(low: FloatArray, swing: FloatArray) -> bool:
    usual = float(np.median(swing))
    return usual > 0.0 and float(np.median(low)) > _LEAST_DARK_LEVEL * usual


def level_freedom(in_view: float) -> int:
    """Return the number of parameters of either level, for the chips in view."""
    return int(np.clip(in_view / _CHIPS_PER_SHAPE, *_SHAPES))


def exposure_deviation(variance: float, exposure: float) -> float:
    """Return by how much a blur of unknown variance may lengthen an exposure, in its units.

    An edge is as wide as the exposure's box, of variance t^2/12, convolved with the blur: a further
    variance d lengthens t by 6 d / t, and never by more than a box of that variance alone.
    """
    return min(6.0 * variance / exposure, math.sqrt(12.0 * variance))


def _covariance(slopes: FloatArray, residual: FloatArray) -> FloatArray:
    variance = dot(residual, residual) / max(1, len(residual) - slopes.shape[1])
    variance *= correlated_columns(residual)
    products = row_products(slopes.T, slopes.T)
    # A parameter on which no column depends gets a large variance instead of a division by zero.
    least = _SINGULAR * float(np.diag(products).max())
    products[np.diag_indices_from(products)] += max(_REGULARIZATION * variance, least, 1e-16)
    return np.asarray(np.linalg.inv(products) * variance)
