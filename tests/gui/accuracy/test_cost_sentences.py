"""The sentences state what is measured, predicted or not yet known."""

import math

import pytest

import occ_model as occ
from occ_gui.accuracy.accuracy_view import describe_ends, describe_forecast, describe_picture
from occ_model.results.accuracy import Forecast, MeasuredCosts, TimeFractions
from occ_model.results.frame import Frame


@pytest.fixture(scope="module")
def frame() -> Frame:
    scene = occ.load_preset("phone-68us").replace(rows=30, columns=60, edge_time=5e-6)
    return occ.render(scene)


def fractions(milliseconds: float, *effects: str) -> TimeFractions:
    return TimeFractions(dict.fromkeys(effects, 0.001), {"image": 1e-3 * milliseconds}, {}, True)


def test_an_error_is_called_measured_predicted_or_promised(frame: Frame) -> None:
    costs = MeasuredCosts(fractions(4.0))
    plan = frame.plan
    assert describe_picture(costs, 0.004, None) == "This picture: 4.0 ms."
    exact = occ.plan(frame.scene, 0.0)
    for expected, words in (
        (Forecast(exact, 0.004, 0.0, is_measured=True), "exact: nothing is left out"),
        (Forecast(plan, 0.004, 0.0, is_measured=True), "nothing is left out"),
        (Forecast(plan, 0.004, 1.234, is_measured=True), "error 1.2 levels (measured)"),
        (Forecast(plan, 0.004, 1.234, is_measured=False), "error about 1.2 levels (predicted)"),
        (Forecast(plan, 0.004, None, is_measured=False), "error about 0 levels (estimated)"),
    ):
        assert describe_picture(costs, 0.004, expected) == f"This picture: 4.0 ms; {words}."


def test_nothing_is_promised_for_effects_off_by_hand_or_an_infinite_tolerance(frame: Frame) -> None:
    for tolerance, force in ((math.inf, {}), (0.5, {"led-edges": False})):
        plan = occ.plan(frame.scene, tolerance, force=force)
        costs = MeasuredCosts(fractions(4.0))
        sentence = describe_picture(costs, 0.004, Forecast(plan, None, None, is_measured=False))
        assert sentence.endswith("error not measured yet.")


def test_a_forecast_names_the_effects_that_it_switches(frame: Frame) -> None:
    after = occ.plan(frame.scene, force={"led-edges": False, "jpeg": True})
    forecast = Forecast(after, 0.01, 2.0, is_measured=False)
    assert describe_forecast(frame, fractions(4.0), forecast) == (
        "Next: about 10.0 ms, now 4.0; error about 2 levels (predicted). "
        "Switches in: JPEG. Switches out: LED rise and fall."
    )


def test_a_time_measured_again_is_stated_beside_the_first_one() -> None:
    picture = fractions(4.0, "jpeg")
    again = MeasuredCosts(picture, (picture, fractions(1.0)))
    assert describe_picture(again, 0.187, None) == (
        "This picture: 5.0 ms, measured again (187 at first)."
    )
    assert describe_picture(again, 0.005, None) == "This picture: 5.0 ms."


def test_the_ends_of_the_slider_are_stated_once_all_are_measured() -> None:
    picture, bare, complete = (
        fractions(4.0, "jpeg"),
        fractions(1.0),
        fractions(8.0, "jpeg", "flicker"),
    )
    errors = {frozenset[str](): 12.34}
    assert describe_ends(MeasuredCosts(picture), "levels") == ""
    assert describe_ends(MeasuredCosts(picture, (picture, complete, bare)), "levels") == ""
    known = MeasuredCosts(picture, (picture, complete, bare), errors=errors)
    assert describe_ends(known, "levels") == "Fastest: 1.0 ms, error 12 levels. Exact: 10.0 ms."
    exact = MeasuredCosts(complete, (complete, bare), errors=errors)
    assert describe_ends(exact, "levels") == "Fastest: 1.0 ms, error 12 levels."
    fastest = MeasuredCosts(bare, (bare, complete), errors=errors)
    assert describe_ends(fastest, "levels") == "Exact: 10.0 ms."


def test_times_of_different_moments_are_not_compared() -> None:
    others = (fractions(205.0), fractions(220.0, "jpeg"))
    stale = MeasuredCosts(fractions(90.0, "jpeg"), others, errors={frozenset(): 9.7})
    assert describe_ends(stale, "levels") == ""
