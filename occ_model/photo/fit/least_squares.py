"""The exposure model fitted to a profile of stripes, by least squares.

A profile is low(i) + swing(i) x tone(lit(i)): the lit fraction of the exact exposure integral,
through the camera's tone, between two levels that vary slowly along the columns. For given times
the levels are a linear fit, so that only the times are searched (variable projection: Golub and
Pereyra, SIAM J. Numer. Anal. 10:413, 1973).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import FLAT, WHITE
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.envelope import smooth_shapes
from occ_model.photo.stripes.period import correlated_columns
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.transmitter.waveform import Waveform

_SMALL = 0.02
"""Columns by which a timing is changed to see what the model makes of it."""

Tone = Callable[[FloatArray, float], FloatArray]
"""From lit fractions and a gamma to pixel values between any two levels."""

_FULL = WHITE - 0.5
_LEAST_KEPT = 0.4
"""Share of the columns that must not be full for the full ones to be left out of the levels."""

_UNSEEN = 1e-4
"""Weight of not knowing: a parameter that no column tells is off by a hundred of its scales."""

_LEAST_SWING = 0.05
"""Share of the largest swing below which a column tells nothing of the stripes."""

_CHIPS_A_FREEDOM = 6
_MOST_FREEDOM = 8

_SHORTEST = 1e-4
"""Chips: a shorter exposure looks like none."""

_BLUR = 0.4
"""Columns by which a lens and a camera's own processing may well soften stripes, unknown to the
model: a standard deviation."""

_DARKEST = -0.1
"""How far the dark level may lie below black, as a share of the swing: dark columns are black."""


@dataclass(frozen=True, eq=False, slots=True)
class StripeFit:
    """What a fit found.

    Parameters
    ----------
    timing
        The times.
    covariance : ndarray of float64, shape (4, 4)
        Of the timing's fields in their order; 0 for gamma where it was given.
    low, swing : ndarray of float64, shape (columns,)
        The levels in grey levels.
    profile : ndarray of float64, shape (columns,)
        The model in grey levels.
    correlation
        Of data and model, both without the uneven light.
    residual
        Sum of the squares of what the model leaves unexplained.
    likely
        A rest up to which another timing is about as likely: by two standard deviations.
    is_possible
        Whether the levels can be a picture's: lit above dark, and dark not below black.
    """

    timing: Timing
    covariance: FloatArray
    low: FloatArray
    swing: FloatArray
    profile: FloatArray
    correlation: float
    residual: float
    likely: float
    is_possible: bool


class StripeModel:
    """The model of one profile, for one sequence of chips and one tone.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    waveform
        What is sent.
    tone
        The camera's tone.
    step
        Chips a column, roughly: the levels get the freedom that as many chips can bear.
    rank_resolution
        Columns within which the tone does not follow a change of the timing.
    """

    def __init__(
        self,
        profile: FloatArray,
        waveform: Waveform,
        tone: Tone,
        step: float,
        rank_resolution: float = 0.0,
    ) -> None:
        self._profile = profile
        self._waveform = waveform
        self._tone = tone
        self._change = max(_SMALL, rank_resolution) * step
        chips = step * len(profile)
        freedom = int(np.clip(chips / _CHIPS_A_FREEDOM, 1, _MOST_FREEDOM))
        # Both levels alike: or a faint tone would have more shapes for the mean than a clear one.
        self._shapes = smooth_shapes(len(profile), freedom)
        kept: NDArray[np.bool_] = profile < _FULL
        self._kept = kept if kept.mean() > _LEAST_KEPT else np.ones_like(kept)

    def levels(self, timing: Timing) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Fit the levels for some times.

        Returns
        -------
        low, swing, profile : ndarray of float64, shape (columns,)
            The profile is the model's, as far as a pixel can hold it.
        """
        lit = timing.lit_fraction(self._waveform, len(self._profile))
        tone = self._tone(lit, timing.gamma)[:, None]
        parts = np.hstack([self._shapes, self._shapes * tone])
        kept = parts[self._kept]
        products = kept.T @ kept
        # A tone that hardly varies leaves the levels open: keep them small rather than wild.
        products[np.diag_indices_from(products)] += 1e-9 * len(kept)
        weights = np.linalg.solve(products, kept.T @ self._profile[self._kept])
        freedom = self._shapes.shape[1]
        low, swing = self._shapes @ weights[:freedom], self._shapes @ weights[freedom:]
        return low, swing, np.minimum(parts @ weights, WHITE)

    def fit(self, start: Timing, with_gamma: bool = False, spread: float = 0.0) -> StripeFit:
        """Fit the times from a first guess.

        Parameters
        ----------
        start
            The guess.
        with_gamma
            Whether gamma is fitted too.
        spread
            Where it is above nothing the exposure is held, evenly likely within as many chips.
        """
        # Slow to import, and only needed when a photo is really matched.
        from scipy.optimize import least_squares

        columns = len(self._profile)
        gamma = PARAMETERS["gamma"]
        assert isinstance(gamma, Quantity)  # noqa: S101 - it is one
        low = np.array([0.5 * start.step, _SHORTEST, -np.inf, gamma.low])
        high = np.array([2.0 * start.step, np.inf, np.inf, gamma.high])
        # From well within the bounds, where a slope can be told.
        inside = np.array([0.0, 10.0 * _SHORTEST, 0.0, 0.05])
        first = np.array([start.step, start.exposure, start.middle, start.gamma])
        first = np.clip(first, low + inside, high - inside)
        if not with_gamma:
            first[3] = start.gamma
        free = np.flatnonzero([True, spread == 0.0, True, with_gamma])
        scale = np.array([0.1 / columns, 0.1, 0.1, 0.3])[free]
        change = self._change * np.array([1.0 / columns, 1.0, 1.0, 1.0])[free]

        def timing_of(scaled: FloatArray) -> Timing:
            values = first.copy()
            values[free] = scaled * scale
            return Timing(*values.tolist())

        def residual(scaled: FloatArray) -> FloatArray:
            return self._profile - self.levels(timing_of(scaled))[2]

        found = least_squares(
            residual,
            first[free] / scale,
            bounds=(low[free] / scale, high[free] / scale),
            diff_step=change / np.maximum(np.abs(first[free]), 1e-12),
            xtol=1e-7, ftol=1e-7, gtol=1e-9, max_nfev=40,
        )  # fmt: skip
        covariance = np.zeros((4, 4))
        covariance[np.ix_(free, free)] = _covariance(found.jac, found.fun) * np.outer(scale, scale)
        timing = timing_of(found.x)
        covariance[1, 1] += spread**2 / 3.0 + _blur_deviation(timing) ** 2
        return self._described(timing, covariance)

    def _described(self, timing: Timing, covariance: FloatArray) -> StripeFit:
        low, swing, profile = self.levels(timing)
        usual = float(np.median(swing))
        possible = usual > 0.0 and float(np.median(low)) > _DARKEST * usual
        # Never so faint that evening the light out would blow up what is left of it.
        swing = np.maximum(swing, _LEAST_SWING * max(float(swing.max()), FLAT))
        correlation = _flattened_correlation(self._profile, profile, low, swing)
        residual = self._profile - profile
        power = float(residual @ residual)
        likely = power * (1.0 + 4.0 * correlated_columns(residual) / len(residual))
        return StripeFit(
            timing, covariance, low, swing, profile, correlation, power, likely, possible
        )


