"""Headers determine at which places of the sent period a sequence of chips can be."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.transmitter.scheme import sent_chips
from occ_model.video.payload_so_far import format_bits, known_bits
from occ_model.video.period import SentPeriod


@pytest.mark.parametrize("shift", [0, 3, 11])
def test_a_header_in_view_shows_the_place(shift: int) -> None:
    scene = occ.Scene()
    chips = np.tile(np.roll(sent_chips(scene.transmitter), shift), 2)
    (place,) = SentPeriod(scene.transmitter).places(chips)
    assert place == -shift % len(sent_chips(scene.transmitter))


def test_contradicting_headers_show_no_place() -> None:
    scene = occ.Scene()
    period = sent_chips(scene.transmitter)
    torn = np.concatenate([period, period[:5], period, period])
    assert SentPeriod(scene.transmitter).places(torn) == ()


def test_without_a_header_no_place_is_shown() -> None:
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
def test_a_payload_is_written_in_its_form_with_dots_for_unknown_parts(
    payload: str, octets: bytes, whole: str, partly: str
) -> None:
    scene = occ.Scene().replace(payload=payload)
    bits = bits_of(octets)
    assert format_bits(bits, scene) == whole
    bits[-1] = -1
    assert format_bits(bits, scene).endswith(partly)


@pytest.mark.parametrize("framing", ["paper", "raw", "preamble"])
def test_a_whole_period_gives_all_bits_and_a_part_fewer(framing: str) -> None:
    scene = occ.Scene().replace(payload="hex:5ac3", framing=framing)
    period = SentPeriod(scene.transmitter)
    sent = np.array(scene.transmitter.payload_bits, dtype=np.uint8)
    chips = period.scheme.encode(sent)
    ratios = np.where(chips == 1, 9.0, -9.0)
    whole = np.ones(len(chips), dtype=bool)
    assert known_bits(ratios, whole, period).tolist() == sent.tolist()
    found = known_bits(ratios, np.arange(len(chips)) < 0.5 * len(chips), period)
    assert 0 < np.count_nonzero(found >= 0) < len(sent)
    assert (found[found >= 0] == sent[found >= 0]).all()
    lost = 0
    for place in range(len(chips)):
        all_but_one = np.arange(len(chips)) != place
        lost += int(np.count_nonzero(known_bits(ratios, all_but_one, period) < 0))
    # A bit needs its own two chips and those of the bit before, or the last chip of a header.
    assert lost == 4 * len(sent) - (framing != "raw")
