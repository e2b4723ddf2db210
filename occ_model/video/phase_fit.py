"""Fit a clock to the phases of frames: a parabola of time with jumps."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.photo.stripes.period import correlated_columns

_MIN_FOR_DRIFT = 6  # minimum number of frames to fit a drift as well
_OUTLIER_DEVIATIONS = 6.0  # standard deviations from which a phase is an outlier (misread packet)
_JUMP_DEVIATIONS = 10.0  # standard deviations from which a change between two frames is a jump
_MIN_JUMP = 0.1  # smallest jump in chips, because the picture itself may shift the phase by less

_MAX_JUMPS = 8

_MIN_TO_COMPARE = 16  # minimum number of frames for a correlation of neighbouring residuals
_CORRELATED_DEVIATIONS = 2.5  # standard deviations from which that correlation is significant
_SIGMA_OF_MEDIAN = 1.4826  # ratio of standard to median deviation of a normal distribution
_MIN_DEVIATION = 1e-5  # smallest credible standard deviation of a phase, in chips


@dataclass(frozen=True, eq=False, slots=True)
class FramePhases:
    """What frames show about the clock, in the order of time."""

    times: FloatArray  # Shape (frames,): the frames' times in seconds
    columns: FloatArray  # Shape (frames,): the column of each phase
    # Shape (frames,): the phase of the chips there, from 0 to below ``period``, and its standard
    # deviation, in chips
    places: FloatArray
    errors: FloatArray
    # Shape (frames,): chips per column, and their standard deviation
    steps: FloatArray
    step_errors: FloatArray
    period: float  # Chips after which the transmission repeats

    @classmethod
    def of(cls, frames: Iterable[tuple[float, ...]], period: float) -> "FramePhases":
        """Make phases from the six values of each frame, in the order of the attributes."""
        times, columns, places, errors, steps, step_errors = np.array(list(frames)).T
        return cls(times, columns, places, errors, steps, step_errors, period)

    def first(self, count: int) -> "FramePhases":
        names = [field.name for field in fields(self) if field.name != "period"]
        return replace(self, **{name: getattr(self, name)[:count] for name in names})


@dataclass(frozen=True, slots=True)
class PhaseJump:
    """A jump of the phase between two frames."""

    # The first frame after the jump, and its time in seconds
    frame: int
    time: float
    chips: float  # Height of the jump, up to whole periods


@dataclass(frozen=True, eq=False, slots=True)
class ClockFit:
    """A parabola of time fitted to the phases of frames."""

    # Chips per second in the middle of the film, and its standard deviation
    frequency: float
    frequency_error: float
    # Its change in Hz per second; 0 if there are too few frames
    drift: float
    drift_error: float
    # Chips per column
    step: float
    step_error: float
    middle: float  # The time in seconds for which the frequency holds
    start: float  # The unwrapped phase at that time in column 0, in chips
    # Shape (frames,): phases minus those of the fit, in chips; meaningful for ``kept`` frames
    residuals: FloatArray
    kept: BoolArray  # Shape (frames,): frames whose phase agrees with the others
    jumps: tuple[PhaseJump, ...]
    chi_squared: float  # Sum of the squared residuals divided by the phases' own variances
    noise: float  # Standard deviation of a phase about the fit, in chips

    def at_start(self, times: FloatArray) -> FloatArray:
        """Return the unwrapped phase in column 0 of frames at some times, in chips."""
        elapsed = np.asarray(times, dtype=np.float64) - self.middle
        phase = self.start + self.frequency * elapsed + 0.5 * self.drift * elapsed**2
        for jump in self.jumps:
            phase = phase + jump.chips * (np.asarray(times) >= jump.time)
        return np.asarray(phase)

    def phase_error(self, time: float) -> float:
        """Return the standard deviation of a predicted phase at a time, in chips."""
        elapsed = time - self.middle
        drift_error = 0.5 * self.drift_error * elapsed**2
        error = np.hypot(np.hypot(self.noise, self.frequency_error * elapsed), drift_error)
        # A few frames may agree by chance.
        return float(error) * (1.0 + 3.0 / max(int(self.kept.sum()) - 3, 1))


def mean_step(phases: FramePhases) -> tuple[float, float]:
    """Return the weighted mean of the chips per column, and its standard deviation.

    The deviation follows from the frames' scatter, but is not below what the frames' own errors
    imply, because an error that all frames share does not scatter.
    """
    weights = 1.0 / np.maximum(phases.step_errors, 1e-12) ** 2
    # A single frame may be far more certain than all others by mistake.
    weights = np.minimum(weights, 4.0 * float(np.median(weights)))
    total = float(weights.sum())
    mean = float(weights @ phases.steps / total)
    count = len(weights)
    scatter = float(weights**2 @ (phases.steps - mean) ** 2) * count / max(count - 1, 1)
    stated = float(weights**2 @ phases.step_errors**2)
    return mean, math.sqrt(max(scatter, stated)) / total


def fit_parabola(phases: FramePhases, unwrapped_phases: FloatArray) -> ClockFit:
    is_kept = np.ones(len(unwrapped_phases), dtype=bool)
    jumps: list[int] = []
    solution = _solve(phases, unwrapped_phases, is_kept, jumps)
    for _ in range(_MAX_JUMPS + 3):
        spread = estimate_local_spread(solution.residuals[is_kept], phases.errors[is_kept])
        jump = _find_largest_jump(solution.residuals, is_kept, spread, jumps)
        deviations = np.abs(solution.residuals)
        typical = _SIGMA_OF_MEDIAN * float(np.median(deviations))
        is_outlier = is_kept & (deviations > _OUTLIER_DEVIATIONS * max(spread, typical))
        if jump is not None and len(jumps) < _MAX_JUMPS:
            jumps.append(jump)
        elif is_outlier.any() and (is_kept & ~is_outlier).sum() >= max(2, len(is_kept) // 2):
            is_kept = is_kept & ~is_outlier
        else:
            break
        solution = _solve(phases, unwrapped_phases, is_kept, jumps)
    return solution


def _solve(
    phases: FramePhases, unwrapped_phases: FloatArray, is_kept: BoolArray, jumps: list[int]
) -> ClockFit:
    middle = float(phases.times[is_kept].mean())
    elapsed = phases.times - middle
    has_drift = int(is_kept.sum()) >= _MIN_FOR_DRIFT + len(jumps)
    design, scale = _scaled_design(elapsed, is_kept, jumps, has_drift)
    errors = np.maximum(phases.errors, _MIN_DEVIATION)
    jitter = 0.0
    for _ in range(8):
        weights = np.where(is_kept, 1.0 / (errors**2 + jitter**2), 0.0)
        inverse = np.linalg.pinv(design.T * weights @ design, rcond=1e-13)
        scaled_coefficients = inverse @ (design.T @ (weights * unwrapped_phases))
        residuals = unwrapped_phases - design @ scaled_coefficients
        freedom = max(1, int(is_kept.sum()) - design.shape[1])
        excess = float(weights @ residuals**2) / freedom
        previous_jitter = jitter
        # The jitter that explains the size of the residuals.
        unexplained = float((residuals[is_kept] ** 2 - errors[is_kept] ** 2).sum())
        jitter = math.sqrt(max(0.0, unexplained / freedom))
        if abs(jitter - previous_jitter) <= 1e-3 * max(jitter, _MIN_DEVIATION):
            break
    scatter = _scatter_of_fit(excess, jitter, freedom)
    covariance = inverse * scatter * _correlated_count(residuals[is_kept]) / np.outer(scale, scale)
    noise = float(np.sqrt(residuals[is_kept] @ residuals[is_kept] / freedom))
    coefficients = scaled_coefficients / scale
    if has_drift:
        # Undo the subtraction of the quadratic's mean in the phase of the middle.
        coefficients[0] -= coefficients[2] * float((0.5 * elapsed[is_kept] ** 2).mean())
    step, step_error = mean_step(phases)
    deviations = np.sqrt(np.diag(covariance))
    chi = residuals[is_kept] / errors[is_kept]
    return ClockFit(
        frequency=float(coefficients[1]),
        frequency_error=float(deviations[1]),
        drift=float(coefficients[2]) if has_drift else 0.0,
        drift_error=float(deviations[2]) if has_drift else 0.0,
        step=step,
        step_error=step_error,
        middle=middle,
        start=float(coefficients[0]),
        residuals=residuals,
        kept=is_kept,
        jumps=tuple(
            PhaseJump(frame, float(phases.times[frame]), height)
            for frame, height in zip(jumps, coefficients[2 + has_drift :].tolist(), strict=True)
        ),
        chi_squared=float(chi @ chi),
        noise=noise,
    )


def _scaled_design(
    elapsed: FloatArray, is_kept: BoolArray, jumps: list[int], has_drift: bool
) -> tuple[FloatArray, FloatArray]:
    """Return the terms of the fit, shape (frames, terms), each divided by its scale, and these."""
    extent = max(float(np.ptp(elapsed)), 1e-12)
    terms, scale = [np.ones(len(elapsed)), elapsed], [1.0, extent]
    if has_drift:
        # The quadratic's mean is subtracted, so that the frequency is that of the middle.
        quadratic = 0.5 * elapsed**2
        terms.append(quadratic - float(quadratic[is_kept].mean()))
        scale.append(extent**2)
    terms += [(np.arange(len(elapsed)) >= frame).astype(np.float64) for frame in jumps]
    scales = np.array(scale + [1.0] * len(jumps))
    return np.column_stack(terms) / scales, scales


def _scatter_of_fit(excess: float, jitter: float, freedom: int) -> float:
    """Return the factor of the fit's variances by how much the frames scatter about it."""
    # Frames may agree better than their own errors imply if they share a part of these errors, such
    # as that of the sensor's fixed pattern. That part still shifts the fit.
    scatter = max(1.0, excess)
    if jitter > 0.0 and freedom > 2:
        # A few may agree by chance: variance of Student's t
        scatter *= freedom / (freedom - 2.0)
    return scatter


