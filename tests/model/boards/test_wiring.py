"""The circuit: its resistors limit the currents as stated, and the figure says so."""

import math

import pytest

import occ_model as occ
from occ_model.boards.board import (
    GATE_CAPACITANCE,
    LED_CURRENT,
    LED_VOLTS,
    TransmitterBoard,
)
from occ_model.boards.pico import PICO
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.transmission import SEIZURES, flicker_sentence, prepare_transmission
from occ_model.figures.transmitter_files import circuit_notes, wiring_bytes

PAPER = occ.load_preset("phone-68us")

every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=lambda board: board.name)


@every_board
def test_no_current_exceeds_what_pin_and_led_may_carry(board: TransmitterBoard) -> None:
    assert board.volts / board.gate_resistor <= board.pin_current
    assert board.led_current <= LED_CURRENT < board.pin_current
    assert board.led_current * board.led_resistor == pytest.approx(board.volts - LED_VOLTS)


@every_board
def test_resistors_are_the_next_of_the_series_e12(board: TransmitterBoard) -> None:
    series = [100, 120, 150, 180, 220, 270, 330, 390, 470, 560, 680, 820]  # IEC 60063
    for resistor, least in (
        (board.gate_resistor, board.volts / board.pin_current),
        (board.led_resistor, (board.volts - LED_VOLTS) / LED_CURRENT),
    ):
        assert resistor == min(each for each in series if each > least - 1e-9)


@every_board
def test_the_gate_rises_as_an_rc_circuit_does(board: TransmitterBoard) -> None:
    constant = board.gate_resistor * GATE_CAPACITANCE
    low, high = (-constant * math.log(1 - part) for part in (0.1, 0.9))
    assert board.rise_time == pytest.approx(high - low)


def test_there_is_a_warning_of_flicker_only_if_it_may_be_seen() -> None:
    slow, fast, steady = (
        flicker_sentence(prepare_transmission(PAPER.replace(**changes), board_named("arduino-uno")))
        for changes in (
            {"switching_frequency": 1e3},
            {"switching_frequency": 10e3},
            {"pattern": "11"},
        )
    )
    assert "41.67 Hz" in slow
    assert slow.endswith(SEIZURES)
    assert "416.7 Hz" in fast
    assert "above 200 Hz" in fast
    assert steady == "The light does not change: all chips are equal."


@pytest.mark.usefixtures("plain_figures")
def test_the_figure_says_pin_resistors_and_caution() -> None:
    board, sent = PICO, prepare_transmission(PAPER, PICO)
    svg = wiring_bytes(sent, "svg").decode()
    drawn = {line.strip(" <!->") for line in svg.splitlines() if line.strip().startswith("<!--")}
    assert {board.pin, board.ground, board.transistor} <= drawn
    assert {f"{board.gate_resistor} Ω", f"{board.led_resistor} Ω"} <= drawn
    text = " ".join(circuit_notes(sent))
    assert flicker_sentence(sent) in text
    assert "Do not look into a bright LED" in text
