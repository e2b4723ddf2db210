"""What is known of a lamp's frequency and a camera's readout time before a film is read."""

from dataclasses import dataclass, replace

from occ_model.errors import ParameterError, quote
from occ_model.results.clock import MeasuredValue
from occ_model.scene.argument_checks import is_number
from occ_model.scene.light_words import CYCLIC_LIGHTS, cycle_frequency
from occ_model.scene.scene import Scene

HALF_CYCLES = 2  # a lamp's phase is counted in half cycles, for which limits in chips are suitable
READOUT_TOLERANCE = 0.05  # relative, of a rough readout time if nothing is known
CRYSTAL_TOLERANCE = 1e-4  # relative, of a clock with a crystal, as that of a camera
MOST_TOLERANCE = 0.5
MOST_SLOW_MOTION = 64  # a film lasts at most so many times as long as its frames took

_UNIFORM = 3.0**-0.5  # standard deviation of a value that has any deviation up to its tolerance
_MAX_READOUT_EXCESS = 1e-3  # fraction of the frame period by which the readout may exceed it
_ERRORS = 4.0  # standard errors by which a range is widened

# Deviations, relative, from the expected values that make one of several solutions less likely:
# a frequency that was stated is mostly exact, a readout time mostly a guess.
_USUAL_FREQUENCY_DEVIATION, _USUAL_READOUT_DEVIATION = 1e-3, 1e-2


@dataclass(frozen=True, slots=True)
class KnownTiming:
    """The expected frequency and readout time, and how far they may be wrong.

    Parameters
    ----------
    frequency
        In chips, or half cycles of a lamp, per second.
    readout_time
        From one column to the next in seconds.
    frequency_tolerance, readout_tolerance
        The largest relative errors; None if the value is only a guess.
    """

    frequency: float
    readout_time: float
    frequency_tolerance: float | None = None
    readout_tolerance: float | None = READOUT_TOLERANCE

    @property
    def without_frequency(self) -> "KnownTiming":
        """The same for a light of another kind than expected."""
        tolerance = self.readout_tolerance or READOUT_TOLERANCE
        return replace(self, frequency_tolerance=None, readout_tolerance=tolerance)

    @property
    def slow_motions(self) -> range:
        """How many times slower than life the film may run: only a known lamp tells that."""
        return range(1, 2 if self.frequency_tolerance is None else MOST_SLOW_MOTION + 1)

    def frequency_range(
        self, step: float, period: MeasuredValue, columns: int
    ) -> tuple[float, float]:
        """Return the lowest and the highest frequency; the lowest is above it if there is none.

        ``step``: chips per column; ``period``: of the frames, in seconds.
        """
        low = step * columns / (period.value * (1.0 + _MAX_READOUT_EXCESS))
        high = float("inf")
        if self.readout_tolerance is not None:
            low = max(low, step / (self.readout_time * (1.0 + self.readout_tolerance)))
            high = step / (self.readout_time * (1.0 - self.readout_tolerance))
        if self.frequency_tolerance is not None:
            tolerance = self.frequency_tolerance + CRYSTAL_TOLERANCE
            tolerance += _ERRORS * period.error / period.value
            low = max(low, self.frequency * (1.0 - tolerance))
            high = min(high, self.frequency * (1.0 + tolerance))
        return low, high

    @property
    def frequency_error(self) -> float:
        """The relative standard deviation of a known frequency."""
        return _UNIFORM * (self.frequency_tolerance or 0.0)

    def join(self, frequency: float, error: float) -> tuple[float, float]:
        """Join a frequency by the film's clock with the known one.

        ``error`` and the second value returned: relative standard deviations.
        """
        if self.frequency_tolerance is None:
            return frequency, error
        weights = (
            self.frequency_error**-2,
            1.0 / (error**2 + (_UNIFORM * CRYSTAL_TOLERANCE) ** 2),
        )
        joined = (weights[0] * self.frequency + weights[1] * frequency) / sum(weights)
        return joined, sum(weights) ** -0.5

    def unlikelihood(self, frequency: float, readout_time: float) -> float:
        """Return how unlikely a solution is by its distance from both expected values."""
        off = (frequency / self.frequency - 1.0) / _USUAL_FREQUENCY_DEVIATION
        readout_off = (readout_time / self.readout_time - 1.0) / _USUAL_READOUT_DEVIATION
        return float((1.0 + off**2) * (1.0 + readout_off**2))


def known_timing(
    scene: Scene, readout_tolerance: float | None, frequency_tolerance: float | None
) -> KnownTiming:
    """Return what a scene and its tolerances say; refuse tolerances out of range."""
    tolerances = {
        "readout_tolerance": readout_tolerance,
        "frequency_tolerance": frequency_tolerance,
    }
    for name, tolerance in tolerances.items():
        if tolerance is None:
            continue
        if not is_number(tolerance) or not 0.0 < tolerance <= MOST_TOLERANCE:
            raise ParameterError.of(name, quote(tolerance), f"above 0 up to {MOST_TOLERANCE:g}")
    if readout_tolerance is None and frequency_tolerance is None:
        readout_tolerance = READOUT_TOLERANCE
    sent = scene.transmitter
    cycles = cycle_frequency(sent) if sent.light in CYCLIC_LIGHTS else None
    frequency = sent.switching_frequency if cycles is None else HALF_CYCLES * cycles
    readout = scene.camera.readout_time
    return KnownTiming(frequency, readout, frequency_tolerance, readout_tolerance)
