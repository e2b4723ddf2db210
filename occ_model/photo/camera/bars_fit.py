"""Find the number of bars a frame, with its error and the likelihood of other numbers."""

import math
from dataclasses import astuple, dataclass, replace

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from occ_model.arrays import FloatArray
from occ_model.photo.camera.bars_model import COARSE, FINE, BarsModel, Scales, Shape
from occ_model.photo.camera.quotient import LineValues

FEWEST_BARS, MOST_BARS = 1.0, 16.0
_STEPS_A_BAR = 8  # steps of the search in which the phase at the frame's end changes by a cycle
_LEAST_LINES = 5.0  # lines a bar
_LEAST_DEVIATION = 2e-3  # least error of a line: 8 bits quantize light by 2 %, over several cells
_CANDIDATES = 4
_LARGEST = 0.999  # value of a quotient whose second picture is dark
_DEGREES = 4.0  # degrees of freedom of Student's t, which gives lines of a moved edge less weight
_ROUNDS = 4
_REACH = 20  # part of the lines up to which residuals are taken to correlate (Newey and West, 1987)
_LEAST_SHARE = 0.2  # least energy in the harmonics that waves of twice or thrice the bars lack
# Standard deviations of the prior of the scales' logarithms, and the largest deviations allowed.
_SPREAD, _FARTHEST = np.array([1.5, 0.4, 0.7, 2.0, 0.5]), np.array([3.0, 0.7, 1.4, 3.0, 1.0])
_APART = 0.04  # relative difference from which two numbers of bars are different answers
_MODULATIONS = (0.06, 0.12, 0.25, 0.5)
_NO_MODULATION = 1e-3
_BENDS = np.linspace(-0.06, 0.06, 7)


@dataclass(frozen=True, eq=False, slots=True)
class BarsFit:
    """The bars that explain a quotient's lines best.

    Parameters
    ----------
    bars, deviation
        Bars a frame and its standard deviation.
    gap
        Natural logarithm of its likelihood over that of the next other number of bars.
    gap_to_none
        The same over that of no bars at all.
    other
        That next number.
    bend, bend_gap
        Most likely displacement by a lens correction in the corners, relative to their distance
        from the middle, and the logarithm of its likelihood over that of none.
    fitted, waves : ndarray of float64, shape (tiles, lines)
        The fit, and its periodic part.
    residual
        Root mean square of what is not explained, weighted.
    """

    bars: float
    deviation: float
    gap: float
    gap_to_none: float
    other: float
    bend: float
    bend_gap: float
    fitted: FloatArray
    waves: FloatArray
    residual: float
    scales: Scales

    @property
    def clipped_waves(self) -> FloatArray:
        """The periodic part, within what a quotient (A - B) / (A + B) of light can be."""
        return np.clip(self.waves, -_LARGEST, _LARGEST)


@dataclass(frozen=True, eq=False, slots=True)
class _BarsSearch:
    """Lines weighted by what the best number of bars so far does not explain, and that number."""

    lines: LineValues
    weights: FloatArray  # Shape (tiles, lines): inverse variances
    scales: Scales
    bars: float = math.nan

    def model(self, bars: float, shape: Shape, bend: float = 0.0) -> BarsModel:
        return BarsModel(self.lines, self.weights, bars, shape, bend)

    def evidence(self, bars: float, shape: Shape, bend: float = 0.0) -> float:
        """Return the log-likelihood of a number of bars."""
        return self.model(bars, shape, bend).log_evidence(self.scales)

    def evidences(self, grid: FloatArray) -> FloatArray:
        """Return the log-likelihoods of numbers of bars, coarsely."""
        return np.array([self.evidence(bars, COARSE) for bars in grid])

    def refine(self, bars: float, shape: Shape) -> tuple[float, float]:
        """Find the most likely number of bars near one; return it with its log-likelihood."""
        step = 1.0 / _STEPS_A_BAR
        found = minimize_scalar(
            lambda tried: -self.evidence(tried, shape),
            bounds=(max(bars - step, FEWEST_BARS), bars + step), options={"xatol": 2e-3},
        )  # fmt: skip
        return float(found.x), -float(found.fun)

    def weight_for(self, bars: float, shape: Shape) -> "_BarsSearch":
        """Fit the scales, and weight the lines by what a number of bars does not explain."""
        model, lines = self.model(bars, shape), self.lines
        scales = _fit_scales(model, _first_scales(lines))
        residual = lines.values - model.fit(scales)
        spread = 1.4826 * float(np.median(np.abs(residual[np.isfinite(lines.deviations)])))
        weights = lines.weights(max(_LEAST_DEVIATION, spread))
        factors, inflation = _weight_factors(residual, weights)
        if shape is COARSE:  # what it does not explain is mostly the wave's higher harmonics
            inflation = 1.0
        return replace(self, weights=weights * (factors / inflation), scales=scales, bars=bars)


