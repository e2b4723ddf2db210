"""The declaration of a board: its clock, its timer, its pin, and what of it is assumed."""

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Board:
    """A microcontroller board, as far as its blinking depends on it.

    A chip lasts ``prescaler * count`` cycles of the clock, both whole numbers: every edge is then a
    whole number of cycles after the one before.

    Parameters
    ----------
    clock
        Frequency in Hz of the clock that its timer counts.
    clock_error
        How far that frequency may be off, in parts per million, by the data sheet of what makes it.
    largest_count
        The largest number of divided cycles that it counts for a chip.
    least_cycles
        Fewest cycles of the clock for a chip.
    limit_reason
        Why fewer are not allowed, as the end of a sentence.
    pin, ground
        The labels on the board of the pin that blinks and of its ground.
    volts
        Voltage of the pin when lit.
    pin_current
        Current in A that the pin may give.
    transistor
        A MOSFET that this voltage switches on wholly.
    table_bytes
        Room for the packet, in bytes.
    """

    name: str
    title: str
    clock: int
    clock_error: float
    prescalers: tuple[int, ...]
    largest_count: int
    least_cycles: int
    limit_reason: str
    pin: str
    ground: str
    volts: float
    pin_current: float
    transistor: str
    table_bytes: int
    language: str
    ending: str

    @property
    def most_cycles(self) -> int:
        """Most cycles of the clock for a chip."""
        return self.prescalers[-1] * self.largest_count

    @property
    def highest_frequency(self) -> Fraction:
        """Highest switching frequency in Hz."""
        return Fraction(self.clock, self.least_cycles)

    @property
    def lowest_frequency(self) -> Fraction:
        """Lowest switching frequency in Hz."""
        return Fraction(self.clock, self.most_cycles)
