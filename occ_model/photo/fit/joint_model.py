"""Fit the timing together with what else is unknown of the camera, and state its uncertainty.

The light of a column is a(i) + b(i) x lit(i), with levels a and b that vary slowly; the camera's
tone curve makes it a grey level. Tone curve, blur and the LED's switching are unknown: they are
fitted too, each with a Gaussian prior of what is usual, so that the timing's uncertainty includes
them. Clipped columns are left out. To use that their light is at least white made estimates no
better in some hundred simulated photographs, forty of them with a fifth or more saturated.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.photo.fit.damped_least_squares import Bounds, minimize_squares
from occ_model.photo.fit.joint_fit import CORRELATED_COLUMNS, JointFit, covariance_of
from occ_model.photo.fit.least_squares import level_freedom
from occ_model.photo.fit.lit_profile import LitProfile, deviation_of
from occ_model.photo.fit.seen_stripes import GAMMA, IN_ORDER, BlurShape, SeenStripes
from occ_model.photo.fit.timing import SHORTEST_EXPOSURE, Timing
from occ_model.photo.stripes.evenly_lit import EvenProfile
from occ_model.photo.stripes.period import correlated_columns
from occ_model.products import combine, dot, row_products
from occ_model.scene.parameters import quantity

PRIORS = {
    "gamma": (0.0, 0.12),
    "offset": (0.03, 0.04),
    "shoulder": (0.0, 0.25),
    "contrast": (0.0, 0.35),
    "blur": (0.5, 0.5),
    "longer": (0.0, 0.02),
}
"""Mean and standard deviation of the priors: gamma's logarithm over the scene's gamma, the tone
curve's bends, the blur in columns, and the chips by which the LED is on longer."""

ANY_GAMMA = 0.5  # standard deviation of gamma's logarithm where nothing is known of it
_EDGE_SHIFT = 0.4  # deviation in columns of edges' distances where pixel values are blurred

_CHIPS_PER_BLOCK = 2
_LEAST_BLOCK = 16
"""Length of a block of columns with correlated residuals, and its minimum: two of the blocks of
JPEG."""

_CHIPS_PER_SLOW_SHAPE = 4
_MOST_SLOW_SHAPES = 32
"""Chips in view per polynomial that is projected out of a residual, and their largest number. The
brightness of a lamp along the columns is no combination of a few polynomials; the rest would count
as noise of many columns, so that the priors would outweigh the data."""

_EXPOSURE_SCALE = 0.05  # of the exposure: a change that matters about as much as the others'
_EDGE_BAND = 0.05  # from both levels, relative to the swing, at which a column is on an edge

_LOW = np.array([0.5, SHORTEST_EXPOSURE, -np.inf, -0.9, -0.1, -0.9, -0.9, 0.0, -0.3])
_HIGH = np.array([2.0, np.inf, np.inf, 0.9, 0.3, 0.9, 1.5, 3.0, 0.3])
"""Bounds of the parameters; those of the step are relative to a rough one."""

_MOST_LOG_CHANGE = 5.0  # of the exposure, in a step of the search


