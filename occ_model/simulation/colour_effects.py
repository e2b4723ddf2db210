"""How much each effect of a colour camera changes its picture, without noise and without a lens."""

import math
from collections.abc import Iterator

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.mosaic import demosaic, store_as_jpeg
from occ_model.camera.photometry import FLAT_SPAN, WHITE, saturate
from occ_model.effects.effect import PaperView
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.frame import Decision, Plan, Stage
from occ_model.scene.scene import Scene
from occ_model.scene.units import LEVEL, NONE
from occ_model.simulation.colour_channels import channel_views

_ROWS = 16  # of a sample of the panel, as many as a block of subsampled chroma has
_LEAST = 1e-9  # change of what is done even if it changes nothing
_LEAST_STATED = 1e-6  # levels: less than one grey level of one pixel of a sample


def colour_decisions(
    scene: Scene, plan: Plan, leds: list[PaperView], profiles: list[FloatArray], *, stores: bool
) -> tuple[Decision, ...]:
    """Return a plan's decisions with those on the effects of colour, in the order of the light.

    Each estimate is the RMS change of the channels in levels of the stretched profile, by the
    effect alone. These effects take no longer than their estimates, so all are simulated.
    """
    region = leds[0].region
    part = slice(region.first_column // 2 * 2, region.last_column)
    seen = np.array([profile[part] for profile in profiles])

    def change_by(**changes: float | str) -> float:
        other = channel_views(scene.replace(**changes), leds, plan)
        return _rms(np.array([saturate(view.values)[part] for view in other]) - seen)

    own: list[tuple[str, str, Stage, float]] = [
        ("mixing", "Crosstalk", "optics", change_by(mixing="", crosstalk=0.0)),
        ("white-balance", "White balance", "processing", change_by(red_gain=1.0, blue_gain=1.0)),
        *_changes_by_processing(scene, seen, stores=stores),
    ]
    stretch = WHITE / max(float(np.ptp(seen)), FLAT_SPAN)
    made = [_decide(name, label, stage, size * stretch) for name, label, stage, size in own]
    before = [d for d in plan.decisions if d.effect != Jpeg.name]
    return tuple(
        decision
        for stage in ("light", "optics", "sensor", "processing")
        for decision in (*before, *made)
        if decision.stage == stage
    )


def _changes_by_processing(
    scene: Scene, profiles: FloatArray, *, stores: bool
) -> Iterator[tuple[str, str, Stage, float]]:
    """Yield the RMS change of some rows by demosaicing, and by the file."""
    colours = scene.colours
    if colours.demosaicing == "none":
        return
    picture = demosaic(_tile(profiles, colours.bayer), scene)
    change = picture.astype(np.float64) - to_bytes(profiles).T
    yield "demosaicing", "Demosaicing", "processing", max(_rms(change), _LEAST)
    if stores:
        quality = scene.camera.jpeg_quality
        full = store_as_jpeg(picture, quality, "full").astype(np.float64)
        yield Jpeg.name, Jpeg.label, "processing", max(_rms(full - picture), _LEAST)
        less = store_as_jpeg(picture, quality, colours.chroma)
        yield "chroma", "Chroma of the file", "processing", _rms(less - full)


def _tile(profiles: FloatArray, bayer: str) -> ByteArray:
    """Return the mosaic of some rows that all see the same light."""
    tile = np.empty((_ROWS, profiles.shape[1]), dtype=np.uint8)
    for place, letter in enumerate(bayer):
        own = to_bytes(profiles["rgb".index(letter), place % 2 :: 2])
        tile[place // 2 :: 2, place % 2 :: 2] = own
    return tile


def _rms(change: FloatArray) -> float:
    return math.sqrt(float(np.square(change).mean()))


def _decide(name: str, label: str, stage: Stage, estimate: float) -> Decision:
    size = f"about {NONE.format(estimate, 2)} {LEVEL.symbol}" if estimate else "none in this scene"
    if 0.0 < estimate < _LEAST_STATED:
        size = "no change in this scene"
    why = "takes less time than its estimate" if estimate else size
    reason = f"{size}, {why}: included" if estimate else f"{size}: left out"
    return Decision(
        name, label, "image", stage, estimate, estimate, bool(estimate), False, why, reason
    )
