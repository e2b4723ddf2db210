"""Harmonics are those of the stripes, and chips come back from them by division."""

import itertools

import numpy as np
import pytest
from lit_fractions import blurred_light, light_of

from occ_model.photo.fit.chips_of_harmonics import (
    ReadPattern,
    best_chips,
    boxes_of,
    chips_by_descent,
    harmonics_of,
    refine_timing,
    rounded_chips,
)
from occ_model.photo.fit.timing import Timing

CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 0], dtype=np.uint8)
PERIOD, COLUMNS = 60.0, 400
STEP = len(CHIPS) / PERIOD


def lines_of(exposure: float, longer: float = 0.0) -> np.ndarray:
    """Return the harmonics of exact stripes whose first column sees the first chip's begin."""
    timing = Timing(STEP, exposure, 0.5 * exposure + 0.5 * STEP * (COLUMNS - 1), 1.0)
    lit = blurred_light(CHIPS, COLUMNS, timing, 0.0, longer)
    return harmonics_of(lit - lit.mean(), PERIOD)


def test_harmonics_are_the_amplitudes_of_the_waves_whatever_the_trend() -> None:
    place = np.arange(COLUMNS) / PERIOD
    wave = 3.0 * np.cos(2 * np.pi * place) + 2.0 * np.sin(6 * np.pi * place)
    trend = 5.0 + 2.0 * np.linspace(-1.0, 1.0, COLUMNS) ** 2
    lines = harmonics_of(wave + trend, PERIOD)
    expected = np.zeros(30, dtype=complex)
    expected[0], expected[2] = 1.5, -1.0j
    assert lines == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize(
    ("columns", "period", "count"), [(400, 60.0, 30), (400, 3.0, 2), (50, 40.0, 14), (9, 8.0, 2)]
)
def test_there_are_no_more_harmonics_than_columns_tell(
    columns: int, period: float, count: int
) -> None:
    noise = np.random.default_rng(1).normal(size=columns)
    assert len(harmonics_of(noise, period)) == count


@pytest.mark.parametrize("exposure", [0.1, 0.9, 1.5, 2.3])
def test_chips_come_back_rotated_at_most(exposure: float) -> None:
    found = best_chips(lines_of(exposure), len(CHIPS))
    assert any(np.array_equal(np.roll(found.chips, k), CHIPS) for k in range(len(CHIPS)))
    assert found.explained > 0.99
    assert found.exposure == pytest.approx(exposure)


def test_harmonics_of_zero_give_no_chips() -> None:
    assert best_chips(np.zeros(30, dtype=complex), len(CHIPS)) is None


def test_boxes_are_the_transforms_of_a_chip_and_an_exposure() -> None:
    """Each is a moving average; the exposure's middle is at the phase."""
    order, count = np.arange(1, 25), 12
    fine = (np.arange(4000) + 0.5) / 4000 - 0.5
    boxes = boxes_of(24, count, np.array([0.7, 2.1]), np.array([0.25, 0.6]))
    for row, exposure, phase in zip(boxes, (0.7, 2.1), (0.25, 0.6), strict=True):
        turns = -2j * np.pi / count * order[:, None]
        chip, box = (np.exp(turns * width * fine).mean(axis=1) for width in (1.0, exposure))
        expected = chip * box * np.exp(turns[:, 0] * phase) / count
        assert row == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("few", [False, True])
def test_levels_are_rounded_between_the_means_of_bright_and_dark(few: bool) -> None:
    """Wherever most chips lie: one bright one among many, or one dark one."""
    chips = np.full(12, int(few), dtype=np.uint8)
    chips[3] = int(not few)
    boxes = boxes_of(30, 12, np.array([0.5]), np.array([0.0]))
    lines = np.fft.fft(chips)[np.arange(1, 31) % 12] * boxes[0]
    assert rounded_chips(lines, boxes, 12)[0].tolist() == chips.tolist()


@pytest.mark.parametrize("longer", [0.0, 0.25, -0.2])
def test_exposure_and_phase_are_refined_though_bright_runs_are_longer(longer: float) -> None:
    lines = lines_of(0.8, longer)
    rough = ReadPattern(CHIPS, 0.9, 0.9, 0.5)
    found = refine_timing(lines, rough, STEP)
    assert found.explained > 0.9995
    assert found.exposure == pytest.approx(0.8, abs=0.03)
    # The exposure's middle, where its chip is: the first column's.
    assert (found.phase + 6.0) % 12.0 - 6.0 == pytest.approx(0.1 - 0.5 * longer, abs=0.03)
    assert np.array_equal(found.chips, CHIPS)


def test_bright_runs_are_no_longer_than_the_ramps_of_edges() -> None:
    """Without white, light passes half its height within each ramp."""
    lines, rough = lines_of(0.1, 0.39), ReadPattern(CHIPS, 0.9, 0.1, 0.5)
    assert refine_timing(lines, rough) is not rough
    assert refine_timing(lines, rough, 0.05) is rough


@pytest.mark.parametrize("exposure", [2.15, 2.7])
def test_chips_of_a_long_exposure_come_back_by_descent_from_noisy_harmonics(
    exposure: float,
) -> None:
    lit = light_of(CHIPS, Timing(STEP, exposure, 3.3, 1.0), COLUMNS)
    noise = 0.02 * np.random.default_rng(8).normal(size=COLUMNS)
    found = chips_by_descent(harmonics_of(lit - lit.mean() + noise, PERIOD), len(CHIPS))
    turned = [np.roll(found[0].chips, k) for k in range(len(CHIPS))]
    assert any(np.array_equal(one, CHIPS) for one in turned)
    assert found[0].explained > 0.99
    assert all(one.explained >= two.explained for one, two in itertools.pairwise(found))
    distinct = {min(np.roll(one.chips, k).tobytes() for k in range(12)) for one in found}
    assert len(distinct) == len(found)


@pytest.mark.parametrize(("harmonics", "count"), [(1, 12), (2, 12), (3, 24)])
def test_a_descent_ends_where_so_few_harmonics_leave_chips_without_any(
    harmonics: int, count: int
) -> None:
    """Rounding would raise the likeness of next to no energy again and again."""
    random = np.random.default_rng(harmonics)
    lines = random.normal(size=harmonics) + 1j * random.normal(size=harmonics)
    assert all(one.explained < 1.0 + 1e-9 for one in chips_by_descent(lines, count))
