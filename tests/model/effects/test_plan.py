"""The plan: what it includes, what it leaves out, and its reasons."""

import math
from itertools import pairwise

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.plan import called_for_by_signal
from occ_model.scene.scene import Scene

LIGHTS_WAY = [
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


def included(plan: occ.Plan) -> set[str]:
    return set(plan.included)


def test_decisions_stand_in_the_order_that_light_travels(scene: Scene) -> None:
    assert [decision.effect for decision in occ.plan(scene).decisions] == LIGHTS_WAY


def test_zero_takes_in_all_that_is_there_and_infinity_nothing(scene: Scene) -> None:
    everything = occ.plan(scene, 0.0)
    assert included(everything) == {d.effect for d in everything.decisions if d.bound}
    assert everything.left_out == 0.0
    assert occ.plan(scene, math.inf).included == ()


@pytest.mark.parametrize("observable", ["profile", "image"])
def test_what_is_left_out_fills_the_tolerance_as_far_as_it_can(
    scene: Scene, observable: str
) -> None:
    for tolerance in np.geomspace(0.01, 300.0, 40).tolist():
        plan = occ.plan(scene, tolerance, observable)  # type: ignore[arg-type]
        left_out = [d.bound for d in plan.decisions if not d.included]
        taken_in = [d.bound for d in plan.decisions if d.included]
        assert plan.left_out == pytest.approx(sum(left_out))
        assert plan.left_out <= tolerance
        assert max(left_out) <= min(taken_in, default=math.inf)
        assert plan.left_out + min(taken_in, default=math.inf) > tolerance


def test_a_larger_tolerance_never_takes_in_more(scene: Scene) -> None:
    plans = [included(occ.plan(scene, tolerance)) for tolerance in np.geomspace(0.01, 300.0, 40)]
    assert plans == sorted(plans, key=len, reverse=True)
    assert all(later <= earlier for earlier, later in pairwise(plans))
    assert len(plans[0]) > len(plans[-1])


def test_a_file_counts_every_bound_as_it_comes_through(scene: Scene) -> None:
    filed = scene.replace(jpeg_quality=90)
    without, through = occ.plan(scene, 1.0), occ.plan(filed, 1.0)
    assert "jpeg" in through
    for plain, seen in zip(without.decisions, through.decisions, strict=True):
        if plain.bound:
            assert seen.bound > plain.bound
            assert "through JPEG" in seen.reason
    by_hand = occ.plan(filed, 1.0, force={"jpeg": False})
    assert by_hand.decisions[:-1] == without.decisions[:-1]


@pytest.mark.parametrize("on", [True, False])
def test_the_user_has_the_last_word(scene: Scene, on: bool) -> None:
    plan = occ.plan(scene, 0.5 if on else 0.0, force={"led-edges": on, "jpeg": on})
    for effect in ("led-edges", "jpeg"):
        decision = plan.decisions[LIGHTS_WAY.index(effect)]
        assert (decision.included, decision.forced) == (on, True)
        assert decision.reason.endswith(f"switched {'on' if on else 'off'} by hand")


def test_effects_switched_off_do_not_count_against_the_tolerance(scene: Scene) -> None:
    free = occ.plan(scene, 0.5)
    by_hand = occ.plan(scene, 0.5, force={"vignetting": False})
    assert included(by_hand) == included(free) - {"vignetting"}


def test_reasons_name_the_bound_and_the_tolerance(scene: Scene) -> None:
    plan = occ.plan(scene, 3.0)
    for decision in plan.decisions:
        if decision.bound:
            assert decision.reason.startswith(f"at most {decision.bound:.2g} levels")
            assert "tolerance 3" in decision.reason
            assert decision.reason.endswith("taken in" if decision.included else "left out")
        else:
            assert decision.reason == "none in this scene: left out"
    lines = str(plan).splitlines()
    assert len(lines) == len(LIGHTS_WAY)
    assert lines[0].startswith("LED rise and fall: at most ")


def test_the_reason_is_the_comparison_that_decides(scene: Scene) -> None:
    """Above the tolerance by itself, with what is left out before it, or within it."""
    bounds = sorted(d.bound for d in occ.plan(scene, 0.0).decisions if d.bound)
    small, next_one = bounds[:2]
    seen = set()
    # A bound that is the tolerance itself is not above it, but its sum with a smaller one is.
    for tolerance in (small, next_one, 0.5 * (bounds[-2] + bounds[-1]), bounds[-1], sum(bounds)):
        for decision in occ.plan(scene, tolerance).decisions:
            if not decision.bound:
                continue
            if not decision.included:
                expected, ending = "within the tolerance", f", tolerance {tolerance:g}: left out"
            elif decision.bound > tolerance:
                expected, ending = "above the tolerance", f", tolerance {tolerance:g}: taken in"
            else:
                expected = "exceeded together with what is left out"
                ending = f", tolerance {tolerance:g}, {expected}: taken in"
            assert (decision.bound, decision.why) == (decision.bound, expected)
            assert decision.reason.endswith(ending)
            seen.add(expected)
    assert len(seen) == 3
    for decision in occ.plan(scene, math.inf).decisions:
        why = "no tolerance is set" if decision.bound else "none in this scene"
        assert decision.why == why
        assert "tolerance" not in decision.reason


def test_a_plan_is_a_value(scene: Scene) -> None:
    assert occ.plan(scene) == occ.plan(scene)
    assert hash(occ.plan(scene)) == hash(occ.plan(scene))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"tolerance": -1}, "tolerance is -1 levels; allowed: "),
        ({"tolerance": math.nan}, "tolerance is nan"),
        ({"tolerance": None}, "tolerance is None, which is not a number"),
        ({"observable": "pixels"}, "observable is 'pixels'; allowed: signal, profile, image"),
        ({"observable": None}, "observable is None"),
        ({"force": {"blur": True}}, "effect is 'blur'; allowed: led-edges, flicker, "),
        ({"force": {3: True}}, "effect is 3; allowed: "),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(
    scene: Scene, arguments: dict[str, object], words: str
) -> None:
    with pytest.raises(occ.ParameterError, match=words):
        occ.plan(scene, **arguments)  # type: ignore[arg-type]


