"""The clock of a film: phases, aliases, jumps, stated errors, and frame times."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from amount import amount

from occ_model.video.clock import fit_clock
from occ_model.video.frame_times import fit_frame_times
from occ_model.video.phase_fit import (
    ClockFit,
    FramePhases,
    PhaseJump,
    estimate_local_spread,
    mean_step,
)

_NOISE = 0.01


def _phases(
    frequency: float,
    times: np.ndarray,
    period: float,
    random: np.random.Generator,
    jitter: float = 0.0,
    drift: float = 0.0,
) -> FramePhases:
    """Return the phases of frames that start at ``times``, except for a jitter."""
    count = len(times)
    started = times + jitter * random.standard_normal(count)
    columns = 500.0 + 30.0 * np.sin(np.arange(count) * 0.1)
    step = frequency * 20e-6
    places = frequency * started + 0.5 * drift * (started - started.mean()) ** 2 + step * columns
    places = places + _NOISE * random.standard_normal(count)
    relative = 1e-5 * random.standard_normal(count)
    return FramePhases(
        times=times,
        columns=columns,
        places=np.mod(places, period),
        errors=np.full(count, _NOISE),
        steps=step * (1.0 + relative),
        step_errors=np.full(count, 1e-5 * step),
        period=period,
    )


def test_the_stated_error_of_the_frequency_covers_68_percent() -> None:
    random = np.random.default_rng(1)
    deviations = []
    for _ in range(150):
        times = np.arange(int(random.integers(30, 150))) / random.choice([24.0, 30.0, 60.0, 240.0])
        frequency = random.uniform(2e3, 2e4)
        drift = frequency * random.uniform(-1e-6, 1e-6)
        jitter = float(random.choice([0.0, 1e-5, 1e-4]))
        phases = _phases(frequency, times, 52.0, random, jitter, drift)
        (fit,) = fit_clock(phases, 0.993 * frequency, 1.006 * frequency)
        middle = frequency + drift * (fit.middle - times.mean())
        deviations.append((fit.frequency - middle) / fit.frequency_error)
    fractions = [np.mean(np.abs(deviations) < bound) for bound in (1.0, 2.0)]
    # Standard deviations of these fractions in 150 trials: 3.8 and 1.8 %.
    assert fractions[0] == pytest.approx(0.68, abs=0.08)
    assert fractions[1] == pytest.approx(0.954, abs=0.04)


@pytest.mark.parametrize("count", [6, 8])
def test_the_errors_of_a_few_frames_hold_even_far_out(count: int) -> None:
    """A few may agree by chance: without Student's t a sixth would lie beyond two errors."""
    random, times = np.random.default_rng(count), np.arange(count) / 30.0
    off = []
    for _ in range(amount(100, 200)):
        (fit, *_) = fit_clock(_phases(8e3, times, 52.0, random, 1e-5), 7960.0, 8040.0)
        off.append([fit.drift / fit.drift_error, (fit.frequency - 8e3) / fit.frequency_error])
    fractions = np.mean(np.abs(off) < 2.0, axis=0)
    # The standard deviation of a fraction in 200 trials is 1.5 %.
    assert fractions.tolist() == pytest.approx([0.954, 0.954], abs=0.045)


def test_frames_that_agree_better_than_their_errors_do_not_reduce_the_clocks_error() -> None:
    """Common errors, such as of the sensor's fixed pattern, do not show in their scatter."""
    phases = _phases(8e3, np.arange(60) / 30.0, 52.0, np.random.default_rng(9))
    (sure,) = fit_clock(phases, 7960.0, 8040.0)
    (fit,) = fit_clock(replace(phases, errors=4.0 * phases.errors), 7960.0, 8040.0)
    assert fit.drift_error == pytest.approx(4.0 * sure.drift_error, rel=0.2)
    assert fit.frequency_error == pytest.approx(4.0 * sure.frequency_error, rel=0.2)


def test_all_frequencies_that_differ_by_a_period_per_frame_are_given() -> None:
    random = np.random.default_rng(2)
    times = np.arange(60) / 30.0
    phases = _phases(8000.0, times, 2.0, random)
    fits = fit_clock(phases, 7920.0, 8080.0)
    # A period of 2 chips more per frame, at 30 frames a second, is 60 Hz more.
    assert sorted(round(fit.frequency) for fit in fits) == [7940, 8000, 8060]


def test_a_jump_of_the_phase_is_found_and_does_not_change_the_frequency() -> None:
    random = np.random.default_rng(4)
    times = np.arange(90) / 30.0
    phases = _phases(8000.0, times, 52.0, random)
    shifted = np.mod(phases.places + 7.0 * (np.arange(90) >= 40), 52.0)
    (fit,) = fit_clock(replace(phases, places=shifted), 7950.0, 8050.0)
    assert [(jump.frame, round(jump.chips)) for jump in fit.jumps] == [(40, 7)]
    assert fit.frequency == pytest.approx(8000.0, abs=5.0 * fit.frequency_error)
    assert fit.frequency_error < 0.01


def test_misread_phases_are_excluded() -> None:
    random = np.random.default_rng(5)
    phases = _phases(8000.0, np.arange(60) / 30.0, 52.0, random)
    places = phases.places.copy()
    places[[7, 23, 41]] = (places[[7, 23, 41]] + 20.0) % 52.0
    (fit,) = fit_clock(replace(phases, places=places), 7950.0, 8050.0)
    assert np.flatnonzero(~fit.kept).tolist() == [7, 23, 41]
    assert fit.frequency == pytest.approx(8000.0, abs=5.0 * fit.frequency_error)


def test_phases_that_fit_no_frequency_give_none() -> None:
    random = np.random.default_rng(6)
    phases = _phases(8000.0, np.arange(60) / 30.0, 52.0, random)
    assert fit_clock(replace(phases, places=random.uniform(0.0, 52.0, 60)), 7950.0, 8050.0) == ()


