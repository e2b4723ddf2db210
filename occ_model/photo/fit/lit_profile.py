"""The model of one profile of pixels that are lit equally: its levels, and the residual they leave.

For given lit fractions and a given tone curve the levels are found by linear least squares, so that
a search need not know them (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10:413,
1973).
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.fit.normal_equations import LitColumns, NormalEquations, at_least_one, solved
from occ_model.photo.fit.seen_stripes import BLUR, BLUR_REACH, Seen, SeenSlopes, blurred
from occ_model.photo.stripes.envelope import LEAST_SWING, smooth_shapes
from occ_model.photo.stripes.evenly_lit import EvenProfile

_LEAST_DEVIATION = 0.02  # minimum standard deviation of a column mean in grey levels
_MOST_CORRECTIONS = 4  # steps by which levels are corrected for the blur of grey levels
_LEAST_CORRECTION = 1e-4  # light of white
_COLUMNS_PER_SLOW_SHAPE = 8  # minimum number of columns per polynomial that is projected out


@dataclass(frozen=True, eq=False, slots=True)
class _Fitted:
    kept: LitColumns
    # Shape (kept,); error, slope: the light of their data less that of the levels, and the data's
    # slope over light, whose square is its weight.
    error: FloatArray
    slope: FloatArray
    products: FloatArray  # shape (levels, levels); the matrix of the normal equations
    levels: FloatArray  # shape (levels,); their solution: the levels as if light were blurred
    # Shape (clipped,); the clipped columns that count in them, as if they were seen at white.
    dark: NDArray[np.bool_]
    # Shape (levels,); the levels of the model: corrected where pixel values are blurred.
    shown: FloatArray


class LitProfile:
    """A profile's columns that are not clipped, and those that are, with the levels' shapes.

    ``freedom``: number of Chebyshev polynomials of which either level is a combination. ``slow``:
    number of those that carry no information: the shape of a lamp does not
    depend on the stripes.
    """

    def __init__(self, profile: EvenProfile, freedom: int, slow: int = 0) -> None:
        self.kept, self.clipped = np.flatnonzero(profile.kept), np.flatnonzero(profile.clipped)
        self.data = profile.values[self.kept]
        slope = np.abs(np.gradient(profile.values))
        self.slope = cv2.dilate(slope[None], np.ones((1, 3), np.uint8))[0][self.kept]
        self.freedom = freedom
        slow = min(slow, self.kept.size // _COLUMNS_PER_SLOW_SHAPE)
        slow_shapes = smooth_shapes(len(profile.values), slow)
        self._slow = np.ascontiguousarray(slow_shapes[self.kept])
        shapes = smooth_shapes(len(profile.values), 2 * freedom - 1)
        self._shapes = np.ascontiguousarray(shapes[:, :freedom].T)
        self._wide_shapes = np.pad(self._shapes, ((0, 0), (BLUR_REACH, BLUR_REACH)), mode="edge")
        self._equations = NormalEquations(shapes[self.kept], freedom)
        self._kept_shapes = np.ascontiguousarray(self._shapes[:, self.kept])
        self._clipped_shapes = np.ascontiguousarray(self._shapes[:, self.clipped])
        # The clipped columns that were below white at last, from which the next levels are sought.
        self._dark = np.zeros(self.clipped.size, dtype=bool)
        # Slopes are asked for where the residual has just been.
        self._fitted = lru_cache(maxsize=1)(self._fitted_to)
        self._of_levels = lru_cache(maxsize=1)(self._slopes_of_levels)

    def residual(self, seen: Seen) -> FloatArray:
        """Return data less model in grey levels: of the kept columns, then of the clipped ones."""
        fitted = self._fitted(seen)
        if seen.sharp is None:
            kept = self.data - seen.table.value_of(fitted.kept.light(fitted.levels))
        else:
            picture = LitColumns(self._wide_shapes, seen.sharp)
            kept = self._less_blurred(seen, picture.light(fitted.shown))
        if not self.clipped.size:
            return kept
        short = 1.0 - self._beyond(seen).light(fitted.levels)
        return np.concatenate([kept, seen.table.steepness * np.maximum(short, 0.0)])

    def slopes(self, seen: Seen, rates: SeenSlopes) -> FloatArray:
        """Return the residual's slopes over the parameters of the light, then over the tone's.

        Where pixel values are blurred, what has the residual as a factor is left out (Kaufman, BIT
        15:49, 1975).

        Shape (parameters, residuals).
        """
        kept = self._slopes_of_kept(seen, rates)
        if not self.clipped.size:
            return kept
        return np.hstack([kept, self._slopes_of_clipped(seen, rates)])

    def relative_slope(self, seen: Seen) -> FloatArray:
        """Return the slope of the swing's logarithm over columns, the clipped columns last."""
        swing = self._fitted(seen).levels[self.freedom :] @ self._shapes
        swing = np.maximum(swing, LEAST_SWING * float(swing.max()))
        slope = np.gradient(np.log(np.maximum(swing, 1e-12)))
        return np.concatenate([slope[self.kept], slope[self.clipped]])

    def slow(self, noise: FloatArray) -> FloatArray:
        """Return an orthonormal basis of slow changes in a residual divided by its noise."""
        return np.asarray(np.linalg.qr(self._slow / noise[:, None])[0])

    def _beyond(self, seen: Seen) -> LitColumns:
        return LitColumns(self._clipped_shapes, seen.lit[self.clipped])

    def _fitted_to(self, seen: Seen) -> _Fitted:
        """Find the levels.

        Clipped columns that they leave below white count as seen at white.
        """
        kept = LitColumns(self._kept_shapes, seen.lit[self.kept])
        light, slope = seen.table.light_of(self.data), seen.table.slope_at(self.data)
        own = self._equations.matrix(slope**2, kept.lit)
        sums = kept.sums(slope**2 * light)
        products, levels = own, solved(own, sums)
        if self.clipped.size:
            beyond, weight = self._beyond(seen), seen.table.steepness**2
            columns = np.vstack([beyond.shapes, beyond.shapes * beyond.lit])
            products, levels, self._dark = at_least_one(own, sums, columns, weight, self._dark)
        shown = levels if seen.sharp is None else self._corrected(seen, seen.sharp, levels)
        return _Fitted(kept, light - kept.light(levels), slope, products, levels, self._dark, shown)

    def _slopes_of_kept(self, seen: Seen, rates: SeenSlopes) -> FloatArray:
        if seen.sharp is not None and rates.sharp is not None:
            return self._slopes_of_blurred(seen, rates, seen.sharp, rates.sharp)
        fitted, by_lit = self._fitted(seen), rates.lit[:, self.kept]
        light = fitted.kept.slopes(fitted.levels, self._of_levels(seen, rates), by_lit)
        values = seen.table.value_of(fitted.kept.light(fitted.levels))
        return -rates.tone.of_values(values, light)

    def _slopes_of_clipped(self, seen: Seen, rates: SeenSlopes) -> FloatArray:
        levels, beyond = self._fitted(seen).levels, self._beyond(seen)
        short, by_lit = 1.0 - beyond.light(levels), rates.lit[:, self.clipped]
        light = beyond.slopes(levels, self._of_levels(seen, rates), by_lit)
        slopes = -seen.table.steepness * light
        slopes[len(by_lit) :] += short * rates.tone.of_steepness[:, None]
        return np.where(short > 0.0, slopes, 0.0)

    def _slopes_of_levels(self, seen: Seen, rates: SeenSlopes) -> FloatArray:
        fitted, by_lit = self._fitted(seen), rates.lit[:, self.kept]
        error, weight = fitted.error, fitted.slope**2
        by_light, by_slope = rates.tone.at(self.data)
        by_tone = weight * by_light + 2.0 * error * fitted.slope * by_slope
        pulls = fitted.kept.pulls(fitted.levels, weight, error, by_lit, by_tone)
        if fitted.dark.any():
            dark, counted = self.clipped[fitted.dark], self._at_white(seen, fitted.dark)
            error = 1.0 - counted.light(fitted.levels)
            weight = np.full(dark.size, seen.table.steepness**2)
            by_tone = error * (2.0 * seen.table.steepness * rates.tone.of_steepness)[:, None]
            pulls += counted.pulls(fitted.levels, weight, error, rates.lit[:, dark], by_tone)
        return solved(fitted.products, pulls)

    def _corrected(self, seen: Seen, sharp: FloatArray, levels: FloatArray) -> FloatArray:
        """Correct levels that were found as if light were blurred, by Gauss and Newton's steps.

        Their shapes are so smooth that blur does not change them. Dark columns beside bright ones,
        whose light a blurred grey level hides, need several steps.
        """
        white = self._at_white(seen, self._dark)
        for _ in range(_MOST_CORRECTIONS):
            light = LitColumns(self._wide_shapes, sharp).light(levels)
            missing = self._less_blurred(seen, light), 1.0 - white.light(levels)
            change = self._explained(seen, self._steep(seen, sharp, light), white, missing)
            levels = levels + change
            if np.abs(change).max() < _LEAST_CORRECTION:
                break
        return levels

    def _slopes_of_blurred(
        self, seen: Seen, rates: SeenSlopes, sharp: FloatArray, by_sharp: FloatArray
    ) -> FloatArray:
        levels, picture = self._fitted(seen).shown, LitColumns(self._wide_shapes, sharp)
        light, fixed = picture.light(levels), np.zeros((rates.parameters, len(levels)))
        values = seen.table.value_of(light)
        by_values = rates.tone.of_values(values, picture.slopes(levels, fixed, by_sharp))
        slopes = -blurred(by_values, seen.kernel)
        slopes[BLUR] -= blurred(values, rates.kernel)
        slopes = slopes[:, self.kept]
        (steep, columns), dark = self._steep(seen, sharp, light), self._fitted(seen).dark
        white, of_white = self._at_white(seen, dark), np.zeros((rates.parameters, dark.sum()))
        of_white[: len(rates.lit)] = -white.swing(levels) * rates.lit[:, self.clipped[dark]]
        moved = self._explained(seen, (steep, columns), white, (slopes, of_white))
        return slopes - steep * columns.light(moved)

    def _at_white(self, seen: Seen, dark: NDArray[np.bool_]) -> LitColumns:
        """Return those of the clipped columns that count as seen at white."""
        place = self.clipped[dark]
        return LitColumns(self._shapes[:, place], seen.lit[place])

    def _steep(
        self, seen: Seen, sharp: FloatArray, light: FloatArray
    ) -> tuple[FloatArray, LitColumns]:
        """Return the kept columns' slopes over the levels: a factor of columns."""
        steep = seen.table.slope_of(light)
        both = blurred(np.stack([steep, steep * sharp]), seen.kernel)[:, self.kept]
        return both[0], LitColumns(self._kept_shapes, both[1] / both[0])

    def _explained(
        self,
        seen: Seen,
        kept: tuple[FloatArray, LitColumns],
        white: LitColumns,
        changes: tuple[FloatArray, FloatArray],
    ) -> FloatArray:
        """Return the levels' changes that best explain those of the kept columns and at white.

        The former in grey levels, the latter in light.
        """
        (steep, columns), weight = kept, seen.table.steepness**2
        at_white = np.vstack([white.shapes, white.shapes * white.lit])
        products = self._equations.matrix(steep**2, columns.lit) + weight * at_white @ at_white.T
        of_kept, of_white = changes
        return solved(products, columns.sums(steep * of_kept) + weight * white.sums(of_white))

    def _less_blurred(self, seen: Seen, light: FloatArray) -> FloatArray:
        return self.data - blurred(seen.table.value_of(light), seen.kernel)[self.kept]


def deviation_of(residual: FloatArray, slope: FloatArray, freedom: float) -> FloatArray:
    """Estimate each column's noise: compression and processing change edges more than plateaus."""
    square = residual**2 * (residual.size / max(1.0, residual.size - 2.0 * freedom))
    steep = slope**2
    parts = np.stack([np.ones_like(steep), steep], axis=1)
    variance = np.full(residual.size, max(float(square.mean()), _LEAST_DEVIATION**2))
    for _ in range(3):
        weighted = parts / variance[:, None]
        level, rate = np.linalg.lstsq(weighted, square / variance, rcond=None)[0].tolist()
        level = max(level, 0.05 * float(square.mean()), _LEAST_DEVIATION**2)
        variance = level + max(rate, 0.0) * steep
    return np.asarray(np.sqrt(variance))
