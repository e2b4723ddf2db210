"""Stated errors hold, and other things are no lamps, in a world that is wider than the model."""

import math

import pytest
from amount import amount
from photo_world.lamp_trials import LampTrial, coverage, lamp_trial
from photo_world.regular_things import verdict_on

SEEDS = range(3000, 3000 + amount(16, 40))
_OTHERS = range(3000, 3000 + amount(12, 30))
_DEVIATIONS = 3.0


@pytest.fixture(scope="module")
def trials() -> list[LampTrial]:
    return [lamp_trial(seed) for seed in SEEDS]


def test_no_sure_period_is_wrong(trials: list[LampTrial]) -> None:
    assert sum(one.verdict == "sure" for one in trials) >= len(trials) // 3
    assert not [one.seed for one in trials if one.is_wrong]


@pytest.mark.whole  # sixteen lamps are too few
@pytest.mark.parametrize("name", ["period", "duty", "exposure"])
def test_stated_errors_hold_and_are_no_larger_than_they_must_be(
    trials: list[LampTrial], name: str
) -> None:
    count, within_one, within_two, *_ = coverage(trials, name)
    assert count >= 5
    for found, right in ((within_one, 0.68), (within_two, 0.95)):
        assert abs(found - right) <= _DEVIATIONS * math.sqrt(right * (1.0 - right) / count)


def test_of_regular_things_none_is_surely_a_lamp() -> None:
    verdicts = [verdict_on(seed) for seed in _OTHERS]
    assert len({kind for kind, _ in verdicts}) >= 8
    assert not [kind for kind, verdict in verdicts if verdict == "sure"]
