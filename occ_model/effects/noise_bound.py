"""How much noise there is to see: what the bounds of the noise effects share."""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE, pixel_value
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.paper_view import off_axis_factor, paper_view_of, reachable_luminances
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable

_FAR = 9.0
"""Standard deviations beyond which nothing of a normal distribution is left."""


def noise_bound(
    effect: NoiseEffect,
    scene: Scene,
    observable: Observable,
    others: tuple[NoiseEffect, ...] = (),
) -> float:
    """Give the root mean square of noise in what is observed, in grey levels.

    Noise depends on the light, and so on the other effects. Where they leave the columns as they
    are, it is averaged over the columns there are; where they do not, the largest is taken.

    Parameters
    ----------
    effect
        The noise.
    scene, observable
        As for :meth:`Effect.bound`.
    others
        The other noise there may be, with which it is cut off sooner at black and white.
    """
    paper_view = paper_view_of(scene)
    as_in_the_paper = paper_view.is_seen and paper_view.sides is not None and not moves_light(scene)
    levels = paper_view.levels if as_in_the_paper else _all_levels(scene)
    squares = _variance(effect, scene, as_in_the_paper)
    seen = squares
    if observable == "profile":
        remainder = np.zeros(len(levels))
        for other in others:
            remainder += _variance(other, scene, as_in_the_paper)
        spreads = np.sqrt(np.stack([squares, squares + remainder, remainder]))
        alone, together, without = _cut_off(levels, spreads)
        moved = np.maximum(np.abs(alone), np.abs(together - without))
        seen = squares / paper_view.region.rows + moved**2
    if not as_in_the_paper:
        return math.sqrt(float(seen.max()))
    return math.sqrt(float(np.maximum(seen[1:], seen[:-1]) @ paper_view.shares))


def _cut_off(levels: FloatArray, spread: FloatArray) -> FloatArray:
    """Give how far the mean of noisy pixels moves as they are cut off at black and white.

    A normal deviation that is cut off u standard deviations from its mean loses
    phi(u) - u Q(u) of them.
    """
    deviations, lost = _lost()
    moved = np.zeros(spread.shape)
    for sign, room in ((1.0, levels), (-1.0, WHITE - np.minimum(levels, WHITE))):
        u = np.full(spread.shape, _FAR)
        np.divide(room, spread, out=u, where=room < _FAR * spread)
        moved += sign * spread * np.interp(u, deviations, lost)
    return moved


@lru_cache(maxsize=1)
def _lost() -> tuple[FloatArray, FloatArray]:
    """Tabulate phi(u) - u Q(u) over u, to where nothing is left of a normal distribution."""
    u = np.linspace(0.0, _FAR, 2305)
    beyond = np.array([0.5 * math.erfc(x / math.sqrt(2.0)) for x in u.tolist()])
    lost = np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi) - u * beyond
    lost[-1] = 0.0
    return u, lost


def noise_amplification(
    effects: tuple[NoiseEffect, ...], scene: Scene, observable: Observable
) -> float:
    """Give how much more a change of the light changes what is observed, with noise in it.

    Another light has another noise. Where one level more makes k levels more of noise, the change
    of a pixel is sqrt(1 + k^2) levels; that of a mean over rows is 1 + k phi(0), for what is cut
    off at black and white, and k over the root of their number.
    """
    levels = _all_levels(scene)
    spread = np.sqrt(sum(_variance(effect, scene, False) for effect in effects))
    slope = float(np.abs(np.diff(spread) / np.diff(levels)).max())
    if observable == "image":
        return math.hypot(1.0, slope)
    rows = paper_view_of(scene).region.rows
    return math.hypot(1.0 + slope / math.sqrt(2.0 * math.pi), slope / math.sqrt(rows))


def moves_light(scene: Scene) -> bool:
    """Say whether an effect of the scene can give pixels another light than the paper's model."""
    lens = scene.lens
    return bool(
        scene.transmitter.edge_time
        or scene.transmitter.lambertian_order != 1.0
        or scene.surroundings.flicker_depth
        or lens.vignetting_exponent
        or lens.distorts
        or lens.point_spread
        or lens.focus_distance
    )


@lru_cache(maxsize=32)
def _variance(effect: NoiseEffect, scene: Scene, as_in_the_paper: bool) -> FloatArray:
    """Give the noise's variance at the levels of the columns, or at all that there can be."""
    levels = paper_view_of(scene).levels if as_in_the_paper else _all_levels(scene)
    return np.asarray(effect.spread(scene, levels) ** 2)


@lru_cache(maxsize=16)
def _all_levels(scene: Scene) -> FloatArray:
    """Give the levels from the darkest pixel that any effects can make to the brightest one."""
    dark, bright = reachable_luminances(scene)
    darkest = dark * off_axis_factor(scene) ** scene.lens.vignetting_exponent
    low, high = pixel_value(np.array([darkest, bright]), scene.camera)
    return np.linspace(low, min(float(high), WHITE) + 1e-9, 257)
