"""The plan's promise for what a decoder reads: the column means of the enhanced pixels."""

import math
from functools import cache

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.simulation.render import observe

SCENES = amount(45, 75)
TOLERANCES = (0.5, 4.0, 20.0, 80.0)
METHODS = ("equalization", "stretch", "none")


def random_scene(number: int, random: np.random.Generator) -> Scene:
    """A preset's small picture: a third near a null or a frontier, half of them tilted."""
    names = occ.presets()
    scene = occ.load_preset(names[number % len(names)])
    smaller = int(random.integers(6, 13))
    changes: dict[str, ParameterValue] = {
        "rows": scene.camera.rows // smaller,
        "columns": scene.camera.columns // smaller,
        "readout_time": scene.camera.readout_time * smaller * float(random.uniform(0.1, 1.0)),
        "enhancement": METHODS[number // len(names) % 3],
        "code": int(random.integers(1024)),
        "distance": float(random.uniform(0.4, 2.0)),
        "start_time": float(random.uniform(0.0, 0.01)),
    }
    chips = float(random.uniform(0.2, 4.0))
    if number % 3 == 0:  # within 5 % of the band model's end, or of a null of the chips' 0101
        chips = float(random.integers(1, 4) * random.uniform(0.95, 1.05))
        if random.random() < 0.5:
            changes["pattern"] = "01"
    changes["switching_frequency"] = chips / scene.camera.exposure_time
    if random.random() < 0.5:
        for angle in ("yaw", "pitch", "roll"):
            changes[angle] = float(random.normal() * 0.2)
    if random.random() < 0.6:  # large pixels have little noise
        changes["pixel_pitch"] = float(10 ** random.uniform(-5.9, -4.5))
    return scene.replace(**changes)


@cache
def scenes() -> tuple[Scene, ...]:
    random = np.random.default_rng(11)
    return tuple(random_scene(number, random) for number in range(SCENES))


@cache
def complete(number: int) -> tuple[occ.Plan, np.ndarray]:
    """The signal with every effect that the scene has."""
    everything = occ.plan(scenes()[number], 0.0, "signal")
    return everything, observe(scenes()[number], everything, seed=number).astype(np.float64)


def difference(number: int, chosen: occ.Plan) -> float:
    """Root mean square in levels of the stretched signal against the complete simulation."""
    seen = observe(scenes()[number], chosen, seed=number)
    return math.sqrt(float(np.mean((seen - complete(number)[1]) ** 2))) * chosen.stretch


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_signal_changes_by_no_more_than_the_tolerance(tolerance: float) -> None:
    left_out = 0
    for number, scene in enumerate(scenes()):
        chosen = occ.plan(scene, tolerance, "signal")
        everything, whole = complete(number)
        if chosen.included == everything.included:
            continue
        left_out += 1
        # The root mean square of n independent numbers is known to 1 / sqrt(2 n) of itself.
        limit = tolerance * (1.0 + 5.0 / math.sqrt(2.0 * whole.size))
        assert difference(number, chosen) <= limit, (number, chosen)
    # Noise is always called for at the default tolerance; at others something is left out.
    assert left_out >= SCENES * {0.5: 0.0, 4.0: 1 / 15, 20.0: 1 / 5, 80.0: 1 / 3}[tolerance]


@pytest.mark.whole
def test_an_effect_by_itself_keeps_its_bound_in_the_signal() -> None:
    for number, scene in enumerate(scenes()[: SCENES // 2]):
        everything, whole = complete(number)
        for effect in everything.included:
            without = occ.plan(scene, 0.0, "signal", {effect: False})
            (bound,) = (d.bound for d in everything.decisions if d.effect == effect)
            limit = bound * (1.0 + 5.0 / math.sqrt(2.0 * whole.size)) + 1e-4
            assert difference(number, without) <= limit, (number, effect)


def test_all_noise_together_keeps_its_bound_in_the_signal() -> None:
    ratios = []
    for number, scene in enumerate(scenes()):
        everything, whole = complete(number)
        if everything.kinds != {"noise"}:
            continue
        bound = sum({d.bound for d in everything.decisions if d.included})
        change = difference(number, occ.plan(scene, math.inf, "signal"))
        assert change <= bound * (1.0 + 5.0 / math.sqrt(2.0 * whole.size)), number
        ratios.append(bound / max(change, 1e-9))
    assert len(ratios) > SCENES / 4
    assert np.median(ratios) < 4.0  # honest, and not for being large


@pytest.mark.parametrize("method", ["equalization", "stretch"])
def test_another_effect_than_noise_is_never_left_out(method: str) -> None:
    scene = occ.load_preset("phone-136us").replace(enhancement=method, edge_time=1e-12)
    chosen = occ.plan(scene, 100.0, "signal")
    assert "led-edges" in chosen
    assert "sensor-noise" in chosen  # through a curve that the edges may change


def test_the_noise_that_an_equalization_raises_is_taken_in() -> None:
    # Of 14.4 kHz at 136 us the mean of the pixels hides what their equalization shows.
    scene = occ.load_preset("phone-136us").replace(switching_frequency=14.4e3)
    assert "sensor-noise" not in occ.plan(scene, observable="profile")
    assert "sensor-noise" in occ.plan(scene, observable="signal")
    changed = observe(scene, occ.plan(scene, 0.0, "signal"))
    bare = observe(scene, occ.plan(scene, math.inf, "signal"))
    assert float(np.sqrt(np.mean((changed - bare) ** 2))) > 5.0
