"""A chip's length on a board: the timer's nearest, with an exact error."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.boards.arduino import UNO
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.timing import choose_timing
from occ_model.boards.transmission import prepare_transmission

PAPER = occ.load_preset("phone-68us")

every_board = pytest.mark.parametrize("board", BOARDS.values(), ids=lambda board: board.name)

frequencies = st.floats(60.0, 125e3)


@given(board=st.sampled_from([*BOARDS.values()]), frequency=frequencies)
def test_no_setting_of_the_timer_comes_nearer(board: TransmitterBoard, frequency: float) -> None:
    found = choose_timing(board, frequency)
    prescalers = np.array(board.prescalers, dtype=np.int64)
    exact = board.clock / (prescalers * frequency)
    counts = np.clip(np.stack([np.floor(exact), np.ceil(exact)]), 1, board.largest_count)
    cycles = (counts * prescalers).astype(np.int64).ravel()
    errors = [
        abs(Fraction(board.clock, int(number)) / Fraction(frequency) - 1)
        for number in cycles
        if number >= board.least_cycles
    ]
    assert abs(found.error_ppm) == min(errors) * 10**6


@given(board=st.sampled_from([*BOARDS.values()]), frequency=frequencies)
def test_frequency_period_and_error_agree(board: TransmitterBoard, frequency: float) -> None:
    timing = choose_timing(board, frequency)
    assert timing.frequency * timing.period == 1
    assert timing.frequency == timing.requested_frequency * (1 + timing.error_ppm / 10**6)
    assert timing.prescaler in board.prescalers
    assert 1 <= timing.count <= board.largest_count


@given(board=st.sampled_from([*BOARDS.values()]), frequency=frequencies)
def test_a_frequency_that_was_sent_can_be_sent_exactly(
    board: TransmitterBoard, frequency: float
) -> None:
    first = prepare_transmission(PAPER.replace(switching_frequency=frequency), board)
    again = prepare_transmission(first.sent_scene, board)
    assert again.timing.cycles == first.timing.cycles
    # A float has only 16 digits of 1/3.
    assert abs(again.timing.error_ppm) < Fraction(1, 10**9)
    assert again.is_exact
    assert again.sent_scene == first.sent_scene


@every_board
def test_the_ends_of_the_range_are_allowed_and_frequencies_beyond_are_not(
    board: TransmitterBoard,
) -> None:
    low, high = float(board.lowest_frequency), float(board.highest_frequency)
    assert choose_timing(board, high).cycles == board.least_cycles
    assert choose_timing(board, low * (1 + 1e-12)).cycles == board.most_cycles
    for beyond in (low * 0.999, high * 1.001):
        with pytest.raises(occ.ParameterError) as refused:
            choose_timing(board, beyond)
        assert refused.value.parameters == ("switching_frequency",)
        why = board.limit_reason if beyond > high else "the timer cannot count longer"
        assert str(refused.value).endswith(f", since {why}.")


def test_a_packet_that_does_not_fit_is_refused() -> None:
    # 4,095 and 32 have no common divisor, so that 32 packets are unpacked.
    pico = board_named("raspberry-pi-pico")
    small = TransmitterBoard(
        **{name: getattr(pico, name) for name in pico.__slots__} | {"table_bytes": 16_000}
    )
    scene = PAPER.replace(pattern="1" + "0" * 4094)
    with pytest.raises(occ.ParameterError) as refused:
        prepare_transmission(scene, small)
    assert str(refused.value) == (
        "The packet has 4,095 chips, which take 16,380 bytes on Raspberry Pi Pico; allowed: 16,000 "
        "bytes. Send fewer bits."
    )
    assert prepare_transmission(scene, pico).timing.cycles


@pytest.mark.parametrize(
    ("pattern", "lowest", "run", "visible"),
    [
        ("01", 5e3, 1e-4, False),
        ("0101", 5e3, 1e-4, False),
        ("1001", 2.5e3, 2e-4, False),
        ("1" + "0" * 99, 100.0, 9.9e-3, True),
    ],
)
def test_the_lowest_frequency_is_that_of_the_shortest_repetition(
    pattern: str, lowest: float, run: float, visible: bool
) -> None:
    sent = prepare_transmission(PAPER.replace(pattern=pattern, switching_frequency=10e3), UNO)
    assert sent.lowest_frequency == lowest
    assert float(sent.longest_run) == run
    assert sent.is_visible == visible


@settings(max_examples=25)
@given(pattern=st.text("01", min_size=2, max_size=40))
def test_below_the_lowest_frequency_the_spectrum_is_empty(pattern: str) -> None:
    sent = prepare_transmission(PAPER.replace(pattern=pattern, switching_frequency=1e3), UNO)
    chips = np.tile(sent.chips, 4).astype(np.float64)
    strengths = np.abs(np.fft.rfft(chips - chips.mean()))
    if sent.lowest_frequency is None:
        assert strengths.max() < 1e-9
        return
    found = np.fft.rfftfreq(len(chips), 1e-3)[strengths > 1e-6]
    assert found.min() >= float(sent.lowest_frequency) * (1 - 1e-9)
    # All frequencies in the light are multiples of it.
    multiples = found / float(sent.lowest_frequency)
    np.testing.assert_allclose(multiples, np.round(multiples), atol=1e-9)
