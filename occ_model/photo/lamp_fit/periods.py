"""Periods that a profile may have, best first."""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import least_squares

_LEAST_PERIOD = 3.0  # columns
_LEAST_PERIODS = 1.3  # in view
_STEPS = 5.0  # frequencies tried within a resolution, which is 1 over the columns
_MOST_TREND = 8  # highest degree of the polynomial that is subtracted first
_MOST_ENVELOPE = 4  # polynomials that modulate a harmonic
_SECOND_FROM = 8.0  # columns of a period from which the second harmonic is tried, too
_MOST_FREQUENCIES = 300  # frequencies that are all tried; among more, those near spectral peaks
_PEAKS, _ORDERS, _PEAK_WIDTH = 6, 3, 1.5
"""Number of peaks, the harmonics that they may be, and the distance from them in resolutions."""


def likely_periods(values: FloatArray, count: int) -> list[float]:
    """Return up to ``count`` periods in columns, by how much a few harmonics explain.

    Slow polynomials are taken off, as many as fit less than a period each; the harmonics are
    modulated by the lowest of them.
    """
    length = len(values)
    most = length / _LEAST_PERIODS
    if most <= _LEAST_PERIOD:
        return []
    step = 1.0 / (_STEPS * length)
    frequencies: FloatArray = np.arange(1.0 / most, 1.0 / _LEAST_PERIOD, step, dtype=np.float64)
    places = np.linspace(-1.0, 1.0, length)
    trends = np.asarray(np.polynomial.legendre.legvander(places, _MOST_TREND), dtype=np.float64)
    if len(frequencies) > _MOST_FREQUENCIES:
        frequencies = _near_peaks(values, trends, frequencies)
    gains = np.array([_gain(values, trends, float(each)) for each in frequencies])
    # Frequencies that were left out separate those beside them.
    apart = np.diff(frequencies) > 1.5 * step
    before = np.where(np.append(True, apart), -np.inf, np.append(-np.inf, gains[:-1]))
    after = np.where(np.append(apart, True), -np.inf, np.append(gains[1:], -np.inf))
    peaks = np.flatnonzero((gains >= before) & (gains >= after))
    best = peaks[np.argsort(-gains[peaks])][:count]
    return [1.0 / float(frequencies[each]) for each in best]


def _near_peaks(values: FloatArray, trends: FloatArray, frequencies: FloatArray) -> FloatArray:
    """Return the frequencies near the highest peaks of the spectrum, and near parts of them."""
    length = len(values)
    slow = least_squares(trends, values)
    power = np.abs(np.fft.rfft((values - trends @ slow) * np.hanning(length), 4 * length))
    highest = np.flatnonzero((power[1:-1] >= power[:-2]) & (power[1:-1] >= power[2:])) + 1
    own = highest[np.argsort(-power[highest])][:_PEAKS] / (4.0 * length)
    wanted = np.concatenate([own / order for order in range(1, _ORDERS + 1)])
    near = np.abs(frequencies[:, None] - wanted) < _PEAK_WIDTH / length
    return np.asarray(frequencies[near.any(axis=1)])


def _gain(values: FloatArray, trends: FloatArray, frequency: float) -> float:
    length = len(values)
    degree = min(_MOST_TREND, max(1, int(length * frequency)))
    slow = trends[:, : degree + 1]
    column = np.arange(length, dtype=np.float64) * (2.0 * math.pi * frequency)
    waves = [np.cos(column), np.sin(column)]
    if frequency < 1.0 / _SECOND_FROM:
        waves += [np.cos(2.0 * column), np.sin(2.0 * column)]
    envelope = slow[:, : min(degree, _MOST_ENVELOPE)]
    whole = np.concatenate([slow, *(wave[:, None] * envelope for wave in waves)], axis=1)
    left, all_left = (_residual(values, each) for each in (slow, whole))
    return math.log(left / max(all_left, 1e-300)) - 2.0 * len(whole.T) / length


def _residual(values: FloatArray, parts: FloatArray) -> float:
    off = values - parts @ least_squares(parts, values)
    return float(np.sum(off * off))
