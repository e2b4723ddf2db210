"""No bound is too small and no promise broken, wherever the sliders are.

Bounds are held to what their effects change alone and within the complete simulation, on scenes
from the whole range of every slider, and where a search for the worst of them has led.
"""

import math
from collections.abc import Callable, Set
from functools import cache, lru_cache

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.photometry import luminance_of
from occ_model.effects.effect import FileEffect, NoiseEffect
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.scene.parameter_kinds import Choice, ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import OBSERVABLES, Observable
from occ_model.simulation.render import observe

SCENES = amount(40, 70)
TOLERANCES = (0.1, 0.5, 2.0, 8.0)

CODING = frozenset({"line_code", "framing", "error_correction", "equalizer"})
"""How bits become chips and are read, of which some refuse each other: half of the scenes send any
chips at all."""

NOTHING: dict[str, dict[str, ParameterValue]] = {
    "led-edges": {"edge_time": 0.0},
    "flicker": {"flicker_depth": 0.0},
    "emission": {"lambertian_order": 1.0},
    "distortion": {"radial_k1": 0, "radial_k2": 0, "tangential_p1": 0, "tangential_p2": 0},
    "defocus": {"point_spread": 0.0, "focus_distance": 0.0},
    "vignetting": {"vignetting_exponent": 0.0},
    "fixed-pattern": {"gain_variation": 0.0},
    "jpeg": {"jpeg_quality": 0},
}
"""The effects that a scene can be without, and how; the others are switched off by hand."""

NOISE = frozenset({"sensor-noise", "fixed-pattern"})
FILE = next(effect for effect in EFFECTS if isinstance(effect, FileEffect))

SURE = math.sqrt(2.0 * math.log(1e4 / 1e-3))
"""Standard errors that one of ten thousand comparisons exceeds in one of a thousand runs."""

SINGLE = 8.0 * float(np.spacing(np.float32(255.0)))
"""Rounding of pixels in single precision, grey levels."""


def draw(random: np.random.Generator) -> tuple[Scene, frozenset[str]]:
    """Draw a small picture that shows the panel at any size and place, and its effects."""
    values: dict[str, ParameterValue] = {}
    for name, declared in PARAMETERS.items():
        if isinstance(declared, Quantity):
            values[name] = declared.at(float(random.random()))
        elif isinstance(declared, Choice) and name not in CODING:
            values[name] = str(random.choice(declared.choices))
    bits = int(random.integers(2, 17))
    chips = random.choice(["0", "1"], int(random.integers(1, 25)))
    values |= {
        "bits": bits,
        "code": int(random.integers(2**bits)),
        "pattern": "".join(chips) if random.random() < 0.5 else "",
        "rows": int(random.integers(16, 301)),
        "columns": int(random.integers(60, 501)),
        "jpeg_quality": int(random.integers(1, 101)),
        "adc_bits": int(random.integers(4, 25)),
    }
    if random.random() < 1 / 3:
        values |= {"yaw": 0.0, "pitch": 0.0, "roll": 0.0}
    without = frozenset(name for name in NAMES if random.random() < 1 / 3)
    for name in without:
        values |= NOTHING.get(name, {})
    return framed(Scene().replace(**values), random), frozenset(NAMES) - without


def framed(scene: Scene, random: np.random.Generator) -> Scene:
    """Bring the panel into the picture, from a fifth of it to three times as large."""
    camera, width = scene.camera, scene.transmitter.panel_width
    share = math.exp(random.uniform(math.log(0.2), math.log(3.0)))
    shortest, longest = PARAMETERS["equivalent_focal_length"].slider  # type: ignore[union-attr]
    wanted = share * camera.columns * scene.pose.distance / width / camera.focal_length_pixels
    focal = min(max(wanted * camera.equivalent_focal_length, shortest), longest)
    scene = scene.replace(equivalent_focal_length=focal)
    if random.random() < 0.1:
        return scene  # wherever the sliders have it, in the picture or not
    metre = scene.pose.distance / scene.camera.focal_length_pixels
    reach_x = 0.4 * (camera.columns * metre + width)
    reach_y = 0.4 * (camera.rows * metre + scene.transmitter.panel_height)
    aside = random.uniform(-1.0, 1.0, 2) * (random.random(2) < 0.7)
    offset = np.clip(aside * (reach_x, reach_y), -1.0, 1.0)
    return scene.replace(offset_x=float(offset[0]), offset_y=float(offset[1]))


