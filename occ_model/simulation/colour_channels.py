"""The light in the three channels of a colour camera, and their column values."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from occ_model.camera.photometry import ColumnLight, panel_values
from occ_model.effects.effect import LightEffect, PaperView, paper_view_of
from occ_model.effects.registry import effects_named
from occ_model.results.frame import Plan
from occ_model.scene.colour_scenes import channel_scene, filter_scene
from occ_model.scene.scene import Scene


def channel_views(scene: Scene, leds: Sequence[PaperView], plan: Plan) -> list[PaperView]:
    """Return what the three channels see, with the planned effects on each LED's light.

    L_c = s_c dark + (bright - dark) sum over k of M_ck lit_k, s_c being the sum of row c of M.
    """
    lights = []
    for led in leds:
        light = led.light
        for effect in effects_named(plan.included, LightEffect):
            light = effect.apply(led.scene, light)
        lights.append(light)
    views = []
    for index, row in enumerate(scene.colours.matrix):
        own = channel_scene(scene, index)
        mixed = sum(
            weight / sum(row) * light.lit for weight, light in zip(row, lights, strict=True)
        )
        light = ColumnLight(np.asarray(mixed), lights[index].ambient)
        values = panel_values(own, light)
        views.append(replace(leds[index], scene=own, light=light, values=values))
    return views


def filter_view(channel: PaperView, place: int) -> PaperView:
    """Return what the pixels at one place of the Bayer pattern see of a channel's light."""
    own = filter_scene(channel.scene, place)
    lit, ambient = channel.light.lit, channel.light.ambient
    every = slice(place % 2, None, 2)
    light = ColumnLight(lit[every], ambient[every] if len(ambient) > 1 else ambient)
    return replace(paper_view_of(own), light=light, values=panel_values(own, light))
