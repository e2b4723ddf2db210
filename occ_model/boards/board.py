"""A board: its clock, its timer, its pin, what of it is assumed, and the circuit behind the pin."""

from dataclasses import dataclass
from fractions import Fraction
from math import log


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


_E12 = (10, 12, 15, 18, 22, 27, 33, 39, 47, 56, 68, 82)  # of resistors: IEC 60063
GATE_CAPACITANCE = 2e-9  # of the MOSFET, in F; assumed: common logic-level types have 0.6 to 2 nF
PULL_DOWN = 10_000  # ohm, keeps the light off while the board starts; 10 to 100 kOhm would do
LED_VOLTS = 2.0  # forward voltage of a single LED, in V; assumed: that of a red one
LED_CURRENT = 0.010  # current of a single LED, in A; assumed: half of what common ones bear


@dataclass(frozen=True, slots=True)
class Wiring:
    # In ohm: limits the current that charges the MOSFET's gate to what the pin may give
    gate_resistor: int
    pull_down: int  # In ohm, from the gate to ground
    rise_time: float  # Time in s that the gate's voltage takes from 10 to 90 %
    led_resistor: int  # In ohm, for a single LED at the pin in place of MOSFET and panel
    led_current: float  # The current in A through that LED


def wiring(board: Board) -> Wiring:
    gate = next_resistor(board.volts / board.pin_current)
    led = next_resistor((board.volts - LED_VOLTS) / LED_CURRENT)
    return Wiring(
        gate_resistor=gate,
        pull_down=PULL_DOWN,
        # An RC low-pass: exp(-t / RC) falls from 0.9 to 0.1.
        rise_time=log(9.0) * gate * GATE_CAPACITANCE,
        led_resistor=led,
        led_current=(board.volts - LED_VOLTS) / led,
    )


def next_resistor(ohms: float) -> int:
    """Return the smallest resistor of the series E12 that is not below a value from 10 ohm."""
    decade = 1
    while True:
        for value in _E12:
            if value * decade >= ohms * (1 - 1e-12):
                return value * decade
        decade *= 10
