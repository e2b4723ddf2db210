"""Suspects of the light: too much of it, too little, and that of other lamps."""

import math
from collections.abc import Iterator

from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    panel_values,
    saturation_value,
)
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.cause.suspect import Attempt, Step, Suspect

_TARGET = 200.0  # grey level of the lit panel that a suggested step aims at
_FULL_FRACTION = 0.8  # of a full pixel's level, where that is below the target
_DIM = 60.0  # grey level of the lit panel below which there may be too little light
_OUTSHONE = 0.5  # of the lit panel's level, from which the dark one's may leave too little


def overexposure(scene: Scene, *, full_pixels: bool) -> Suspect | None:
    """Suspect columns that are white; with ``full_pixels`` also those whose pixels are full."""
    limit = saturation_value(scene) if full_pixels else WHITE
    if float(panel_values(scene, ColumnLight.of(scene)).max()) <= limit:
        return None
    dark, lit = level_values(scene).tolist()
    end = "white is 255" if limit == WHITE else f"a pixel is full at {limit:.4g}"
    why = f"The lit panel would have the level {lit:.4g}, and {end}: columns above that look alike."
    if dark >= limit:
        why = f"Even the dark panel would have the level {dark:.4g}, and {end}: it has no stripes."
    return Suspect(
        "overexposed", why, _darkened, tuple(_to_level(scene, _level_below(scene))), True
    )


def _level_below(scene: Scene) -> float:
    return min(_TARGET, _FULL_FRACTION * saturation_value(scene))


def _darkened(one: Attempt) -> Attempt:
    """Lower the gain until the lit panel is below white, and then the light until no pixel is full.

    A lower gain keeps the electrons and their noise.
    """
    scene, iso = one.scene, quantity("iso")
    gain = _light_to(scene, _TARGET)
    value = max(scene.camera.iso * gain, iso.low)
    one = one.changed(iso=value).lit_anew(gain * scene.camera.iso / value)
    level = _level_below(one.scene)
    return one if level == _TARGET else one.lit_anew(_light_to(one.scene, level))


def _light_to(scene: Scene, level: float) -> float:
    """Return the factor of the light at which the lit panel has a level."""
    lit = float(level_values(scene)[1])
    return float((level / lit) ** scene.camera.gamma)


def _to_level(scene: Scene, level: float) -> Iterator[Step]:
    """Yield the ISO speed and the aperture that bring the lit panel to a level, as far as sliders.

    The aperture alone keeps pixels from being full.
    """
    light = _light_to(scene, level)
    for name, value in (
        ("iso", scene.camera.iso * light), ("f_number", scene.camera.f_number / math.sqrt(light))
    ):  # fmt: skip
        declared = quantity(name)
        low, high = declared.slider
        within = float(f"{min(max(value, low), high):.3g}")
        label = "ISO" if name == "iso" else "the f-number"
        yield Step(f"Set {label} {declared.format(within)}", {name: within})


def darkness(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not dark < lit < _DIM:
        return None
    return Suspect(
        "too dark",
        f"The lit panel has the level {lit:.2g}, the dark one {dark:.2g}, of 255.",
        lambda one: one.lit_anew(_light_to(one.scene, _TARGET)),
        tuple(_to_level(scene, _TARGET)),
    )


def other_light(scene: Scene) -> Suspect | None:
    dark, lit = level_values(scene).tolist()
    if not scene.surroundings.illuminance or dark < _OUTSHONE * lit:
        return None
    return Suspect(
        "much light from elsewhere",
        f"The dark panel has {100.0 * dark / lit:.2g} % of the lit one's level.",
        lambda one: one.changed(illuminance=0.0),
    )
