"""Jobs of the detection map and the slider strips; nothing here needs Qt."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from occ_gui.detection_map.rate_map import LINES, TheoryFields
from occ_model.effects.plan import plan
from occ_model.effects.registry import EFFECTS
from occ_model.errors import OccError
from occ_model.parallel.job import Heartbeat
from occ_model.results.sweep_request import RateSettings, SweepPoint
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study import theory
from occ_model.study.sweep.sweep import measure_points

IMAGE_EFFECTS = tuple(effect.name for effect in EFFECTS if effect.kind == "image")
"""Effects that make rows differ, which a column profile cannot show."""

SEED = 1  # the seed of :func:`occ_model.sweep`, so that its table agrees with the map

UNSEEN_PARAMETERS: dict[str, ParameterValue] = {
    "start_time": 0.0,
    "flicker_phase": 0.0,
    "band_reading": "aligned",
}
"""Parameters that do not affect rates, which are means over all start times."""

PRELOAD = __name__  # the module that a worker process needs


@dataclass(frozen=True, slots=True)
class StripPoints:
    name: str
    points: tuple[SweepPoint, ...]


def make_rate_settings(
    settings: SimulationSettings, images: int, decoders: tuple[str, ...], with_image_effects: bool
) -> RateSettings:
    """Return the settings with which rates are measured for the window.

    ``with_image_effects``: whether effects that make rows differ are simulated.
    """
    force: Mapping[str, bool] = settings.force
    if not with_image_effects:
        force = {**force, **dict.fromkeys(IMAGE_EFFECTS, False)}
    return RateSettings(images, decoders, SEED, settings.tolerance, force)


def find_omitted_effects(scene: Scene, settings: SimulationSettings) -> tuple[str, ...]:
    """Return the names of the image effects of a scene; none if there is no picture."""
    try:
        decisions = plan(scene, settings.tolerance, "signal", settings.force).decisions
    except OccError:
        return ()
    return tuple(d.label for d in decisions if d.kind == "image" and d.included)


def measure_strip(
    scene: Scene,
    settings: RateSettings,
    name: str,
    points: tuple[tuple[int, dict[str, ParameterValue]], ...],
    heartbeat: Heartbeat,
) -> StripPoints:
    return StripPoints(name, measure_points(scene, settings, points, 0, heartbeat).points)


def compute_theory_fields(
    scene: Scene, x: str, y: str, counts: tuple[int, int], heartbeat: Heartbeat
) -> TheoryFields:
    """Compute on which side of each limit the points of a coarse lattice lie.

    The values are logarithms of ratios. Over logarithmic axes, they are nearly planes, so that
    few points give sufficiently exact lines.
    """
    places = (np.linspace(0.0, 1.0, counts[0]), np.linspace(0.0, 1.0, counts[1]))
    sides = {name: np.full(counts, math.nan) for name in LINES}
    for i, at_x in enumerate(places[0].tolist()):
        heartbeat()
        for j, at_y in enumerate(places[1].tolist()):
            try:
                values = {x: quantity(x).at(at_x), y: quantity(y).at(at_y)}
                point_sides = _find_sides(scene.replace(**values))
            except OccError:
                continue
            for name, side in point_sides.items():
                sides[name][i, j] = side
    return TheoryFields(places, sides)


def _find_sides(scene: Scene) -> dict[str, float]:
    frequency = scene.transmitter.switching_frequency
    packets = theory.two_packets_frequency(scene)
    white = theory.saturation_exposure(scene)
    ratios = {
        "band": frequency / theory.band_model_frequency(scene),
        "null": frequency / theory.null_frequency(scene),
        "packets": math.nan if packets is None else frequency / packets,
        "saturation": scene.camera.exposure_time / white if math.isfinite(white) else math.nan,
    }
    return {name: math.log(ratio) for name, ratio in ratios.items()}
