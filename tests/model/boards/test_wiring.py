"""The circuit: its resistors keep currents within what is stated, and the figure says so."""

import math

import pytest

import occ_model as occ
from occ_model.boards.board import (
    GATE_CAPACITANCE,
    LED_CURRENT,
    LED_VOLTS,
    Board,
    next_resistor,
    wiring,
)
from occ_model.boards.pico import PICO
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.transmission import SEIZURES, flicker_sentence, transmission
from occ_model.figures.transmitter_files import notes, wiring_bytes

PAPER = occ.load_preset("phone-68us")

every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=lambda board: board.name)


@every_board
def test_no_current_exceeds_what_pin_and_led_may_carry(board: Board) -> None:
    values = wiring(board)
    assert board.volts / values.gate_resistor <= board.pin_current
    assert values.led_current <= LED_CURRENT < board.pin_current
    assert values.led_current * values.led_resistor == pytest.approx(board.volts - LED_VOLTS)


@every_board
def test_the_gate_rises_as_an_rc_circuit_does(board: Board) -> None:
    values = wiring(board)
    constant = values.gate_resistor * GATE_CAPACITANCE
    low, high = (-constant * math.log(1 - part) for part in (0.1, 0.9))
    assert values.rise_time == pytest.approx(high - low)


@pytest.mark.parametrize(
    ("ohms", "resistor"), [(10.0, 10), (10.1, 12), (82.1, 100), (250.0, 270), (275.0, 330)]
)
def test_the_next_resistor_of_the_series_is_taken(ohms: float, resistor: int) -> None:
    assert next_resistor(ohms) == resistor


def test_flicker_is_warned_of_where_it_may_be_seen_only() -> None:
    slow, fast, steady = (
        flicker_sentence(transmission(PAPER.replace(**changes), board_named("arduino-uno")))
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


def test_the_figure_says_pin_resistors_and_caution() -> None:
    board, sent = PICO, transmission(PAPER, PICO)
    values = wiring(board)
    svg = wiring_bytes(sent, "svg").decode()
    drawn = {line.strip(" <!->") for line in svg.splitlines() if line.strip().startswith("<!--")}
    assert {board.pin, board.ground, board.transistor} <= drawn
    assert {f"{values.gate_resistor} Ω", f"{values.led_resistor} Ω"} <= drawn
    text = " ".join(notes(sent))
    assert flicker_sentence(sent) in text
    assert "Do not look into a bright LED" in text


def test_the_text_below_the_figure_stays_within_it() -> None:
    from occ_model.figures.drawing import house_style
    from occ_model.figures.transmitter_files import wiring_figure

    longest = PAPER.replace(payload="text:" + "Photograph me. " * 30, switching_frequency=1.5e3)
    with house_style():
        figure = wiring_figure(transmission(longest, board_named("raspberry-pi-pico")))
        figure.draw_without_rendering()
        whole = figure.bbox
        for axes in figure.axes:
            for text in axes.texts:
                box = text.get_window_extent()
                assert whole.x0 <= box.x0
                assert box.x1 <= whole.x1
                assert whole.y0 <= box.y0
                assert box.y1 <= whole.y1