def test_what_only_the_signal_calls_for_is_named() -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=14.6e3)
    of_profile = occ.plan(scene, observable="profile")
    assert "sensor-noise" not in of_profile
    assert "Shot and read noise" in called_for_by_signal(of_profile, scene)
    assert called_for_by_signal(occ.plan(scene), scene) == ()
    assert called_for_by_signal(occ.plan(scene, observable="signal"), scene) == ()
    # By hand it is left out of both, and without a tolerance of everything.
    off = dict.fromkeys(["sensor-noise", "fixed-pattern"], False)
    assert called_for_by_signal(occ.plan(scene, observable="profile", force=off), scene) == ()
    assert called_for_by_signal(occ.plan(scene, math.inf), scene) == ()


def test_before_a_file_only_noise_of_half_a_grey_level_is_kept_whatever_the_tolerance() -> None:
    """It spreads pixels over the steps of rounding; less of it is left out as all else is."""
    kept = []
    for variation in (1e-3, 5e-3, 0.02, 0.04):
        plain = occ.load_preset("phone-136us").replace(gain_variation=variation)
        plain = plain.replace(rows=200, columns=200)
        (own,) = (
            d for d in occ.plan(plain, 20.0, "image").decisions if d.effect == "fixed-pattern"
        )
        levels = own.bound / occ.plan(plain, 20.0, "image").stretch
        filed = occ.plan(plain.replace(jpeg_quality=90), 20.0, "image")
        (through,) = (d for d in filed.decisions if d.effect == "fixed-pattern")
        assert "jpeg" in filed
        assert through.included == (levels >= 0.5 or through.bound > 20.0)
        kept.append(through.included and through.bound <= 20.0)
    assert set(kept) == {True, False}
