"""The model of one profile of pixels that are lit alike: its levels, and the residual they leave.

For given lit fractions and a given tone curve the levels are found by linear least squares, so that
a search need not know them (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10:413,
1973).
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.fit.tone_curve import ToneTable
from occ_model.photo.stripes.envelope import smooth_shapes
from occ_model.photo.stripes.evenly_lit import EvenProfile

_PRECISE = 0.02
"""Smallest standard deviation of a column mean, in grey levels."""

_COLUMNS_A_SLOW_SHAPE = 8
"""Least number of columns for each slow shape that is left out of account."""


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """What the columns see: lit fractions, blurred, or sharp and blurred as pixel values."""

    lit: FloatArray
    table: ToneTable
    sharp: FloatArray | None
    kernel: FloatArray


class LitProfile:
    """A profile's columns that are not clipped, and those that are, with the levels' shapes.

    Parameters
    ----------
    profile
        The profile.
    freedom
        Number of Chebyshev polynomials of which either level is a combination.
    slow
        Number of those that say nothing: what lamps are shaped like is no matter of the stripes.
    """

    def __init__(self, profile: EvenProfile, freedom: int, slow: int = 0) -> None:
        self.kept, self.clipped = np.flatnonzero(profile.kept), np.flatnonzero(profile.clipped)
        self.data = profile.values[self.kept]
        slope = np.abs(np.gradient(profile.values))
        self.slope = cv2.dilate(slope[None], np.ones((1, 3), np.uint8))[0][self.kept]
        self.freedom = freedom
        self._slow = self._slow_shapes(len(profile.values), slow)
        shapes = smooth_shapes(len(profile.values), 2 * freedom - 1)
        self._shapes = np.ascontiguousarray(shapes[:, :freedom].T)
        self._kept_shapes = np.ascontiguousarray(shapes[self.kept].T)
        self._clipped_shapes = shapes[self.clipped, :freedom]
        place = np.arange(freedom)
        self._up, self._down = place[:, None] + place, np.abs(place[:, None] - place)
        # A fit's slopes need the same tone curve again and again.
        self._weighted = lru_cache(maxsize=4)(self._weighted_by)

    def residual(self, seen: Seen) -> FloatArray:
        """Give data less model in grey levels: of the kept columns, then of the clipped ones."""
        light, weight, once, of_light = self._weighted(seen.table)
        lit = seen.lit[self.kept]
        products = self._block(once, weight * lit, lit)
        own = self._kept_shapes[: self.freedom]
        sums = np.concatenate([of_light, own @ (weight * lit * light)])
        if self.clipped.size:
            levels, short = self._with_clipped(seen, products, sums)
        else:
            levels, short = _solved(products, sums), np.zeros(0)
        if seen.sharp is None:
            residual = self.data - seen.table.value_of(self._light(own, lit, levels))
        else:
            residual = self._blurred(seen, seen.sharp, levels)
        return np.concatenate([residual, short])

    def _slow_shapes(self, columns: int, count: int) -> FloatArray:
        """Give the slow shapes at the kept columns, shape (kept, count)."""
        count = min(count, self.kept.size // _COLUMNS_A_SLOW_SHAPE)
        return np.ascontiguousarray(smooth_shapes(columns, count)[self.kept])

    def slow(self, noise: FloatArray) -> FloatArray:
        """Give an orthonormal basis of what is slow in a residual that is divided by its noise."""
        return np.asarray(np.linalg.qr(self._slow / noise[:, None])[0])

    def _weighted_by(
        self, table: ToneTable
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Give the data's light, its weight, and the sums with it that need no lit fractions."""
        light, weight = table.light_of(self.data), table.slope_at(self.data) ** 2
        of_light = self._kept_shapes[: self.freedom] @ (weight * light)
        return light, weight, self._products(weight), of_light

    def _light(self, shapes: FloatArray, lit: FloatArray, levels: FloatArray) -> FloatArray:
        return np.asarray(levels[: self.freedom] @ shapes + lit * (levels[self.freedom :] @ shapes))

    def _products(self, weight: FloatArray) -> FloatArray:
        """Give the weighted sums over the kept columns of the products of any two shapes.

        Of Chebyshev polynomials the product is half the sum of two others,
        T_i T_j = (T_(i+j) + T_|i-j|) / 2: all products follow from one sum for each polynomial.
        """
        sums = self._kept_shapes @ weight
        return np.asarray(0.5 * (sums[self._up] + sums[self._down]))

    def _block(self, dark: FloatArray, weight: FloatArray, lit: FloatArray) -> FloatArray:
        """Give the matrix of the normal equations of both levels."""
        count = self.freedom
        products = np.empty((2 * count, 2 * count))
        products[:count, :count] = dark
        products[:count, count:] = products[count:, :count] = self._products(weight)
        products[count:, count:] = self._products(weight * lit)
        return products

    def _with_clipped(
        self, seen: Seen, products: FloatArray, sums: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give the levels, and by how many grey levels they leave clipped columns below white."""
        table, lit = seen.table, seen.lit[self.clipped]
        beyond = np.hstack([self._clipped_shapes, self._clipped_shapes * lit[:, None]])
        levels = _solved(products, sums)
        white, slope = float(table.light_of(np.array([WHITE]))[0]), WHITE * float(table.slope[-1])
        for _ in range(2):
            dark = beyond[beyond @ levels < white]
            if not len(dark):
                break
            levels = _solved(
                products + slope**2 * dark.T @ dark, sums + slope**2 * white * dark.sum(0)
            )
        return levels, np.maximum(white - beyond @ levels, 0.0) * slope

    def _blurred(self, seen: Seen, sharp: FloatArray, levels: FloatArray) -> FloatArray:
        """Give the residual of the kept columns where pixel values are blurred.

        The levels, found as if light were blurred, are corrected by a Gauss-Newton step; their
        shapes are so smooth that blur does not change them.
        """
        light = self._light(self._shapes, sharp, levels)
        steep = seen.table.slope_of(light)
        dark = _convolved(steep, seen.kernel)[self.kept]
        lit = _convolved(steep * sharp, seen.kernel)[self.kept]
        residual = self._less_blurred(seen, light)
        products = self._block(self._products(dark**2), dark * lit, lit / dark)
        own = self._kept_shapes[: self.freedom]
        sums = np.concatenate([own @ (dark * residual), own @ (lit * residual)])
        levels = levels + _solved(products, sums)
        return self._less_blurred(seen, self._light(self._shapes, sharp, levels))

    def _less_blurred(self, seen: Seen, light: FloatArray) -> FloatArray:
        """Give the kept columns' data less the blurred values of light."""
        return np.asarray(
            self.data - _convolved(seen.table.value_of(light), seen.kernel)[self.kept]
        )


def _convolved(values: FloatArray, kernel: FloatArray) -> FloatArray:
    blurred = cv2.filter2D(values[None], -1, kernel[None], borderType=cv2.BORDER_REPLICATE)
    return np.asarray(blurred[0], dtype=np.float64)


def _solved(products: FloatArray, sums: FloatArray) -> FloatArray:
    regular = products.copy()
    regular.flat[:: len(regular) + 1] += 1e-9 * float(np.trace(products))
    return np.asarray(np.linalg.solve(regular, sums))


def deviation_of(residual: FloatArray, slope: FloatArray, freedom: float) -> FloatArray:
    """Estimate each column's noise: compression and processing change edges more than plateaus."""
    square = residual**2 * (residual.size / max(1.0, residual.size - 2.0 * freedom))
    steep = slope**2
    parts = np.stack([np.ones_like(steep), steep], axis=1)
    variance = np.full(residual.size, max(float(square.mean()), _PRECISE**2))
    for _ in range(3):
        weighted = parts / variance[:, None]
        level, rate = np.linalg.lstsq(weighted, square / variance, rcond=None)[0].tolist()
        level = max(level, 0.05 * float(square.mean()), _PRECISE**2)
        variance = level + max(rate, 0.0) * steep
    return np.asarray(np.sqrt(variance))
