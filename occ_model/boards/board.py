"""The declaration of a board: its clock, its timer, its pin, and what of it is assumed."""

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Board:
    """A microcontroller board: a chip lasts ``prescaler * count`` whole cycles of its clock."""

    name: str
    title: str
    clock: int  # Frequency in Hz of the clock that its timer counts
    # How far that frequency may be off, in parts per million, by the data sheet of what makes it
    clock_error: float
    prescalers: tuple[int, ...]
    largest_count: int  # The largest number of divided cycles that it counts for a chip
    least_cycles: int  # Fewest cycles of the clock for a chip
    limit_reason: str  # Why fewer are not allowed, as the end of a sentence
    # The labels on the board of the pin that blinks and of its ground
    pin: str
    ground: str
    volts: float  # Voltage of the pin when lit
    pin_current: float  # Current in A that the pin may give
    transistor: str  # A MOSFET that this voltage switches on wholly
    table_bytes: int  # Room for the packet, in bytes
    language: str
    ending: str

    @property
    def most_cycles(self) -> int:
        return self.prescalers[-1] * self.largest_count

    @property
    def highest_frequency(self) -> Fraction:
        return Fraction(self.clock, self.least_cycles)

    @property
    def lowest_frequency(self) -> Fraction:
        return Fraction(self.clock, self.most_cycles)