def _correlated_count(residuals: FloatArray) -> float:
    """Return the number of neighbouring residuals that count as one; 1 if they are independent."""
    count = len(residuals)
    power = float(residuals @ residuals)
    if count < _MIN_TO_COMPARE or power <= 0.0:
        return 1.0
    neighbours = float(residuals[1:] @ residuals[:-1]) / power
    return (
        correlated_columns(residuals)
        if neighbours > _CORRELATED_DEVIATIONS / math.sqrt(count)
        else 1.0
    )


def estimate_local_spread(residuals: FloatArray, errors: FloatArray) -> float:
    """Return the standard deviation of phases without slow changes, from their differences."""
    least = float(np.median(errors))
    if len(residuals) < 3:
        return max(least, _MIN_DEVIATION)
    steps = np.abs(np.diff(residuals))
    return max(_SIGMA_OF_MEDIAN / math.sqrt(2.0) * float(np.median(steps)), least, _MIN_DEVIATION)


def _find_largest_jump(
    residuals: FloatArray, kept: BoolArray, spread: float, jumps: list[int]
) -> int | None:
    """Find the largest lasting jump of the residuals, confirmed by the frames on either side."""
    frames: IndexArray = np.flatnonzero(kept)
    if len(frames) < 8:
        return None
    values = residuals[frames]
    heights = np.abs(np.diff(values))
    for index in np.argsort(heights)[::-1][:4].tolist():
        if heights[index] < max(_JUMP_DEVIATIONS * spread, _MIN_JUMP):
            return None
        frame = int(frames[index + 1])
        before, after = values[max(0, index - 2) : index + 1], values[index + 1 : index + 4]
        is_lasting = abs(float(np.median(after)) - float(np.median(before))) > 0.6 * heights[index]
        if is_lasting and len(before) > 2 and len(after) > 2 and frame not in jumps:
            return frame
    return None
