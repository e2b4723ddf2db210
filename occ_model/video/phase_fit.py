"""Fit a clock to the phases of frames: a parabola of time with jumps."""

import math
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.photo.stripes.period import correlated_columns

_MIN_FOR_DRIFT = 6  # minimum number of frames to fit a drift as well
_OUTLIER_DEVIATIONS = 6.0  # from which a phase is an outlier, such as of a misread packet
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

    def first(self, count: int) -> "FramePhases":
        names = ("times", "columns", "places", "errors", "steps", "step_errors")
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
        later = np.asarray(times, dtype=np.float64) - self.middle
        phase = self.start + self.frequency * later + 0.5 * self.drift * later**2
        for jump in self.jumps:
            phase = phase + jump.chips * (np.asarray(times) >= jump.time)
        return np.asarray(phase)

    def phase_error(self, time: float) -> float:
        """Return the standard deviation of a predicted phase at a time, in chips."""
        later = time - self.middle
        drifted = 0.5 * self.drift_error * later**2
        error = np.hypot(np.hypot(self.noise, self.frequency_error * later), drifted)
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


def fit_parabola(phases: FramePhases, counted: FloatArray) -> ClockFit:
    kept = np.ones(len(counted), dtype=bool)
    jumps: list[int] = []
    solution = _solve(phases, counted, kept, jumps)
    for _ in range(_MAX_JUMPS + 3):
        spread = local_spread(solution.residuals[kept], phases.errors[kept])
        jump = _largest_jump(solution.residuals, kept, spread, jumps)
        off = np.abs(solution.residuals)
        typical = _SIGMA_OF_MEDIAN * float(np.median(off))
        outlying = kept & (off > _OUTLIER_DEVIATIONS * max(spread, typical))
        if jump is not None and len(jumps) < _MAX_JUMPS:
            jumps.append(jump)
        elif outlying.any() and (kept & ~outlying).sum() >= max(2, len(kept) // 2):
            kept = kept & ~outlying
        else:
            break
        solution = _solve(phases, counted, kept, jumps)
    return solution


def _solve(phases: FramePhases, counted: FloatArray, kept: BoolArray, jumps: list[int]) -> ClockFit:
    times = phases.times
    middle = float(times[kept].mean())
    later = times - middle
    extent = max(float(np.ptp(later)), 1e-12)
    has_drift = int(kept.sum()) >= _MIN_FOR_DRIFT + len(jumps)
    parts = [np.ones(len(times)), later]
    if has_drift:
        # The bend's mean is subtracted so that the frequency is that of the middle.
        bend = 0.5 * later**2
        parts.append(bend - float(bend[kept].mean()))
    parts += [(np.arange(len(times)) >= frame).astype(np.float64) for frame in jumps]
    design = np.column_stack(parts)
    scale = np.array([1.0, extent, extent**2][: 2 + has_drift] + [1.0] * len(jumps))
    errors = np.maximum(phases.errors, _MIN_DEVIATION)
    jitter = 0.0
    for _ in range(8):
        weights = np.where(kept, 1.0 / (errors**2 + jitter**2), 0.0)
        products = (design * scale**-1.0).T * weights @ (design / scale)
        inverse = np.linalg.pinv(products, rcond=1e-13)
        found = inverse @ ((design / scale).T @ (weights * counted)) / scale
        residuals = counted - design @ found
        free = max(1, int(kept.sum()) - design.shape[1])
        excess = float(weights @ residuals**2) / free
        before = jitter
        # The jitter that explains the size of the residuals.
        jitter = float(
            np.sqrt(max(0.0, float((residuals[kept] ** 2 - errors[kept] ** 2).sum()) / free))
        )
        if abs(jitter - before) <= 1e-3 * max(jitter, _MIN_DEVIATION):
            break
    # Frames may agree better than their own errors imply if a part of these errors is common, such
    # as that of the sensor's fixed pattern. That part still moves the fit.
    scatter = max(1.0, excess)
    if jitter > 0.0 and free > 2:
        scatter *= free / (free - 2.0)  # a few may agree by chance: variance of Student's t
    covariance = inverse * scatter * _correlated_count(residuals[kept]) / np.outer(scale, scale)
    noise = float(np.sqrt(residuals[kept] @ residuals[kept] / free))
    if has_drift:
        # Undo the subtraction of the bend's mean in the phase of the middle.
        found = found.copy()
        found[0] -= found[2] * float((0.5 * later[kept] ** 2).mean())
    step, step_error = mean_step(phases)
    deviations = np.sqrt(np.diag(covariance))
    chi = residuals[kept] / errors[kept]
    return ClockFit(
        frequency=float(found[1]),
        frequency_error=float(deviations[1]),
        drift=float(found[2]) if has_drift else 0.0,
        drift_error=float(deviations[2]) if has_drift else 0.0,
        step=step,
        step_error=step_error,
        middle=middle,
        start=float(found[0]),
        residuals=residuals,
        kept=kept,
        jumps=tuple(
            PhaseJump(frame, float(phases.times[frame]), height)
            for frame, height in zip(jumps, found[2 + has_drift :].tolist(), strict=True)
        ),
        chi_squared=float(chi @ chi),
        noise=noise,
    )


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


def local_spread(residuals: FloatArray, errors: FloatArray) -> float:
    """Return the standard deviation of phases without slow changes, from their steps."""
    least = float(np.median(errors))
    if len(residuals) < 3:
        return max(least, _MIN_DEVIATION)
    steps = np.abs(np.diff(residuals))
    return max(_SIGMA_OF_MEDIAN / math.sqrt(2.0) * float(np.median(steps)), least, _MIN_DEVIATION)


def _largest_jump(
    residuals: FloatArray, kept: BoolArray, spread: float, jumps: list[int]
) -> int | None:
    """Find the largest lasting jump of the residuals, confirmed by the frames on either side."""
    frames: IndexArray = np.flatnonzero(kept)
    if len(frames) < 8:
        return None
    values = residuals[frames]
    heights = np.abs(np.diff(values))
    for place in np.argsort(heights)[::-1][:4].tolist():
        if heights[place] < max(_JUMP_DEVIATIONS * spread, _MIN_JUMP):
            return None
        frame = int(frames[place + 1])
        before, after = values[max(0, place - 2) : place + 1], values[place + 1 : place + 4]
        lasts = abs(float(np.median(after)) - float(np.median(before))) > 0.6 * heights[place]
        if lasts and len(before) > 2 and len(after) > 2 and frame not in jumps:
            return frame
    return None
