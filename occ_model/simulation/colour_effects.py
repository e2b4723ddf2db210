"""How much each effect of a colour camera changes its picture, without noise and without a lens."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TypeAlias, get_args

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.mosaic import demosaic, store_as_jpeg
from occ_model.camera.photometry import FLAT_SPAN, WHITE, saturate
from occ_model.effects.effect import PaperView
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.frame import Decision, Plan, Stage
from occ_model.scene.colour_scenes import EFFECTS_OFF
from occ_model.scene.scene import Scene
from occ_model.scene.units import LEVEL, NONE
from occ_model.simulation.colour_channels import channel_views

_ROWS = 16  # rows of a sample of the panel: those of a block of subsampled chroma
_LEAST_STATED = 1e-6  # levels: less than one grey level of one pixel of a sample

_Change: TypeAlias = tuple[str, str, Stage, float | None]
"""An effect's name, label and stage, and the RMS change by it; None if the scene has it not."""


def plan_with_colour(
    scene: Scene, plan: Plan, leds: list[PaperView], profiles: list[FloatArray],
    force: Mapping[str, bool],
) -> Plan:  # fmt: skip
    """Return a plan with the decisions on the effects of colour, in the order of the light.

    Each estimate is the RMS change of the channels in levels of the stretched profile, by the
    effect alone. These effects take no longer than their estimates, so all are simulated that are
    not switched off.
    """
    region = leds[0].region
    part = slice(region.first_column // 2 * 2, region.last_column)
    seen = np.array([profile[part] for profile in profiles])

    def change_without(effect: str) -> float:
        other = channel_views(scene.replace(**EFFECTS_OFF[effect]), leds, plan)
        return _rms(np.array([saturate(view.values)[part] for view in other]) - seen)

    colours = scene.colours
    is_balanced = colours.gains == (1.0, 1.0, 1.0)
    changes: list[_Change] = [
        ("mixing", "Crosstalk", "optics", change_without("mixing") if colours.mixes else None),
        ("white-balance", "White balance", "processing",
         None if is_balanced else change_without("white-balance")),
        *_changes_by_processing(scene, seen),
    ]  # fmt: skip
    stretch = WHITE / max(float(np.ptp(seen)), FLAT_SPAN)
    made = [_decide(change, stretch, force.get(change[0])) for change in changes]
    before = [d for d in plan.decisions if d.effect != Jpeg.name]
    decisions = tuple(
        decision
        for stage in get_args(Stage)
        for decision in (*before, *made)
        if decision.stage == stage
    )
    off = (decision.estimate for decision in made if not decision.included)
    return replace(plan, decisions=decisions, error=math.hypot(plan.error, *off))


def _changes_by_processing(scene: Scene, profiles: FloatArray) -> Iterator[_Change]:
    """Yield the change of some rows by demosaicing, and by the file."""
    colours, quality = scene.colours, scene.camera.jpeg_quality
    if colours.demosaicing == "none":  # a raw picture, which no file compresses
        yield Jpeg.name, Jpeg.label, "processing", None
        return
    tile = np.empty((_ROWS, profiles.shape[1]), dtype=np.uint8)
    for channel, own in colours.filters:
        tile[own] = to_bytes(profiles[channel, own[1]])
    picture = demosaic(tile, scene)
    change = picture.astype(np.float64) - to_bytes(profiles).T
    yield "demosaicing", "Demosaicing", "processing", _rms(change)
    if quality:
        full = store_as_jpeg(picture, quality, "full").astype(np.float64)
        yield Jpeg.name, Jpeg.label, "processing", _rms(full - picture)
        less = store_as_jpeg(picture, quality, colours.chroma)
        is_full = colours.chroma == "full"
        yield "chroma", "Chroma of the file", "processing", None if is_full else _rms(less - full)


def _rms(change: FloatArray) -> float:
    return math.sqrt(float(np.square(change).mean()))


def _decide(change: _Change, stretch: float, by_hand: bool | None) -> Decision:
    name, label, stage, rms = change
    estimate = 0.0 if rms is None else rms * stretch
    size = f"about {NONE.format(estimate, 2)} {LEVEL.symbol}"
    if estimate < _LEAST_STATED:
        size = "none in this scene" if rms is None else "no change in this scene"
    included = rms is not None and by_hand is not False
    why = size if rms is None else "takes less time than its estimate"
    reason = f"{size}: left out" if rms is None else f"{size}, {why}: included"
    if by_hand is not None and rms is not None:
        why = f"switched {'on' if included else 'off'}"
        reason = f"{size}: {why}"
    return Decision(
        name, label, "image", stage, estimate, estimate, included, by_hand is not None, why, reason
    )
