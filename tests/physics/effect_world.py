"""A world of scenes wider than the sliders, to test the plan's promise and its estimates."""

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from scene_values import presets_of_codes

import occ_model as occ
from occ_model.results.frame import Decision, Plan
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Observable, Scene
from occ_model.simulation.render import observe

NOTHING: dict[str, ParameterValue] = {
    "edge_time": 0.0,
    "lambertian_order": 1.0,
    "jpeg_quality": 0,
    "vignetting_exponent": 0.0,
    "radial_k1": 0.0,
    "radial_k2": 0.0,
    "tangential_p1": 0.0,
    "tangential_p2": 0.0,
    "point_spread": 0.0,
    "focus_distance": 0.0,
    "flicker_depth": 0.0,
    "gain_variation": 0.0,
}
"""Values of each effect's parameters that switch it off."""

PRESETS = presets_of_codes()
METHODS = ("equalization", "stretch", "none")


def draw_anywhere(random: np.random.Generator) -> Scene:
    """Draw a small picture with a panel somewhere in it, and all other parameters anywhere."""
    changes: dict[str, ParameterValue] = {
        name: declared.at(float(random.random()))
        for name, declared in PARAMETERS.items()
        if isinstance(declared, Quantity)
    }
    distance = float(random.uniform(0.3, 3.0))
    width, height = (random.uniform(0.1, 1.5, size=2) * distance).tolist()
    changes |= {
        "rows": int(random.integers(16, 200)),
        "columns": int(random.integers(60, 400)),
        "code": int(random.integers(1024)),
        "averaging": str(random.choice(["light", "pixel-value"])),
        "enhancement": str(random.choice(METHODS)),
        "jpeg_quality": int(random.integers(1, 101)),
        "adc_bits": int(random.integers(6, 14)),
        "equivalent_focal_length": float(random.uniform(0.02, 0.06)),
        "distance": distance,
        "panel_width": width,
        "panel_height": height,
        "offset_x": float(random.normal() * 0.2 * distance),
        "offset_y": float(random.normal() * 0.2 * distance),
        # At the sliders' ends most pictures fold.
        "radial_k1": float(random.uniform(-0.15, 0.15)),
        "radial_k2": float(random.uniform(-0.15, 0.15)),
    }
    if random.random() < 0.8:  # not black, not all white
        changes["luminance"] = float(10 ** random.uniform(2.5, 5.0))
        changes["illuminance"] = float(10 ** random.uniform(1.0, 4.0))
    for angle in ("yaw", "pitch", "roll"):
        if random.random() < 0.6:
            changes[angle] = 0.0
    weaken(changes, random)
    return Scene().replace(**changes)


def draw_like_preset(random: np.random.Generator) -> Scene:
    """Draw a small picture like a preset's, sometimes near a null, tilted, dark, full or flat."""
    scene = occ.load_preset(str(random.choice(PRESETS)))
    smaller = int(random.integers(6, 13))
    changes: dict[str, ParameterValue] = {
        "rows": scene.camera.rows // smaller,
        "columns": scene.camera.columns // smaller,
        "readout_time": scene.camera.readout_time * smaller * float(random.uniform(0.1, 1.0)),
        "enhancement": str(random.choice(METHODS)),
        "code": int(random.integers(1024)),
        "distance": float(random.uniform(0.4, 2.0)),
        "start_time": float(random.uniform(0.0, 0.01)),
        "iso": float(100.0 * 2.0 ** random.choice([0.0, 0.0, random.uniform(-2.0, 5.0)])),
        "flicker_phase": float(random.uniform(-math.pi, math.pi)),
    }
    chips = float(random.uniform(0.2, 4.0))
    if random.random() < 0.3:  # within 5 % of the band model's end, or of a null of the chips' 0101
        chips = float(random.integers(1, 4) * random.uniform(0.95, 1.05))
        if random.random() < 0.5:
            changes["pattern"] = "01"
    changes["switching_frequency"] = chips / scene.camera.exposure_time
    if random.random() < 0.4:
        for angle in ("yaw", "pitch", "roll"):
            changes[angle] = float(random.normal() * 0.2)
    if random.random() < 0.4:  # large pixels have little noise
        changes["pixel_pitch"] = float(10 ** random.uniform(-5.9, -4.5))
    if random.random() < 0.1:
        height = scene.transmitter.panel_height * scene.camera.rows
        changes["panel_height"] = height * float(random.uniform(0.003, 0.03)) / scene.camera.rows
    return scene.replace(**changes)


def weaken(changes: dict[str, ParameterValue], random: np.random.Generator) -> None:
    """Switch some effects off, and in half of the scenes bring the others near the tolerances."""
    weak = random.random() < 0.5
    for name, nothing in NOTHING.items():
        if random.random() < (0.7 if name == "jpeg_quality" else 0.4):
            changes[name] = nothing
        elif weak and name not in ("jpeg_quality", "focus_distance"):
            fraction = 10.0 ** random.uniform(-3.0, 0.0)
            changes[name] = nothing + (changes[name] - nothing) * fraction  # type: ignore[operator]
    if weak:
        changes["pixel_pitch"] = float(10 ** random.uniform(-6.0, -4.5))


def scene_of(seed: int) -> Scene:
    """Draw random scenes until one has a picture."""
    random = np.random.default_rng([7, seed])
    while True:
        scene = _drawn(random)
        if _has_picture(scene):
            return scene


def large_scene_of(seed: int) -> Scene:
    """Draw a picture of few rows and of many columns, some of which a plan samples."""
    random = np.random.default_rng([11, seed])
    while True:
        scene = _drawn(random)
        columns = int(min(scene.camera.columns * random.uniform(2.5, 8.0), 2400))
        readout = scene.camera.readout_time * scene.camera.columns / columns
        scene = scene.replace(
            columns=columns, rows=int(random.integers(24, 120)), readout_time=readout
        )
        if _has_picture(scene):
            return scene


def _drawn(random: np.random.Generator) -> Scene:
    return draw_anywhere(random) if random.random() < 0.5 else draw_like_preset(random)


def _has_picture(scene: Scene) -> bool:
    try:
        observe(scene, occ.plan(scene, 0.0))
    except occ.ProjectionError:
        return False
    return True


def observe_with(
    scene: Scene, effects: frozenset[str], observable: Observable, seed: int
) -> np.ndarray:
    """Return the observable of a scene with only these effects."""
    force = dict.fromkeys(sorted(effects), True)
    return observe(scene, occ.plan(scene, math.inf, observable, force), seed=seed).astype(float)


def measured_changes(
    scene: Scene, observable: Observable, seed: int, tolerances: Sequence[float] = ()
) -> tuple[list[tuple[Decision, float]], list[float]]:
    """Return what leaving out each effect of a scene changes, and each plan at some tolerances."""
    everything = occ.plan(scene, 0.0, observable)
    effects = present_effects(everything)
    whole = observe_with(scene, effects, observable, seed)

    @cache
    def change(included: frozenset[str]) -> float:
        seen = observe_with(scene, included, observable, seed)
        return rms(whole - seen) * everything.stretch

    of_effects = [(d, change(effects - {d.effect})) for d in everything.decisions if d.included]
    plans = (occ.plan(scene, tolerance, observable) for tolerance in tolerances)
    return of_effects, [change(present_effects(plan)) for plan in plans]


def rms(change: np.ndarray) -> float:
    """Return the root mean square."""
    return math.sqrt(float(np.mean(change**2)))


def present_effects(plan: Plan) -> frozenset[str]:
    """Return the effects that a plan's scene has."""
    return frozenset(d.effect for d in plan.decisions if d.included)
