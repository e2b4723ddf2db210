"""The phases of frames, and the clock that was fitted to them."""

import math
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import BoolArray, FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class Phases:
    """What frames say of the clock, in the order of time."""

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
        """Return the standard deviation of a foretold phase at a time, in chips."""
        later = time - self.middle
        drifted = 0.5 * self.drift_error * later**2
        error = np.hypot(np.hypot(self.noise, self.frequency_error * later), drifted)
        # Few frames may agree by chance.
        return float(error) * (1.0 + 3.0 / max(int(self.kept.sum()) - 3, 1))


def mean_step(phases: Phases) -> tuple[float, float]:
    """Return the weighted mean of the chips a column, and its deviation by the frames' scatter."""
    weights = 1.0 / np.maximum(phases.step_errors, 1e-12) ** 2
    # A single frame that is surer than all others may be so by mistake.
    weights = np.minimum(weights, 4.0 * float(np.median(weights)))
    total = float(weights.sum())
    mean = float(weights @ phases.steps / total)
    squares = float(weights**2 @ (phases.steps - mean) ** 2) / total**2
    count = len(weights)
    stated = float(weights**2 @ phases.step_errors**2) / total**2
    if count < 4:
        return mean, float(math.sqrt(max(stated, squares)))
    return mean, float(math.sqrt(squares * count / (count - 1)))
