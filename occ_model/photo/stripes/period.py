"""Find the period of stripes in columns, with its uncertainty."""

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.stripes.envelope import smooth_shapes
from occ_model.products import combine, row_products, solve_positive_definite

_SHORTEST_PERIOD = 3  # shortest period in columns
LEAST_AUTOCORRELATION = 0.5  # minimum autocorrelation after one period
_TOLERANCE = 0.06  # maximum difference of the shortest period's autocorrelation from the best
_LONGEST_FRACTION = 0.67  # longest period relative to the width, so that part of it appears twice
_MOST_HARMONICS = 24  # maximum number of harmonics
_MOST_ITERATIONS = 8  # maximum number of Gauss-Newton iterations
_REGULARIZATION = 1e-6  # of the normal equations, relative to a harmonic's energy

Harmonics = NDArray[np.complex128]


def repeat_period(flattened: FloatArray) -> tuple[float, float] | None:
    """Return the shortest period of stripes in columns and its deviation; None if there is none."""
    estimate = _rough_period(flattened)
    return None if estimate is None else refine_period(flattened, estimate)


def best_repetition(flattened: FloatArray) -> tuple[int, float]:
    """Return the longest period that is searched for, in columns, and the best autocorrelation."""
    lags, heights = _repetitions(flattened)
    longest = int(_LONGEST_FRACTION * len(flattened))
    return longest, float(heights.max()) if lags.size else 0.0


def _rough_period(flattened: FloatArray) -> float | None:
    """Find the shortest lag whose autocorrelation is about the best."""
    lags, heights = _repetitions(flattened)
    if lags.size == 0 or heights.max() < LEAST_AUTOCORRELATION:
        return None
    return float(lags[np.flatnonzero(heights >= heights.max() - _TOLERANCE)[0]])


