"""Tables of normal noise: probabilities, what clipping removes, and what rounding adds.

A value x with noise of standard deviation s, both in steps, is rounded to whole steps, as a file
rounds its coefficients. Its rounding error round(x) - x is a sawtooth in x; noise damps the n-th
harmonic of the sawtooth's Fourier series by exp(-2 pi^2 n^2 s^2).
"""

import math
from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.normal import normal_fraction


def mean_after_clipping(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the mean of noisy pixels after clipping at black and white.

    Clipping a normal variable u standard deviations from its mean moves the mean by phi(u) - u Q(u)
    standard deviations.
    """
    spreads = np.maximum(spread, _TINY_NOISE)
    return np.asarray(
        levels + spreads * (_excess(levels / spreads) - _excess((white - levels) / spreads))
    )


def _excess(u: FloatArray) -> FloatArray:
    flat = np.minimum(np.abs(u), 40.0)
    density = np.exp(-0.5 * flat * flat) / math.sqrt(2.0 * math.pi)
    return density - u * normal_fraction(-u)


def unclipped_fraction(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the fraction of noisy pixels that are clipped neither at black nor at white."""
    spreads = np.maximum(spread, _TINY_NOISE)
    return normal_fraction(levels / spreads) - normal_fraction((levels - white) / spreads)


_HARMONICS = 6

DAMPING = 2.0 * math.pi**2
"""Damping exponent of the first harmonic for noise of one step; that of the n-th is n^2 times
it."""

_NEGLIGIBLE_EXPONENT = 9.0  # damping exponent above which a harmonic is neglected
SHARP_NOISE = 0.08  # noise in steps below which nearly all values round as without noise
_FINE_NOISE = 2.0  # noise in steps above which rounding adds the variance of a uniform error
_TINY_NOISE = 1e-9  # noise in steps in place of none, to divide by
_WIDE_NOISE = 0.8  # noise in steps above which the variance after rounding is the same for any mean


def rounding_square(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean square error of rounding, in squared steps."""
    square = np.full(np.broadcast_shapes(x.shape, s.shape), 1.0 / 12.0)
    for n, angle, damping in _harmonics(x, s):
        square += np.cos(angle) * (damping / (math.pi * n) ** 2)
    sharp = s < SHARP_NOISE  # there six harmonics are too few
    return np.where(sharp, (x - np.rint(x)) ** 2 + s * s, square) if sharp.any() else square


def rounding_mean(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean of round(x) - x, in steps."""
    mean = np.rint(x) - x
    sharp = s < SHARP_NOISE
    if sharp.all():
        return np.asarray(np.broadcast_to(mean, np.broadcast_shapes(x.shape, s.shape)))
    damped_mean = np.zeros(np.broadcast_shapes(x.shape, s.shape))
    for n, angle, damping in _harmonics(x, s):
        damped_mean += np.sin(angle) * (damping / (math.pi * n))
    return np.where(sharp, mean, damped_mean) if sharp.any() else damped_mean


def _harmonics(x: FloatArray, s: FloatArray) -> Iterator[tuple[int, Pixels, Pixels]]:
    """Yield n, the angle, and (-1)^n times the damping, of each harmonic that is not negligible."""
    least = max(float(s.min()), SHARP_NOISE)
    turn = ((x - np.rint(x)) * (2.0 * math.pi)).astype(np.float32)
    square = (-DAMPING * np.square(s)).astype(np.float32)
    for n in range(1, _HARMONICS + 1):
        if n > 1 and DAMPING * (n * least) ** 2 > _NEGLIGIBLE_EXPONENT:
            return
        yield n, turn * np.float32(n), np.exp(square * np.float32(n * n)) * np.float32((-1) ** n)


def rounding_growth(change: FloatArray) -> FloatArray:
    """Return how much the mean square of a change grows by rounding the values it lies between."""
    fraction = change - np.floor(change)  # many times faster than ``%``
    return fraction * (1.0 - fraction)


@lru_cache(maxsize=3)
def _tabulate(of: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, FloatArray]:
    s = np.linspace(0.0, _FINE_NOISE, 2001)
    return s, of(s)


def rounding_growth_by_noise(s: FloatArray) -> FloatArray:
    """Return :func:`rounding_growth` for normal changes d: |d| - d^2 where |d| is within a step."""
    return np.interp(s, *_tabulate(_compute_growth_by_noise))


def _compute_growth_by_noise(s: FloatArray) -> FloatArray:
    damping = np.exp(-DAMPING * s * s)
    growth = 1.0 / 6.0 - (damping + damping**4 / 4.0) / math.pi**2
    return np.where(s < 0.3, math.sqrt(2.0 / math.pi) * s - s * s, growth)


def density_at_boundaries(s: FloatArray) -> FloatArray:
    """Return the density of noise of mean 0 at the rounding boundaries, at most 1.

    Values that are uniform over the steps have the density 1.
    """
    return np.interp(s, *_tabulate(_compute_boundary_density))


def _compute_boundary_density(s: FloatArray) -> FloatArray:
    s = np.maximum(s, _TINY_NOISE)
    halves = np.arange(0.5, 6.0)[:, None] / s
    density = 2.0 * (np.exp(-0.5 * halves**2) / (math.sqrt(2.0 * math.pi) * s)).sum(axis=0)
    return np.asarray(np.minimum(density, 1.0))


def square_of_rounded_noise(s: FloatArray) -> FloatArray:
    """Return the mean square of noise of mean 0 after rounding, in squared steps."""
    return np.where(
        s > _FINE_NOISE, s * s + 1.0 / 12.0, np.interp(s, *_tabulate(_compute_rounded_square))
    )


def _compute_rounded_square(s: FloatArray) -> FloatArray:
    step = np.arange(1.0, 17.0)
    tail = 1.0 - normal_fraction((step - 0.5)[:, None] / np.maximum(s, _TINY_NOISE))
    return np.asarray(2.0 * ((2.0 * step - 1.0)[:, None] * tail).sum(axis=0))


def variance_after_rounding(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the variance of values of mean x and noise s after rounding, in squared steps."""
    offset = x - np.rint(x)
    step = np.array([1.0, 2.0, 3.0]).reshape(-1, *(1,) * max(x.ndim, s.ndim))
    above, below = (normal_fraction((sign * offset - step + 0.5) / s) for sign in (1.0, -1.0))
    mean = (above - below).sum(axis=0)
    square = ((2.0 * step - 1.0) * (above + below)).sum(axis=0)
    return np.where(s > _WIDE_NOISE, s * s + 1.0 / 12.0, np.maximum(square - mean * mean, 0.0))
