"""Durations on a board in whole timer counts: of a chip, or of a lamp's period and lit part."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import floor

from occ_model.boards.board import TransmitterBoard
from occ_model.errors import ParameterError
from occ_model.scene.parameters import quantity


@dataclass(frozen=True, slots=True)
class BoardTiming:
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
    requested = Fraction(frequency)
    if not board.lowest_frequency <= requested <= board.highest_frequency:
        raise _refuse_frequency(
            "switching_frequency", board, frequency, board.lowest_frequency,
            board.highest_frequency, board.limit_reason,
        )  # fmt: skip
    settings = (
        BoardTiming(board.clock, prescaler, count, requested)
        for prescaler in board.prescalers
        for count in _list_counts(board.clock, prescaler, requested)
        if count <= board.largest_count and prescaler * count >= board.least_cycles
    )
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
    requested, timer = Fraction(frequency), board.lamp_timer
    low, high = (
        Fraction(board.clock, cycles)
        for cycles in (
            timer.prescalers[-1] * timer.largest_count, timer.prescalers[0] * timer.least_count
        )
    )  # fmt: skip
    if not low <= requested <= high:
        raise _refuse_frequency(name, board, frequency, low, high, timer.limit_reason)
    timings = []
    for prescaler in timer.prescalers:
        for count in _list_counts(board.clock, prescaler, requested):
            if not timer.least_count <= count <= timer.largest_count:
                continue
            requested_lit_time = lit_time(Fraction(prescaler * count, board.clock))
            nearest = round(requested_lit_time * board.clock / prescaler)
            lit = min(max(nearest, timer.least_part), count - timer.least_part)
            timings.append(
                LampBoardTiming(board.clock, prescaler, count, requested, lit, requested_lit_time)
            )
    return min(
        timings,
        key=lambda timing: (
            abs(timing.error_ppm),
            abs(timing.lit_time - timing.requested_lit_time),
            timing.prescaler,
        ),
    )


def _list_counts(clock: int, prescaler: int, requested: Fraction) -> Iterator[int]:
    """Yield the whole numbers next to the exact count, from 1 on."""
    lower = floor(clock / (prescaler * requested))
    yield from (count for count in (lower, lower + 1) if count >= 1)


def _refuse_frequency(
    name: str,
    board: TransmitterBoard,
    frequency: float,
    low: Fraction,
    high: Fraction,
    reason: str,
) -> ParameterError:
    declared = quantity(name)
    why = reason if frequency > high else "the timer cannot count longer"
    return ParameterError.of(
        declared.name,
        declared.format(frequency),
        f"{declared.format(float(low))} to {declared.format(float(high))}, since {why}",
        condition=f"on {board.title}",
        parameters=(declared.name,),
    )
