"""How much noise there is to see: what the bounds of the noise effects share."""

from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import pixel_value
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.sight import off_axis_factor, reachable_luminances, sight_of
from occ_model.scene import Scene
from occ_model.simulation_settings import Observable


def noise_bound(effect: NoiseEffect, scene: Scene, observable: Observable) -> float:
    """Give the root mean square of noise in what is observed, in grey levels.

    Noise depends on the light, and so on the other effects. Where they leave the columns as they
    are, it is averaged over the columns there are; where they do not, the largest is taken.
    """
    sight = sight_of(scene)
    if moves_light(scene) or sight.sides is None:
        mean_square = float(effect.spread(scene, _all_levels(scene)).max()) ** 2
    else:
        squares = effect.spread(scene, sight.levels) ** 2
        mean_square = float(np.maximum(squares[1:], squares[:-1]) @ sight.shares)
    if observable == "profile":
        mean_square /= sight.region.rows
    return float(np.sqrt(mean_square))


def steepness(effects: tuple[NoiseEffect, ...], scene: Scene) -> float:
    """Give by how many grey levels the noise changes where the mean changes by one, at most.

    An effect that changes the light changes its noise too.
    """
    levels = _all_levels(scene)
    spread = np.sqrt(sum(effect.spread(scene, levels) ** 2 for effect in effects))
    return float(np.abs(np.diff(spread) / np.diff(levels)).max())


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


@lru_cache(maxsize=16)
def _all_levels(scene: Scene) -> FloatArray:
    """Give the levels from the darkest pixel that any effects can make to the brightest one."""
    dark, bright = reachable_luminances(scene)
    darkest = dark * off_axis_factor(scene) ** scene.lens.vignetting_exponent
    low, high = pixel_value(np.array([darkest, bright]), scene.camera)
    return np.linspace(low, min(float(high), 255.0) + 1e-9, 257)
