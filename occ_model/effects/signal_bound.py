"""Bounds in the signal: the column means of the enhanced pixels, which a decoder reads.

The enhancement's curve has steps, one for each grey level, and an equalization makes steep ones of
levels that many columns share. What changes the mean of pixels by little can change the mean of
enhanced pixels by much, and what leaves the mean of pixels as it is can move that of enhanced ones.

Noise is bounded through the curve, exactly enough, as long as it is all that a scene has. Another
effect changes the curve itself, which follows the picture's own histogram, or the outline within
which it is applied: its change is then not bounded but by the range of the grey levels.
"""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.photometry import FLAT, WHITE, saturate
from occ_model.effects.paper_view import PaperView

_FAR = 9.0
"""Standard deviations beyond which nothing of a normal distribution is left."""


@dataclass(frozen=True, eq=False, slots=True)
class SignalView:
    """The paper's view of a scene through the receiver's enhancement.

    Parameters
    ----------
    view
        The paper's view.
    curve : ndarray of uint8, shape (256,)
        The enhanced level of each grey level.
    levels : ndarray of uint8, shape (columns of the region,)
        The grey level of each observed column.
    swing
        Largest less smallest enhanced column value, at least one grey level.
    """

    view: PaperView
    curve: ByteArray
    levels: ByteArray
    swing: float

    @property
    def is_enhanced(self) -> bool:
        """Whether the receiver does more than to round."""
        return self.view.scene.model.enhancement != "none"

    def noise_bound(self, spread: float) -> float:
        """Bound the change of the signal by noise, where it is all that the scene has.

        A pixel at the level v, with noise of the standard deviation s, passes the step of the curve
        at a distance d above it with the probability Q(d / s), and the mean rises by the sum of
        these steps; likewise below. Both sums grow with s, so that they bound what any part of the
        noise changes. The distance is taken from the nearer rounding limit of the column's level.

        Parameters
        ----------
        spread
            The largest standard deviation of a pixel, in grey levels.

        Returns
        -------
        float
            Root mean square over the columns, in levels of the signal.
        """
        if not spread:
            return 0.0
        weights = np.bincount(self.levels, minlength=256) / len(self.levels)
        rows = self.view.region.rows
        squares = _mean_squares(self.curve, spread, rows)
        if self.view.is_seen and self.view.sides is not None:
            bound = math.sqrt(float(squares @ weights))
        else:  # pixels beside the panel are observed too, and only rounded
            beside = _mean_squares(np.arange(256, dtype=np.uint8), spread, rows)
            bound = math.sqrt(float(max(squares[weights > 0].max(), beside.max())))
        return min(bound, WHITE)


def signal_view(view: PaperView) -> SignalView:
    """Look at a scene through the receiver's enhancement."""
    seen, region = saturate(view.values), view.region
    enhancement = Enhancement(seen, view.scene.model.enhancement)
    enhanced = enhancement(seen)
    swing = max(float(enhanced.max()) - float(enhanced.min()), FLAT)
    levels = to_bytes(seen[region.first_column : region.last_column])
    return SignalView(view, enhancement.curve, levels, swing)


def _mean_squares(curve: ByteArray, spread: float, rows: int) -> FloatArray:
    """Bound the mean square of what noise makes of each grey level's column mean, shape (256,).

    The mean's own shift, and the sampling error of the mean of some rows: that of a difference of
    two noises is at most twice as large as that of either.
    """
    taps = min(math.ceil(_FAR * spread) + 1, 256)
    passing = np.array([0.5 * math.erfc(j / (math.sqrt(2.0) * spread)) for j in range(taps)])
    up, up_square = _beyond(curve.astype(np.float64), passing)
    down, down_square = _beyond(255.0 - curve[::-1].astype(np.float64), passing)
    shift = np.maximum(up, down[::-1])
    return np.asarray(shift**2 + 4.0 * (up_square + down_square[::-1]) / rows)


def _beyond(curve: FloatArray, passing: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the mean of what noise lifts each level by, and of its square.

    Parameters
    ----------
    curve : ndarray of float64, shape (256,)
        A curve that nowhere falls.
    passing : ndarray of float64, shape (taps,)
        Probability to pass the next step above, the one after it, and so on.
    """
    steps = np.append(np.diff(curve), 0.0)  # from each level to the one above it
    sums = np.append(curve[1:] + curve[:-1], 0.0)
    backwards = passing[::-1]
    lift = np.convolve(steps, backwards)[len(passing) - 1 :]
    squares = np.convolve(steps * sums, backwards)[len(passing) - 1 :]
    return lift, np.maximum(squares - 2.0 * curve * lift, 0.0)
