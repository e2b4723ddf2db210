"""The law of all bounds: leaving an effect out changes no more, whichever others there are."""

import math
from functools import lru_cache

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.registry import EFFECTS, moves_light
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable
from occ_model.simulation.render import observe

BOUNDS = {effect.name: effect for effect in EFFECTS}
MEANS = sorted(set(BOUNDS) - {"sensor-noise", "fixed-pattern", "jpeg"})
"""Effects on the pixels' means: what noise and a file make of them is the plan's to add."""

ALONE: dict[str, dict[str, float]] = {
    "led-edges": {"edge_time": 60e-6},
    "flicker": {"flicker_depth": 0.4, "flicker_phase": math.pi},
    "emission": {"lambertian_order": 3.0, "yaw": 0.4},
    "distortion": {"radial_k1": 0.1},
    "defocus": {"point_spread": 2.0},
    "vignetting": {"vignetting_exponent": 12.0},
    "full-well": {"full_well": 3000.0},
}


@lru_cache(maxsize=2)
def observed(scene: Scene, observable: Observable, without: str = "") -> np.ndarray:
    """What is seen of a scene's means with all effects, or with all but one.

    All are switched on by hand, so that none is missed whose bound is wrongly 0.
    """
    force = {name: name in MEANS and name != without for name in BOUNDS}
    return observe(scene, occ.plan(scene, 0, observable, force)).astype(float)


def exceeds(scene: Scene, name: str, observable: Observable) -> str:
    """Say by how much a change exceeds its bound, nothing where it does not."""
    change = observed(scene, observable) - observed(scene, observable, name)
    found, bound = (
        math.sqrt(np.mean(change**2)),
        BOUNDS[name].bound(paper_view_of(scene), observable),
    )
    # The pixels are of single precision.
    return f"{found:.4g} > {bound:.4g}" if found > bound * (1 + 1e-4) + 1e-3 else ""


@pytest.mark.parametrize("observable", ["image", "profile"])
@pytest.mark.parametrize("illuminance", [3e3, 4e5, 1e6])
@pytest.mark.parametrize("name", MEANS)
def test_bounds_hold_where_vignetting_undoes_saturation(
    name: str, illuminance: float, observable: Observable
) -> None:
    scene = Scene().replace(
        rows=60,
        columns=120,
        equivalent_focal_length=0.013,
        distance=0.25,
        iso=100.0,
        luminance=2.0 * illuminance / math.pi,
        illuminance=illuminance,
        full_well=1e9,
        vignetting_exponent=12.0,
    )
    assert exceeds(scene.replace(**ALONE[name]), name, observable) == ""


@pytest.mark.parametrize("observable", ["image", "profile"])
@pytest.mark.parametrize("averaging", ["light", "pixel-value"])
@pytest.mark.parametrize("luminance", [3e4, 1e5, 1e7])
@pytest.mark.parametrize("name", MEANS)
def test_bounds_hold_where_only_the_fully_lit_panel_saturates(
    name: str, luminance: float, averaging: str, observable: Observable
) -> None:
    scene = Scene().replace(
        rows=60,
        columns=120,
        distance=1.0,
        switching_frequency=16e3,
        iso=500.0,
        luminance=luminance,
        averaging=averaging,
        full_well=1e9,
    )
    assert exceeds(scene.replace(**ALONE[name]), name, observable) == ""


@pytest.mark.parametrize("observable", ["image", "profile"])
@pytest.mark.parametrize("seed", range(4))
def test_bounds_hold_whichever_other_effects_there_are(seed: int, observable: Observable) -> None:
    rng = np.random.default_rng(seed)
    wrong = []
    for number in range(12):
        scene = Scene().replace(
            rows=int(rng.integers(40, 120)),
            columns=int(rng.integers(60, 200)),
            distance=float(rng.choice([0.1, 0.7, 1.5, 3.0])),
            yaw=float(rng.choice([0.0, 0.2])),
            roll=float(rng.choice([0.0, 0.3])),
            iso=float(10 ** rng.uniform(1.5, 4)),
            illuminance=float(10 ** rng.uniform(1, 6)),
            luminance=float(10 ** rng.uniform(2, 6)),
            averaging=str(rng.choice(["light", "pixel-value"])),
            switching_frequency=float(10 ** rng.uniform(3, 5)),
            edge_time=float(rng.choice([0.0, 10e-6, 100e-6])),
            flicker_depth=float(rng.choice([0.0, 0.1, 0.8])),
            lambertian_order=float(rng.choice([1.0, 3.0])),
            radial_k1=float(rng.choice([0.0, -0.05])),
            point_spread=float(rng.choice([0.0, 2.0])),
            vignetting_exponent=float(rng.choice([0.0, 4.0, 12.0])),
            full_well=float(10 ** rng.uniform(2, 6)),
        )
        for name in MEANS:
            excess = exceeds(scene, name, observable)
            if excess:
                wrong.append((number, name, excess))
    assert wrong == []


@pytest.mark.parametrize("observable", ["image", "profile"])
@pytest.mark.parametrize("name", ["sensor-noise", "fixed-pattern"])
@pytest.mark.parametrize(
    "light",
    [
        {"illuminance": 0.0},
        {"illuminance": 290.0},
        {"iso": 6400.0, "luminance": 370.0},
        {"iso": 1600.0},
        {"iso": 100.0, "luminance": 1e5},
    ],
)
def test_noise_left_out_changes_no_more_than_its_bound(
    light: dict[str, float], name: str, observable: Observable
) -> None:
    scene = Scene().replace(rows=400, columns=500, distance=0.1, gain_variation=0.05, **light)
    noisy, clean = (
        observe(scene, occ.plan(scene, math.inf, observable, {name: on})).astype(float)
        for on in (True, False)
    )
    change = math.sqrt(np.mean((noisy - clean) ** 2))
    # What is drawn differs from what is expected by the share that a sample of its size does.
    largest = BOUNDS[name].bound(paper_view_of(scene), observable) * (
        1 + 4 / math.sqrt(2 * noisy.size)
    )
    assert 0.0 < change <= largest


@pytest.mark.parametrize("name", MEANS)
def test_a_scene_has_an_effect_once_its_parameter_is_not_nothing(name: str) -> None:
    bare = Scene().replace(iso=50.0, luminance=1e5, full_well=1e9, gain_variation=0.0)
    present = {effect.name for effect in EFFECTS if effect.is_present(bare)}
    assert present == {"sensor-noise"}  # light comes in photons
    scene = bare.replace(**ALONE[name])
    assert {effect.name for effect in EFFECTS if effect.is_present(scene)} == {*present, name}
    assert moves_light(scene) == (name != "full-well")