def _first_scales(lines: LineValues) -> Scales:
    seen = lines.values[np.isfinite(lines.deviations)]
    spread = max(float(np.std(seen)), _LEAST_DEVIATION) if seen.size else _LEAST_DEVIATION
    return Scales(spread, 1.5, 0.15, 0.5 * spread, 1.0)


def fit_bars(lines: LineValues) -> BarsFit:
    """Fit the bars that explain a quotient's lines best, and compare them with other explanations.

    These are other numbers of bars, no bars, and bent ones.
    """
    start, grid = _first_scales(lines), _grid(lines.values.shape[1])
    search = _BarsSearch(lines, lines.weights(start.slow), start)
    for _ in range(_ROUNDS):
        top = float(grid[int(np.argmax(search.evidences(grid)))])
        search = search.weight_for(search.refine(top, COARSE)[0], COARSE)
    search = search.weight_for(search.bars, FINE)
    search = search.weight_for(search.refine(search.bars, FINE)[0], FINE)
    tops = [search.bars, *_maxima(grid, search.evidences(grid))]
    tried = {*tops, *(search.bars * factor for factor in (1 / 3, 0.5, 2.0, 3.0))}
    found = [search.refine(bars, FINE) for bars in tried if FEWEST_BARS <= bars <= grid[-1]]
    bars, evidence = max(found, key=lambda each: each[1])
    for factor in (2, 3):
        if factor * bars <= grid[-1] and _share_of_others(search, bars, factor) < _LEAST_SHARE:
            bars, evidence = search.refine(factor * bars, FINE)
    others = [each for each in found if abs(each[0] / bars - 1.0) > _APART]
    other, next_best = max(others, key=lambda each: each[1], default=(math.nan, -math.inf))
    search = replace(search, bars=bars)
    none = _fit_none(search)
    bars, deviation = _posterior(search)
    search = replace(search, bars=bars)
    bend, bend_gap = _bend(search)
    model = search.model(bars, FINE)
    fitted, weights = model.fit(search.scales), search.weights
    square = float((weights * (lines.values - fitted) ** 2).sum() / weights.sum())
    return BarsFit(
        bars, deviation, evidence - next_best, evidence - none, other, bend, bend_gap,
        fitted, model.waves(search.scales), math.sqrt(square), search.scales,
    )  # fmt: skip


def _grid(lines: int) -> FloatArray:
    most = min(MOST_BARS, lines / _LEAST_LINES)
    count = int((most - FEWEST_BARS) * _STEPS_A_BAR) + 1
    return np.linspace(FEWEST_BARS, most, count)


def _fit_scales(model: BarsModel, start: Scales) -> Scales:
    """Find the most likely scales, each within an allowed factor of its start."""
    middle = np.log(astuple(start))

    def cost(logs: FloatArray) -> float:
        if (np.abs(logs - middle) > _FARTHEST).any():
            return math.inf
        penalty = 0.5 * (((logs - middle) / _SPREAD) ** 2).sum()
        return float(penalty - model.log_evidence(Scales(*np.exp(logs))))

    found = minimize(cost, middle, method="Nelder-Mead", options={"maxfev": 150, "xatol": 0.02})
    return Scales(*(float(each) for each in np.exp(found.x)))


def _weight_factors(residual: FloatArray, weights: FloatArray) -> tuple[FloatArray, float]:
    """Return factors on the weights by Student's t, and how far correlation inflates variances."""
    away = np.where(weights > 0.0, residual * np.sqrt(weights), 0.0)
    factors = (_DEGREES + 1.0) / (_DEGREES + away**2)
    robust = away * np.sqrt(factors)
    energy = max(float((robust**2).sum()), 1e-12)
    reach = robust.shape[1] // _REACH
    along = 1.0 + 2.0 * sum(
        (1.0 - lag / (reach + 1)) * float((robust[:, lag:] * robust[:, :-lag]).sum()) / energy
        for lag in range(1, reach + 1)
    )
    across = float((robust.sum(axis=0) ** 2).sum()) / energy  # 1 for independent tiles
    return factors, max(along, 1.0) * max(across, 1.0)


