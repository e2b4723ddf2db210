"""An Arduino Uno in simavr: compiles a sketch by avr-g++, runs it, and records the pin's edges."""

import shutil
import subprocess
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

import occ_model as occ
from occ_model.arrays import IndexArray
from occ_model.boards.sketch import write_sketch
from occ_model.boards.transmission import Transmission

PIN_IN_PORT_B = 1  # OC1A, pin 9 of the board

_TRACE = Path(__file__).with_name("pin_trace.c")
_HEADER = Path("/usr/include/simavr/sim_avr.h")
_MAIN = """\
void setup();
void loop();
#include "{sketch}"

ISR(TIMER0_OVF_vect) {{
  for (volatile uint8_t turn = 0; turn < 20; ++turn) {{
  }}
}}

int main() {{
  sei();
  TCCR0A = _BV(WGM01) | _BV(WGM00);
  TCCR0B = _BV(CS01) | _BV(CS00);
  TIMSK0 = _BV(TOIE0);
  TCCR1B = _BV(CS11) | _BV(CS10);
  TCCR1A = _BV(WGM10);
  for (volatile uint16_t turn = 0; turn < 999; ++turn) {{
  }}
  setup();
  for (;;) loop();
}}
"""
"""A main() that sets up the processor as the Arduino core does: timer 0 interrupts, timer 1 PWM."""


def missing_tools() -> str:
    """Name what is missing here to run an AVR program; '' if nothing is."""
    programs = [name for name in ("avr-g++", "avr-size", "gcc") if shutil.which(name) is None]
    headers = [] if _HEADER.is_file() else [str(_HEADER)]
    return ", ".join([*programs, *headers])


def run(*command: str | Path) -> str:
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@dataclass(frozen=True)
class Trace:
    """Edges of the pin: cycles of the clock, shape (edges,), and the levels after them.

    Also the cycles of the longest interrupt, from its first instruction to its last.
    """

    cycles: IndexArray
    levels: IndexArray
    longest_interrupt: int


class SimulatedUno:
    """Compiles and runs sketches in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._trace = folder / "pin_trace"
        run("gcc", "-O1", "-Wall", "-Werror", _TRACE, "-o", self._trace, "-lsimavr", "-lelf")

    def build(self, source: str) -> Path:
        """Compile a sketch as the Arduino IDE does, which adds the functions' declarations."""
        sketch, program = self.folder / "sketch.ino", self.folder / "sketch.elf"
        sketch.write_text(source)
        main = self.folder / "main.cpp"
        main.write_text(_MAIN.format(sketch=sketch.name))
        warnings = ("-Wall", "-Wextra", "-Werror")
        run("avr-g++", "-std=gnu++11", *warnings, "-Os", "-mmcu=atmega328p", main, "-o", program)
        return program

    def flash_bytes(self, source: str) -> int:
        """Count the bytes of flash memory that a sketch takes."""
        text, data = run("avr-size", self.build(source)).splitlines()[1].split()[:2]
        return int(text) + int(data)

    def edges(self, sent: Transmission, packets: int) -> Trace:
        """Run a sketch until the pin has the edges of some packets, or for twice their time."""
        program = self.build(write_sketch(sent))
        count = len(expected_edges(sent, packets)[0])
        most = 2 * (packets + 1) * len(sent.chips) * sent.timing.cycles + 10**6
        lines = run(self._trace, program, str(PIN_IN_PORT_B), str(count), str(most)).split()
        numbers = np.array(lines, dtype=np.int64).reshape(-1, 2)
        return Trace(numbers[:-1, 0], numbers[:-1, 1], int(numbers[-1, 0]))


def expected_edges(sent: Transmission, packets: int) -> tuple[IndexArray, IndexArray]:
    """Return the chips at which the light of some packets changes, starting dark, and the
    levels."""
    chips = np.tile(occ.packet(sent.scene), packets).astype(np.int64)
    places = np.flatnonzero(np.diff(chips, prepend=0))
    return places, chips[places]


def worst_error(sent: Transmission, trace: Trace, packets: int) -> Fraction:
    """Measure the largest error of an edge in chips; the first edge is time zero.

    Fails if an edge is missing, of the wrong kind, or off by more than half a chip.
    """
    places, levels = expected_edges(sent, packets)
    np.testing.assert_array_equal(trace.levels, levels)
    wanted = (places - places[0]) * sent.timing.cycles
    found = trace.cycles - trace.cycles[0]
    worst = int(np.abs(found - wanted).max())
    assert 2 * worst < sent.timing.cycles, f"an edge is {worst} cycles off: it is another chip's"
    return Fraction(worst, sent.timing.cycles)
