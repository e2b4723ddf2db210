"""How long a chip lasts on a board: whole cycles of its clock, in exact arithmetic.

A period that is not a whole number of cycles is rounded, and the error is stated. Spreading the
fraction over the chips would keep the mean frequency, but move single edges by up to half a cycle,
which no photo can be corrected for; a frequency that is known exactly is taken into the scene.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import floor

from occ_model.boards.board import Board
from occ_model.errors import ParameterError
from occ_model.scene.parameters import quantity


@dataclass(frozen=True, slots=True)
class ChipTiming:
    clock: int  # Frequency of the board's clock in Hz
    prescaler: int
    count: int  # How many divided cycles a chip lasts
    asked: Fraction  # The switching frequency asked for, in Hz

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
        """By how much more than asked is sent, in parts per million of the frequency."""
        return (self.frequency / self.asked - 1) * 10**6

    @property
    def is_as_asked(self) -> bool:
        """Whether the frequency is the one asked for, as exactly as a scene can hold it."""
        return float(self.frequency) == float(self.asked)


def best_timing(board: Board, frequency: float) -> ChipTiming:
    """Choose the setting whose frequency is nearest; of several the one with the finest timer."""
    asked = Fraction(frequency)
    if not board.lowest_frequency <= asked <= board.highest_frequency:
        raise _refusal(board, frequency)
    settings = (
        ChipTiming(board.clock, prescaler, count, asked)
        for prescaler in board.prescalers
        for count in _counts(board, prescaler, asked)
    )
    return min(settings, key=lambda timing: (abs(timing.error_ppm), timing.prescaler))


def _counts(board: Board, prescaler: int, asked: Fraction) -> Iterator[int]:
    """Return the whole numbers around the exact count that the board allows."""
    below = floor(board.clock / (prescaler * asked))
    for count in (below, below + 1):
        if 1 <= count <= board.largest_count and prescaler * count >= board.least_cycles:
            yield count


def _refusal(board: Board, frequency: float) -> ParameterError:
    declared = quantity("switching_frequency")
    low, high = float(board.lowest_frequency), float(board.highest_frequency)
    why = board.limit_reason if frequency > high else "the timer counts no longer"
    return ParameterError.of(
        declared.name,
        declared.format(frequency),
        f"{declared.format(low)} to {declared.format(high)}, since {why}",
        condition=f"on {board.title}",
        parameters=(declared.name,),
    )
