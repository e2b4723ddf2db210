"""Laws of what omitting an effect changes, and of the forecast based on it."""

from dataclasses import replace

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.accuracy import EffectDifference, MeasuredCosts, TimeFractions
from occ_model.scene.scene import OBSERVABLES, Observable, Scene, SimulationSettings
from occ_model.study.effect_differences import (
    CROP,
    CompleteSimulation,
    choose_crop,
    forecast,
    plan_of_effects,
    rms,
)


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us-real").replace(
        rows=160, columns=400, panel_width=0.1, panel_height=0.05, distance=0.5
    )


@pytest.fixture(scope="module")
def differences(scene: Scene) -> dict[str, EffectDifference]:
    complete = CompleteSimulation(scene, "image")
    return {name: complete.without(name) for name in complete.effects}


@pytest.mark.parametrize("observable", OBSERVABLES)
def test_a_measured_error_is_within_its_effects_limit(scene: Scene, observable: Observable) -> None:
    complete = CompleteSimulation(scene, observable)
    for decision in occ.plan(scene, 0.0, observable).decisions:
        if decision.estimate:
            assert complete.without(decision.effect).error <= decision.limit, decision.effect


def test_the_change_by_one_effect_is_the_error_of_the_others(
    scene: Scene, differences: dict[str, EffectDifference]
) -> None:
    complete = CompleteSimulation(scene, "image")
    for name, difference in differences.items():
        others = set(complete.effects) - {name}
        assert difference.error == pytest.approx(complete.error_of(others))
        assert rms(difference.change) == pytest.approx(difference.error)
    assert complete.error_of(complete.effects) == 0.0


def test_noise_does_not_add_to_the_change_by_a_small_effect() -> None:
    noisy = occ.load_preset("phone-136us").replace(
        rows=400, columns=600, panel_width=0.2, panel_height=0.1, vignetting_exponent=2.0
    )
    quiet = noisy.replace(full_well=1e6, read_noise=0.0, gain_variation=0.0)
    changes = []
    for scene in (noisy, quiet):
        complete = CompleteSimulation(scene, "image")
        stretch = occ.plan(scene, 0.0).stretch
        changes.append(complete.without("vignetting").error / stretch)
    assert changes[0] == pytest.approx(changes[1], rel=0.1)


def test_crops_stretch_both_pictures_equally_and_state_the_amplification() -> None:
    random = np.random.default_rng(5)
    one = random.uniform(40.0, 60.0, (300, 400)).astype(np.float32)
    other = one.copy()
    checks = np.where(np.indices(CROP).sum(axis=0) % 2, 3.0, -3.0)
    other[100:164, 200:312] -= checks
    crop = choose_crop(one, other)
    assert crop.with_effect.shape == crop.without_effect.shape == crop.difference.shape == CROP
    assert not crop.is_averaged
    np.testing.assert_allclose(crop.difference, 128 + checks * crop.amplification, atol=1)
    both = crop.with_effect.astype(int) - crop.without_effect
    inside = (np.minimum(crop.with_effect, crop.without_effect) > 0) & (
        np.maximum(crop.with_effect, crop.without_effect) < 255
    )
    assert np.ptp(np.abs(both[inside])) <= 1  # both are stretched in the same way


def test_a_slow_change_is_shown_on_the_whole_panel() -> None:
    ramp = np.linspace(0.0, 20.0, 900, dtype=np.float32)[None, :] + np.zeros((700, 1), np.float32)
    crop = choose_crop(100.0 + ramp, np.full_like(ramp, 100.0))
    assert crop.is_averaged
    assert (np.diff(crop.difference[0].astype(int)) >= 0).all()
    assert crop.difference[0, -1] == pytest.approx(128 + 20 * crop.amplification, abs=2)


@pytest.mark.parametrize("tolerance", [0.0, 3.0, np.inf])
def test_the_times_of_a_picture_add_up_to_the_pictures_time(scene: Scene, tolerance: float) -> None:
    frame = occ.render(scene, tolerance=tolerance)
    fractions = TimeFractions.of(frame)
    assert fractions.seconds == pytest.approx(sum(frame.timings.values()), rel=1e-12)
    assert fractions.other_seconds >= 0.0
    parts = (*fractions.effects.values(), fractions.other_seconds)
    assert sum(parts) == pytest.approx(fractions.seconds, rel=1e-12)
    included = set(fractions.effects) | set(fractions.shared_steps)
    assert included == set(frame.plan.included)
    assert set(fractions.shared_steps.values()) <= set(fractions.effects)


def test_a_forecast_of_the_measured_plan_is_its_own_time(scene: Scene) -> None:
    settings = SimulationSettings(3.0)
    measured = TimeFractions.of(occ.render(scene, tolerance=3.0))
    found = forecast(scene, settings, MeasuredCosts(measured))
    assert found.seconds == pytest.approx(measured.seconds, rel=1e-12)


def test_a_forecast_adds_switched_effects_and_gives_none_if_one_is_not_measured(
    scene: Scene, differences: dict[str, EffectDifference]
) -> None:
    complete = TimeFractions.of(occ.render(scene, tolerance=0.0))
    bare = TimeFractions.of(occ.render(scene, tolerance=np.inf))
    off = SimulationSettings(0.0, force={"jpeg": False})
    found = forecast(scene, off, MeasuredCosts(complete, (), differences))
    assert found.error == pytest.approx(differences["jpeg"].error)
    assert not found.is_measured
    assert found.seconds == pytest.approx(complete.seconds - complete.effects["jpeg"], rel=1e-12)
    none = replace(off, tolerance=np.inf, force={})
    unknown = forecast(scene, none, MeasuredCosts(complete))
    assert (unknown.seconds, unknown.error) == (None, None)
    known = forecast(scene, none, MeasuredCosts(complete, (bare,)))
    assert known.seconds == pytest.approx(bare.seconds, rel=1e-12)


def test_a_forecast_uses_an_error_that_was_measured_for_the_same_effects(scene: Scene) -> None:
    fractions = TimeFractions.of(occ.render(scene, tolerance=0.0))
    off = SimulationSettings(0.0, force={"jpeg": False, "flicker": False})
    included = frozenset(occ.plan(scene, 0.0, force=off.force).included)
    found = forecast(scene, off, MeasuredCosts(fractions, errors={included: 1.5}))
    assert (found.error, found.is_measured) == (1.5, True)
    found = forecast(scene, SimulationSettings(0.0), MeasuredCosts(fractions))
    assert (found.error, found.is_measured) == (0.0, True)


def test_independent_changes_add_up(scene: Scene) -> None:
    plain = scene.replace(jpeg_quality=100, gain_variation=0.0, enhancement="none")
    complete = CompleteSimulation(plain, "profile")
    left_out = ("led-edges", "flicker")
    differences = {name: complete.without(name) for name in left_out}
    settings = SimulationSettings(0.0, "profile", dict.fromkeys(left_out, False))
    fractions = TimeFractions.of(occ.render(plain, tolerance=0.0))
    predicted = forecast(plain, settings, MeasuredCosts(fractions, (), differences)).error
    true = complete.error_of(set(complete.effects) - set(left_out))
    assert predicted == pytest.approx(true, rel=0.3)


def test_a_plan_of_effects_includes_these_and_no_other(scene: Scene) -> None:
    assert plan_of_effects(scene, "image", ["jpeg", "vignetting"]).included == (
        "vignetting", "jpeg",
    )  # fmt: skip
