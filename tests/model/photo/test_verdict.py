"""A match says how sure it is, and why, and refuses what is no lamp's."""

import pickle
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from matches import match_of_lamp
from photo_trials import said_of_negative
from simulated_photos import photo_of, take

import occ_model as occ
from occ_model.light.waveform import Waveform
from occ_model.photo.evidence.doubts import _doubts_by_reading
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.chip_runs import pulse, runs_of
from occ_model.photo.fit.initial_search import Search
from occ_model.photo.fit.joint_model import JointModel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.match import _Case
from occ_model.photo.match_facts import match_facts
from occ_model.photo.stripes.evenly_lit import EvenProfile
from occ_model.results.match import PLAIN_STRIPES


# tests/benchmarks/matching.py tries 400: these two were once said to be explained.
@pytest.mark.parametrize("seed", [pytest.param(41, marks=pytest.mark.whole), 103])
def test_pictures_without_an_led_are_refused(seed: int) -> None:
    assert said_of_negative(seed).verdict == "refused"


@pytest.mark.whole
def test_a_regular_pattern_is_a_lamps_only_where_that_is_said() -> None:
    bars = np.tile(np.repeat([30, 210], 20).astype(np.uint8), (80, 20))
    scene = occ.load_preset("phone-136us")
    with pytest.raises(occ.MatchError, match="as those of any regular object are") as refused:
        occ.match_photo(photo_of(bars), scene)
    assert refused.value.reasons[0] == PLAIN_STRIPES
    assert str(refused.value).count("a lamp is sent") == 1
    read = occ.match_photo(photo_of(bars), scene, sent="read")
    assert (read.pattern, read.verdict) == ("10", "doubtful")
    given_one = occ.match_photo(photo_of(bars), scene.replace(pattern="10"))
    assert (given_one.pattern, given_one.pattern_was_read) == ("10", False)


CYCLES = 1500.0


def dimmed(percent: int, exposed: float, noted: float | None) -> tuple[occ.Photo, occ.Scene]:
    """Photograph a lamp dimmed by the width of its pulses; exposures are told in its periods."""
    chips = "".join(map(str, pulse(percent, 100).tolist()))
    camera = occ.load_preset("phone-68us").replace(
        rows=100, columns=1200, readout_time=10e-6, exposure_time=exposed / CYCLES,
        averaging="light", enhancement="none", panel_width=3.0,
    )  # fmt: skip
    photo = take(camera.replace(pattern=chips, switching_frequency=CYCLES * len(chips)))
    told = camera.replace(pattern="10", switching_frequency=2.0 * CYCLES, readout_time=1e-6)
    return replace(photo, exposure_time=noted and noted / CYCLES), told


def test_a_short_pulse_exposed_for_half_a_period_keeps_its_duty_if_that_is_noted() -> None:
    photo, told = dimmed(13, 0.5, noted=0.5)
    match = occ.match_photo(photo, told)
    assert match.verdict == match.exposure_verdict == "sure"
    assert match.readout_time == pytest.approx(10e-6, rel=1e-3)
    assert abs(match.duty - 0.13) < 2.0 * match.uncertainties["duty"]
    error = match.exposure_time - 0.5 / CYCLES
    assert abs(error) < 3.0 * match.uncertainties["exposure_time"]


def test_a_pulse_and_its_exposure_are_exchangeable_where_none_is_noted() -> None:
    """A lamp of duty 50 %, exposed for 0.13 of its period, has the stripes of this pulse."""
    photo, told = dimmed(13, 0.5, noted=None)
    match = occ.match_photo(photo, told)
    assert (match.verdict, match.exposure_verdict) == ("sure", "doubtful")
    times = np.array([match.exposure_time, *match.other_exposures]) * CYCLES
    assert np.abs(times - 0.5).min() < 0.03
    assert np.abs(times - 0.13).min() < 0.03
    assert "doubtful" in next(str(one) for one in match_facts(match) if one.key == "exposure_time")
    assert "given" not in next(str(one) for one in match_facts(match) if one.key == "duty")


@pytest.mark.parametrize(("error", "expected"), [(0.12, True), (0.11, False), (None, False)])
def test_a_duty_that_was_searched_is_the_scenes_within_two_standard_deviations(
    error: float | None, expected: bool
) -> None:
    told: Any = SimpleNamespace(scene=occ.Scene().replace(pattern="10"))
    nothing: Any = None
    case = _Case(nothing, nothing, told, nothing, (), "auto", nothing)
    uncertainties = {} if error is None else {"duty": error}
    found = match_of_lamp(0.26, uncertainties=uncertainties)
    assert case.may_be_as_sent(found) is expected


