"""Normal noise, from tables: its probabilities, what a limit cuts off, and how it is rounded.

A value x, in steps, with noise of the deviation s in steps, is rounded to whole steps, as a file
rounds its coefficients. What rounding adds, round(x) - x, is a sawtooth; noise damps the n-th
harmonic of its Fourier series by exp(-2 pi^2 n^2 s^2).
"""

import math
from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, Pixels

_RANGE = 9.0  # standard deviations beyond which nothing of a normal distribution is left

_PER_DEVIATION = 256


@lru_cache(maxsize=1)
def _tables() -> tuple[FloatArray, FloatArray]:
    """Tabulate the probability Q(u) above u, and phi(u) - u Q(u), from -_RANGE to _RANGE."""
    u = np.arange(-_RANGE * _PER_DEVIATION, _RANGE * _PER_DEVIATION + 1.0) / _PER_DEVIATION
    beyond = np.array([0.5 * math.erfc(x / math.sqrt(2.0)) for x in u.tolist()])
    lost = np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi) - u * beyond
    lost[-1] = 0.0
    return beyond, lost


def _place(u: FloatArray) -> np.ndarray:
    place = np.minimum(np.maximum(u, -_RANGE), _RANGE)
    place += _RANGE + 0.5 / _PER_DEVIATION
    place *= _PER_DEVIATION
    return place.astype(np.intp)


def normal_fraction(u: FloatArray) -> FloatArray:
    """Return the probability of a normal distribution below some standard deviations."""
    return _tables()[0].take(_place(-u))


def clipped_mean(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the mean of noisy pixels that are cut off at black and white.

    A normal deviation that is cut off u standard deviations from its mean loses phi(u) - u Q(u) of
    them.
    """
    lost = _tables()[1]
    least = np.maximum(spread, 1e-9)
    above = lost.take(_place(levels / least)) - lost.take(_place((white - levels) / least))
    return np.asarray(levels + least * above)


def fraction_unclipped(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the fraction of noisy pixels that are cut off neither at black nor at white."""
    least = np.maximum(spread, 1e-9)
    return normal_fraction(levels / least) - normal_fraction((levels - white) / least)


_HARMONICS = 6

DAMPING = 2.0 * math.pi**2
"""Exponent of the first harmonic, for a noise of one step; it grows as the square of the number."""

_NEGLIGIBLE_EXPONENT = 9.0  # exponent from which a harmonic is damped to nothing
SHARP_NOISE = 0.08  # noise in steps below which nearly all values are rounded as without it
_FINE_NOISE = 2.0  # noise in steps from which it is rounded like a value that lies anywhere
_TINY_NOISE = 1e-9  # noise in steps that none is taken for
_WIDE_NOISE = 0.8  # noise in steps from which its rounded values vary as much wherever they lie


def rounding_square(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean square error of rounding, in steps."""
    found = np.full(np.broadcast_shapes(x.shape, s.shape), 1.0 / 12.0)
    for n, angle, damped in _harmonics(x, s):
        found += np.cos(angle) * (damped / (math.pi * n) ** 2)
    sharp = s < SHARP_NOISE  # there the series ends too early
    return np.where(sharp, (x - np.rint(x)) ** 2 + s * s, found) if sharp.any() else found


def rounding_mean(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean of round(x) - x, in steps."""
    found = np.rint(x) - x
    sharp = s < SHARP_NOISE
    if sharp.all():
        return np.asarray(np.broadcast_to(found, np.broadcast_shapes(x.shape, s.shape)))
    damped = np.zeros(np.broadcast_shapes(x.shape, s.shape))
    for n, angle, fraction in _harmonics(x, s):
        damped += np.sin(angle) * (fraction / (math.pi * n))
    return np.where(sharp, found, damped) if sharp.any() else damped


def _harmonics(x: FloatArray, s: FloatArray) -> Iterator[tuple[int, Pixels, Pixels]]:
    """Yield n, the angle, and (-1)^n times the damping, of the harmonics that noise leaves."""
    least = max(float(s.min()), SHARP_NOISE)
    turn = ((x - np.rint(x)) * (2.0 * math.pi)).astype(np.float32)
    square = (-DAMPING * np.square(s)).astype(np.float32)
    for n in range(1, _HARMONICS + 1):
        if n > 1 and DAMPING * (n * least) ** 2 > _NEGLIGIBLE_EXPONENT:
            return
        yield n, turn * np.float32(n), np.exp(square * np.float32(n * n)) * np.float32((-1) ** n)


def moved_steps(change: FloatArray) -> FloatArray:
    """Return by how much the mean square of a change grows when both values are rounded."""
    fraction = change - np.floor(change)  # many times faster than a remainder
    return fraction * (1.0 - fraction)


@lru_cache(maxsize=3)
def _table(of: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, FloatArray]:
    s = np.linspace(0.0, _FINE_NOISE, 2001)
    return s, of(s)


def moved_steps_of_noise(s: FloatArray) -> FloatArray:
    """Return :func:`moved_steps` for a change by noise: |d| - d^2 where within a step."""
    return np.interp(s, *_table(_moved_by_noise))


def _moved_by_noise(s: FloatArray) -> FloatArray:
    damped = np.exp(-DAMPING * s * s)
    found = 1.0 / 6.0 - (damped + damped**4 / 4.0) / math.pi**2
    return np.where(s < 0.3, math.sqrt(2.0 / math.pi) * s - s * s, found)


def near_half(s: FloatArray) -> FloatArray:
    """Return how near to a step's end noise about 0 is, against values spread evenly; at most 1."""
    return np.interp(s, *_table(_at_halves))


def _at_halves(s: FloatArray) -> FloatArray:
    s = np.maximum(s, _TINY_NOISE)
    halves = np.arange(0.5, 6.0)[:, None] / s
    density = 2.0 * (np.exp(-0.5 * halves**2) / (math.sqrt(2.0 * math.pi) * s)).sum(axis=0)
    return np.asarray(np.minimum(density, 1.0))


def rounded_noise(s: FloatArray) -> FloatArray:
    """Return the mean square of rounded noise about 0, in steps."""
    return np.where(s > _FINE_NOISE, s * s + 1.0 / 12.0, np.interp(s, *_table(_square_of_rounded)))


def _square_of_rounded(s: FloatArray) -> FloatArray:
    step = np.arange(1.0, 17.0)
    passed = 1.0 - normal_fraction((step - 0.5)[:, None] / np.maximum(s, _TINY_NOISE))
    return np.asarray(2.0 * ((2.0 * step - 1.0)[:, None] * passed).sum(axis=0))


def rounded_variance(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the variance of rounded values of some mean and noise, in steps."""
    away = x - np.rint(x)
    step = np.array([1.0, 2.0, 3.0]).reshape(-1, *(1,) * max(x.ndim, s.ndim))
    above, below = (normal_fraction((sign * away - step + 0.5) / s) for sign in (1.0, -1.0))
    mean = (above - below).sum(axis=0)
    square = ((2.0 * step - 1.0) * (above + below)).sum(axis=0)
    return np.where(s > _WIDE_NOISE, s * s + 1.0 / 12.0, np.maximum(square - mean * mean, 0.0))