class JointModel:
    """The model of profiles of one lamp, by one sequence of chips.

    ``step``: chips per column, roughly. ``gamma``: the usual one; 1 if pixel values are averaged.
    ``values_blurred``: whether pixel values are blurred (noise reduction, resizing) or light
    (demosaicing). ``wide``: whether gamma may have any value of a scene's.
    """

    def __init__(
        self,
        profiles: Sequence[EvenProfile],
        chips: ByteArray,
        step: float,
        gamma: float,
        *,
        values_blurred: bool = False,
        wide: bool = False,
        check: Callable[[], object] = lambda: None,
    ) -> None:
        self._check = check
        columns = len(profiles[0].values)
        self._columns, self._step, self.gamma = columns, step, gamma
        self._values_blurred = values_blurred
        in_view = step * columns
        freedom = level_freedom(in_view)
        slow = int(np.clip(in_view / _CHIPS_PER_SLOW_SHAPE, 1, _MOST_SLOW_SHAPES))
        self._parts = [LitProfile(profile, freedom, slow) for profile in profiles]
        width = max(_LEAST_BLOCK, round(_CHIPS_PER_BLOCK / step))
        self._block = np.concatenate([part.kept // width for part in self._parts])
        self._noise = [np.ones(part.data.size) for part in self._parts]
        self._slow = [part.slow(np.ones(part.data.size)) for part in self._parts]
        usual = np.array(list(PRIORS.values()))
        self._mean, self._deviation = usual[:, 0], usual[:, 1].copy()
        self._deviation[5] = math.hypot(self._deviation[5], _EDGE_SHIFT * step)
        if wide:
            self._deviation[0] = ANY_GAMMA
        self._low, self._high = _LOW.copy(), _HIGH.copy()
        self._low[0] *= step
        self._high[0] *= step
        if wide:
            allowed = quantity("gamma")
            inside = (1.0 + 1e-9, 1.0 - 1e-9)  # of the range, whatever is rounded
            ends = np.array([allowed.low, allowed.high]) * inside
            self._low[3], self._high[3] = np.log(ends / gamma)
        self._free = np.flatnonzero([True] * 3 + [gamma != 1.0] * 2 + [True] * 4)
        self._scale = np.array([0.1 / columns, 0.02, 0.02, *self._deviation])
        self._seen = SeenStripes(chips, columns, gamma, values_blurred=values_blurred)

    def start(self, timing: Timing) -> FloatArray:
        """Return the parameters of a timing with the usual values of all others."""
        values = np.array([timing.step, timing.exposure, timing.middle, *self._mean])
        if self.gamma == 1.0:
            values[4] = 0.0
        return values

    def adapt(self, values: FloatArray) -> FloatArray:
        """Return parameters of another model with usual values of what this one does not fit."""
        return self._usual_but(values, self._free)

    def with_usual(self, values: FloatArray) -> FloatArray:
        """Return parameters with usual values of all but timing, blur and a gamma that is free."""
        is_wide = self._deviation[0] == ANY_GAMMA
        kept = np.flatnonzero([True] * 3 + [is_wide] + [False] * 3 + [True, False])
        return self._usual_but(values, kept)

    def _usual_but(self, values: FloatArray, kept: IndexArray) -> FloatArray:
        step, exposure, middle = values[:3].tolist()
        usual = self.start(Timing(step, exposure, middle, self.gamma))
        usual[kept] = values[kept]
        return usual

    def take_noise(self, other: "JointModel") -> None:
        """Take the noise that another model of the same profiles found."""
        self._noise, self._slow = other._noise, other._slow

    def fit(
        self,
        first: FloatArray,
        rounds: int = 12,
        shape: BlurShape = "normal",
        hopeless: float = math.inf,
    ) -> JointFit:
        """Fit from a first guess; end after a step if the misfit is above ``hopeless``."""
        index = self._free
        values, residual = self._minimize(first, rounds, shape, hopeless)
        scale = np.where(np.arange(9) == 1, _EXPOSURE_SCALE * values[1], self._scale)
        # What is at a bound has no slope, and so is not known.
        inside = (values > self._low) & (values < self._high)
        slopes = (self.slopes(values, shape).T * (inside * scale))[:, index]
        scale = scale[index]
        covariance = np.zeros((9, 9))
        covariance[np.ix_(index, index)] = covariance_of(slopes, residual, self._block) * np.outer(
            scale, scale
        )
        prior = residual[-len(PRIORS) :]
        shift = np.zeros(9)
        # Where pixel values are blurred, the model itself blurs the product.
        if not self._values_blurred:
            by_middle = slopes[:, np.searchsorted(index, 2)] / self._scale[2]
            shift[index] = scale * _explain(slopes, by_middle * self._displacement(values, shape))
        return JointFit(values, covariance, dot(residual, residual), float(prior @ prior), shift)

    def _minimize(
        self, first: FloatArray, rounds: int, shape: BlurShape, hopeless: float
    ) -> tuple[FloatArray, FloatArray]:
        """Return the best parameters, and the residual.

        The exposure's logarithm is searched, whose equal changes matter about as much.
        """
        index, low, high = self._free, self._low.copy(), self._high.copy()
        first = np.clip(first, low, high)
        low[1], first[1] = math.log(low[1]), math.log(first[1])
        most = np.where(index == 1, _MOST_LOG_CHANGE, np.inf)

        def values_of(place: FloatArray) -> FloatArray:
            values = first.copy()
            values[index] = place
            values[1] = math.exp(values[1])
            return values

        def slopes(place: FloatArray) -> FloatArray:
            values = values_of(place)
            slopes = self.slopes(values, shape)
            slopes[1] *= values[1]
            return slopes[index].T

        place, residual = minimize_squares(
            lambda place: self.residual(values_of(place), shape),
            slopes,
            first[index],
            rounds,
            bounds=Bounds(low[index], high[index], most),
            hopeless=hopeless,
        )
        return values_of(place), residual

    def _displacement(self, values: FloatArray, shape: BlurShape) -> FloatArray:
        """Return by how many chips blurred levels shift the edge at each residual.

        The model multiplies blurred stripes by the levels, but a lens blurs their product. Where
        the swing E changes along the columns, a blur of variance s^2 thus moves an edge towards the
        darker side by s^2 (ln E)': an exponential times a normal distribution is one that is moved.
        """
        seen = self._seen.at(values, shape)
        slopes = [part.relative_slope(seen) for part in self._parts]
        moved = float(values[0] * values[7] ** 2) * np.concatenate(slopes)
        return np.concatenate([moved, np.zeros(len(PRIORS))])

    def distance_from_usual(self, values: FloatArray) -> float:
        """Return the distance of a fit's unknowns from usual ones, in standard deviations."""
        return float(np.linalg.norm((values[3:] - self._mean) / self._deviation))

    def estimate_noise(self, values: FloatArray) -> None:
        """Take a fit's residual as the noise of each profile, neighbours being correlated."""
        seen = self._seen.at(values)
        for number, part in enumerate(self._parts):
            residual = part.residual(seen)
            slow = part.slow(np.ones(part.data.size))
            residual -= combine(row_products(residual, slow), slow)
            deviation = deviation_of(residual, part.slope, part.freedom + len(slow) / 2.0)
            whole = np.zeros(self._columns)
            whole[part.kept] = residual / deviation
            deviation *= math.sqrt(CORRELATED_COLUMNS * correlated_columns(whole))
            self._noise[number] = deviation
            self._slow[number] = part.slow(deviation)

    def misfit_of_columns(self, values: FloatArray) -> FloatArray:
        """Return the mean square of each column's residual over the profiles that show it.

        In grey levels, shape (columns,); NaN for a column that none shows unclipped.
        """
        seen = self._seen.at(values)
        squares, count = np.zeros(self._columns), np.zeros(self._columns)
        for part in self._parts:
            squares[part.kept] += part.residual(seen) ** 2
            count[part.kept] += 1.0
        return np.where(count > 0.0, squares / np.maximum(count, 1.0), np.nan)

    def edges_seen(self, values: FloatArray) -> float:
        """Return the largest unclipped fraction of the edges' columns in a profile."""
        lit = self._seen.at(values).lit
        low, high = float(lit.min()), float(lit.max())
        edges = (lit > low + _EDGE_BAND * (high - low)) & (lit < high - _EDGE_BAND * (high - low))
        count = max(1, int(edges.sum()))
        return max(float(edges[part.kept].sum()) / count for part in self._parts)

    def residual(self, values: FloatArray, shape: BlurShape) -> FloatArray:
        self._check()
        seen = self._seen.at(values, shape)
        unusual = (values[3:] - self._mean) / self._deviation
        return np.concatenate([*self._whiten([p.residual(seen) for p in self._parts]), unusual])

    def slopes(self, values: FloatArray, shape: BlurShape) -> FloatArray:
        """Return the residual's slopes, shape (9, residuals)."""
        self._check()
        seen, rates = self._seen.at(values, shape), self._seen.slopes(values, shape)
        found = np.hstack(self._whiten([part.slopes(seen, rates) for part in self._parts]))
        slopes = np.zeros((9, found.shape[1] + len(PRIORS)))
        slopes[IN_ORDER, : -len(PRIORS)] = found
        slopes[GAMMA] *= self._seen.gamma(values)  # over its logarithm
        slopes[3:, -len(PRIORS) :] = np.diag(1.0 / self._deviation)
        return slopes

    def _whiten(self, parts: Sequence[FloatArray]) -> list[FloatArray]:
        """Divide residuals, or slopes, by the noise, and take out what is slow."""
        found = []
        for values, noise, slow in zip(parts, self._noise, self._slow, strict=True):
            white = values / noise
            found.append(white - combine(row_products(white, slow), slow))
        return found


def _explain(slopes: FloatArray, change: FloatArray) -> FloatArray:
    """Return the changes of the parameters that best explain a change of the residual."""
    information = row_products(slopes.T, slopes.T)
    information[np.diag_indices_from(information)] += 1e-9
    return np.asarray(np.linalg.solve(information, row_products(change, slopes.T)))