def test_chips_that_are_read_in_place_of_a_given_pulse_are_never_sure() -> None:
    scene = occ.load_preset("phone-68us").replace(
        rows=60, columns=240, readout_time=10e-6, pattern="11010", switching_frequency=10e3,
        averaging="light", enhancement="none", panel_width=3.0,
    )  # fmt: skip
    match = occ.match_photo(take(scene), scene.replace(pattern="10"))
    assert len(match.pattern) == 5
    assert any("as is given" in why for why in match.reasons)


def test_bright_runs_that_white_lengthens_may_be_those_of_longer_chips() -> None:
    runs = [(2, 1), (1, 3), (3, 2)]  # bright and dark, in chips of two, each a half too long
    chips = np.concatenate([[1] * (2 * on + 1) + [0] * (2 * off - 1) for on, off in runs])
    found: Any = SimpleNamespace(chips=chips.astype(np.uint8), read_again=False)
    white, dark = (SimpleNamespace(saturated=fraction, period=None) for fraction in (0.5, 0.0))
    (why,) = _doubts_by_reading(found, white)  # type: ignore[arg-type]
    assert "12 chips that last 2 times as long explain the same edges" in why
    assert _doubts_by_reading(found, dark) == []  # type: ignore[arg-type]


@pytest.mark.whole
def test_a_duty_of_half_stays_so_where_its_exposure_is_noted_or_its_duty_is_stated() -> None:
    for noted, sent in ((0.13, "auto"), (None, "scene")):
        match = occ.match_photo(*dimmed(50, 0.13, noted), sent=sent)
        assert (match.duty, match.exposure_verdict) == (0.5, "sure")
        assert match.exposure_time == pytest.approx(0.13 / CYCLES, rel=0.03)


@pytest.mark.parametrize(
    ("found", "other", "is_given", "shared"),
    [
        (("10", False, 1.0), ("1" * 13 + "0" * 12, True, 12.5), False, True),
        (("1" * 13 + "0" * 12, True, 12.5), ("1" * 14 + "0" * 11, True, 12.5), False, True),
        (("10", False, 1.0), ("100", True, 1.0), False, False),
        (("100", True, 1.0), ("110", True, 1.0), False, False),
        (("1101000", False, 1.0), ("1100100", True, 1.0), False, False),
        (("1101000", False, 1.0), ("1100100", True, 1.0), True, True),
    ],
)
def test_another_duty_of_the_same_period_tells_the_same_timing(
    found: tuple[str, bool, float], other: tuple[str, bool, float], is_given: bool, shared: bool
) -> None:
    def hypothesis(chips: str, was_read: bool, rate: float) -> Hypothesis:
        explanation = SimpleNamespace(chips=np.array([int(one) for one in chips], dtype=np.uint8))
        return Hypothesis(chips, explanation, None, 0.0, was_read, rate)  # type: ignore[arg-type]

    assert hypothesis(*found).shares_timing_with(hypothesis(*other), is_given=is_given) == shared


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
    search = Search(
        np.random.default_rng(1).standard_normal(2000), np.arange(chips, dtype=np.uint8) % 3 % 2
    )
    calls: list[int] = []

    def stop() -> None:
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        search.candidates(search.steps(), 2.2, stop)
    assert len(calls) == 3


def test_what_a_check_raises_ends_the_joint_fit() -> None:
    calls: list[int] = []

    def stop() -> None:
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt

    columns = stripes_of_ones_and_zeros(12.0, 400)
    even = EvenProfile(columns, np.ones(400, dtype=bool), 100.0)
    model = JointModel([even], np.array([1, 0], dtype=np.uint8), 1 / 12, 2.2, check=stop)
    with pytest.raises(KeyboardInterrupt):
        model.fit(model.start(Timing(1 / 12, 0.5, 0.0, 2.2)))
    assert len(calls) == 3


def stripes_of_ones_and_zeros(columns_a_chip: float, columns: int) -> np.ndarray:
    wave = Timing(1 / columns_a_chip, 0.5, 0.0, 2.2)
    return 20.0 + 100.0 * wave.lit_fraction(Waveform(np.array([1, 0], dtype=np.uint8)), columns)
