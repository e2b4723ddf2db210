"""Fit the model of a lamp's stripes to a profile, from several starts."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.damped_least_squares import Bounds, minimize_squares
from occ_model.photo.lamp_fit.model import (
    AMBIENT,
    BLUR,
    COUNT,
    ENDS,
    FLOOR,
    GAMMA,
    MOST_STEPS,
    PERIOD,
    PLACE,
    RAMP,
    TOE,
    LampModel,
    envelope_basis,
)
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.wave import Wave
from occ_model.products import least_squares, row_products, two_factors

_MULTIPLES = (1.0, 2.0, 3.0, 0.5)  # of a likely period, from which fits start
_LEAST_PERIOD, _LEAST_PERIODS = 3.0, 1.2  # columns of a period, and periods in view
_SAME_PERIOD = 0.08  # relative difference up to which two starts are one
_STIFFNESS, _OTHER_STIFFNESSES = 0.6, (0.25, 4.0)
"""Standard deviation of the envelope's second differences, and factors on it; hot spots need the
last."""
_FIRST_NOISE = 0.03, 0.02  # fractions of the level and of the swing
_MOST_KNOTS = 30
_ROUNDING = 0.15 / 255.0  # least noise of a profile

_FITTED_STARTS, _HOPELESS = 3, 400.0
"""Starts that are fitted to the end, and the evidence that the best one has over hopeless ones."""
_FIRST_STEPS, _STEPS = (8,), (10, 10, 25)  # in each round, after which the noise is estimated anew
_MOST_CORRELATION = 0.8  # between the residuals of neighbouring columns


@dataclass(frozen=True, eq=False)
class LampFit:
    """The model's best parameters for a profile."""

    model: LampModel
    values: FloatArray
    noise: FloatArray  # Shape (columns,): standard deviation of each value
    inverse: FloatArray  # Inverse of the products of the slopes and beliefs
    inflation: float  # Factor on variances, as neighbouring columns have similar noise
    score: float  # Logarithm of the evidence, up to a constant

    @property
    def profile(self) -> LampProfile:
        return self.model.profile

    @property
    def wave(self) -> Wave:
        return self.model.wave(self.values)

    @property
    def floor(self) -> float:
        return self.model.floor(self.values)

    @property
    def gamma(self) -> float:
        return math.exp(self.values[GAMMA])

    @property
    def covariance(self) -> FloatArray:
        return self.inflation * self.inverse

    @property
    def slopes(self) -> FloatArray:
        """The slopes of the levels over the parameters, in deviations, shape (columns, n)."""
        return self.model.weighted_slopes(self.values, self.noise)[: len(self.noise)]

    @property
    def gamma_error(self) -> float:
        """The standard deviation of gamma."""
        return self.gamma * math.sqrt(max(float(self.covariance[GAMMA, GAMMA]), 0.0))

    @property
    def levels(self) -> FloatArray:
        return self.model.levels(self.values)

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """Levels of dark and of lit columns, by the envelope."""
        return self.model.ends(self.values)

    @property
    def height(self) -> float:
        """The height of the stripes in fractions of white, at most the profile's swing."""
        dark, lit = self.ends
        return max(min(float(np.max(lit - dark)), self.profile.swing), 1e-6)

    @property
    def residual(self) -> FloatArray:
        """The profile minus the model, in fractions of white."""
        return -self.profile.excess(self.levels)


def fit_lamp(
    profile: LampProfile,
    periods: Sequence[float],
    *,
    is_linear: bool = False,
    check: Callable[[], object] = lambda: None,
) -> list[LampFit]:
    """Return fits of a profile, the most likely first, from some periods and multiples of them.

    ``is_linear``: whether levels are in proportion to the light. ``check`` is called every few
    hundredths of a second, and may raise an exception to end the work.
    """
    starts: list[float] = []
    for tried in (multiple * period for period in periods for multiple in _MULTIPLES):
        is_new = all(abs(tried / other - 1.0) > _SAME_PERIOD for other in starts)
        if is_new and _LEAST_PERIOD <= tried <= len(profile.values) / _LEAST_PERIODS:
            starts.append(tried)
    if not starts:
        return []

    def fit_from(period: float, steps: Sequence[int]) -> LampFit:
        check()
        return _fit_from_period(profile, period, is_linear, steps)

    rough = [fit_from(period, _FIRST_STEPS) for period in starts]
    rough.sort(key=lambda fit: -fit.score)
    hopeful = [fit for fit in rough[:_FITTED_STARTS] if rough[0].score - fit.score < _HOPELESS]
    found = [fit_from(start.wave.period, _STEPS) for start in hopeful]
    check()
    best = max(found, key=lambda fit: fit.score)
    found += [_fit_with_stiffness(best, factor) for factor in _OTHER_STIFFNESSES]
    return sorted([*found, *rough[len(hopeful) :]], key=lambda fit: -fit.score)


def _fit_from_period(
    profile: LampProfile, period: float, is_linear: bool, steps: Sequence[int]
) -> LampFit:
    """Fit from a period, in as many steps in each round of noise."""
    count = len(profile.values)
    knots = int(min(max(round(count / (0.9 * period)), 2), _MOST_KNOTS))
    basis = envelope_basis(count, knots)
    deviation = _STIFFNESS * min(1.0, (6.0 / knots) ** 1.5)
    model = LampModel(profile, basis, _bends(basis) / deviation, is_linear)
    return _fit(model, _start(model, period), _FIRST_NOISE, steps)


