"""Suspected causes in the light: too much of it, too little, or that of other lamps."""

import math
from collections.abc import Iterator

from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    panel_values,
    saturation_value,
)
from occ_model.results.decoding import Remedy
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.study.cause.suspect import Attempt, Suspect

_TARGET = 200.0  # grey level of the lit panel at which a remedy aims
_FULL_FRACTION = 0.8  # fraction of a full pixel's level to aim at if that is below the target
_DIM = 60.0  # grey level of the lit panel below which there may be too little light
_OUTSHONE = 0.5  # dark panel's fraction of the lit one's level, from which contrast may be low


def suspect_overexposure(scene: Scene, *, full_pixels: bool) -> Suspect | None:
    """Suspect columns that are white and, with ``full_pixels``, those whose pixels are full."""
    limit = saturation_value(scene) if full_pixels else WHITE
    if float(panel_values(scene, ColumnLight.of(scene)).max()) <= limit:
        return None
    dark, lit = level_values(scene).tolist()
    end = "white is 255" if limit == WHITE else f"a pixel is full at {limit:.4g}"
    why = f"The lit panel would have the level {lit:.4g}, and {end}: columns above that look alike."
    if dark >= limit:
        why = f"Even the dark panel would have the level {dark:.4g}, and {end}: it has no stripes."
    return Suspect("overexposed", why, _darken, tuple(_remedies(scene, _target_level(scene))), True)


def _target_level(scene: Scene) -> float:
    return min(_TARGET, _FULL_FRACTION * saturation_value(scene))


def _darken(one: Attempt) -> Attempt:
    """Lower the gain until the lit panel is below white, then the light until no pixel is full.

    A lower gain leaves the electrons and their noise unchanged.
    """
    scene, iso = one.scene, quantity("iso")
    gain = _light_factor(scene, _TARGET)
    value = max(scene.camera.iso * gain, iso.low)
    one = one.change(iso=value).scale_light(gain * scene.camera.iso / value)
    level = _target_level(one.scene)
    return one if level == _TARGET else one.scale_light(_light_factor(one.scene, level))


def _light_factor(scene: Scene, level: float) -> float:
    """Return the factor by which light brings the lit panel to a level."""
    lit = float(level_values(scene)[1])
    return float((level / lit) ** scene.camera.gamma)


def _remedies(scene: Scene, level: float) -> Iterator[Remedy]:
    """Yield the ISO speed and the aperture that bring the lit panel to a level within the sliders.

    Only the aperture can keep pixels from being full.
    """
    light = _light_factor(scene, level)
    for name, value in (
        ("iso", scene.camera.iso * light), ("f_number", scene.camera.f_number / math.sqrt(light))
    ):  # fmt: skip
        declared = quantity(name)
        low, high = declared.slider
        within = float(f"{min(max(value, low), high):.3g}")
        label = "ISO" if name == "iso" else "the f-number"
        yield Remedy(f"Set {label} {declared.format(within)}", {name: within})


def suspect_darkness(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not dark < lit < _DIM:
        return None
    return Suspect(
        "too dark",
        f"The lit panel has the level {lit:.2g}, the dark one {dark:.2g}, of 255.",
        lambda one: one.scale_light(_light_factor(one.scene, _TARGET)),
        tuple(_remedies(scene, _TARGET)),
    )


def suspect_other_light(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not scene.surroundings.illuminance or dark < _OUTSHONE * lit:
        return None
    return Suspect(
        "much light from other sources",
        f"The dark panel has {PERCENT.format(dark / lit, 2)} of the lit one's level.",
        lambda one: one.change(illuminance=0.0),
    )
