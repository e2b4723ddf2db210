"""Durations on a board in whole timer counts: of a chip, or of a lamp's period and lit part."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import floor

from occ_model.boards.board import Timer, TransmitterBoard
from occ_model.errors import ParameterError
from occ_model.scene.parameters import quantity


@dataclass(frozen=True, slots=True)
class BoardTiming:
    """A timer's setting for a chip, and the frequency that was requested."""

    clock: int  # Frequency of the board's clock in Hz
    prescaler: int
    count: int  # Divided cycles for a chip
    requested_frequency: Fraction  # The requested switching frequency, in Hz

    @property
    def cycles(self) -> int:
        return self.prescaler * self.count

    @property
    def frequency(self) -> Fraction:
        """The switching frequency that is sent, in Hz."""
        return Fraction(self.clock, self.cycles)

    @property
    def period(self) -> Fraction:
        return Fraction(self.cycles, self.clock)

    @property
    def error_ppm(self) -> Fraction:
        """Relative error of the frequency in parts per million, positive if it is too high."""
        return (self.frequency / self.requested_frequency - 1) * 10**6


@dataclass(frozen=True, slots=True)
class LampBoardTiming(BoardTiming):
    """Timing of a lamp: divided cycles of its period, and of its lit part."""

    lit_count: int
    requested_lit_time: Fraction  # The requested time in s for which it is lit in each such period

    @property
    def duty(self) -> Fraction:
        return Fraction(self.lit_count, self.count)

    @property
    def lit_cycles(self) -> int:
        return self.prescaler * self.lit_count

    @property
    def lit_time(self) -> Fraction:
        """Time in s for which the lamp is lit in each period."""
        return Fraction(self.lit_cycles, self.clock)


def choose_timing(board: TransmitterBoard, frequency: float) -> BoardTiming:
    """Choose the timer's setting with the nearest frequency; among equals the finest counts."""
    settings = _list_settings(board, board.chip_timer, "switching_frequency", frequency)
    return min(settings, key=lambda timing: (abs(timing.error_ppm), timing.prescaler))


def choose_lamp_timing(
    board: TransmitterBoard,
    name: str,
    frequency: float,
    lit_time: Callable[[Fraction], Fraction],
) -> LampBoardTiming:
    """Choose the timer's setting with a lamp's nearest frequency, and then the nearest lit time.

    ``name`` is that of the frequency's parameter; ``lit_time`` returns the requested
    lit time in s for a period in s.
    """
    timer, timings = board.lamp_timer, []
    for setting in _list_settings(board, timer, name, frequency):
        requested = lit_time(setting.period)
        nearest = round(requested * board.clock / setting.prescaler)
        lit = min(max(nearest, timer.least_part), setting.count - timer.least_part)
        timings.append(
            LampBoardTiming(
                board.clock, setting.prescaler, setting.count, setting.requested_frequency,
                lit, requested,
            )
        )  # fmt: skip
    return min(
        timings,
        key=lambda timing: (
            abs(timing.error_ppm),
            abs(timing.lit_time - timing.requested_lit_time),
            timing.prescaler,
        ),
    )


def _list_settings(
    board: TransmitterBoard, timer: Timer, name: str, frequency: float
) -> list[BoardTiming]:
    """List a timer's settings next to a frequency; refuse one that it cannot reach."""
    requested = Fraction(frequency)
    low, high = board.frequency_range(timer)
    if not low <= requested <= high:
        declared = quantity(name)
        why = timer.limit_reason if requested > high else "the timer cannot count longer"
        raise ParameterError.of(
            name,
            declared.format(frequency),
            f"{declared.format(float(low))} to {declared.format(float(high))}, since {why}",
            condition=f"on {board.title}",
            parameters=(name,),
        )
    lower_counts = {each: floor(board.clock / (each * requested)) for each in timer.prescalers}
    return [
        BoardTiming(board.clock, prescaler, count, requested)
        for prescaler, lower in lower_counts.items()
        for count in (lower, lower + 1)
        if timer.least_count <= count <= timer.largest_count
    ]
