"""The plan: what it includes, what it leaves out, and why."""

import math
from itertools import pairwise

import numpy as np
import pytest
from physics.effect_world import scene_of

import occ_model as occ
from occ_model.effects.effect import paper_view_of
from occ_model.effects.plan import effect_sets_of, name_effects_for_signal
from occ_model.scene.scene import Observable, Scene, SimulationSettings
from occ_model.simulation.render import observe

LIGHT_PATH = [
    "led-edges",
    "flicker",
    "emission",
    "distortion",
    "defocus",
    "vignetting",
    "full-well",
    "fixed-pattern",
    "sensor-noise",
    "jpeg",
]


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us-real").replace(jpeg_quality=0, rows=400, columns=300)


def test_decisions_stand_in_the_order_that_light_travels(scene: Scene) -> None:
    assert [decision.effect for decision in occ.plan(scene).decisions] == LIGHT_PATH


@pytest.mark.parametrize("observable", ["image", "profile"])
def test_a_plan_takes_the_fastest_set_within_the_tolerance(
    scene: Scene, observable: Observable
) -> None:
    bare = occ.plan(scene, math.inf, observable)
    everything = bare.saved + bare.effect_sets[0].seconds
    for tolerance in np.geomspace(0.01, 300.0, 12).tolist():
        plan = occ.plan(scene, tolerance, observable)
        assert plan.left_out <= tolerance
        seconds = everything - plan.saved
        # The error of a set is as if changes added; together they may change less or more.
        assert all(
            effect_set.seconds >= seconds - 1e-12
            for effect_set in plan.effect_sets
            if effect_set.error <= tolerance / 2
        )
        assert any(
            effect_set.seconds <= seconds + 1e-12
            for effect_set in plan.effect_sets
            if effect_set.error <= tolerance * 2
        )


def test_effect_sets_run_from_fast_and_inexact_to_slow_and_exact(scene: Scene) -> None:
    effect_sets = occ.plan(scene).effect_sets
    assert len(effect_sets) > 10
    for faster, slower in pairwise(effect_sets):
        assert faster.seconds <= slower.seconds
        assert faster.error > slower.error
    assert effect_sets[-1].error == 0.0
    assert effect_sets[0].effects == frozenset()


def test_a_plan_saves_the_effects_that_take_most_time(scene: Scene) -> None:
    """Noise and a file take most; a plan for pixels needs them, one for the profile does not."""
    filed = scene.replace(jpeg_quality=90, rows=4000, columns=3000)
    of_pixels, of_means = occ.plan(filed, 5.0), occ.plan(filed, 5.0, "profile")
    assert "jpeg" not in of_means
    assert of_means.saved > 2.0 * of_pixels.saved


def test_a_decision_needs_less_than_the_signal() -> None:
    """Where every chip is far from the threshold, no effect can change the code that is read."""
    scene = occ.load_preset("phone-136us-real").replace(switching_frequency=3e3)
    signal, decision = occ.plan(scene, 0.5, "signal"), occ.plan(scene, 0.5, "decision")
    assert set(decision.included) < set(signal.included)
    assert all("margins" in d.reason for d in decision.decisions if d.estimate)


def test_the_margin_of_a_decision_is_about_half_of_the_signals_swing() -> None:
    """A margin must hold two root mean squares of a smooth change."""
    scene = occ.load_preset("phone-136us").replace(switching_frequency=3e3, enhancement="none")
    margin = 2.0 / occ.plan(scene, observable="decision").stretch
    assert 0.4 < margin / np.ptp(occ.column_profile(scene)) < 0.55


@pytest.mark.parametrize("on", [True, False])
def test_the_user_has_the_last_word(scene: Scene, on: bool) -> None:
    plan = occ.plan(scene, 0.5 if on else 0.0, force={"led-edges": on, "jpeg": on})
    for effect in ("led-edges", "jpeg"):
        decision = plan.decisions[LIGHT_PATH.index(effect)]
        assert (decision.included, decision.forced) == (on, True)
        assert decision.reason.endswith(f"switched {'on' if on else 'off'}")


def test_effects_switched_off_do_not_count_against_the_tolerance(scene: Scene) -> None:
    free = occ.plan(scene, 0.5)
    by_hand = occ.plan(scene, 0.5, force={"vignetting": False})
    assert set(by_hand.included) <= set(free.included) - {"vignetting"}


def test_reasons_name_the_estimate_and_the_tolerance(scene: Scene) -> None:
    plan = occ.plan(scene, 3.0)
    for decision in plan.decisions:
        if decision.estimate:
            assert decision.estimate <= decision.limit
            told = f"about {decision.estimate:.2g}"
            if decision.limit > 1.3 * decision.estimate:
                told += f", at most {decision.limit:.2g}"
            assert decision.reason.startswith(f"{told} levels")
            assert "tolerance 3" in decision.reason
            assert decision.reason.endswith("included" if decision.included else "left out")
        else:
            assert decision.reason == "none in this scene: left out"
    lines = str(plan).splitlines()
    assert len(lines) == len(LIGHT_PATH)
    assert lines[0].startswith("LED rise and fall: about ")


