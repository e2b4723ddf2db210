"""After how many columns stripes repeat, and how surely."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.stripes.envelope import smooth_shapes

_SHORTEST = 3
"""Columns: anything faster is noise."""

_LEAST_ALIKE = 0.5
"""Correlation with itself, one period on, below which nothing repeats."""

_AS_GOOD = 0.06
"""By how much the correlation after the shortest period may fall behind the best."""

_SEEN = 0.67
"""Share of the columns that a period may be long: some of it must be seen twice."""

_HARMONICS = 24
_STEPS = 8


def repeat_period(flattened: FloatArray) -> tuple[float, float] | None:
    """Find the shortest number of columns after which stripes repeat.

    Parameters
    ----------
    flattened : ndarray of float64, shape (columns,)
        The profile without uneven light.

    Returns
    -------
    period, uncertainty : float
        Columns, and the period's standard deviation; None where nothing repeats.
    """
    rough = _rough_period(flattened)
    return None if rough is None else _refined(flattened, rough)


def _rough_period(flattened: FloatArray) -> float | None:
    """Find the shortest lag after which the profile is as like itself as it gets."""
    alike = self_likeness(flattened)
    count = int(_SEEN * len(alike))
    negative = np.flatnonzero(alike[:count] < 0.0)
    start = max(_SHORTEST, int(negative[0]) if negative.size else _SHORTEST)
    inner = alike[start : count - 1]
    if inner.size < 1:
        return None
    peaks = start + np.flatnonzero(
        (inner >= alike[start - 1 : count - 2]) & (inner >= alike[start + 1 : count])
    )
    if peaks.size == 0:
        return None
    # A short period's peak is missed by up to half a column: a parabola tells its height.
    before, here, after = alike[peaks - 1], alike[peaks], alike[peaks + 1]
    bend = np.minimum(before - 2.0 * here + after, -1e-12)
    aside = np.clip(0.5 * (before - after) / bend, -0.5, 0.5)
    height = here - 0.25 * (before - after) * aside
    if height.max() < _LEAST_ALIKE:
        return None
    first = int(np.flatnonzero(height >= height.max() - _AS_GOOD)[0])
    return float(peaks[first] + aside[first])


def self_likeness(values: FloatArray) -> FloatArray:
    """Correlate values with themselves at every lag, each over the columns that both have.

    Returns
    -------
    ndarray of float64, shape (columns,)
        From -1 to 1, the first being 1; 0 where either part is flat.
    """
    count = len(values)
    about = values - values.mean()
    spectrum = np.fft.rfft(about, 2 * count)
    products = np.fft.irfft(np.abs(spectrum) ** 2)[:count]
    squares = np.concatenate([[0.0], np.cumsum(about**2)])
    lags = np.arange(count)
    energy = np.sqrt(squares[count - lags] * (squares[count] - squares[lags]))
    flat = energy <= 1e-12 * max(float(squares[-1]), 1e-300)
    return np.where(flat, 0.0, products / np.where(flat, 1.0, energy))


def _refined(flattened: FloatArray, period: float) -> tuple[float, float]:
    """Fit harmonics of the period, by Gauss-Newton steps."""
    count = len(flattened)
    harmonics = int(np.clip(period / 2.5, 1, min(_HARMONICS, count / 6)))
    change = 0.1 * period / count  # small against a column at the last stripe
    best, best_residual = period, np.inf
    slope = residual = np.zeros(count)
    for _ in range(_STEPS):
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


def _residual(flattened: FloatArray, period: float, harmonics: int) -> FloatArray:
    """Give what harmonics of a period leave unexplained."""
    count = len(flattened)
    turn = 2.0 * np.pi / period * np.arange(count)[:, None] * np.arange(1, harmonics + 1)
    waves = np.hstack([np.cos(turn), np.sin(turn)])
    shapes = smooth_shapes(count, 2)
    # Of one strength all along: one that might vary would make up for a wrong period.
    parts = np.hstack([shapes, waves])
    products = parts.T @ parts
    products[np.diag_indices_from(products)] *= 1.0 + 1e-10
    return np.asarray(flattened - parts @ np.linalg.solve(products, parts.T @ flattened))


def correlated_columns(residual: FloatArray) -> float:
    """Say how many columns of what a fit leaves unexplained make one independent number.

    1 + 2 times the sum of the autocorrelations up to the first that is not positive: what a model
    does not know, such as a lens's blur, is alike in neighbouring columns, and says so once only.

    Parameters
    ----------
    residual : ndarray of float64, shape (columns,)
        Data less model.
    """
    power = float(residual @ residual)
    if power <= 0.0:
        return 1.0
    spectrum = np.abs(np.fft.rfft(residual, 2 * len(residual))) ** 2
    alike = np.fft.irfft(spectrum)[1 : len(residual)] / power
    ends = np.flatnonzero(alike <= 0.0)
    return 1.0 + 2.0 * float(alike[: ends[0] if ends.size else None].sum())
