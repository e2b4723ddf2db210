"""Bits a second of a film, however short it is."""

from types import SimpleNamespace

import numpy as np
import pytest

from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets
from occ_model.results.video_reading import VideoReading


@pytest.mark.parametrize(("duration", "rate"), [(0.0, 0.0), (0.25, 160.0), (4.0, 10.0)])
def test_bits_a_second_are_those_that_were_read_over_the_films_length(
    duration: float, rate: float
) -> None:
    kinds = [(20, 0), (20, None), (9, 1), (None, None)]
    packets = [
        PacketReading(number, 0, 0.0, 0, 1.0, None if bits is None else np.zeros(bits, np.uint8), w)
        for number, (bits, w) in enumerate(kinds)
    ]
    sent = SentPackets((FilmPart(0.0, duration, len(packets)),), tuple(packets))
    film = SimpleNamespace(duration=duration, packets=sent)
    assert VideoReading.bits_per_second.fget(film) == rate  # type: ignore[attr-defined]
    # The two that are right are repeats in one frame.
    net: float = VideoReading.net_bits_per_second.fget(film)  # type: ignore[attr-defined]
    assert net == rate / 2.0
