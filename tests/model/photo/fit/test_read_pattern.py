"""Chips are read from their stripes, by edges or by harmonics, whichever of them is first."""

from itertools import groupby

import numpy as np
import pytest
from hypothesis import assume, example, given, strategies as st
from lit_fractions import light_of

from occ_model.arrays import ByteArray
from occ_model.photo.fit.chip_runs import canonical
from occ_model.photo.fit.chips_of_harmonics import ReadPattern
from occ_model.photo.fit.read_pattern import read_otherwise, read_patterns
from occ_model.photo.fit.timing import Timing

PATTERNS = st.lists(st.integers(0, 1), min_size=2, max_size=26).map(
    lambda chips: np.array(chips, dtype=np.uint8)
)


def stripes_of(chips: ByteArray, exposure: float, chip: float, phase: float) -> np.ndarray:
    """Lit fractions over four periods."""
    timing = Timing(1.0 / chip, exposure, phase, gamma=2.22)
    return light_of(chips, timing, int(4.0 * len(chips) * chip))


def is_unambiguous(chips: str) -> bool:
    """Whether there are three pulses or more and a run of one chip, or one pulse of one chip."""
    turned = chips[chips.index("0") :] + chips[: chips.index("0")]
    runs = [len(list(run)) for _, run in groupby(turned)]
    return chips == "10" or (len(runs) >= 6 and min(runs) == 1)


def text(chips: ByteArray) -> str:
    return "".join(map(str, chips.tolist()))


@example(chips=np.array([0, 1], np.uint8), exposure=0.05, chip=17.0, phase=0.15625, seed=0)
@given(
    chips=PATTERNS,
    exposure=st.floats(0.05, 0.7),
    chip=st.floats(4.0, 20.0),
    phase=st.floats(0.0, 1.0),
    seed=st.integers(0, 99),
)
def test_a_sharp_pattern_is_read(
    chips: ByteArray, exposure: float, chip: float, phase: float, seed: int
) -> None:
    assume(0 < chips.sum() < len(chips))
    shortest = canonical(chips)
    assume(is_unambiguous(text(shortest)))
    # An edge sharper than a column may be half a column from where it seems to be, in each period
    # by as much if a period is a whole number of columns.
    exposure = max(exposure, 1.0 / chip)
    stripes = stripes_of(shortest, exposure, chip, phase)
    stripes += 0.01 * np.random.default_rng(seed).standard_normal(len(stripes))
    read = read_patterns(stripes, stripes, len(shortest) * chip)
    assert text(read[0].chips) == text(shortest)


def test_bright_runs_are_longer_by_less_than_an_edge() -> None:
    """Eight chips whose bright runs are longer by a third of a chip would explain these twelve."""
    chips = np.array([1, 1, 0, 1, 1, 0, 1, 1, 0, 0, 0, 0], dtype=np.uint8)
    stripes = stripes_of(canonical(chips), 0.25, 4.0, 0.0)
    stripes += 0.01 * np.random.default_rng(0).standard_normal(len(stripes))
    assert text(read_patterns(stripes, stripes, 12 * 4.0)[0].chips) == text(canonical(chips))


@pytest.mark.parametrize("exposure", [1.3, 2.7])
def test_an_exposure_of_several_chips_is_undone(exposure: float) -> None:
    chips = np.array([1, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0], dtype=np.uint8)
    stripes = stripes_of(chips, exposure, 9.3, 0.4)
    read = read_patterns(stripes, stripes, 18 * 9.3)
    assert text(canonical(chips)) in [text(one.chips) for one in read]


def test_long_exposures_by_a_bent_tone_curve_are_read_otherwise() -> None:
    """The chips are found from a wrong reading, which has as many chips."""
    chips = np.array([int(chip) for chip in "111010101010011010010110"], dtype=np.uint8)
    stripes = (stripes_of(chips, 2.75, 5.24, 0.4) + 0.05) ** 0.45
    stripes += 0.005 * np.random.default_rng(1).standard_normal(len(stripes))
    wrong = ReadPattern(np.roll(np.repeat([1, 0], 12), 3).astype(np.uint8), 0.9, 1.1, 0.0)
    read = read_otherwise(stripes, 24 * 5.24, [wrong])
    assert text(canonical(chips)) in [text(one.chips) for one in read]


def test_a_period_that_holds_the_chips_twice_says_so() -> None:
    """The chips then take half of the period's columns."""
    chips = np.array([1, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0], dtype=np.uint8)
    stripes = stripes_of(chips, 0.2, 9.3, 0.4)
    for times in (1, 2):
        read = read_patterns(stripes, stripes, times * 17 * 9.3)[0]
        assert (text(read.chips), read.times) == (text(canonical(chips)), times)


@given(PATTERNS, st.integers(0, 30), st.integers(1, 3))
def test_the_canonical_form_knows_no_start_and_no_repetition(
    chips: ByteArray, turn: int, times: int
) -> None:
    assert text(canonical(np.tile(np.roll(chips, turn), times))) == text(canonical(chips))


def test_no_chips_are_read_from_noise() -> None:
    noise = np.random.default_rng(4).standard_normal(1000)
    assert read_patterns(noise, noise, 120.0) == []
