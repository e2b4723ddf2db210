"""Lengths of codes are compared by how many there are, how alike they are, and what is read."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_rooms import small_room

import occ_model as occ
from occ_model.cli import main
from occ_model.room.room import Place
from occ_model.study.code_length import CodeLength, code_lengths, least_distance
from occ_model.study.room_map import RoomMapRequest, room_map
from occ_model.transmitter.packet import sent_chips

ROOM = small_room(2, turned=0.0, camera=Place(z=-0.2))


def test_the_least_distance_is_that_of_the_nearest_pair_at_the_nearest_shift() -> None:
    sent = occ.Scene().transmitter.replaced({"code": 0, "bits": 4})
    packets = np.array([sent_chips(sent.replaced({"code": code})) for code in range(16)])
    by_hand = min(
        int((first != np.roll(second, shift)).sum())
        for n, first in enumerate(packets)
        for second in packets[:n]
        for shift in range(packets.shape[1])
    )
    assert least_distance(packets) == by_hand > 0
    assert least_distance(packets[[3, 3]]) == 0
    assert least_distance(np.array([packets[3], np.roll(packets[3], 5)])) == 0


def test_lamps_are_read_as_long_as_a_packet_is_shown() -> None:
    short, long = code_lengths(RoomMapRequest(ROOM, (0.6,), (0.0,), 2), 64, (6, 15))
    assert (short.bits, short.codes, short.chips) == (6, 64, 16)
    assert short.columns == pytest.approx(16 / 8e3 / 36e-6)
    assert (short.whole, short.named, short.misread) == (4, 4, 0)
    assert short.packets / long.packets == pytest.approx(long.chips / short.chips)
    assert long.packets < 2.0


def test_a_place_without_a_picture_has_no_lamp_that_is_whole() -> None:
    request = RoomMapRequest(ROOM.replace(z=2.3, pitch=0.9), (0.6,), (0.0,))
    (point,) = room_map(request)
    (found,) = code_lengths(request, 64, (6,))
    assert "partly behind the camera" in point.note
    assert (found.whole, found.packets) == (point.shown, 0.0) == (0, 0.0)


def test_lengths_are_those_of_codes_whatever_the_lamps_send_now() -> None:
    lamps = [replace(lamp, transmitter=lamp.transmitter.replaced({"payload": "bits:1100"}))
             for lamp in ROOM.lamps]  # fmt: skip
    sending = replace(ROOM, lamps=tuple(lamps))
    asked = [RoomMapRequest(room, (0.6,), (0.0,)) for room in (ROOM, sending)]
    plain, found = (code_lengths(request, 64, (6,)) for request in asked)
    assert found == plain
    assert found[0].distance > 0


def test_a_misread_code_is_another_lamp_s_as_often_as_codes_are_used() -> None:
    found = CodeLength(12, 28, 100.0, 3.0, 2, whole=50, named=40, misread=9)
    assert found.named_wrongly(1024) == pytest.approx(9 * 1023 / 4095)
    assert found.named_wrongly(1) == 0.0


def test_a_length_with_fewer_codes_than_lamps_is_refused() -> None:
    with pytest.raises(occ.ParameterError, match=r"bits is 9; allowed for 1024 lamps: from 10"):
        code_lengths(RoomMapRequest(ROOM, (0.6,), (0.0,)), 1024, (9,))


def test_the_command_says_which_length_serves_best(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "room.toml"
    path.write_text(ROOM.to_toml(), encoding="utf-8")
    words = ("room", "codes", "--room", str(path), "--lamps", "64", "--bits", "6", "--side", "1")
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "6       64     16" in said
    assert "6 bits serve 64 lamps best: 2 of 2 whole lamps named rightly" in said
    assert "As well do" not in said
    assert main((*words, "--bits", "8")) == 0
    assert "As well do 8 bits: so few pictures do not distinguish them." in capsys.readouterr().out