@cache
def scenes() -> tuple[tuple[Scene, frozenset[str]], ...]:
    """Scenes that have a picture; those that have none are drawn again."""
    random = np.random.default_rng(2026)
    found: list[tuple[Scene, frozenset[str]]] = []
    refused = 0
    while len(found) < SCENES:
        scene, effects = draw(random)
        try:
            picture(scene, effects)
        except occ.ProjectionError:
            refused += 1
        else:
            found.append((scene, effects))
    assert refused < SCENES / 3
    return tuple(found)


@lru_cache(maxsize=4 * SCENES)
def picture(scene: Scene, effects: frozenset[str]) -> Pixels:
    """Simulate just these effects, by hand, so that none is missed whose bound is wrongly 0."""
    by_hand = occ.plan(scene, 0.0, "image", {name: name in effects for name in NAMES})
    return observe(scene, by_hand)


def changed(scene: Scene, name: str, around: Set[str]) -> FloatArray:
    """What an effect changes among others, pixel by pixel."""
    others = frozenset(around) - {name}
    return picture(scene, others | {name}).astype(np.float64) - picture(scene, others)


def size(change: FloatArray, observable: Observable) -> float:
    """Root mean square of a change, in grey levels."""
    seen = change if observable == "image" else change.mean(axis=0)
    return math.sqrt(float(np.mean(seen**2)))


def sampling(scene: Scene, effects: Set[str], pixels: int) -> float:
    """By what noise may exceed its expected root mean square in one picture, in grey levels.

    The root mean square of n pixels changes by at most s / sqrt(n) as their normal numbers change
    by one, s being the largest standard deviation there is. What such a function of normal numbers
    is above its mean is no larger than a normal number of that deviation (B. S. Tsirelson,
    I. A. Ibragimov and V. N. Sudakov, "Norms of Gaussian sample functions", 1976). The same holds
    of the means of columns.
    """
    levels = np.arange(0.0, 255.1, 0.25)
    noise = [e for e in EFFECTS if isinstance(e, NoiseEffect) and e.name in effects]
    squares = sum((effect.spread(scene, levels) ** 2 for effect in noise), np.zeros(1))
    return SURE * math.sqrt(float(squares.max()) / pixels)


def excess(scene: Scene, name: str, around: Set[str], observable: Observable) -> str:
    """Say by how much an effect among others changes more than its bound, if it does."""
    change = changed(scene, name, around)
    file = FILE.name in around | {name}
    plan = occ.plan(scene, 0.0, observable, {} if file else {FILE.name: False})
    bound = next(d.bound for d in plan.decisions if d.effect == name) / plan.stretch
    if name != FILE.name:  # whose bound is no mean over noise
        allowed = sampling(scene, around | {name}, change.size)
        bound += (
            FILE.propagated_change(paper_view_of(scene), allowed, True)
            if file and allowed
            else allowed
        )
    found = size(change, observable)
    return f"{observable}: {found:.4g} > {bound:.4g}" if found > bound + SINGLE else ""


def excesses(name: str, around: Callable[[Set[str]], Set[str]], needed: Set[str]) -> list[str]:
    """Look for excesses in all scenes that have the effects needed."""
    wrong, tried = [], 0
    for number, (scene, effects) in enumerate(scenes()):
        if needed <= effects:
            tried += 1
            found = (excess(scene, name, around(effects), observable) for observable in OBSERVABLES)
            wrong += [f"scene {number}, {text}" for text in found if text]
    assert tried > SCENES / 4
    return wrong


@pytest.mark.parametrize("name", NAMES)
def test_no_effect_alone_exceeds_its_bound_on_the_papers_model(name: str) -> None:
    assert excesses(name, lambda effects: set(), {name}) == []


@pytest.mark.parametrize("name", NAMES)
def test_no_effect_exceeds_its_bound_on_the_full_simulation(name: str) -> None:
    assert excesses(name, lambda effects: effects - {FILE.name}, {name}) == []


