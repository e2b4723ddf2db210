"""How long a board lets a chip, or a lamp's period and its lit part, last: whole timer counts."""

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
    asked: Fraction  # The requested switching frequency, in Hz

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
        return (self.frequency / self.asked - 1) * 10**6


@dataclass(frozen=True, slots=True)
class LampTiming(BoardTiming):
    """The same of a lamp: divided cycles for a period, and those of them in which it is lit."""

    lit_count: int
    lit_asked: Fraction  # The requested time in s for which it is lit in each such period

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
    """Choose the timer's setting with the nearest frequency; among equals the finest timer."""
    asked = Fraction(frequency)
    if not board.lowest_frequency <= asked <= board.highest_frequency:
        raise _refuse_frequency(
            "switching_frequency", board, frequency, board.lowest_frequency,
            board.highest_frequency, board.limit_reason,
        )  # fmt: skip
    settings = (
        BoardTiming(board.clock, prescaler, count, asked)
        for prescaler in board.prescalers
        for count in _list_counts(board.clock, prescaler, asked)
        if count <= board.largest_count and prescaler * count >= board.least_cycles
    )
    return min(settings, key=lambda timing: (abs(timing.error_ppm), timing.prescaler))


def choose_lamp_timing(
    board: TransmitterBoard,
    name: str,
    frequency: float,
    lit_time: Callable[[Fraction], Fraction],
) -> LampTiming:
    """Choose the timer's setting with a lamp's nearest frequency, and then the nearest lit time.

    ``name`` is that of the frequency's parameter; ``lit_time`` gives the time asked for in s in a
    period in s.
    """
    asked, timer = Fraction(frequency), board.lamp_timer
    low, high = (
        Fraction(board.clock, cycles)
        for cycles in (
            timer.prescalers[-1] * timer.largest_count, timer.prescalers[0] * timer.least_count
        )
    )  # fmt: skip
    if not low <= asked <= high:
        raise _refuse_frequency(name, board, frequency, low, high, timer.limit_reason)
    found = []
    for prescaler in timer.prescalers:
        for count in _list_counts(board.clock, prescaler, asked):
            if not timer.least_count <= count <= timer.largest_count:
                continue
            wanted = lit_time(Fraction(prescaler * count, board.clock))
            exact = round(wanted * board.clock / prescaler)
            lit = min(max(exact, timer.least_part), count - timer.least_part)
            found.append(LampTiming(board.clock, prescaler, count, asked, lit, wanted))
    return min(
        found,
        key=lambda one: (abs(one.error_ppm), abs(one.lit_time - one.lit_asked), one.prescaler),
    )


def _list_counts(clock: int, prescaler: int, asked: Fraction) -> Iterator[int]:
    """Yield the whole numbers next to the exact count, from 1 on."""
    below = floor(clock / (prescaler * asked))
    yield from (count for count in (below, below + 1) if count >= 1)


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