@pytest.mark.parametrize("resolution", [0.0, 1e-3])
def test_missing_frames_do_not_change_the_frame_period(resolution: float) -> None:
    numbers = np.delete(np.arange(80), [10, 11, 30])
    times = numbers / 29.97
    found = fit_frame_times(np.round(times, 3) if resolution else times, resolution)
    assert abs(found.period.value - 1.0 / 29.97) < 4.0 * found.period.error + 1e-15
    assert found.numbers.tolist() == numbers.tolist()
    assert found.problems == (
        "According to the frame times 3 frames are missing after frames 9, 27.",
    )


def test_a_changing_rate_is_reported() -> None:
    times = np.cumsum(np.where(np.arange(60) < 30, 1 / 30, 1 / 22))
    found = fit_frame_times(times)
    assert any("not constant" in problem for problem in found.problems)
    assert any("uneven" in problem for problem in found.problems)


def test_times_that_do_not_increase_are_reported() -> None:
    times = np.arange(20) / 30.0
    times[8] = times[7]
    found = fit_frame_times(times)
    assert any("do not increase after frame 7" in problem for problem in found.problems)


def fit_of(frames: int) -> ClockFit:
    return ClockFit(
        frequency=2000.0, frequency_error=0.3, drift=4.0, drift_error=0.5, step=0.04,
        step_error=1e-6, middle=1.5, start=7.0, residuals=np.zeros(frames),
        kept=np.arange(frames + 5) < frames, jumps=(PhaseJump(9, 2.0, 3.0),), chi_squared=1.0,
        noise=0.02,
    )  # fmt: skip


def test_a_predicted_phase_is_a_parabola_of_time_with_its_jumps() -> None:
    times = np.array([0.5, 1.5, 1.9, 2.0, 3.5])
    later = times - 1.5
    expected = 7.0 + 2000.0 * later + 2.0 * later**2 + np.array([0.0, 0.0, 0.0, 3.0, 3.0])
    assert fit_of(60).at_start(times) == pytest.approx(expected)


def test_the_error_of_a_predicted_phase_adds_noise_frequency_and_drift() -> None:
    """For many frames, whose three contributions are independent."""
    many = fit_of(100_000)
    for later in (-4.0, 0.0, 0.7, 10.0):
        expected = math.hypot(0.02, 0.3 * later, 0.25 * later**2)
        assert many.phase_error(1.5 + later) == pytest.approx(expected, rel=1e-4)


def test_a_few_frames_predict_with_a_larger_and_never_a_zero_error() -> None:
    errors = [fit_of(frames).phase_error(1.5) for frames in (1, 4, 5, 6, 20, 1000)]
    assert errors[0] == errors[1] == pytest.approx(4.0 * 0.02)
    assert all(few > more for few, more in itertools.pairwise(errors[1:]))
    # The scatter of n frames about three unknowns has n - 3 degrees of freedom.
    assert errors[3] / 0.02 - 1.0 == pytest.approx((errors[2] / 0.02 - 1.0) * 2.0 / 3.0)


def phases_of(steps: list[float], errors: list[float]) -> FramePhases:
    count = len(steps)
    return FramePhases(
        np.arange(count) / 30.0, np.full(count, 500.0), np.zeros(count), np.full(count, 0.01),
        np.array(steps), np.array(errors), 52.0,
    )  # fmt: skip


def test_the_mean_step_is_weighted_and_its_error_that_of_the_scatter() -> None:
    steps, errors = [1.0, 1.4, 0.7, 1.2, 1.0], [0.1, 0.15, 0.12, 0.1, 0.2]
    weights = 1.0 / np.square(errors)
    mean, deviation = mean_step(phases_of(steps, errors))
    assert mean == pytest.approx(np.average(steps, weights=weights))
    fraction = weights / weights.sum()
    scatter = math.sqrt(float(fraction**2 @ (np.array(steps) - mean) ** 2) * 5.0 / 4.0)
    assert deviation == pytest.approx(scatter)


@pytest.mark.parametrize("frames", [1, 2, 25])
def test_frames_that_agree_do_not_reduce_their_stated_error(frames: int) -> None:
    """An error common to all of them does not scatter."""
    agree = mean_step(phases_of([1.0] * frames, [0.1] * frames))
    assert agree == (1.0, pytest.approx(0.1 / math.sqrt(frames)))


def test_a_single_frame_that_states_no_error_does_not_decide_alone() -> None:
    mean, _ = mean_step(phases_of([1.0, 1.0, 1.0, 1.0, 2.0], [0.1, 0.1, 0.1, 0.1, 1e-9]))
    # Four times the median weight is the most that a frame counts.
    assert mean == pytest.approx((4.0 + 4.0 * 2.0) / 8.0)


def test_the_scatter_of_phases_is_the_median_of_their_steps_and_at_least_their_error() -> None:
    random = np.random.default_rng(3)
    noise = random.normal(size=4000)
    # Slow changes are not part of the scatter.
    spread = estimate_local_spread(0.2 * noise + np.linspace(0.0, 40.0, 4000), np.full(4000, 0.01))
    assert spread == pytest.approx(0.2, rel=0.06)
    assert estimate_local_spread(0.001 * noise, np.full(4000, 0.3)) == 0.3
    assert estimate_local_spread(np.array([0.0, 5.0]), np.array([0.1, 0.2])) == pytest.approx(0.15)
    assert estimate_local_spread(np.zeros(2), np.zeros(2)) > 0.0


def test_the_phase_of_a_thousand_frames_is_followed_from_the_first_ones() -> None:
    """The later frames exclude an alias that the first ones allow."""
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
