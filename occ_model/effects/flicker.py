"""Mains flicker: the light of other lamps swings at twice the mains' frequency."""

import math
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import cycle_phases
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.effect import Cost, LightEffect
from occ_model.scene.scene import Scene


class Flicker(LightEffect):
    """The external illuminance is E_v (1 + m cos(2 pi F x + phi)) at the time x.

    Its mean over an exposure [x, x + t] is E_v (1 + m sinc(F t) cos(2 pi F (x + t/2) + phi)) with
    sinc(y) = sin(pi y) / (pi y): the exposure is a moving average, and that is its frequency
    response.
    """

    name = "flicker"
    label = "Mains flicker"
    parameters = ("flicker_depth", "flicker_frequency", "flicker_phase")
    cost = Cost(picture=0.12e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether an exposure leaves anything of the flicker."""
        return seen_depth(scene) != 0.0

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Vary the external light from column to column."""
        return replace(light, ambient=light.ambient * ambient_shares(scene))


def seen_depth(scene: Scene) -> float:
    """Return the flicker's depth in the mean light of an exposure."""
    depth = scene.surroundings.flicker_depth
    return depth * abs(response(scene)) if depth else 0.0


@lru_cache(maxsize=4)
def ambient_shares(scene: Scene) -> FloatArray:
    """Return the mean external illuminance in each column's exposure, as a multiple of E_v."""
    surroundings, exposure = scene.surroundings, Fraction(scene.camera.exposure_time)
    cycles = cycle_phases(scene, surroundings.flicker_frequency, exposure / 2)
    swing = np.cos(2.0 * math.pi * cycles + surroundings.flicker_phase)
    found = np.asarray(1.0 + surroundings.flicker_depth * response(scene) * swing)
    found.flags.writeable = False
    return found


def response(scene: Scene) -> float:
    """Return sinc(F t), the fraction of the flicker that an exposure leaves.

    Whole cycles are subtracted before the sine, so that it is exactly 0 for a whole number of them.
    """
    cycles = Fraction(scene.surroundings.flicker_frequency) * Fraction(scene.camera.exposure_time)
    whole = round(cycles)
    sine = math.sin(math.pi * float(cycles - whole))
    return (-sine if whole % 2 else sine) / (math.pi * float(cycles))