def _maxima(grid: FloatArray, values: FloatArray) -> list[float]:
    padded = np.concatenate([[-np.inf], values, [-np.inf]])
    is_top = (padded[1:-1] >= padded[:-2]) & (padded[1:-1] >= padded[2:])
    tops = np.flatnonzero(is_top)
    tops = tops[np.argsort(values[tops])[::-1][:_CANDIDATES]]
    return [float(each) for each in grid[tops]]


def _share_of_others(search: _BarsSearch, bars: float, factor: int) -> float:
    """Return the share of a wave's energy in harmonics that are no multiples of a factor."""
    energies = search.model(bars, FINE).harmonic_energies(search.scales)
    return 1.0 - float(energies[factor - 1 :: factor].sum() / max(energies.sum(), 1e-12))


def _fit_none(search: _BarsSearch) -> float:
    """Return the log-likelihood without bars, with the slow change that suits it best."""
    model, scales = search.model(search.bars, COARSE), search.scales
    slow = [scales.slow * factor for factor in (0.3, 1.0, 3.0, 10.0)]
    return max(model.log_evidence(replace(scales, wave=1e-9, slow=each)) for each in slow)


def _posterior(search: _BarsSearch) -> tuple[float, float]:
    """Return mean and deviation of the number of bars, over it and the modulation."""
    scales, width = search.scales, _width(search)
    near = search.bars + width * np.linspace(-4.0, 4.0, 25)
    near = near[near > 0.5 * FEWEST_BARS]
    models = [search.model(each, FINE) for each in near]
    logs = np.array([
        [model.log_evidence(replace(scales, modulation=each))
         - 0.5 * (math.log(each / 0.15) / 0.7) ** 2 for each in _MODULATIONS]
        for model in models
    ])  # fmt: skip
    weights = np.exp(logs - logs.max()).sum(axis=1)
    weights /= weights.sum()
    mean = float((weights * near).sum())
    variance = float((weights * (near - mean) ** 2).sum())
    return mean, math.sqrt(_widen_variance(search, mean, variance))


def _widen_variance(search: _BarsSearch, bars: float, variance: float) -> float:
    """Widen a variance by what tiles have in common, and by how far they disagree.

    Modulations are independent in the model's tiles, but the same lamps light all of them: their
    part of the variance is taken as if half of the tiles showed the same one.
    """
    step = 0.5 * math.sqrt(variance)
    places = (bars + step, bars, bars - step)
    models = [search.model(each, FINE) for each in places]
    even = replace(search.scales, modulation=_NO_MODULATION)
    steepest = _curvature([model.log_evidences(even) for model in models], step)
    least = min(1.0 / steepest, variance)
    logs = [model.log_evidences(search.scales) for model in models]
    slopes = (logs[0] - logs[2]) / (2.0 * step)
    tiles = len(slopes)
    scatter = float(((slopes - slopes.mean()) ** 2).sum()) * tiles / (tiles - 1)
    common = least + 0.5 * tiles * (variance - least)
    return common * max(1.0, scatter / _curvature(logs, step))


def _curvature(logs: list[FloatArray], step: float) -> float:
    above, at, below = (float(each.sum()) for each in logs)
    return max((2.0 * at - above - below) / step**2, 1e-9)


def _width(search: _BarsSearch) -> float:
    """Return about the standard deviation of the number of bars, by the curvature at its best."""
    step, top = 2e-3, search.evidence(search.bars, FINE)
    while True:
        beside = (search.evidence(search.bars + side * step, FINE) for side in (1, -1))
        drop = top - 0.5 * sum(beside)
        if drop > 0.5 or step > 0.1:
            return step / math.sqrt(2.0 * max(drop, 0.1)) * 1.3
        step *= 2.0


def _bend(search: _BarsSearch) -> tuple[float, float]:
    """Return the most likely bend, and the logarithm of its likelihood over that of none."""

    def best(bend: float) -> float:
        near = search.bars * (1.0 - np.array([-0.1, 0.1, 0.3, 0.5]) * bend)
        return max(search.evidence(bars, FINE, bend) for bars in near)

    values = [best(float(bend)) for bend in _BENDS]
    top = int(np.argmax(values))
    return float(_BENDS[top]), values[top] - values[len(_BENDS) // 2]
