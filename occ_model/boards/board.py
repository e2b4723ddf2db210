"""A microcontroller board: its clock, timer and pin, and the circuit at the pin."""

from dataclasses import dataclass
from fractions import Fraction
from math import log

GATE_CAPACITANCE = 2e-9  # in F, assumed for the MOSFET: common logic-level types have 0.6 to 2 nF
PULL_DOWN = 10_000  # in ohm; keeps the light off while the board starts. 10 to 100 kOhm would do
LED_VOLTS = 2.0  # forward voltage of a single LED in V, assumed to be a red one
LED_CURRENT = 0.010  # current of a single LED in A, half of what common ones bear


@dataclass(frozen=True, slots=True, kw_only=True)
class LampTimer:
    """How a board blinks a lamp: ``prescaler * count`` cycles of its clock a period."""

    prescalers: tuple[int, ...]
    least_count: int
    largest_count: int
    least_part: int  # Fewest counts for the lit and for the dark part
    limit_reason: str  # Why there must not be fewer for a period, as the end of a sentence


@dataclass(frozen=True, slots=True, kw_only=True)
class TransmitterBoard:
    """A microcontroller board; a chip lasts ``prescaler * count`` cycles of its clock."""

    name: str
    title: str
    clock: int  # Frequency in Hz of the clock whose cycles its timer counts
    # Largest error of that frequency in parts per million, by the data sheet of its resonator
    clock_error: float
    prescalers: tuple[int, ...]
    largest_count: int  # Largest number of divided cycles that the timer can count
    least_cycles: int  # Fewest cycles of the clock for a chip
    limit_reason: str  # Why there must not be fewer, as the end of a sentence
    lamp_timer: LampTimer
    # The board's labels of the pin that blinks and of its ground
    pin: str
    ground: str
    volts: float  # Voltage of the pin when lit
    pin_current: float  # Current in A that the pin may give
    # Resistors in ohm, rounded up to the series E12: one limits the current into the MOSFET's gate
    # to what the pin may give, the other the current of a single LED in place of MOSFET and panel
    gate_resistor: int
    led_resistor: int
    transistor: str  # A MOSFET that this voltage switches on fully
    table_bytes: int  # Memory for the packet in bytes
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
        """Time in s in which the gate's voltage rises from 10 to 90 %."""
        # An RC low-pass: exp(-t / RC) falls from 0.9 to 0.1.
        return log(9.0) * self.gate_resistor * GATE_CAPACITANCE

    @property
    def led_current(self) -> float:
        """Current in A through the single LED."""
        return (self.volts - LED_VOLTS) / self.led_resistor
