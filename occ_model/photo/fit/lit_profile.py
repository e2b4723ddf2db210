"""The model of one profile of pixels that are lit alike: its levels, and the residual they leave.

For given lit fractions and a given tone curve the levels are found by linear least squares, so that
a search need not know them (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10:413,
1973).
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.fit.tone_curve import ToneTable
from occ_model.photo.stripes.evenly_lit import EvenProfile

_PRECISE = 0.02
"""Smallest standard deviation of a column mean, in grey levels."""


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """What the columns see: lit fractions, blurred, or sharp and blurred as pixel values."""

    lit: FloatArray
    table: ToneTable
    sharp: FloatArray | None
    kernel: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class LitProfile:
    """A profile's columns that are not clipped, and those that are, with the levels' shapes."""

    kept: NDArray[np.int64]
    data: FloatArray
    slope: FloatArray
    shapes: FloatArray
    clipped: NDArray[np.int64]

    @classmethod
    def of(cls, profile: EvenProfile, shapes: FloatArray) -> "LitProfile":
        """Take the columns that tell something from a profile; the shapes are its levels'."""
        kept, clipped = np.flatnonzero(profile.kept), np.flatnonzero(profile.clipped)
        slope = np.abs(np.gradient(profile.values))
        slope = cv2.dilate(slope[None], np.ones((1, 3), np.uint8))[0]
        return cls(kept, profile.values[kept], slope[kept], shapes, clipped)

    def residual(self, seen: Seen) -> FloatArray:
        """Give data less model in grey levels: of the kept columns, then of the clipped ones."""
        table, lit = seen.table, seen.lit
        light, weight = table.light_of(self.data), table.slope_at(self.data)
        shapes = self.shapes[self.kept]
        parts = np.hstack([shapes, shapes * lit[self.kept, None]])
        weighted = parts * weight[:, None]
        products = weighted.T @ weighted
        sums = weighted.T @ (weight * light)
        levels = _solved(products, sums)
        if self.clipped.size:
            return self._with_clipped(seen, parts, products, sums, levels)
        if seen.sharp is None:
            return self.data - table.value_of(parts @ levels)
        return self._blurred(seen, levels)

    def _with_clipped(
        self,
        seen: Seen,
        parts: FloatArray,
        products: FloatArray,
        sums: FloatArray,
        levels: FloatArray,
    ) -> FloatArray:
        table, lit = seen.table, seen.lit
        beyond = self.shapes[self.clipped]
        beyond = np.hstack([beyond, beyond * lit[self.clipped, None]])
        white, slope = float(table.light_of(np.array([WHITE]))[0]), WHITE * float(table.slope[-1])
        for _ in range(2):
            dark = beyond[beyond @ levels < white]
            if not len(dark):
                break
            levels = _solved(
                products + slope**2 * dark.T @ dark, sums + slope**2 * white * dark.sum(0)
            )
        short = np.maximum(white - beyond @ levels, 0.0) * slope
        if seen.sharp is None:
            return np.concatenate([self.data - table.value_of(parts @ levels), short])
        return np.concatenate([self._blurred(seen, levels), short])

    def _blurred(self, seen: Seen, levels: FloatArray) -> FloatArray:
        """Give the residual of the kept columns where pixel values are blurred.

        The levels, found as if light were blurred, are corrected by a Gauss-Newton step.
        """
        assert seen.sharp is not None  # noqa: S101 - the caller has looked
        table = seen.table
        parts = np.hstack([self.shapes, self.shapes * seen.sharp[:, None]])
        light = parts @ levels
        slopes = _convolved(parts * table.slope_of(light)[:, None], seen.kernel)[self.kept]
        residual = self._less_blurred(seen, light)
        levels = levels + _solved(slopes.T @ slopes, slopes.T @ residual)
        return self._less_blurred(seen, parts @ levels)

    def _less_blurred(self, seen: Seen, light: FloatArray) -> FloatArray:
        """Give the kept columns' data less the blurred values of light."""
        model = _convolved(seen.table.value_of(light)[:, None], seen.kernel)
        return np.asarray(self.data - model[self.kept, 0])


def _convolved(values: FloatArray, kernel: FloatArray) -> FloatArray:
    blurred = cv2.filter2D(values, -1, kernel[:, None], borderType=cv2.BORDER_REPLICATE)
    return np.asarray(blurred, dtype=np.float64).reshape(values.shape)


def _solved(products: FloatArray, sums: FloatArray) -> FloatArray:
    regular = products.copy()
    regular[np.diag_indices_from(regular)] += 1e-9 * float(np.trace(products))
    return np.asarray(np.linalg.solve(regular, sums))


def deviation_of(residual: FloatArray, slope: FloatArray, freedom: int) -> FloatArray:
    """Estimate each column's noise: compression and processing change edges more than plateaus."""
    square = residual**2 * (residual.size / max(1, residual.size - 2 * freedom))
    steep = slope**2
    parts = np.stack([np.ones_like(steep), steep], axis=1)
    variance = np.full(residual.size, float(square.mean()))
    for _ in range(3):
        weighted = parts / variance[:, None]
        level, rate = np.linalg.lstsq(weighted, square / variance, rcond=None)[0].tolist()
        level = max(level, 0.05 * float(square.mean()), _PRECISE**2)
        variance = level + max(rate, 0.0) * steep
    return np.asarray(np.sqrt(variance))
