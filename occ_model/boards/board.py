"""A board: its clock, its timer, its pin, what of it is assumed, and the circuit behind the pin."""

from dataclasses import dataclass
from fractions import Fraction
from math import log

GATE_CAPACITANCE = 2e-9  # of the MOSFET, in F; assumed: common logic-level types have 0.6 to 2 nF
PULL_DOWN = 10_000  # ohm, keeps the light off while the board starts; 10 to 100 kOhm would do
LED_VOLTS = 2.0  # forward voltage of a single LED, in V; assumed: that of a red one
LED_CURRENT = 0.010  # current of a single LED, in A; assumed: half of what common ones bear


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
    # The next resistors of the series E12, in ohm: the one limits the current that charges the
    # MOSFET's gate to what the pin may give, the other that of a single LED in place of MOSFET and
    # panel
    gate_resistor: int
    led_resistor: int
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

    @property
    def rise_time(self) -> float:
        """Time in s that the gate's voltage takes from 10 to 90 %."""
        # An RC low-pass: exp(-t / RC) falls from 0.9 to 0.1.
        return log(9.0) * self.gate_resistor * GATE_CAPACITANCE

    @property
    def led_current(self) -> float:
        """Current in A through the single LED."""
        return (self.volts - LED_VOLTS) / self.led_resistor