@pytest.mark.parametrize("name", [name for name in NAMES if name != FILE.name])
def test_no_effect_exceeds_its_bound_on_a_files_pixels(name: str) -> None:
    assert excesses(name, lambda effects: effects, {name, FILE.name}) == []


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("observable", OBSERVABLES)
def test_what_is_left_out_changes_no_more_than_the_tolerance(
    observable: Observable, tolerance: float
) -> None:
    wrong, tried = [], 0
    for number, (scene, effects) in enumerate(scenes()):
        by_hand = {name: False for name in set(NAMES) - effects if name not in NOTHING}
        plan = occ.plan(scene, tolerance, observable, by_hand)
        left_out = effects - set(plan.included)
        if not left_out:
            continue
        tried += 1
        change = picture(scene, effects).astype(np.float64)
        change -= picture(scene, frozenset(plan.included))
        allowed = sampling(scene, left_out, change.size)
        if FILE.name in plan and allowed:
            allowed = FILE.propagated_change(paper_view_of(scene), allowed, True)
        found = size(change, observable) * plan.stretch
        most = tolerance + (allowed + SINGLE) * plan.stretch
        if found > most:
            wrong.append(f"scene {number} without {sorted(left_out)}: {found:.4g} > {most:.4g}")
    assert wrong == []
    assert tried > SCENES / 10


BESIDE: dict[str, ParameterValue] = {
    "rows": 90,
    "columns": 120,
    "distance": 1.0,
    "panel_width": 0.3,
    "panel_height": 2.0,
    "pattern": "1",
    "full_well": 1e9,
    "gain_variation": 0.0,
}
"""A panel always lit, to be put beside the picture."""


def right_of_the_picture(pixels: float, **changes: float) -> Scene:
    """A panel whose left side is some pixels beyond the picture's last column."""
    scene = Scene().replace(**(BESIDE | changes))
    camera, half = scene.camera, scene.transmitter.panel_width / 2
    left = (camera.columns / 2 + pixels) / camera.focal_length_pixels
    return scene.replace(offset_x=left * scene.pose.distance + half)


@pytest.mark.parametrize("observable", OBSERVABLES)
@pytest.mark.parametrize("luminance", [3600.0, 1e6])
def test_blur_brings_in_light_of_a_panel_beside_the_picture(
    luminance: float, observable: Observable
) -> None:
    scene = right_of_the_picture(0.5, luminance=luminance, point_spread=2.0)
    assert size(changed(scene, "defocus", set()), "image") > 1.0
    assert excess(scene, "defocus", set(), observable) == ""


@pytest.mark.parametrize("observable", OBSERVABLES)
@pytest.mark.parametrize("illuminance", [5.0, 290.0])
def test_a_picture_without_the_panel_has_its_surroundings_noise(
    illuminance: float, observable: Observable
) -> None:
    scene = right_of_the_picture(500.0, illuminance=illuminance, read_noise=10.0)
    assert excess(scene, "sensor-noise", set(), observable) == ""


@pytest.mark.parametrize("observable", OBSERVABLES)
def test_a_lens_that_bends_the_panel_out_of_view_has_an_effect(
    observable: Observable,
) -> None:
    scene = Scene().replace(
        rows=190,
        columns=245,
        equivalent_focal_length=0.01,
        distance=1.0,
        panel_width=0.08,
        panel_height=0.3,
        offset_x=-1.6,
        radial_k1=0.3,
    )
    assert size(changed(scene, "distortion", set()), observable) > 10.0
    assert excess(scene, "distortion", set(), observable) == ""
    assert "distortion" in occ.plan(scene, 0.0, observable)


@pytest.mark.parametrize("name", sorted(NOISE))
def test_two_noises_are_cut_off_at_white_sooner_than_each(name: str) -> None:
    scene = occ.load_preset("phone-136us").replace(
        rows=3000,
        columns=200,
        distance=0.2,
        pattern="1",
        gamma=1.0,
        illuminance=1.0,
        gain_variation=0.035,
        full_well=1e9,
    )
    # Two to three standard deviations below white.
    luminance = float(luminance_of(np.array([240.0]), scene.camera)[0])
    assert excess(scene.replace(luminance=luminance), name, NOISE, "profile") == ""
