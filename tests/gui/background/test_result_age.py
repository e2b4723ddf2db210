"""The age of a result is the time since its request was replaced."""

import math

import pytest

from occ_gui.background.result_age import PAUSE, ResultAges


class Clock:
    """A clock that the test sets."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def ages(clock: Clock) -> ResultAges[str]:
    return ResultAges("first", clock)


def test_a_result_ages_from_the_next_change_on(ages: ResultAges[str], clock: Clock) -> None:
    clock.now += 5.0
    assert ages.age("first") == 0.0
    ages.begin("second")
    clock.now += 2.0
    ages.begin("third")
    clock.now += 1.0
    assert [ages.age(r) for r in ("first", "second", "third")] == [3.0, 1.0, 0.0]


def test_a_request_that_returns_is_present_again(ages: ResultAges[str], clock: Clock) -> None:
    ages.begin("second")
    clock.now += 2.0
    ages.begin("first")
    assert ages.age("first") == 0.0
    clock.now += 1.0
    ages.begin("third")
    assert ages.age("first") == 0.0  # it ended just now, not 3 s ago
    clock.now += 0.5
    assert ages.age("first") == 0.5


def test_no_result_and_a_forgotten_one_are_of_any_age(ages: ResultAges[str]) -> None:
    assert ages.age(None) == math.inf
    for number in range(200):
        ages.begin(str(number))
    assert ages.age("first") == math.inf


def test_only_changes_in_quick_succession_are_a_movement(
    ages: ResultAges[str], clock: Clock
) -> None:
    ages.begin("second")
    assert ages.rest() == 0.0
    clock.now += PAUSE / 2
    ages.begin("third")
    assert ages.rest() == pytest.approx(PAUSE)
    clock.now += PAUSE / 2
    assert ages.rest() == pytest.approx(PAUSE / 2)
    clock.now += PAUSE
    assert ages.rest() == 0.0
    ages.begin("fourth")
    assert ages.rest() == 0.0
