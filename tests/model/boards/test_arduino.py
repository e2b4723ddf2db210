"""The Arduino's sketch, compiled and run: its pin follows the packet."""

from fractions import Fraction
from itertools import product

import pytest
from model.boards.simulated_uno import SimulatedUno, missing_tools, worst_error

import occ_model as occ
from occ_model.boards.arduino import UNO
from occ_model.boards.sketch import write_sketch
from occ_model.boards.timing import BoardTiming
from occ_model.boards.transmission import (
    Transmission,
    count_table_bytes,
    prepare_transmission,
)
from occ_model.scene.payload import MAX_PAYLOAD_BITS

pytestmark = pytest.mark.compilers

FREQUENCIES = (1e3, 2e3, 5e3, 10e3, 14.7e3, 20e3, 40e3)  # in Hz

PAPER = occ.load_preset("phone-68us")

CODES = {
    "the paper's, code 718": PAPER,
    "Manchester, C-OOK": PAPER.replace(
        payload="text:Hello", line_code="manchester", framing="c-ook"
    ),
    "8b10b, raw frame": PAPER.replace(
        payload="text:Photograph me", line_code="8b10b", framing="raw"
    ),
}

EVERY_DAY = [("the paper's, code 718", 14.7e3), ("the paper's, code 718", 40e3)]

PACKETS = 100


@pytest.fixture(scope="module")
def uno(tmp_path_factory: pytest.TempPathFactory) -> SimulatedUno:
    missing = missing_tools()
    if missing:
        pytest.skip(f"no Arduino can be simulated here; missing: {missing}")
    return SimulatedUno(tmp_path_factory.mktemp("uno"))


def measure_edge_error(uno: SimulatedUno, sent: Transmission, packets: int) -> Fraction:
    """Run a sketch for some packets; return its worst edge's error in chips."""
    return worst_error(sent, uno.edges(sent, packets), packets)


def set_cycles(sent: Transmission, cycles: int) -> Transmission:
    """Let chips last a number of cycles, whatever the board's limit."""
    timing = BoardTiming(UNO.clock, 1, cycles, Fraction(UNO.clock, cycles))
    return Transmission(sent.scene, sent.board, sent.chips, timing)


@pytest.mark.parametrize(
    ("code", "frequency"),
    [
        pytest.param(*case, marks=() if case in EVERY_DAY else pytest.mark.whole)
        for case in product(CODES, FREQUENCIES)
    ],
)
def test_the_edges_are_those_of_the_packet(uno: SimulatedUno, code: str, frequency: float) -> None:
    sent = prepare_transmission(CODES[code].replace(switching_frequency=frequency), UNO)
    assert measure_edge_error(uno, sent, PACKETS) <= Fraction(1, 1000)


def test_a_slow_scene_is_sent_with_a_divided_clock(uno: SimulatedUno) -> None:
    sent = prepare_transmission(PAPER.replace(switching_frequency=30.0, pattern="0010111"), UNO)
    assert sent.timing.prescaler > 1
    assert measure_edge_error(uno, sent, 3) <= Fraction(1, 1000)


@pytest.mark.parametrize("code", CODES)
def test_at_the_highest_frequency_the_edges_are_still_exact(uno: SimulatedUno, code: str) -> None:
    scene = CODES[code].replace(switching_frequency=float(UNO.clock / UNO.chip_timer.least_count))
    sent = prepare_transmission(scene, UNO)
    assert sent.timing.cycles == UNO.chip_timer.least_count
    assert measure_edge_error(uno, sent, 20) == 0


def test_well_above_the_highest_frequency_the_interrupt_does_not_keep_pace(
    uno: SimulatedUno,
) -> None:
    sent = set_cycles(prepare_transmission(PAPER, UNO), UNO.chip_timer.least_count * 5 // 8)
    with pytest.raises(AssertionError):
        measure_edge_error(uno, sent, 5)


@pytest.mark.whole
def test_the_interrupt_takes_as_long_as_the_refusal_says(uno: SimulatedUno) -> None:
    sent = prepare_transmission(CODES["8b10b, raw frame"], UNO)
    (stated,) = (int(word) for word in UNO.chip_timer.limit_reason.split() if word.isdigit())
    longest = uno.edges(sent, 20).longest_interrupt
    assert abs(longest - stated) <= 10  # another compiler needs a few more or fewer
    assert longest < UNO.chip_timer.least_count


def test_the_largest_payload_fits_into_the_flash_memory(uno: SimulatedUno) -> None:
    scene = PAPER.replace(
        payload="bits:" + "01" * (MAX_PAYLOAD_BITS // 2), line_code="fsk", framing="c-ook",
        error_correction="reed-solomon",
    )  # fmt: skip
    sent = prepare_transmission(scene, UNO)
    flash, boot_loader = 32 * 1024, 2 * 1024
    taken = uno.flash_bytes(write_sketch(sent))
    assert taken <= flash - boot_loader
    assert taken - count_table_bytes(UNO, len(sent.chips)) < 1024


@pytest.mark.whole
def test_a_packet_of_thousands_of_chips_is_sent_whole(uno: SimulatedUno) -> None:
    scene = PAPER.replace(payload="bits:" + "0110" * (MAX_PAYLOAD_BITS // 4))
    sent = prepare_transmission(scene.replace(switching_frequency=40e3), UNO)
    assert measure_edge_error(uno, sent, 3) <= Fraction(1, 1000)
