"""Where in the period of what is sent a stretch of chips can be, as its headers show."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.transmitter.packet import sent_chips
from occ_model.video.payload_so_far import known_bits, written
from occ_model.video.period import SentPeriod


@pytest.mark.parametrize("shift", [0, 3, 11])
def test_a_header_in_view_shows_the_place(shift: int) -> None:
    scene = occ.Scene()
    chips = np.tile(np.roll(sent_chips(scene.transmitter), shift), 2)
    (place,) = SentPeriod(scene.transmitter).places(chips)
    assert place == -shift % len(sent_chips(scene.transmitter))


def test_headers_that_contradict_each_other_show_nothing() -> None:
    scene = occ.Scene()
    period = sent_chips(scene.transmitter)
    torn = np.concatenate([period, period[:5], period, period])
    assert SentPeriod(scene.transmitter).places(torn) == ()


def test_nothing_is_shown_without_a_header() -> None:
    scene = occ.Scene()
    assert SentPeriod(scene.transmitter).places(sent_chips(scene.transmitter)[8:14]) == ()


def bits_of(octets: bytes) -> np.ndarray:
    return np.unpackbits(np.frombuffer(octets, np.uint8)).astype(np.int64)


@pytest.mark.parametrize(
    ("payload", "octets", "whole", "partly"),
    [
        ("text:é!", "é!".encode(), "é!", "·"),
        ("hex:0fa0", b"\x0f\xa0", "0fa0", "··"),
        ("bits:10", b"\x80", "10000000", "·"),
    ],
)
def test_a_payload_is_written_in_its_form_and_what_is_missing_by_dots(
    payload: str, octets: bytes, whole: str, partly: str
) -> None:
    scene = occ.Scene().replace(payload=payload)
    bits = bits_of(octets)
    assert written(bits, scene) == whole
    bits[-1] = -1
    assert written(bits, scene).endswith(partly)


@pytest.mark.parametrize("framing", ["paper", "raw", "preamble"])
def test_all_bits_are_known_of_a_whole_period_and_fewer_of_a_part(framing: str) -> None:
    scene = occ.Scene().replace(payload="hex:5ac3", framing=framing)
    period = SentPeriod(scene.transmitter)
    sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
    chips = period.scheme.encode(sent)
    ratios = np.where(chips == 1, 9.0, -9.0)
    whole: Any = SimpleNamespace(ratios=ratios, known=np.ones(len(chips), dtype=bool))
    assert known_bits(whole, period).tolist() == sent.tolist()
    half: Any = SimpleNamespace(ratios=ratios, known=np.arange(len(chips)) < 0.5 * len(chips))
    found = known_bits(half, period)
    assert 0 < np.count_nonzero(found >= 0) < len(sent)
    assert (found[found >= 0] == sent[found >= 0]).all()
    lost = 0
    for place in range(len(chips)):
        one: Any = SimpleNamespace(ratios=ratios, known=np.arange(len(chips)) != place)
        lost += int(np.count_nonzero(known_bits(one, period) < 0))
    # A bit needs its two chips and those of the bit before: of a header, the last one.
    assert lost == 4 * len(sent) - (framing != "raw")
