"""The columns' pixel values, as far as all rows are alike: light, exposure, the pixel's limits.

Where nothing in the plan makes rows differ, this is the whole simulation: the profile path.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import panel_values, saturate, surroundings_values
from occ_model.effects.effect import LightEffect, PixelEffect
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import planned
from occ_model.results.plan import Plan
from occ_model.simulation.stage_timer import StageTimer


@dataclass(frozen=True, eq=False, slots=True)
class Columns:
    """The pixel values of each column."""

    # Shape (columns,): pixel values of the panel and beside it before saturation, which a lens may
    # still darken
    panel: FloatArray
    surroundings: FloatArray
    # Shape (columns,): the same after saturation: the column values PV_sim, and those beside them
    profile: FloatArray
    around: FloatArray


def expose_columns(view: PaperView, chosen: Plan, timer: StageTimer | None = None) -> Columns:
    timer = timer or StageTimer()
    scene, light, panel = view.scene, view.light, view.values
    for effect in planned(chosen, LightEffect):
        light = effect.apply(scene, light)
        timer.stage_ended(effect.name)
    if light is not view.light:
        panel = panel_values(scene, light)
    surroundings = np.broadcast_to(surroundings_values(scene, light), panel.shape)
    profile, around = panel, surroundings
    timer.stage_ended("exposure")
    for limit in planned(chosen, PixelEffect):
        profile, around = limit.apply(scene, profile), limit.apply(scene, around)
        timer.stage_ended(limit.name)
    return Columns(panel, surroundings, saturate(profile), saturate(around))
