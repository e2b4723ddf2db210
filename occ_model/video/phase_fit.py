"""The phases of frames, and the clock that is fitted to them: a parabola of time with jumps."""

import math
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.photo.stripes.period import correlated_columns

_MIN_FOR_DRIFT = 6  # frames from which a drift is fitted too
_OUTLIER_DEVIATIONS = 6.0  # standard deviations from which a phase is an outlier: a misread packet
_JUMP_DEVIATIONS = 10.0  # deviations from which the phase jumps between two frames
_MIN_JUMP = 0.1  # smallest jump in chips: the picture itself may shift the phase by less

_MAX_JUMPS = 8

_MIN_TO_COMPARE = 16  # minimum frames for a correlation of neighbouring residuals
_CORRELATED_DEVIATIONS = 2.5  # standard deviations from which that correlation is significant
_SIGMA_OF_MEDIAN = 1.4826  # standard deviation over median deviation of a normal distribution
_MIN_DEVIATION = 1e-5  # least standard deviation of a phase in chips that is believed


@dataclass(frozen=True, eq=False, slots=True)
class Phases:
    """What frames show of the clock, in the order of time."""

    times: FloatArray  # Shape (frames,): the frames' times in seconds
    columns: FloatArray  # Shape (frames,): the column that each phase is that of
    # Shape (frames,): the phase of the chips there, in chips from 0 to below ``period``, and its
    # deviation
    places: FloatArray
    errors: FloatArray
    # Shape (frames,): chips from one column to the next, and its deviation
    steps: FloatArray
    step_errors: FloatArray
    period: float  # Chips after which what is sent repeats

    def first(self, count: int) -> "Phases":
        names = ("times", "columns", "places", "errors", "steps", "step_errors")
        return replace(self, **{name: getattr(self, name)[:count] for name in names})


@dataclass(frozen=True, slots=True)
class PhaseJump:
    """A jump of the phase between two frames."""

    # The first frame after it, and its time in seconds
    frame: int
    time: float
    chips: float  # The jump, up to whole periods


@dataclass(frozen=True, eq=False, slots=True)
class ClockFit:
    """The phases of frames as a parabola of their times."""

    # Chips a second in the middle of the film's times, and its standard deviation
    frequency: float
    frequency_error: float
    # Its change in Hz a second; 0 where too few frames show it
    drift: float
    drift_error: float
    # Chips from one column to the next
    step: float
    step_error: float
    middle: float  # The time that the frequency is that of, in seconds
    start: float  # The phase at that time in column 0, in chips, counted on over periods
    # Shape (frames,): phases less those of the fit, in chips; of frames that are ``kept``
    residuals: FloatArray
    kept: BoolArray  # Shape (frames,): frames whose phase agrees with the others'
    jumps: tuple[PhaseJump, ...]
    chi_squared: float  # Sum of the squared residuals over the variances of the phases alone
    noise: float  # Standard deviation of a phase about the fit, in chips

    def at_start(self, times: FloatArray) -> FloatArray:
        """Return the phase in column 0 of frames at some times, in chips counted over periods."""
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
        # Few frames may agree by chance.
        return float(error) * (1.0 + 3.0 / max(int(self.kept.sum()) - 3, 1))


def mean_step(phases: Phases) -> tuple[float, float]:
    """Return the weighted mean of the chips a column, and its deviation.

    It is that of the frames' scatter, but no less than the frames' own errors imply: an error that
    all frames share does not scatter.
    """
    weights = 1.0 / np.maximum(phases.step_errors, 1e-12) ** 2
    # A single frame that is surer than all others may be so by mistake.
    weights = np.minimum(weights, 4.0 * float(np.median(weights)))
    total = float(weights.sum())
    mean = float(weights @ phases.steps / total)
    count = len(weights)
    scatter = float(weights**2 @ (phases.steps - mean) ** 2) * count / max(count - 1, 1)
    stated = float(weights**2 @ phases.step_errors**2)
    return mean, math.sqrt(max(scatter, stated)) / total


def fit_parabola(phases: Phases, counted: FloatArray) -> ClockFit:
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


def _solve(phases: Phases, counted: FloatArray, kept: BoolArray, jumps: list[int]) -> ClockFit:
    times = phases.times
    middle = float(times[kept].mean())
    later = times - middle
    extent = max(float(np.ptp(later)), 1e-12)
    has_drift = int(kept.sum()) >= _MIN_FOR_DRIFT + len(jumps)
    parts = [np.ones(len(times)), later]
    if has_drift:
        # Of the frequency in the middle: the parabola has no slope there on the mean.
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
        # The jitter with which the residuals are as large as they are.
        jitter = float(
            np.sqrt(max(0.0, float((residuals[kept] ** 2 - errors[kept] ** 2).sum()) / free))
        )
        if abs(jitter - before) <= 1e-3 * max(jitter, _MIN_DEVIATION):
            break
    # Frames agree better than each by itself is sure where a part of their errors is common, such
    # as the sensor's fixed pattern; that part moves the fit all the same.
    scatter = max(1.0, excess)
    if jitter > 0.0 and free > 2:
        scatter *= free / (free - 2.0)  # frames may agree by chance: the variance of Student's t
    covariance = inverse * scatter * _correlated_count(residuals[kept]) / np.outer(scale, scale)
    noise = float(np.sqrt(residuals[kept] @ residuals[kept] / free))
    if has_drift:
        # The phase in the middle is without what the bend's own mean takes off.
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
    """Return the number of neighbouring residuals that count as one, 1 for independent ones."""
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
    """Return the deviation of phases from that of the frame before, free of slow changes."""
    least = float(np.median(errors))
    if len(residuals) < 3:
        return max(least, _MIN_DEVIATION)
    steps = np.abs(np.diff(residuals))
    return max(_SIGMA_OF_MEDIAN / math.sqrt(2.0) * float(np.median(steps)), least, _MIN_DEVIATION)


def _largest_jump(
    residuals: FloatArray, kept: BoolArray, spread: float, jumps: list[int]
) -> int | None:
    """Find the largest jump of the residuals, which lasts: the frames to either side agree."""
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
