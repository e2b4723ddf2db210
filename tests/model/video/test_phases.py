"""Foretold phases, their errors, and the mean step of a film's frames, against closed forms."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from occ_model.video.clock_fit import fit_clock
from occ_model.video.phase_fit import _local_spread
from occ_model.video.phases import ClockFit, PhaseJump, Phases, mean_step


def fit_of(frames: int) -> ClockFit:
    return ClockFit(
        frequency=2000.0, frequency_error=0.3, drift=4.0, drift_error=0.5, step=0.04,
        step_error=1e-6, middle=1.5, start=7.0, residuals=np.zeros(frames),
        kept=np.arange(frames + 5) < frames, jumps=(PhaseJump(9, 2.0, 3.0),), chi_squared=1.0,
        noise=0.02,
    )  # fmt: skip


def test_a_foretold_phase_is_a_parabola_of_time_with_its_jumps() -> None:
    times = np.array([0.5, 1.5, 1.9, 2.0, 3.5])
    later = times - 1.5
    expected = 7.0 + 2000.0 * later + 2.0 * later**2 + np.array([0.0, 0.0, 0.0, 3.0, 3.0])
    assert fit_of(60).at_start(times) == pytest.approx(expected)


def test_its_error_grows_from_the_noise_by_those_of_frequency_and_drift() -> None:
    """Of many frames: the three are independent."""
    many = fit_of(100_000)
    for later in (-4.0, 0.0, 0.7, 10.0):
        expected = math.hypot(0.02, 0.3 * later, 0.25 * later**2)
        assert many.phase_error(1.5 + later) == pytest.approx(expected, rel=1e-4)


def test_few_frames_foretell_less_and_never_nothing() -> None:
    errors = [fit_of(frames).phase_error(1.5) for frames in (1, 4, 5, 6, 20, 1000)]
    assert errors[0] == errors[1] == pytest.approx(4.0 * 0.02)
    assert all(few > more for few, more in itertools.pairwise(errors[1:]))
    # What the agreement of n frames tells of three unknowns has n - 3 degrees of freedom.
    assert errors[3] / 0.02 - 1.0 == pytest.approx((errors[2] / 0.02 - 1.0) * 2.0 / 3.0)


def phases_of(steps: list[float], errors: list[float]) -> Phases:
    count = len(steps)
    return Phases(
        np.arange(count) / 30.0, np.full(count, 500.0), np.zeros(count), np.full(count, 0.01),
        np.array(steps), np.array(errors), 52.0,
    )  # fmt: skip


def test_the_mean_step_is_weighted_and_its_error_that_of_the_scatter() -> None:
    steps, errors = [1.0, 1.2, 0.9, 1.1, 1.0], [0.1, 0.15, 0.12, 0.1, 0.2]
    weights = 1.0 / np.square(errors)
    mean, deviation = mean_step(phases_of(steps, errors))
    assert mean == pytest.approx(np.average(steps, weights=weights))
    share = weights / weights.sum()
    scatter = math.sqrt(float(share**2 @ (np.array(steps) - mean) ** 2) * 5.0 / 4.0)
    assert deviation == pytest.approx(scatter)


def test_a_single_frame_that_states_no_error_does_not_decide_alone() -> None:
    mean, _ = mean_step(phases_of([1.0, 1.0, 1.0, 1.0, 2.0], [0.1, 0.1, 0.1, 0.1, 1e-9]))
    assert mean == pytest.approx((4.0 + 4.0 * 2.0) / 8.0)


def test_of_few_frames_the_larger_error_is_taken() -> None:
    """Two that agree by chance know no more than they state."""
    agree = mean_step(phases_of([1.0, 1.0], [0.1, 0.1]))
    differ = mean_step(phases_of([0.0, 2.0], [0.1, 0.1]))
    assert agree == (1.0, pytest.approx(0.1 / math.sqrt(2.0)))
    assert differ == (1.0, pytest.approx(1.0 / math.sqrt(2.0)))


def test_phases_scatter_by_the_median_of_their_steps_and_no_less_than_they_state() -> None:
    random = np.random.default_rng(3)
    noise = random.normal(size=4000)
    # Slow changes do not count.
    spread = _local_spread(0.2 * noise + np.linspace(0.0, 40.0, 4000), np.full(4000, 0.01))
    assert spread == pytest.approx(0.2, rel=0.06)
    assert _local_spread(0.001 * noise, np.full(4000, 0.3)) == 0.3
    assert _local_spread(np.array([0.0, 5.0]), np.array([0.1, 0.2])) == pytest.approx(0.15)
    assert _local_spread(np.zeros(2), np.zeros(2)) > 0.0


def test_thousand_frames_are_followed_from_the_first_ones() -> None:
    """An alias that only the first frames allow is told apart by the later ones."""
    random = np.random.default_rng(7)
    times = np.arange(600) / 30.0
    places = 8000.0 * times + 0.01 * random.standard_normal(600)
    phases = replace(
        phases_of([0.16] * 600, [1e-6] * 600), times=times, places=np.mod(places, 52.0),
        columns=np.zeros(600),
    )  # fmt: skip
    (fit,) = fit_clock(phases, 7980.0, 8020.0)
    assert fit.frequency == pytest.approx(8000.0, abs=5.0 * fit.frequency_error)
    assert fit.frequency_error < 1e-3
