"""All that the pane of the bars shows of a scene."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.bands import BandAdvice, BandDepth, EyeFlicker
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import band_advice
from occ_model.study.bands.depth import band_depth
from occ_model.study.bands.eye import eye_flicker
from occ_model.study.bands.least_depth import DepthOver

FREQUENCIES = quantity("switching_frequency").slider
EXPOSURES = (1e-5, 0.1)
"""Ends of the map's axes, in Hz and s: exposures up to usual shutter speeds, past the slider."""

_SHAPE = (120, 120)


@dataclass(frozen=True, eq=False, slots=True)
class ShownBands:
    """The bars of a scene, what shows none, and the map of the least depth.

    Parameters
    ----------
    least : ndarray of float64, shape (frequencies, exposures)
        Least depth within the exposures of each cell, at its frequency; both axes logarithmic.
    period
        Chips after which the code repeats.
    """

    scene: Scene
    depth: BandDepth
    advice: BandAdvice
    eye: EyeFlicker
    least: FloatArray
    period: int


def shown_bands(scene: Scene) -> ShownBands:
    """Count the bars of a scene."""
    over = DepthOver.of(scene)
    ends = np.geomspace(*FREQUENCIES, _SHAPE[0] + 1)
    exposures = np.geomspace(*EXPOSURES, _SHAPE[1] + 1)
    middles = np.sqrt(ends[:-1] * ends[1:])
    least = np.stack([over.least(float(each), exposures) for each in middles])
    return ShownBands(
        scene, band_depth(scene), band_advice(scene), eye_flicker(scene), least, over.period
    )
