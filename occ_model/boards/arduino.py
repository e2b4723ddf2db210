"""Sketches for Arduino boards with an ATmega328P, where a timer's compare output sets the pin.

During each chip, an interrupt only tells the timer what to do at the chip's end. Edges are thus
exact to a cycle of the clock, however late the interrupt runs.
"""

from dataclasses import replace
from string import Template

from occ_model.boards.board import Timer, TransmitterBoard
from occ_model.boards.chip_table import c_table, head_comment
from occ_model.boards.transmission import LampTransmission, Transmission
from occ_model.scene.units import HERTZ

_CLOCK_SELECT = {  # bits of TCCR1B by prescaler: ATmega328P data sheet, table 16-5
    1: "_BV(CS10)",
    8: "_BV(CS11)",
    64: "_BV(CS11) | _BV(CS10)",
    256: "_BV(CS12)",
    1024: "_BV(CS12) | _BV(CS10)",
}

UNO = TransmitterBoard(
    name="arduino-uno",
    title="Arduino Uno",
    clock=16_000_000,
    # The Uno has a ceramic resonator, with 0.5 %.
    clock_error=5000.0,
    chip_timer=Timer(
        prescalers=tuple(_CLOCK_SELECT),
        least_count=128,
        largest_count=65_536,
        limit_reason="its interrupt takes about 100 of the clock's cycles for each chip",
    ),
    # In fast PWM the timer counts from 0 to TOP, which is at least 3 (data sheet, 16.9.3).
    lamp_timer=Timer(
        prescalers=tuple(_CLOCK_SELECT),
        least_count=4,
        largest_count=65_536,
        limit_reason="its timer counts at least 4 cycles",
    ),
    pin="pin 9",
    ground="GND",
    volts=5.0,
    pin_current=0.020,
    gate_resistor=270,
    led_resistor=330,
    transistor="IRLZ44N",
    table_bytes=8_191,
    language="C++",
    ending=".ino",
)
"""Chips are counted in 16 bits, and their table takes at most a third of the flash memory.

Measured in simavr, the interrupt takes up to 99 cycles, and edges are lost with fewer than 90. The
rest of the chip timer's ``least_count`` is left for waking up and for the code of other compilers.
"""

NANO = replace(UNO, name="arduino-nano", title="Arduino Nano")

_SKETCH = Template("""\
$head

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>

// The packet, eight chips to a byte: the first chip is the highest bit of the first byte, and a 1
// is light. PROGMEM leaves it in flash memory, which has sixteen times the room of the RAM.
const uint16_t CHIPS = $chips;
const uint8_t PACKET[] PROGMEM = {
$table
};

// Timer 1 counts $ticks.
// It counts from 0 to TOP and then starts again: a chip lasts TOP + 1 counts.
const uint8_t CLOCK_SELECT = $clock_select;
const uint16_t TOP = $count - 1;

// What the timer can do to $pin, which is its output OC1A, when it has counted to TOP.
const uint8_t MAKE_DARK = _BV(COM1A1);
const uint8_t MAKE_LIT = _BV(COM1A1) | _BV(COM1A0);

// The timer has just switched the pin, and a chip begins. While it lasts, tell the timer what to do
// at its end. The edges come from the timer and not from here: they are exact to one cycle of the
// clock, even when this interrupt is late.
ISR(TIMER1_COMPA_vect) {
  static uint16_t chip = 0;
  static uint8_t bits = 0;
  if (chip % 8 == 0) bits = pgm_read_byte(&PACKET[chip / 8]);
  TCCR1A = (bits & 0x80) ? MAKE_LIT : MAKE_DARK;
  bits <<= 1;
  if (++chip == CHIPS) chip = 0;
}

void setup() {
  cli();
  TIMSK0 = 0;                          // no other interrupts: millis() and delay() stand still
  DDRB |= _BV(DDB1);                   // $pin is an output
  TCCR1B = _BV(WGM12);                 // count to TOP and start again ("CTC"); not running yet
  TCCR1A = MAKE_DARK;
  OCR1A = TOP;
  TCNT1 = 0;
  TIMSK1 = _BV(OCIE1A);                // interrupt whenever TOP is reached
  TCCR1B = _BV(WGM12) | CLOCK_SELECT;  // go
  set_sleep_mode(SLEEP_MODE_IDLE);     // asleep, the processor stops and the timers go on
  sleep_enable();
  sei();
}

void loop() { sleep_cpu(); }
""")


_LAMP_SKETCH = Template("""\
$head

#include <avr/interrupt.h>
#include <avr/io.h>

// Timer 1 counts $ticks.
// It counts from 0 to TOP and then starts again: a period lasts TOP + 1 counts. Its output OC1A,
// $pin, is lit from 0 on until it has counted COMPARE + 1 of them ("fast PWM", mode 14).
const uint8_t CLOCK_SELECT = $clock_select;
const uint16_t TOP = $count - 1;
const uint16_t COMPARE = $lit - 1;

void setup() {
  cli();
  TIMSK0 = 0;                          // no interrupts: millis() and delay() stand still
  TIMSK1 = 0;
  TCCR1A = 0;                          // not running, and not yet comparing
  TCCR1B = 0;
  OCR1A = COMPARE;
  TCCR1A = _BV(COM1A1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12);
  ICR1 = TOP;                          // it can be written only in such a mode
  TCNT1 = 0;
  DDRB |= _BV(DDB1);                   // $pin is an output
  TCCR1B = _BV(WGM13) | _BV(WGM12) | CLOCK_SELECT;  // go
}

void loop() {}
""")


def arduino_sketch(transmission: Transmission) -> str:
    """Write the sketch in C++ for the Arduino IDE, or for avr-g++ with a ``main`` added."""
    timing = transmission.timing
    clock = f"the cycles of the {HERTZ.format(timing.clock)} clock"
    words: dict[str, object] = {
        "head": head_comment(transmission, "//"),
        "ticks": clock if timing.prescaler == 1 else f"every {timing.prescaler}th of {clock}",
        "clock_select": _CLOCK_SELECT[timing.prescaler],
        "count": timing.count,
        "pin": transmission.board.pin,
    }
    if isinstance(transmission, LampTransmission):
        return _LAMP_SKETCH.substitute(words, lit=transmission.timing.lit_count)
    return _SKETCH.substitute(
        words, chips=len(transmission.chips), table=c_table(transmission.chips)
    )