def _blur_deviation(timing: Timing) -> float:
    """Give the chips by which an unknown blur may make an exposure look longer.

    An edge's slope is the exposure's box, of variance t^2/12, and the blur's; to second order a
    blur of sigma makes t look longer by 6 sigma^2 / t, and never by more than its own width.
    """
    blur = _BLUR * timing.step
    return min(6.0 * blur**2 / timing.exposure, math.sqrt(12.0) * blur)


def _covariance(slopes: FloatArray, residual: FloatArray) -> FloatArray:
    """Give the covariance of fitted parameters from the model's slopes and the residual."""
    variance = float(residual @ residual) / max(1, len(residual) - slopes.shape[1])
    variance *= correlated_columns(residual)
    products = slopes.T @ slopes
    # What no column sees a change of is not known for sure, but not known at all.
    products[np.diag_indices_from(products)] += _UNSEEN * max(variance, 1e-12)
    return np.asarray(np.linalg.inv(products) * variance)


def _flattened_correlation(
    data: FloatArray, model: FloatArray, low: FloatArray, swing: FloatArray
) -> float:
    """Correlate data and model without their uneven light; a column counts as its light swings."""
    weight = swing**2 / float((swing**2).sum())
    a, b = (data - low) / swing, (model - low) / swing
    a, b = a - float(weight @ a), b - float(weight @ b)
    energy = math.sqrt(float(weight @ a**2) * float(weight @ b**2))
    return float(weight @ (a * b)) / energy if energy > 0.0 else 0.0
