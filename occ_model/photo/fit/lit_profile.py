"""The model of one profile of pixels that are lit equally: its levels and its residual.

For given lit fractions and a given tone curve the levels are found by linear least squares, so that
a search need not know them (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10:413,
1973).
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.levels import LevelShapes, LitColumns
from occ_model.photo.fit.seen_stripes import BLUR, BLUR_REACH, Seen, SeenSlopes, blur_rows
from occ_model.photo.stripes.envelope import LEAST_SWING, smooth_shapes
from occ_model.photo.stripes.evenly_lit import EvenProfile
from occ_model.products import combine, orthonormalize

_LEAST_DEVIATION = 0.02  # minimum standard deviation of a column mean in grey levels
_MOST_CORRECTIONS = 4  # steps by which levels are corrected for the blur of grey levels
_LEAST_CORRECTION = 1e-4  # light of white
_COLUMNS_PER_SLOW_SHAPE = 8  # minimum number of columns per polynomial that is projected out


@dataclass(frozen=True, eq=False, slots=True)
class _Fitted:
    kept: LitColumns
    # Shape (levels,); those that explain the data's light best, as if light were blurred, and those
    # of the model: corrected where pixel values are blurred.
    levels: FloatArray
    shown: FloatArray


class LitProfile:
    """A profile's columns that are not clipped, with the levels' shapes.

    ``freedom``: number of Chebyshev polynomials of which either level is a combination. ``slow``:
    number of those that carry no information, as the shape of a lamp does not depend on the
    stripes.
    """

    def __init__(self, profile: EvenProfile, freedom: int, slow: int = 0) -> None:
        self.kept = np.flatnonzero(profile.kept)
        self.data = profile.values[self.kept]
        slope = np.abs(np.gradient(profile.values))
        self.slope = cv2.dilate(slope[None], np.ones((1, 3), np.uint8))[0][self.kept]
        self.freedom = freedom
        slow = min(slow, self.kept.size // _COLUMNS_PER_SLOW_SHAPE)
        slow_shapes = smooth_shapes(len(profile.values), slow)
        self._slow = np.ascontiguousarray(slow_shapes[self.kept].T)
        self._shapes = LevelShapes(len(profile.values), freedom, self.kept)
        self._wide_shapes = np.pad(
            self._shapes.all, ((0, 0), (BLUR_REACH, BLUR_REACH)), mode="edge"
        )
        # Slopes are needed where the residual has just been computed.
        self._fitted = lru_cache(maxsize=1)(self._fit_levels)

    def residual(self, seen: Seen) -> FloatArray:
        """Return data less model in grey levels, shape (kept,)."""
        fitted = self._fitted(seen)
        if seen.sharp is None:
            return self.data - seen.table.value_of(fitted.kept.light(fitted.levels))
        picture = LitColumns(self._wide_shapes, seen.sharp)
        return self._residual_of_blurred(seen, picture.light(fitted.shown))

    def slopes(self, seen: Seen, rates: SeenSlopes) -> FloatArray:
        """Return the residual's slopes over the light's parameters, then the tone's: (any, kept).

        What has the residual as a factor is left out (Kaufman, BIT 15:49, 1975).
        """
        fitted, by_lit = self._fitted(seen), rates.lit
        if seen.sharp is None:
            picture, by_lit = fitted.kept, by_lit[:, self.kept]
        else:
            picture = LitColumns(self._wide_shapes, seen.sharp)
        light = picture.light(fitted.shown)
        values = seen.table.value_of(light)
        by_light = np.zeros((len(by_lit) + len(rates.tone.light), len(light)))
        np.multiply(by_lit, picture.swing(fitted.shown), out=by_light[: len(by_lit)])
        slopes = -rates.tone.of_values(values, by_light)
        steep, columns = seen.table.slope_of(light), picture
        if seen.sharp is not None:
            slopes = blur_rows(slopes, seen.kernel)
            slopes[BLUR] -= blur_rows(values, rates.kernel)
            slopes = slopes[:, self.kept]
            steep, columns = self._steep(seen, seen.sharp, light)
        return slopes - steep * columns.light(self._shapes.fit(columns.lit, steep, slopes))

    def relative_slope(self, seen: Seen) -> FloatArray:
        """Return the slope of the swing's logarithm over columns, shape (kept,)."""
        swing = combine(self._fitted(seen).levels[self.freedom :], self._shapes.all)
        swing = np.maximum(swing, LEAST_SWING * float(swing.max()))
        slope = np.gradient(np.log(np.maximum(swing, 1e-12)))
        return np.asarray(slope[self.kept])

    def slow(self, noise: FloatArray) -> FloatArray:
        """Return an orthonormal basis of slow changes in a residual divided by its noise.

        Shape (changes, kept).
        """
        return orthonormalize(self._slow / noise)

    def _fit_levels(self, seen: Seen) -> _Fitted:
        kept = LitColumns(self._shapes.kept, seen.lit[self.kept])
        light, slope = seen.table.light_of(self.data), seen.table.slope_at(self.data)
        levels = self._shapes.fit(kept.lit, slope, slope * light)
        shown = levels if seen.sharp is None else self._correct_levels(seen, seen.sharp, levels)
        return _Fitted(kept, levels, shown)

    def _correct_levels(self, seen: Seen, sharp: FloatArray, levels: FloatArray) -> FloatArray:
        """Correct levels that were found as if light were blurred, by Gauss and Newton's steps.

        Their shapes are so smooth that blur does not change them. Dark columns beside bright ones,
        whose light a blurred grey level hides, need several steps.
        """
        for _ in range(_MOST_CORRECTIONS):
            light = LitColumns(self._wide_shapes, sharp).light(levels)
            steep, columns = self._steep(seen, sharp, light)
            change = self._shapes.fit(columns.lit, steep, self._residual_of_blurred(seen, light))
            levels = levels + change
            if np.abs(change).max() < _LEAST_CORRECTION:
                break
        return levels

    def _steep(
        self, seen: Seen, sharp: FloatArray, light: FloatArray
    ) -> tuple[FloatArray, LitColumns]:
        """Return the kept columns' slopes over the levels: a factor of columns."""
        steep = seen.table.slope_of(light)
        both = blur_rows(np.stack([steep, steep * sharp]), seen.kernel)[:, self.kept]
        return both[0], LitColumns(self._shapes.kept, both[1] / both[0])

    def _residual_of_blurred(self, seen: Seen, light: FloatArray) -> FloatArray:
        return self.data - blur_rows(seen.table.value_of(light), seen.kernel)[self.kept]


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
