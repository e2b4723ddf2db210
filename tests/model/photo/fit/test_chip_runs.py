"""A pulse counts by its edges: it is fitted the same however finely its chips are told."""

from dataclasses import replace

import numpy as np
import pytest

from occ_model.photo.fit.chip_runs import chips_as_one
from occ_model.photo.fit.initial_search import Search
from occ_model.photo.fit.least_squares import StripeModel
from occ_model.photo.fit.timing import Timing
from occ_model.transmitter.waveform import Waveform

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
