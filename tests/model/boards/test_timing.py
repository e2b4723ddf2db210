"""A chip's length on a board: the timer's nearest, with an exact error."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.boards.arduino import UNO
from occ_model.boards.board import TransmitterBoard
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.timing import BoardTiming, choose_lamp_timing, choose_timing
from occ_model.boards.transmission import prepare_transmission

PAPER = occ.load_preset("phone-68us")

boards = st.sampled_from([*BOARDS.values()])
lights: st.SearchStrategy[dict[str, str | float]] = st.one_of(
    st.builds(dict, switching_frequency=st.floats(60.0, 125e3)),
    st.builds(
        dict, light=st.just("lamp"), lamp_frequency=st.floats(0.3, 400e3),
        duty=st.floats(0.001, 0.999),
    ),
)  # fmt: skip


@given(board=boards, frequency=st.floats(60.0, 125e3))
def test_no_setting_of_the_timer_comes_nearer(board: TransmitterBoard, frequency: float) -> None:
    found, timer = choose_timing(board, frequency), board.chip_timer
    prescalers = np.array(timer.prescalers, dtype=np.int64)
    exact = board.clock / (prescalers * frequency)
    counts = np.clip(np.stack([np.floor(exact), np.ceil(exact)]), 1, timer.largest_count)
    cycles = (counts * prescalers).astype(np.int64).ravel()
    errors = [
        abs(Fraction(board.clock, int(number)) / Fraction(frequency) - 1)
        for number in cycles
        if number >= timer.least_count
    ]
    assert abs(found.error_ppm) == min(errors) * 10**6
    assert found.prescaler in timer.prescalers
    assert 1 <= found.count <= timer.largest_count


@settings(max_examples=80)
@given(board=boards, light=lights)
def test_what_was_sent_can_be_sent_exactly(
    board: TransmitterBoard, light: dict[str, str | float]
) -> None:
    first = prepare_transmission(PAPER.replace(**light), board)
    again = prepare_transmission(first.sent_scene, board)
    assert (again.timing.cycles, again.start_of(1)) == (first.timing.cycles, first.start_of(1))
    # A float has only 16 digits of 1/3.
    assert abs(again.timing.error_ppm) < Fraction(1, 10**9)
    assert again.is_exact
    assert again.sent_scene == first.sent_scene


@pytest.mark.parametrize("name", ["switching_frequency", "lamp_frequency"])
@pytest.mark.parametrize("board", BOARDS.values(), ids=lambda board: board.name)
def test_the_ends_of_the_range_are_allowed_and_frequencies_beyond_are_not(
    board: TransmitterBoard, name: str
) -> None:
    is_lamp = name == "lamp_frequency"
    timer = board.lamp_timer if is_lamp else board.chip_timer

    def send(frequency: float) -> BoardTiming:
        """Choose the timing of any frequency, as a scene limits that of its chips and lamps."""
        if is_lamp:
            return choose_lamp_timing(board, name, frequency, lambda period: period / 2)
        return choose_timing(board, frequency)

    most, least = timer.prescalers[-1] * timer.largest_count, timer.least_count
    low, high = board.clock / most, board.clock / least
    assert send(high).cycles == least
    assert send(low * (1 + 1e-12)).cycles == most
    for beyond, why in ((low * 0.999, "the timer cannot count longer"),
                        (high * 1.001, timer.limit_reason)):  # fmt: skip
        with pytest.raises(occ.ParameterError) as refused:
            send(beyond)
        assert refused.value.parameters == (name,)
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
