"""What a move costs and what is saved is stated from one measurement, with its scatter."""

import math
from dataclasses import replace

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.accuracy import (
    Forecast,
    MeasuredCosts,
    TimeFractions,
    Times,
    format_milliseconds,
)
from occ_model.results.frame import EffectSet, Plan
from occ_model.results.move_cost import (
    state_error,
    state_measurement,
    state_move,
    state_saving,
    state_switches,
)
from occ_model.scene.scene import Scene


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A scene with two effects: its noise, and the slow edges of its LED."""
    return occ.load_preset("phone-68us").replace(
        rows=30, columns=60, edge_time=5e-6, gain_variation=0.0
    )


NOISE, EDGES = "sensor-noise", "led-edges"


def runs(*milliseconds: float, effects: tuple[str, ...] = (NOISE, EDGES)) -> TimeFractions:
    """Return the measured times of pictures with some effects."""
    fractions = [
        TimeFractions(dict.fromkeys(effects, 0.0), {"image": 1e-3 * time}, {}, True)
        for time in milliseconds
    ]
    return TimeFractions.of_runs(fractions)


def forecast_of(plan: Plan, error: float | None, *sets: tuple[float, float, str]) -> Forecast:
    """Return a forecast with plans of some tolerances, milliseconds and effects."""
    effect_sets = tuple(EffectSet(frozenset(names.split()), 0.0, e) for e, _, names in sets)
    return Forecast(plan, None, error, True, effect_sets, tuple(1e-3 * time for _, time, _ in sets))


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_the_fractions_of_the_median_run_add_up_to_the_stated_time(count: int) -> None:
    random = np.random.default_rng(count)
    fractions = [
        TimeFractions({"a": a}, {"b": b}, {}, True) for a, b in random.uniform(0.1, 1, (count, 2))
    ]
    median = TimeFractions.of_runs(fractions)
    assert median.seconds == median.times.median
    totals = sorted(run.seconds for run in fractions)
    times = median.times
    assert times.median == totals[(count - 1) // 2]
    assert (times.least, times.most, times.count) == (totals[0], totals[-1], count)
    assert sum(times.middle[0] <= total <= times.middle[1] for total in totals) >= count / 2


def test_a_time_is_shorter_only_beyond_the_scatter_of_both() -> None:
    assert Times.of((1, 2, 3)).is_below(Times.of((3.5, 4, 5)))
    assert Times.of((1, 2, 3)).is_below(Times.of((2.5, 4, 5)))  # ranges may overlap
    assert not Times.of((1, 2, 9)).is_below(Times.of((2.5, 4, 5)))  # 9 was as slow
    busy = (1, 1.1, 2, 2.1, 9)  # a busy machine made one run slow
    assert Times.of(busy).is_below(Times.of((3.5, 4, 4.1, 4.2, 9)))
    assert not Times.of((1, 1.1, 2, 8, 9)).is_below(Times.of((3.5, 4, 4.1, 4.2, 9)))
    assert not Times.of((1, 2, 3)).is_below(Times.of((1.5, 4, 5)))
    same = Times.of((2.0,))
    assert not same.is_below(same)


def test_a_time_has_the_digits_that_its_scatter_leaves() -> None:
    assert str(Times.of((0.3204,))) == "320 ms"
    assert str(Times.of((0.3204, 0.2912, 0.4133))) == "320 ms (290 to 410)"
    assert str(Times.of((0.06131, 0.0521, 0.0880))) == "61 ms (52 to 88)"
    assert str(Times.of((0.0023, 0.00231, 0.00235))) == "2.3 ms (2.3 to 2.4)"
    assert format_milliseconds(0.000123) == "0.12"
    assert format_milliseconds(0.0) == "0.0"


def test_a_move_is_stated_by_kind_and_with_its_scatter() -> None:
    costs = MeasuredCosts(runs(300, 320, 410), draft=Times.of((0.05, 0.06, 0.09)))
    assert state_move(costs, None) == (
        "A slider's next move: a draft in 60 ms (50 to 90), then the picture in 320 ms "
        "(300 to 410)."
    )
    assert state_measurement(costs).startswith("Median and range of the last 3 pictures and 3 ")
    assert "A draft has only some rows" in state_measurement(costs)
    first = MeasuredCosts(runs(320))
    assert state_move(first, None) == "A slider's next move: the picture in 320 ms."
    assert "the last picture" in state_measurement(first)


def test_a_move_with_other_settings_is_predicted_or_not_yet_known(scene: Scene) -> None:
    costs = MeasuredCosts(runs(320))
    forecast = forecast_of(occ.plan(scene, math.inf), None)
    assert "not measured yet" in state_move(costs, forecast)
    known = replace(forecast, seconds=0.0023)
    assert state_move(costs, known) == (
        "A slider's next move: the picture in about 2.3 ms, now 320 ms."
    )


def test_an_error_is_called_measured_predicted_or_estimated(scene: Scene) -> None:
    plan = occ.plan(scene, 0.5)
    for expected, words in (
        (forecast_of(occ.plan(scene, 0.0), 0.0), "exact: nothing is left out"),
        (forecast_of(plan, 0.0), "nothing is left out"),
        (forecast_of(plan, 1.234), "error 1.2 levels (measured)"),
        (Forecast(plan, None, 1.234, False), "error about 1.2 levels (predicted)"),
        (forecast_of(plan, None), "error about 0 levels (estimated)"),
        (forecast_of(occ.plan(scene, math.inf), None), "error not measured yet"),
        (forecast_of(occ.plan(scene, force={EDGES: False}), None), "error not measured yet"),
    ):
        assert state_error(expected) == words


def test_what_is_saved_is_stated_beside_the_time_of_all_effects(scene: Scene) -> None:
    plan = occ.plan(scene, math.inf)
    bare = runs(30, 31, 32, effects=())
    costs = MeasuredCosts(bare, (runs(300, 320, 330),))
    assert state_saving(costs, forecast_of(plan, 11.4)) == (
        "Without effects: 31.0 ms in place of 320 ms; left out: LED rise and fall, Shot and read "
        "noise; error 11 levels (measured)."
    )


def test_no_saving_within_the_scatter_is_claimed(scene: Scene) -> None:
    plan = occ.plan(scene, 0.5, force={EDGES: False})
    costs = MeasuredCosts(runs(310, 318, 340, effects=(NOISE,)), (runs(300, 320, 330),))
    sentence = state_saving(costs, forecast_of(plan, 3.0))
    assert sentence.startswith(
        "As switched the saving is within the scatter: 318 ms, and 320 ms with all effects;"
    )
    assert "left out: LED rise and fall" in sentence


def test_the_report_states_that_no_tolerance_below_the_noise_saves_time(scene: Scene) -> None:
    plan = occ.plan(scene, 0.0)
    (noise,) = [d.estimate for d in plan.decisions if d.effect == NOISE]
    costs = MeasuredCosts(runs(300, 320, 330))
    bare, no_edges = (2 * noise, 30.0, ""), (noise / 2, 315.0, NOISE)
    exact = (0.0, 320.0, f"{NOISE} {EDGES}")
    floor = "A tolerance below the noise "
    sentence = state_saving(costs, forecast_of(plan, 0.0, bare, no_edges, exact))
    assert floor in sentence
    assert "on, the picture takes about 30.0 ms, without: LED rise and fall, Shot" in sentence
    faster = (noise / 2, 200.0, NOISE)
    sentence = state_saving(costs, forecast_of(plan, 0.0, bare, faster, exact))
    assert floor not in sentence
    assert "on, the picture takes about 200 ms, without: LED rise and fall." in sentence


def test_a_forecast_names_the_effects_that_it_switches(scene: Scene) -> None:
    before = occ.plan(scene, 0.0)
    after = occ.plan(scene, 0.0, force={EDGES: False, "jpeg": True})
    assert state_switches(before, after) == ("Switches in: JPEG. Switches out: LED rise and fall.")
    assert state_switches(before, before) == ""
