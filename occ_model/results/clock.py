"""The clock of a film: how fast its light switches, and its camera reads out."""

import math
from dataclasses import dataclass, replace
from typing import Self

_AGREEING_ERRORS = 4.0  # standard deviations up to which two values agree


@dataclass(frozen=True, slots=True)
class MeasuredValue:
    """A number with its standard deviation."""

    value: float
    error: float


@dataclass(frozen=True, slots=True)
class ClockSolution:
    """The values of one clock that fits a film.

    Times are by the clock that stamps the frames, or, where the lamp's frequency is known, by the
    lamp's and the camera's clock together. Errors are standard deviations.

    Parameters
    ----------
    switching_frequency
        In Hz, at the middle of the film.
    readout_time
        From one column to the next in seconds: chips a column over chips a second.
    frame_period
        From one frame to the next, in seconds.
    gap
        The part of the frame period in which no column starts its exposure, in seconds.
    slow_motion
        How many times longer the film's stated times are.
    """

    switching_frequency: MeasuredValue
    readout_time: MeasuredValue
    frame_period: MeasuredValue
    gap: MeasuredValue
    slow_motion: int


@dataclass(frozen=True, slots=True)
class Clock(ClockSolution):
    """The clock of a film, from the phases of the stripes and the frames' times.

    Parameters
    ----------
    drift
        The change of the frequency in Hz a second; None if there are too few frames to measure it.
    timing_noise
        Root mean square difference of the frames' starts from equal steps or, where these explain
        them better, from their time stamps, in seconds; None if the phases fit no clock, so that
        all times rest on the lamp's known frequency.
    frames
        Number of frames whose phase was used.
    spacing
        How far apart in Hz the switching frequencies are that fit the frames equally well,
        whatever is known; None if the frames do not come in equal steps.
    chips_a_frame
        Chips sent in a frame period, up to the whole periods that ``spacing`` leaves open; None if
        the frames do not come in equal steps.
    phase, repeated_chips
        Chips sent at the film's time 0, in the middle of the exposure of column 0, up to whole
        periods of ``repeated_chips``; None if the phases fit no clock.
    alternatives
        Other clocks that fit equally well and that what is known does not exclude.
    problems
        Sentences on contradictions in the frames' times or phases, and on uncertainties.
    chips_of_cycle
        Number of chips in a cycle of the filmed lamp; 0 for a code.
    """

    drift: MeasuredValue | None
    timing_noise: float | None
    frames: int
    spacing: float | None = None
    chips_a_frame: MeasuredValue | None = None
    phase: MeasuredValue | None = None
    repeated_chips: float = 0.0
    alternatives: tuple[ClockSolution, ...] = ()
    problems: tuple[str, ...] = ()
    chips_of_cycle: int = 0

    def widen_readout(self, relative_error: float, columns: int) -> Self:
        """Add an error to the readout time, and to the gap, which follows some columns."""
        readout, gap = self.readout_time, self.gap
        added = relative_error * readout.value
        return replace(
            self,
            readout_time=MeasuredValue(readout.value, math.hypot(readout.error, added)),
            gap=MeasuredValue(gap.value, math.hypot(gap.error, columns * added)),
        )

    @property
    def lamp_frequency(self) -> MeasuredValue | None:
        """The frequency of the filmed lamp, in Hz; None for a code."""
        return self._divide_by_cycle(self.switching_frequency)

    @property
    def lamp_drift(self) -> MeasuredValue | None:
        """The change of the lamp's frequency in Hz a second; None for a code, or if unknown."""
        return None if self.drift is None else self._divide_by_cycle(self.drift)

    @property
    def beat(self) -> MeasuredValue | None:
        """How often in Hz a lamp's stripes pass through the frames, positive if the lamp is fast.

        None for a code, or if the frames do not come in equal steps.
        """
        if not self.chips_of_cycle or self.chips_a_frame is None:
            return None
        cycles = self.chips_a_frame.value / self.chips_of_cycle
        period = self.frame_period.value
        beat = (cycles - round(cycles)) / period
        return MeasuredValue(beat, self.chips_a_frame.error / self.chips_of_cycle / period)

    def offset_of(self, other: "Clock") -> MeasuredValue | None:
        """Return the time of another film when this one's time is 0, in seconds.

        It is known up to whole periods of what both films show, which last ``repeat_time``. The
        time of a frame is that of the middle of the exposure of column 0, and that of the first
        frame is 0. None if either clock is not sure.
        """
        if self.phase is None or other.phase is None or not (self.is_sure and other.is_sure):
            return None
        frequency = other.switching_frequency
        chips = (self.phase.value - other.phase.value) % self.repeated_chips
        errors = self.phase.error, other.phase.error, chips * frequency.error / frequency.value
        return MeasuredValue(chips / frequency.value, math.hypot(*errors) / frequency.value)

    @property
    def repeat_time(self) -> float:
        """How long what is sent takes before it repeats, in seconds."""
        return self.repeated_chips / self.switching_frequency.value

    def _divide_by_cycle(self, chip_rate: MeasuredValue) -> MeasuredValue | None:
        chips = self.chips_of_cycle
        return MeasuredValue(chip_rate.value / chips, chip_rate.error / chips) if chips else None

    @property
    def is_sure(self) -> bool:
        """Whether the phases fit this clock, and no other one equally well."""
        return not self.alternatives and self.timing_noise is not None

    def is_sure_of(self, name: str) -> bool:
        """Return whether all clocks that fit agree on a value within its error."""
        if self.timing_noise is None:
            return False
        value: MeasuredValue = getattr(self, name)
        bound = _AGREEING_ERRORS * value.error
        others: list[MeasuredValue] = [getattr(other, name) for other in self.alternatives]
        return all(abs(other.value - value.value) <= bound for other in others)

    @property
    def gap_ratio(self) -> float:
        """The gap as a fraction of the frame period."""
        return self.gap.value / self.frame_period.value
