"""Bits a second of a film, however short it is."""

from types import SimpleNamespace

import pytest

from occ_model.results.video_reading import VideoReading


@pytest.mark.parametrize(("duration", "rate"), [(0.0, 0.0), (0.25, 160.0), (4.0, 10.0)])
def test_bits_a_second_are_those_that_were_read_over_the_films_length(
    duration: float, rate: float
) -> None:
    packets = [
        SimpleNamespace(bits=bits, is_read=bits is not None, correct=correct)
        for bits, correct in ((range(20), True), (range(20), None), (range(9), False), (None, None))
    ]
    film = SimpleNamespace(duration=duration, packets=packets)
    assert VideoReading.bits_per_second.fget(film) == rate  # type: ignore[attr-defined]
