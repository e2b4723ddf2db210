"""A pulse counts by its edges: it is fitted the same however finely its chips are told."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from occ_model.light.waveform import Waveform
from occ_model.photo.fit.chip_runs import chips_as_one, chips_if_longer, is_single_pulse
from occ_model.photo.fit.initial_search import Search
from occ_model.photo.fit.least_squares import StripeModel
from occ_model.photo.fit.timing import Timing

COLUMNS = 300
SQUARE = np.array([1, 0], dtype=np.uint8)
TRUE = Timing(0.09, 0.6, 2.7, 1.0)
PLACE = np.linspace(-1.0, 1.0, COLUMNS)
PROFILE = (
    30.0 + (120.0 - 40.0 * PLACE**2) * TRUE.lit_fraction(Waveform(SQUARE), COLUMNS)
    + np.random.default_rng(41).normal(0.0, 3.0, COLUMNS)
)  # fmt: skip


def tone(lit: np.ndarray, gamma: float) -> np.ndarray:
    return lit**gamma


def scaled(timing: Timing, parts: int) -> Timing:
    return replace(
        timing, step=parts * timing.step, exposure=parts * timing.exposure,
        middle=parts * timing.middle,
    )  # fmt: skip


@pytest.mark.parametrize("parts", [3, 25])
def test_levels_have_the_freedom_of_the_square_wave(parts: int) -> None:
    plain = StripeModel(PROFILE, SQUARE, tone, TRUE.step).levels(TRUE)
    finer = StripeModel(PROFILE, np.repeat(SQUARE, parts), tone, parts * TRUE.step)
    for one, other in zip(plain, finer.levels(scaled(TRUE, parts)), strict=True):
        assert other == pytest.approx(one, abs=1e-9)


def test_a_search_tries_the_same_exposures() -> None:
    def tried(chips: np.ndarray, step: float) -> list[float]:
        found = Search(PROFILE - PROFILE.mean(), chips).candidates(np.array([step]), 1.0)
        return sorted(one.timing.exposure / step for one in found)

    finer = tried(np.repeat(SQUARE, 5), 5.0 * TRUE.step)
    assert finer == pytest.approx(tried(SQUARE, TRUE.step))


def test_each_chip_of_a_code_counts() -> None:
    assert chips_as_one(np.array([1, 1, 0, 1, 0, 0], dtype=np.uint8)) == 1.0


@given(st.lists(st.integers(1, 5), min_size=2, max_size=12), st.integers(2, 5), st.data())
def test_chips_whose_bright_runs_are_longer_by_as_much_may_be_fewer(
    runs: list[int], together: int, data: st.DataObject
) -> None:
    bright = [together * run for run in runs]
    dark = [together * run for run in reversed(runs)]
    longer = data.draw(st.integers(1, together - 1))
    chips = np.concatenate(
        [[1] * (on + longer) + [0] * (off - longer) for on, off in zip(bright, dark, strict=True)]
    ).astype(np.uint8)
    assume(not is_single_pulse(chips))
    found, by = chips_if_longer(chips)
    assert (found, by) == (together, longer) or found > together


@pytest.mark.parametrize(
    "chips", ["111", "10", "1110", "1101001", "10100010", "1110100110", "1100110000"]
)
def test_chips_of_no_such_kind_are_no_fewer(chips: str) -> None:
    assert chips_if_longer(np.array(list(chips), dtype=np.uint8)) == (1, 0)
