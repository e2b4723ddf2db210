"""The text of sketches: with any payload, the comment at the head stays a comment."""

import ast
from itertools import product

import pytest
from each_case import each_case
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.boards.sketch import BOARDS, board_named
from occ_model.boards.transmission import prepare_transmission

PAPER = occ.load_preset("phone-68us")

every_board = pytest.mark.parametrize("board", BOARDS)

HOSTILE = (
    "text:\\",
    "text:a\nb",
    "text:*/",
    "text:??/",
    "text:'''\"\"\"",
    "text:\u2028x",
    "text:ä",
)


def read_head(source: str) -> list[str]:
    return source.partition("\n\n")[0].splitlines()


@each_case(product(BOARDS, HOSTILE))
def test_no_payload_leaves_the_comment(board: str, payload: str) -> None:
    source = occ.transmitter_sketch(PAPER.replace(payload=payload), board)
    mark = "#" if board == "raspberry-pi-pico" else "//"
    head = read_head(source)
    assert all(line.startswith(mark) for line in head)
    # Either would join the next line to the comment.
    assert not any(line.endswith(("\\", "??/")) for line in head)


@settings(max_examples=25)
@given(text=st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=40))
def test_the_program_of_the_pico_is_python_with_any_payload(text: str) -> None:
    ast.parse(occ.transmitter_sketch(PAPER.replace(payload=f"text:{text}"), "raspberry-pi-pico"))


@every_board
def test_the_head_states_what_is_sent(board: str) -> None:
    scene = PAPER.replace(switching_frequency=14.7e3)
    sent = prepare_transmission(scene, board_named(board))
    head = " ".join(line.lstrip("/# ") for line in read_head(occ.transmitter_sketch(scene, board)))
    assert "Sends the code 718 of 10 bits." in head
    assert "Packet: 24 chips" in head
    assert "11100101 10010101 10011010" in head
    assert f"{float(sent.timing.error_ppm):+.3g} ppm from the 14.7 kHz asked" in head
    assert f"{sent.timing.cycles:,} cycles" in head
    assert f"{sent.board.clock_error:,.0f} ppm" in head


def test_the_nano_blinks_as_the_uno() -> None:
    uno, nano = (occ.transmitter_sketch(PAPER, f"arduino-{name}") for name in ("uno", "nano"))
    assert nano == uno.replace("Arduino Uno", "Arduino Nano")
