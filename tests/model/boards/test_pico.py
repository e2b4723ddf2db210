"""The Pico's program in a simulated Pico: it sends the packet."""

import tracemalloc
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from model.boards.simulated_pico import DIVIDER, TURNS, SimulatedPico

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


@pytest.fixture(params=SCENES)
def sent(request: pytest.FixtureRequest) -> Transmission:
    return prepare_transmission(SCENES[request.param], PICO)


def test_the_state_machine_sends_packets_end_to_end(sent: Transmission) -> None:
    pico = SimulatedPico().run(write_sketch(sent))
    assert pico.settings["out_shiftdir"] == "left"
    assert (pico.settings["autopull"], pico.settings["pull_thresh"]) == (True, 32)
    # Shifted out to the left, the highest bit of a word first.
    levels = [word >> place & 1 for word in pico.words for place in range(31, -1, -1)]
    assert len(levels) % len(sent.chips) == 0, "the loop ends with a whole packet"
    np.testing.assert_array_equal(levels, np.resize(sent.chips, len(levels)))
    assert 4 * len(pico.words) // TURNS == count_table_bytes(PICO, len(sent.chips))


def test_a_chip_lasts_the_cycles_that_are_stated(sent: Transmission) -> None:
    pico = SimulatedPico().run(write_sketch(sent))
    (instruction,) = pico.program
    assert (instruction.name, *instruction.words) == ("out", "pins", 1)
    divider = pico.registers[DIVIDER]
    assert divider & 0xFFFF == 0, "no fraction, which would make chips unequal"
    assert (1 + instruction.delay) * (divider >> 16) == sent.timing.cycles
    assert pico.clock == PICO.clock
    assert f"GP{pico.pin}" == PICO.pin


class MeasuredPico(SimulatedPico):
    """Measures the memory between setting the clock and making the state machine."""

    def set_clock(self, hertz: int) -> None:
        tracemalloc.reset_peak()
        self.before, _ = tracemalloc.get_traced_memory()
        super().set_clock(hertz)

    def make_state_machine(self, number: int, program: object, **pins: Any) -> SimpleNamespace:
        self.peak = tracemalloc.get_traced_memory()[1] - self.before
        return super().make_state_machine(number, program, **pins)


def test_the_table_of_a_long_packet_is_made_once() -> None:
    """A second list of that length would not fit into the Pico's heap."""
    long = PAPER.replace(payload="bits:" + "01" * 2040, line_code="fsk", framing="c-ook")
    sent = prepare_transmission(long, PICO)
    pico = MeasuredPico()
    tracemalloc.start()
    try:
        pico.run(write_sketch(sent))
    finally:
        tracemalloc.stop()
    size = count_table_bytes(PICO, len(sent.chips))
    assert size == 105_060
    assert size < pico.peak < 1.25 * size
