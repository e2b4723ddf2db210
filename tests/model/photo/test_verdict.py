"""A match says how sure it is, and why, and refuses what is no lamp's."""

import pickle
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given, strategies as st
from lit_fractions import light_of
from photo_trials import judge_negative
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.fit.chip_runs import runs_of
from occ_model.photo.fit.initial_search import TimingSearch
from occ_model.photo.fit.joint_model import JointModel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.evenly_lit import EvenProfile
from occ_model.results.match import PLAIN_STRIPES


# tests/benchmarks/matching.py tries 400: these two were once said to be explained.
@pytest.mark.parametrize("seed", [pytest.param(41, marks=pytest.mark.whole), 103])
def test_pictures_without_an_led_are_refused(seed: int) -> None:
    assert judge_negative(seed).verdict == "refused"


@pytest.mark.whole
def test_a_regular_pattern_is_a_lamps_only_where_that_is_said() -> None:
    bars = np.tile(np.repeat([30, 210], 20).astype(np.uint8), (80, 20))
    scene = occ.load_preset("phone-136us")
    with pytest.raises(occ.MatchError, match="as those of any regular object are") as refused:
        occ.match_photo(photo_of(bars), scene)
    assert refused.value.reasons[0] == PLAIN_STRIPES
    assert str(refused.value).count(PLAIN_STRIPES) == 1
    assert occ.match_photo(photo_of(bars), scene.replace(pattern="10")).lamp is not None


def test_a_refusal_holds_its_reasons_also_in_another_process() -> None:
    error = occ.MatchError("One reason.", "Another one.")
    assert error.reasons == ("One reason.", "Another one.")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.reasons) == ("One reason. Another one.", error.reasons)


@given(st.lists(st.integers(0, 1), min_size=1, max_size=40))
def test_the_runs_of_a_period_make_up_all_its_chips(chips: list[int]) -> None:
    assert sum(runs_of(np.array(chips, dtype=np.uint8))) == len(chips)


@pytest.mark.parametrize("chips", [24, 1024])
def test_what_a_check_raises_ends_the_search(chips: int) -> None:
    search = TimingSearch(
        np.random.default_rng(1).standard_normal(2000), np.arange(chips, dtype=np.uint8) % 3 % 2
    )
    stop = Mock(side_effect=[None, None, KeyboardInterrupt])
    with pytest.raises(KeyboardInterrupt):
        search.candidates(search.steps(), 2.2, stop)
    assert stop.call_count == 3


def test_what_a_check_raises_ends_the_joint_fit() -> None:
    stop = Mock(side_effect=[None, None, KeyboardInterrupt])
    chips, timing = np.array([1, 0], dtype=np.uint8), Timing(1 / 12, 0.5, 0.0, 2.2)
    columns = 20.0 + 100.0 * light_of(chips, timing, 400)
    even = EvenProfile(columns, np.ones(400, dtype=bool), 100.0)
    model = JointModel([even], chips, timing.step, 2.2, check=stop)
    with pytest.raises(KeyboardInterrupt):
        model.fit(model.start(timing))
    assert stop.call_count == 3
