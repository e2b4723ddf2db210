"""The noise of a scene's pixels with some of the effects."""

import math
from collections.abc import Collection

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.grey_law import GreyLaw, grey_law
from occ_model.camera.photometry import white_electrons
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell
from occ_model.scene.scene import Scene


def noise_of(scene: Scene, included: Collection[str]) -> PixelNoise | None:
    """Return the noise of pixels with the effects of these names; None if there is none.

    A full well that is left out, although pixels of the scene are full, limits none of them.
    """
    effects = [e for e in effects_named(included, NoiseEffect) if e.is_present(scene)]
    if not effects:
        return None
    well = FullWell()
    is_limited = well.name in included or not well.is_present(scene)
    noise = PixelNoise(
        white=white_electrons(scene),
        gamma=scene.camera.gamma,
        full=scene.sensor.full_well if is_limited else math.inf,
    )
    for effect in effects:
        noise = effect.apply(scene, noise)
    return noise


def law_of(scene: Scene, included: Collection[str], *values: FloatArray) -> GreyLaw | None:
    """Return the law of grey levels, up to the largest of some mean values; None without noise."""
    noise = noise_of(scene, included)
    if noise is None:
        return None
    return grey_law(noise, max(float(each.max()) for each in values))


def enhancement_of(
    scene: Scene, profile: FloatArray, panel: FloatArray, law: GreyLaw | None
) -> Enhancement:
    """Return the enhancement of a picture whose columns have some values.

    ``panel`` are the values before saturation, ``profile`` those after it, which noise changes: an
    equalization by the histogram of the noisy pixels, any other by the means of the columns.
    """
    method = scene.model.enhancement
    if law is None:
        return Enhancement(profile, method)
    counts = law.histogram(panel, np.full(len(panel), float(scene.camera.rows)))
    return Enhancement(law.interpolate(law.means, panel), method, counts)
