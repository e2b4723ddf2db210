"""A microcontroller board: its clock, timer and pin, and the circuit at the pin."""

from dataclasses import dataclass
from fractions import Fraction
from math import log

GATE_CAPACITANCE = 2e-9  # in F, assumed for the MOSFET: common logic-level types have 0.6 to 2 nF
PULL_DOWN = 10_000  # in ohm; keeps the light off while the board starts. 10 to 100 kOhm would do
LED_VOLTS = 2.0  # forward voltage of a single LED in V, assumed to be a red one
LED_CURRENT = 0.010  # current of a single LED in A, half of what common ones bear


@dataclass(frozen=True, slots=True, kw_only=True)
class Timer:
    """How a board times a chip or a lamp's period: ``prescaler * count`` cycles of its clock."""

    prescalers: tuple[int, ...]
    least_count: int
    largest_count: int
    least_part: int = 1  # Fewest counts for the lit and for the dark part of a lamp's period
    limit_reason: str  # Why there must not be fewer counts, as the end of a sentence


@dataclass(frozen=True, slots=True, kw_only=True)
class TransmitterBoard:
    name: str
    title: str
    clock: int  # Frequency in Hz of the clock whose cycles its timers count
    # Largest error of that frequency in parts per million, by the data sheet of its resonator
    clock_error: float
    chip_timer: Timer
    lamp_timer: Timer
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

    def frequency_range(self, timer: Timer) -> tuple[Fraction, Fraction]:
        """Return the lowest and the highest frequency of one of the board's timers, in Hz."""
        most_cycles = timer.prescalers[-1] * timer.largest_count
        least_cycles = timer.prescalers[0] * timer.least_count
        return Fraction(self.clock, most_cycles), Fraction(self.clock, least_cycles)

    @property
    def rise_time(self) -> float:
        """Time in s in which the gate's voltage rises from 10 to 90 %."""
        # An RC low-pass: exp(-t / RC) falls from 0.9 to 0.1.
        return log(9.0) * self.gate_resistor * GATE_CAPACITANCE

    @property
    def led_current(self) -> float:
        """Current in A through the single LED."""
        return (self.volts - LED_VOLTS) / self.led_resistor
