"""Bounds of the noise effects: the root mean square of noise in what is observed."""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE, pixel_value
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.paper_view import PaperView, reachable_luminances
from occ_model.scene.simulation_settings import Observable

_FAR = 9.0
"""Standard deviations beyond which nothing of a normal distribution is left."""


class NoiseBounds:
    """The bounds of all noise in a scene; they share the variances of each.

    Noise depends on the light, and so on the other effects. Where they leave the columns as they
    are, it is averaged over the columns there are; where they do not, the largest is taken.

    Parameters
    ----------
    noises
        The noise effects that the scene has.
    view
        The paper's view of the scene.
    moves_light
        Whether another effect may give pixels another light than the paper's model does.
    """

    def __init__(
        self, noises: Sequence[NoiseEffect], view: PaperView, *, moves_light: bool
    ) -> None:
        self._noises = noises
        self._view = view
        is_paper = view.is_seen and view.sides is not None and not moves_light
        self._shares = view.shares if is_paper else None
        self._levels = view.levels if is_paper else _all_levels(view)
        self._variances = _variances(noises, view, self._levels)

    def bounds(self, observable: Observable) -> dict[str, float]:
        """Return the root mean square of each noise in the observable, in grey levels, by name."""
        return {
            effect.name: self._root_mean_square(self._seen(place, observable))
            for place, effect in enumerate(self._noises)
        }

    @property
    def largest_spread(self) -> float:
        """The largest standard deviation of a pixel by all noise together, in grey levels."""
        return math.sqrt(float(np.sum(self._variances, axis=0).max())) if self._noises else 0.0

    def _seen(self, place: int, observable: Observable) -> FloatArray:
        """Return the mean square of one noise in the observable, at each level."""
        own = self._variances[place]
        if observable != "profile":
            return own
        others = np.zeros(len(self._levels))
        for other, variance in enumerate(self._variances):
            if other != place:
                others += variance
        # With the other noise it is cut off sooner at black and white.
        spreads = np.sqrt(np.stack([own, own + others, others]))
        alone, together, without = _mean_shift(self._levels, spreads)
        shift = np.maximum(np.abs(alone), np.abs(together - without))
        return np.asarray(own / self._view.region.rows + shift**2)

    def _root_mean_square(self, squares: FloatArray) -> float:
        if self._shares is None:
            return math.sqrt(float(squares.max()))
        return math.sqrt(float(np.maximum(squares[1:], squares[:-1]) @ self._shares))

    def amplification(self, observable: Observable) -> float:
        """Return the factor by which noise enlarges another effect's change of the observable.

        Another light has another noise. Where one level more makes k levels more of noise, the
        change of a pixel is sqrt(1 + k^2) levels; that of a mean over rows is 1 + k phi(0), for
        what is cut off at black and white, and k over the root of their number.
        """
        levels, variances = self._levels, self._variances
        if self._shares is not None:
            levels = _all_levels(self._view)
            variances = _variances(self._noises, self._view, levels)
        spread = np.sqrt(sum(variances))
        slope = float(np.abs(np.diff(spread) / np.diff(levels)).max())
        if observable == "image":
            return math.hypot(1.0, slope)
        rows = self._view.region.rows
        return math.hypot(1.0 + slope / math.sqrt(2.0 * math.pi), slope / math.sqrt(rows))


def _variances(
    noises: Sequence[NoiseEffect], view: PaperView, levels: FloatArray
) -> list[FloatArray]:
    """Return the variance of each noise at some levels."""
    return [effect.spread(view.scene, levels) ** 2 for effect in noises]


def _all_levels(view: PaperView) -> FloatArray:
    """Return levels from the darkest pixel that any effects can make to the brightest one."""
    scene = view.scene
    dark, bright = reachable_luminances(scene)
    darkest = dark * view.off_axis_factor**scene.lens.vignetting_exponent
    low, high = pixel_value(np.array([darkest, bright]), scene.camera)
    return np.linspace(low, min(float(high), WHITE) + 1e-9, 257)


def _mean_shift(levels: FloatArray, spread: FloatArray) -> FloatArray:
    """Return how far the mean of noisy pixels moves as they are cut off at black and white.

    A normal deviation that is cut off u standard deviations from its mean loses
    phi(u) - u Q(u) of them.
    """
    deviations, lost = _cut_off_loss()
    shift = np.zeros(spread.shape)
    for sign, headroom in ((1.0, levels), (-1.0, WHITE - np.minimum(levels, WHITE))):
        u = np.full(spread.shape, _FAR)
        np.divide(headroom, spread, out=u, where=headroom < _FAR * spread)
        shift += sign * spread * np.interp(u, deviations, lost)
    return shift


@lru_cache(maxsize=1)
def _cut_off_loss() -> tuple[FloatArray, FloatArray]:
    """Tabulate phi(u) - u Q(u) over u, to where nothing is left of a normal distribution."""
    u = np.linspace(0.0, _FAR, 2305)
    beyond = np.array([0.5 * math.erfc(x / math.sqrt(2.0)) for x in u.tolist()])
    lost = np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi) - u * beyond
    lost[-1] = 0.0
    return u, lost
