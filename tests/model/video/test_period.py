"""Where in the period of what is sent a stretch of chips can be, as its headers show."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.transmitter.packet import sent_chips
from occ_model.video.partial_payload import written
from occ_model.video.period import period_of


@pytest.mark.parametrize("shift", [0, 3, 11])
def test_a_header_in_view_shows_the_place(shift: int) -> None:
    scene = occ.Scene()
    chips = np.tile(np.roll(sent_chips(scene.transmitter), shift), 2)
    (place,) = period_of(scene).places(chips)
    assert place == -shift % len(sent_chips(scene.transmitter))


def test_headers_that_contradict_each_other_show_nothing() -> None:
    scene = occ.Scene()
    period = sent_chips(scene.transmitter)
    torn = np.concatenate([period, period[:5], period, period])
    assert period_of(scene).places(torn) == ()


def test_nothing_is_shown_without_a_header() -> None:
    scene = occ.Scene()
    assert period_of(scene).places(sent_chips(scene.transmitter)[8:14]) == ()


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