def _repetitions(flattened: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the lags at which the autocorrelation has peaks, and the peaks' heights."""
    correlations = autocorrelation(flattened)
    count = int(_LONGEST_FRACTION * len(correlations))
    negative = np.flatnonzero(correlations[:count] < 0.0)
    start = max(_SHORTEST_PERIOD, int(negative[0]) if negative.size else _SHORTEST_PERIOD)
    inner = correlations[start : count - 1]
    if inner.size < 1:
        return np.zeros(0), np.zeros(0)
    peaks = start + np.flatnonzero(
        (inner >= correlations[start - 1 : count - 2]) & (inner >= correlations[start + 1 : count])
    )
    # A peak lies up to half a column beside a lag; a parabola gives its place and height.
    before, peak, after = correlations[peaks - 1], correlations[peaks], correlations[peaks + 1]
    curvature = np.minimum(before - 2.0 * peak + after, -1e-12)
    offset = np.clip(0.5 * (before - after) / curvature, -0.5, 0.5)
    return peaks + offset, peak - 0.25 * (before - after) * offset


def autocorrelation(values: FloatArray) -> FloatArray:
    """Return the autocorrelation at every lag, normalized over the overlapping columns."""
    count = len(values)
    deviations = values - values.mean()
    spectrum = np.fft.rfft(deviations, 2 * count)
    products = np.fft.irfft(np.abs(spectrum) ** 2)[:count]
    squares = np.concatenate([[0.0], np.cumsum(deviations**2)])
    lags = np.arange(count)
    energy = np.sqrt(squares[count - lags] * (squares[count] - squares[lags]))
    is_flat = energy <= 1e-12 * max(float(squares[-1]), 1e-300)
    return np.where(is_flat, 0.0, products / np.where(is_flat, 1.0, energy))


def refine_period(flattened: FloatArray, period: float, least: int = 1) -> tuple[float, float]:
    """Return the period near ``period`` that explains a profile best, and its deviation.

    The repeated wave has as many harmonics as the columns resolve, and at least ``least``.
    """
    count = len(flattened)
    harmonics = max(least, harmonics_within(count, period))
    change = 0.1 * period / count  # shifts the last stripe by a tenth of a column
    best, best_residual = period, np.inf
    slope = residual = np.zeros(count)
    for _ in range(_MOST_ITERATIONS):
        residual = _residual(flattened, period, harmonics)
        power = float(residual @ residual)
        if power >= best_residual * (1.0 - 1e-9):
            break
        best, best_residual = period, power
        slope = (_residual(flattened, period + change, harmonics) - residual) / change
        step = -float(slope @ residual) / max(float(slope @ slope), 1e-300)
        period += float(np.clip(step, -0.5 * period**2 / count, 0.5 * period**2 / count))
    residual = _residual(flattened, best, harmonics)
    freedom = max(1, count - 2 * harmonics - 2)
    variance = float(residual @ residual) / freedom * correlated_columns(residual)
    return best, float(np.sqrt(variance / max(float(slope @ slope), 1e-300)))


def unrepeated_fraction(flattened: FloatArray, period: float, least: int = 1) -> float:
    """Return the fraction of a profile's variance that a wave of this period does not explain."""
    residual = _residual(flattened, period, max(least, harmonics_within(len(flattened), period)))
    deviations = flattened - flattened.mean()
    return float(residual @ residual) / max(float(deviations @ deviations), 1e-300)


def remove_repetition(flattened: FloatArray, period: float) -> FloatArray:
    """Return the residual of a profile from the best wave of this period."""
    return _residual(flattened, period, harmonics_within(len(flattened), period))


def harmonics_within(columns: int, period: float) -> int:
    """Return the number of harmonics of a repeated wave that columns resolve."""
    return int(np.clip(period / 2.5, 1, min(_MOST_HARMONICS, columns / 6)))


def _residual(flattened: FloatArray, period: float, harmonics: int) -> FloatArray:
    # The amplitude is constant, as a varying one would compensate for a wrong period.
    return repeated_wave(flattened, period, harmonics, 2)[1]


def repeated_wave(
    values: FloatArray, period: float, harmonics: int, slow: int
) -> tuple[Harmonics, FloatArray]:
    """Fit the harmonics of a period, together with ``slow`` polynomials.

    Returned are the strength of each harmonic, from the first, and the residual.

    With columns counted from the middle, cosines and even polynomials are orthogonal to sines and
    odd ones, so that each group is fitted alone. Inner products of two cosines, or of two sines,
    follow from the sums of the cosines whose orders are their sum and their difference.
    """
    count = len(values)
    column, rate = np.arange(count) - 0.5 * (count - 1), 2.0 * np.pi / period
    order = np.arange(1, harmonics + 1)
    sums = np.cos(rate * np.outer(np.arange(2 * harmonics + 1), column)).sum(axis=1)
    of_difference, of_sum = sums[np.abs(order[:, None] - order)], sums[order[:, None] + order]
    shapes, phases = smooth_shapes(count, slow).T, rate * np.outer(order, column)
    residual, strengths = values, np.zeros(harmonics, dtype=np.complex128)
    for wave, first, factor in ((np.cos, 0, 1.0), (np.sin, 1, -1.0)):
        parts = np.vstack([wave(phases), shapes[first::2]])
        products = row_products(parts, parts[harmonics:])
        products = np.hstack([np.zeros((len(parts), harmonics)), products])
        products[harmonics:, :harmonics] = products[:harmonics, harmonics:].T
        products[:harmonics, :harmonics] = 0.5 * (of_difference + factor * of_sum)
        # At half the column rate a sine has no energy of its own.
        products[np.diag_indices_from(products)] += _REGULARIZATION * count
        weights = solve_positive_definite(products, row_products(values, parts))
        residual = residual - combine(weights, parts)
        strengths += 0.5 * weights[:harmonics] * (1.0 if first == 0 else -1j)
    return strengths * np.exp(0.5j * rate * (1 - count) * order), residual


def correlated_columns(residual: FloatArray) -> float:
    """Return the number of columns of a fit's residual that count as one independent value.

    It is 1 plus twice the sum of the autocorrelations up to the first that is not positive.
    Neighbouring columns are not independent if an effect outside the model, such as a lens's blur,
    is the same in them.
    """
    power = float(residual @ residual)
    if power <= 0.0:
        return 1.0
    spectrum = np.abs(np.fft.rfft(residual, 2 * len(residual))) ** 2
    correlations = np.fft.irfft(spectrum)[1 : len(residual)] / power
    ends = np.flatnonzero(correlations <= 0.0)
    return 1.0 + 2.0 * float(correlations[: ends[0] if ends.size else None].sum())