def test_the_reason_is_the_comparison_that_decides(scene: Scene) -> None:
    """An effect is above the tolerance, perhaps above it, within it, or saves less than others."""
    seen = set()
    for tolerance in np.geomspace(0.05, 30.0, 12).tolist():
        for decision in occ.plan(scene, tolerance).decisions:
            if not decision.estimate:
                continue
            if not decision.included:
                assert decision.why == "within the tolerance"
            elif decision.estimate > tolerance:
                assert decision.why == "above the tolerance"
            elif decision.limit > tolerance:
                assert decision.why == "not known to be within the tolerance"
            else:
                assert decision.why == "leaving out others saves more time"
                assert decision.why in decision.reason
            seen.add(decision.why)
    assert len(seen) == 4
    for decision in occ.plan(scene, math.inf).decisions:
        why = "no tolerance is set" if decision.estimate else "none in this scene"
        assert decision.why == why
        assert "tolerance" not in decision.reason


def test_effects_that_only_the_signal_needs_are_named() -> None:
    scene = occ.load_preset("phone-136us").replace(
        switching_frequency=14.6e3, illuminance=10_000.0, pixel_pitch=3e-6, full_well=1e5
    )
    of_profile = occ.plan(scene, observable="profile")
    assert "sensor-noise" not in of_profile
    assert "Shot and read noise" in name_effects_for_signal(of_profile, scene)
    assert name_effects_for_signal(occ.plan(scene), scene) == ()
    assert name_effects_for_signal(occ.plan(scene, observable="signal"), scene) == ()
    # Switched off by hand, it is in neither plan; without a tolerance, no effect is.
    off = dict.fromkeys(["sensor-noise", "fixed-pattern"], False)
    assert name_effects_for_signal(occ.plan(scene, observable="profile", force=off), scene) == ()
    assert name_effects_for_signal(occ.plan(scene, math.inf), scene) == ()


@pytest.mark.parametrize("observable", ["image", "profile", "signal", "decision"])
@pytest.mark.parametrize("name", [name for name in occ.presets() if name.endswith("6us-real")])
def test_a_plan_changes_at_the_error_of_each_set_and_nowhere_else(
    name: str, observable: Observable
) -> None:
    scene = occ.load_preset(name)
    effect_sets = effect_sets_of(scene, SimulationSettings(observable=observable))
    assert len(effect_sets) > 15
    for faster, effect_set in pairwise(effect_sets):
        assert effect_set.error < faster.error
        for tolerance in (effect_set.error, faster.error / (1.0 + 1e-8)):
            if tolerance:
                assert set(occ.plan(scene, tolerance, observable).included) == effect_set.effects


def test_the_limit_of_noise_in_the_means_of_columns_is_its_law() -> None:
    """The RMS of n normal numbers deviates by 1 / sqrt(2 n) of it; 3.5 times that is allowed."""
    scene = occ.load_preset("phone-68us").replace(
        rows=200, columns=300, illuminance=10_000.0, pixel_pitch=4e-6, full_well=1e5, adc_bits=14
    )  # so many electrons that the noise moves no column's mean
    everything = occ.plan(scene, 0.0, "profile")
    (noise,) = (d for d in everything.decisions if d.effect == "sensor-noise")
    complete, without = (
        [observe(scene, plan, seed=seed).astype(float) for seed in range(20)]
        for plan in (everything, occ.plan(scene, 0.0, "profile", {"sensor-noise": False}))
    )
    found = [
        math.sqrt(np.mean((a - b) ** 2)) * everything.stretch
        for a, b in zip(complete, without, strict=True)
    ]
    columns = paper_view_of(scene).region.columns
    allowed = (noise.limit / noise.estimate - 1.0) / (3.5 / math.sqrt(2.0 * columns))
    assert 1.0 < allowed < 1.02  # bright columns have a little more noise than dark ones
    assert math.sqrt(np.mean(np.square(found))) == pytest.approx(
        noise.estimate, rel=4.0 / math.sqrt(2.0 * columns * len(found))
    )
    assert max(found) <= noise.limit


def test_no_change_is_stated_for_a_scene_without_stripes() -> None:
    dark = occ.load_preset("phone-136us-real").replace(luminance=0.5, rows=100, columns=200)
    unknown = occ.plan(dark, 0.5)
    assert set(unknown.included) == {d.effect for d in unknown.decisions if d.estimate}
    for decision in unknown.decisions:
        if decision.estimate:
            assert decision.limit == math.inf
            assert decision.reason.startswith("not known, as the stripes span less")
            assert "about" not in decision.reason


def test_a_signal_is_planned_where_only_levels_of_no_pixel_have_little_noise() -> None:
    estimates = [each.estimate for each in occ.plan(scene_of(71151), 0.0, "signal").decisions]
    assert np.isfinite(estimates).all()