def _fit_with_stiffness(fit: LampFit, factor: float) -> LampFit:
    """Fit further, with other deviations of the envelope's bends."""
    model = replace(fit.model, bending=fit.model.bending / factor)
    parts = _noise_parts(fit.profile, fit.levels, fit.noise, len(fit.values))
    return _fit(model, fit.values, parts, _STEPS[1:])


def _fit(
    model: LampModel, values: FloatArray, parts: tuple[float, float], steps: Sequence[int]
) -> LampFit:
    profile = model.profile
    for most in steps:
        noise = _noise(profile, model.levels(values), parts)
        values = _minimize(model, values, noise, most)
        parts = _noise_parts(profile, model.levels(values), noise, len(values))
    return _describe_fit(model, values, _noise(profile, model.levels(values), parts))


def _bends(basis: FloatArray) -> FloatArray:
    """Return the second differences of a spline's coefficients, shape (splines - 2, splines)."""
    return np.diff(np.eye(basis.shape[1]), 2, axis=0)


def _start(model: LampModel, period: float) -> FloatArray:
    """Return parameters of a period, the other ones as usual or by what the profile shows."""
    columns, level = model.profile.columns, model.profile.values
    light = np.clip(level, 1e-4, 1.0) ** (1.0 if model.is_linear else 2.2)
    turn = np.exp(-2j * math.pi * columns / period)
    place = -np.angle((level - level.mean()) @ turn) / (2.0 * math.pi) * period % period
    reach = max(3, int(period)) | 1
    padded = np.pad(light, reach, mode="edge")
    brightest = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    bends = 0.05 * _bends(model.envelope)
    brightness = least_squares(
        np.vstack([model.envelope, bends]),
        np.concatenate([np.log(brightest), np.zeros(len(bends))]),
    )
    own = np.zeros(COUNT)
    own[PERIOD], own[PLACE], own[RAMP] = math.log(period), place, -0.4
    for each in (BLUR, GAMMA, TOE):
        own[each] = model.priors[each][0]
    own[FLOOR], own[AMBIENT] = 0.4, 1e-4
    return np.concatenate([own, brightness])


def _noise(profile: LampProfile, levels: FloatArray, parts: tuple[float, float]) -> FloatArray:
    of_level, of_swing = parts
    variance = profile.variances + (of_level * levels) ** 2 + (of_swing * profile.swing) ** 2
    return np.sqrt(variance + _ROUNDING**2)


def _noise_parts(
    profile: LampProfile, levels: FloatArray, noise: FloatArray, parameters: int
) -> tuple[float, float]:
    """Return the noise in proportion to the level, and to the swing, that residuals have."""
    residual = profile.excess(levels)
    count = len(residual)
    weight = 1.0 / noise**2
    freedom = max(count - parameters + 4, 0.5 * count)
    excess = np.square(residual) * count / freedom - profile.variances
    parts = np.stack([levels**2, np.full(count, profile.swing**2)], axis=1)
    found = two_factors(parts * weight[:, None], np.maximum(excess, 0.0) * weight)
    return max(math.sqrt(found[0]), 0.002), max(math.sqrt(found[1]), 0.002)


def _minimize(model: LampModel, values: FloatArray, noise: FloatArray, steps: int) -> FloatArray:
    """Minimize the misfit and what contradicts the priors (Levenberg and Marquardt)."""
    most = np.concatenate([MOST_STEPS, np.ones(len(values) - COUNT)])
    most[PLACE] *= math.exp(values[PERIOD])
    low, high = np.full((2, len(values)), [[-math.inf], [math.inf]])
    low[list(ENDS)], high[list(ENDS)] = np.array(list(ENDS.values())).T
    return minimize_squares(
        lambda at: model.weighted_residual(at, noise),
        lambda at: model.weighted_slopes(at, noise),
        values, steps, bounds=Bounds(low, high, most),
    )[0]  # fmt: skip


def _describe_fit(model: LampModel, values: FloatArray, noise: FloatArray) -> LampFit:
    """Return the fit of some parameters, with its covariance and evidence (by Laplace)."""
    slopes = model.weighted_slopes(values, noise)
    products = row_products(slopes.T, slopes.T)
    # Prior: the period is known to a factor of e, and the place to a period.
    products[PERIOD, PERIOD] += 1.0
    products[PLACE, PLACE] += math.exp(-2.0 * values[PERIOD])
    products.flat[:: len(products) + 1] += 1e-9
    residual = -model.profile.excess(model.levels(values)) / noise
    square = float(residual @ residual)
    near = float(residual[1:] @ residual[:-1]) / max(square, 1e-300)
    near = min(max(near, 0.0), _MOST_CORRELATION)
    inflation = (1.0 + near) / (1.0 - near)
    beliefs = model.beliefs(values)[0]
    likelihood = -0.5 * square - float(np.log(noise).sum())
    stiff = np.linalg.slogdet(model.bending.T @ model.bending + 1e-3 * np.eye(len(values) - COUNT))
    score = likelihood / inflation - 0.5 * float(beliefs @ beliefs)
    score += 0.5 * float(stiff[1] - np.linalg.slogdet(products)[1])
    inverse = np.asarray(np.linalg.inv(products), dtype=np.float64)
    return LampFit(model, values, noise, inverse, inflation, score)
