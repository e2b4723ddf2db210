"""What each column shows, as far as all rows are alike: light, exposure, the pixel's limits.

Where nothing in the plan makes rows differ, this is the whole simulation: the profile path.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import (
    ColumnLight,
    panel_values,
    saturate,
    surroundings_values,
)
from occ_model.effects.effect import LightEffect, PixelEffect
from occ_model.effects.registry import planned
from occ_model.results import Plan
from occ_model.scene.scene import Scene
from occ_model.simulation.stage_timer import StageClock


@dataclass(frozen=True, eq=False, slots=True)
class Columns:
    """What each column shows.

    Parameters
    ----------
    panel, surroundings : ndarray of float64, shape (columns,)
        Pixel values of the panel and beside it, before saturation: what a lens may still darken.
    profile, around : ndarray of float64, shape (columns,)
        The same as far as a pixel can hold it: the column values PV_sim, and those beside them.
    """

    panel: FloatArray
    surroundings: FloatArray
    profile: FloatArray
    around: FloatArray


def expose_columns(scene: Scene, chosen: Plan, clock: StageClock | None = None) -> Columns:
    """Simulate the columns.

    Parameters
    ----------
    scene
        The scene.
    chosen
        Its column effects are simulated.
    clock
        Is told of each stage.
    """
    clock = clock or StageClock()
    light = ColumnLight.of(scene)
    clock.done("exposure")
    for effect in planned(chosen, LightEffect):
        light = effect.apply(scene, light)
        clock.done(effect.name)
    panel = panel_values(scene, light)
    surroundings = np.broadcast_to(surroundings_values(scene, light), panel.shape)
    profile, around = panel, surroundings
    clock.done("exposure")
    for limit in planned(chosen, PixelEffect):
        profile, around = limit.apply(scene, profile), limit.apply(scene, around)
        clock.done(limit.name)
    return Columns(panel, surroundings, saturate(profile), saturate(around))
