"""The Pico's program, run with stand-ins for MicroPython's modules: it sends the packet.

The stand-in counts the cycles of the state machine's one instruction as the RP2040's data sheet
does: one, and its delay.
"""

import sys
import tracemalloc
from collections.abc import Callable
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.boards.pico import PICO
from occ_model.boards.sketch import write_sketch
from occ_model.boards.transmission import Transmission, count_table_bytes, prepare_transmission

PAPER = occ.load_preset("phone-68us")

SCENES = {
    "paper": PAPER.replace(switching_frequency=14.7e3),
    "prime number of chips": PAPER.replace(pattern="1101000"),
    "whole words": PAPER.replace(pattern="1101000110010111" * 4),
    "slow": PAPER.replace(switching_frequency=100.0),
    "fast": PAPER.replace(switching_frequency=1e6),
    "long": PAPER.replace(payload="text:" + "Photograph me. " * 30, line_code="4b6b"),
}

_TURNS = 3  # how often the program's endless loop may fill the queue

_DIVIDER = 0x502000C8


class Ended(Exception):  # noqa: N818 - no error
    """The loop has run often enough."""


class Instruction:
    """The instruction ``out``, with the delay that brackets add."""

    def __init__(self, pins: object, count: int) -> None:
        assert pins == "pins"
        self.count, self.delay = count, 0

    def __getitem__(self, delay: int) -> "Instruction":
        assert 0 <= delay <= 31
        self.delay = delay
        return self


class Machine:
    """What the program has done: instructions, words sent, registers, clock."""

    def __init__(self) -> None:
        self.program: list[Instruction] = []
        self.settings: dict[str, object] = {}
        self.words: list[int] = []
        self.registers: dict[int, int] = {}
        self.clock, self.pin, self.running, self.turns = 0, None, False, 0

    def modules(self) -> dict[str, ModuleType]:
        machine, rp2 = ModuleType("machine"), ModuleType("rp2")
        machine.freq = self._freq  # type: ignore[attr-defined]
        machine.mem32 = self.registers  # type: ignore[attr-defined]
        machine.Pin = lambda number: number  # type: ignore[attr-defined]
        rp2.PIO = SimpleNamespace(  # type: ignore[attr-defined]
            OUT_LOW="low", SHIFT_LEFT="left", JOIN_TX="tx"
        )
        rp2.asm_pio = self._asm_pio  # type: ignore[attr-defined]
        rp2.StateMachine = self._state_machine  # type: ignore[attr-defined]
        return {"machine": machine, "rp2": rp2}

    def _freq(self, hertz: int) -> None:
        self.clock = hertz

    def _asm_pio(self, **settings: object) -> Callable[[Callable[[], None]], object]:
        self.settings = settings

        def assemble(program: Callable[[], None]) -> object:
            names = program.__globals__
            names["pins"] = "pins"
            names["out"] = lambda pins, count: self._add(Instruction(pins, count))
            program()
            del names["pins"], names["out"]
            return self.program

        return assemble

    def _add(self, instruction: Instruction) -> Instruction:
        self.program.append(instruction)
        return instruction

    def _state_machine(self, number: int, program: object, out_base: Any) -> SimpleNamespace:
        assert number == 0, "the divider's register is that of state machine 0"
        assert program is self.program
        self.pin = out_base
        return SimpleNamespace(active=self._active, put=self._put)

    def _active(self, on: bool) -> None:
        assert _DIVIDER in self.registers, "the divider is set before it runs"
        self.running = on

    def _put(self, words: Any) -> None:
        assert self.running
        assert words.itemsize == 4
        self.words += words.tolist()
        self.turns += 1
        if self.turns == _TURNS:
            raise Ended


@pytest.fixture(params=SCENES)
def sent(request: pytest.FixtureRequest) -> Transmission:
    return prepare_transmission(SCENES[request.param], PICO)


def run_program(
    source: str, monkeypatch: pytest.MonkeyPatch, machine: Machine | None = None
) -> Machine:
    """Run a program for some turns of its loop."""
    machine = machine or Machine()
    for name, module in machine.modules().items():
        monkeypatch.setitem(sys.modules, name, module)
    with pytest.raises(Ended):
        exec(compile(source, "main.py", "exec"), {"__name__": "__main__"})
    return machine


def test_the_state_machine_sends_packets_end_to_end(
    sent: Transmission, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = run_program(write_sketch(sent), monkeypatch)
    assert machine.settings["out_shiftdir"] == "left"
    assert (machine.settings["autopull"], machine.settings["pull_thresh"]) == (True, 32)
    # Shifted out to the left, the highest bit of a word first.
    levels = [word >> place & 1 for word in machine.words for place in range(31, -1, -1)]
    assert len(levels) % len(sent.chips) == 0, "the loop ends with a whole packet"
    np.testing.assert_array_equal(levels, np.resize(sent.chips, len(levels)))


def test_a_chip_lasts_the_cycles_that_are_stated(
    sent: Transmission, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = run_program(write_sketch(sent), monkeypatch)
    (instruction,) = machine.program
    assert instruction.count == 1
    divider = machine.registers[_DIVIDER]
    assert divider & 0xFFFF == 0, "no fraction, which would make chips unequal"
    assert (1 + instruction.delay) * (divider >> 16) == sent.timing.cycles
    assert machine.clock == PICO.clock
    assert f"GP{machine.pin}" == PICO.pin


def test_the_unpacked_words_take_the_stated_number_of_bytes(
    sent: Transmission, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = run_program(write_sketch(sent), monkeypatch)
    assert 4 * len(machine.words) // _TURNS == count_table_bytes(PICO, len(sent.chips))


class MeasuredMachine(Machine):
    """Measures the memory between setting the clock and making the state machine."""

    def _freq(self, hertz: int) -> None:
        tracemalloc.reset_peak()
        self.before, _ = tracemalloc.get_traced_memory()
        super()._freq(hertz)

    def _state_machine(self, number: int, program: object, out_base: Any) -> SimpleNamespace:
        self.peak = tracemalloc.get_traced_memory()[1] - self.before
        return super()._state_machine(number, program, out_base)


def test_the_table_of_a_long_packet_is_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A second list of that length would not fit into the Pico's heap."""
    long = PAPER.replace(payload="bits:" + "01" * 2040, line_code="fsk", framing="c-ook")
    sent = prepare_transmission(long, PICO)
    machine = MeasuredMachine()
    tracemalloc.start()
    try:
        run_program(write_sketch(sent), monkeypatch, machine)
    finally:
        tracemalloc.stop()
    size = count_table_bytes(PICO, len(sent.chips))
    assert size == 105_060
    assert size < machine.peak < 1.25 * size
