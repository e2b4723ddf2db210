"""The period of frames whose times a container has rounded.

The time of frame n is a + n T, rounded to multiples of q and scattered by a standard deviation s.
Each frame's probability is Phi((r + q/2) / s) - Phi((r - q/2) / s) with r = t - a - n T. The
product over all frames, integrated over a and over s, gives T and its error. A scatter of the
rounded times alone would not do: if T is almost a multiple of q, all frames share one rounding.
"""

import numpy as np
from scipy.special import ndtr

from occ_model.arrays import FloatArray
from occ_model.results.clock import MeasuredValue

_SCATTERS = (1 / 32, 1 / 8, 1 / 4, 1 / 2)  # scatters tried, in steps of rounding
_MAX_ROUNDED_SCATTER = 0.6  # scatter in steps from which rounding only adds to it
_GRID = np.linspace(-1.0, 1.0, 17)
_ZOOMS = 3
_LOG_RANGE = 16.0  # below the largest log-likelihood, where nothing is left
_MOST_FRAMES = 400
_COVERED = 4.0  # standard deviations that cover all periods that can be


def fit_line(numbers: FloatArray, times: FloatArray) -> tuple[float, float, float]:
    """Return the slope of times over numbers, its standard deviation, and their scatter."""
    centred_numbers, centred_times = numbers - numbers.mean(), times - times.mean()
    power = float(centred_numbers @ centred_numbers)
    slope = float(centred_numbers @ centred_times) / power
    residuals = centred_times - centred_numbers * slope
    scatter = float(np.sqrt(np.sum(residuals**2) / max(len(times) - 2, 1)))
    return slope, scatter / np.sqrt(power), scatter


def fit_rounded_period(numbers: FloatArray, times: FloatArray, step: float) -> MeasuredValue:
    """Return the period of times that are rounded to multiples of ``step``, in the same unit."""
    slope, error, scatter = fit_line(numbers, times)
    if scatter > _MAX_ROUNDED_SCATTER * step:
        return MeasuredValue(slope, error)
    if len(times) > _MOST_FRAMES:
        kept = np.linspace(0, len(times) - 1, _MOST_FRAMES).astype(np.int64)
        numbers, times = numbers[kept], times[kept]
    centred = numbers - 0.5 * float(numbers[0] + numbers[-1])
    residuals = (times - times.mean() - slope * (centred - centred.mean())) / step
    # In steps: a period's change while the last frame moves by one, and the start's change.
    extent = float(np.ptp(numbers))
    centre, width = np.zeros(2), np.array([6.0 / extent, 2.0])
    for _ in range(_ZOOMS):
        slopes, starts = (middle + half * _GRID for middle, half in zip(centre, width, strict=True))
        likelihood = _likelihood(centred, residuals, slopes, starts)
        is_possible = likelihood > np.exp(-_LOG_RANGE)
        for axis, values in enumerate((slopes, starts)):
            inside = values[is_possible.any(axis=1 - axis)]
            spacing = values[1] - values[0]
            centre[axis] = 0.5 * (inside[0] + inside[-1])
            width[axis] = 0.5 * (inside[-1] - inside[0]) + spacing
    weights = likelihood.sum(axis=1) / likelihood.sum()
    mean = float(weights @ slopes)
    deviation = float(np.sqrt(weights @ (slopes - mean) ** 2))
    lowest, highest = _possible_slopes(centred, residuals)
    if lowest <= highest:  # nominal rates lie at one of these ends more often than others
        deviation = max(deviation, (mean - lowest) / _COVERED, (highest - mean) / _COVERED)
    return MeasuredValue(slope + step * mean, step * deviation)


def _possible_slopes(centred: FloatArray, residuals: FloatArray) -> tuple[float, float]:
    """Return the lowest and the highest slope if times scatter by their rounding alone; in steps.

    The lowest is above the highest if there is none.
    """
    after, before = np.triu_indices(len(centred), 1)[::-1]
    distances, changes = centred[after] - centred[before], residuals[after] - residuals[before]
    is_later = distances > 0
    distances, changes = distances[is_later], changes[is_later]
    return (
        float(((changes - 1.0) / distances).max()),
        float(((changes + 1.0) / distances).min()),
    )


def _likelihood(
    centred: FloatArray, residuals: FloatArray, slopes: FloatArray, starts: FloatArray
) -> FloatArray:
    """Return the likelihood of each slope and start, relative to the largest; in steps."""
    logs = np.empty((len(_SCATTERS), len(slopes), len(starts)))
    for row, slope in enumerate(slopes.tolist()):
        distances = (residuals - slope * centred) - starts[:, None]
        for layer, scatter in enumerate(_SCATTERS):
            inside = ndtr((0.5 - np.abs(distances)) / scatter)
            beyond = ndtr((-0.5 - np.abs(distances)) / scatter)
            logs[layer, row] = np.log(np.maximum(inside - beyond, 1e-300)).sum(axis=1)
    return np.asarray(np.exp(logs - logs.max()).sum(axis=0))
