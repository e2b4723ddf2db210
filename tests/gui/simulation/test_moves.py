"""The log of moves keeps the last ones of each set of effects, and gives the latest first."""

import pytest

import occ_model as occ
from occ_gui.simulation.moves import MoveLog, MoveTime
from occ_model.results.accuracy import TimeFractions
from occ_model.results.frame import Frame

SIZE = (30, 60)


@pytest.fixture(scope="module")
def frame() -> Frame:
    return occ.render(occ.load_preset("phone-68us").replace(rows=SIZE[0], columns=SIZE[1]))


def time_of(seconds: float, *effects: str, size: tuple[int, int] = SIZE) -> MoveTime:
    fractions = TimeFractions(dict.fromkeys(effects, 0.0), {"image": seconds}, {}, True)
    return MoveTime(size, frozenset(effects), fractions)


def test_a_log_keeps_the_last_nine_moves_with_the_same_effects_and_size(frame: Frame) -> None:
    log, effects = MoveLog(), tuple(TimeFractions.of(frame).included)
    alone = log.costs_of(frame)
    assert alone.picture.times.count == 1, "the picture itself"
    assert alone.draft is None
    for number in range(12):
        log.add(time_of(1.0 + number, *effects))
    log.add(time_of(99.0, *effects, size=(31, 60)))
    times = log.costs_of(frame).picture.times
    assert (times.count, times.least, times.most, times.median) == (9, 4.0, 12.0, 8.0)


def test_of_other_sets_the_latest_comes_first(frame: Frame) -> None:
    log = MoveLog()
    for number, effects in enumerate((["jpeg"], ["jpeg", "flicker"], ["jpeg"])):
        log.add(time_of(1.0 + number, *effects))
    others = log.costs_of(frame).others
    assert [each.included for each in others] == [{"jpeg"}, {"jpeg", "flicker"}]
    assert others[0].times.count == 2


def test_drafts_are_of_the_same_effects_only(frame: Frame) -> None:
    log = MoveLog()
    log.add(MoveTime.of(frame, 0.2))
    log.add(MoveTime(SIZE, frozenset({"jpeg"}), draft_seconds=9.0))
    costs = log.costs_of(frame)
    assert (costs.draft.median, costs.draft.count) == (0.2, 1)
    assert costs.others == ()
