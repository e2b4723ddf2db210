"""Words for a film's reading: what each rate counts, and to which digit it is known."""

import numpy as np
import pytest

from occ_gui.video.reading_jobs import sentences_of
from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets
from occ_model.results.video_reading import FilmProgress, FrameReading, VideoReading
from occ_model.study.reading_facts import error_rate, film_facts

_BITS = np.zeros(10, dtype=np.uint8)


def packet(number: int, frame: int | None, wrong: int | None) -> PacketReading:
    return PacketReading(
        number, 0, 0.0, frame, 1.0, None if wrong is None else _BITS, wrong
    )  # fmt: skip


def reading(right: int, unread: int, unseen: int, wrong: int = 0) -> VideoReading:
    kinds = [(0, 0)] * right + [(0, None)] * unread + [(None, None)] * unseen + [(0, 1)] * wrong
    packets = tuple(packet(number, *kind) for number, kind in enumerate(kinds))
    return VideoReading(
        frames=(FrameReading(0, 0.0), FrameReading(1, 0.03)), clock=None, certainty=1.0,
        packets=SentPackets((FilmPart(0.0, 0.06, len(packets)),), packets),
        bits=_BITS, known=np.ones(24, dtype=bool), payload="0", complete_at=0.0, duration=0.06,
        failure=None,
    )  # fmt: skip


def known(whole: VideoReading, placed: int = 2) -> FilmProgress:
    return FilmProgress(whole.frames[-1], 2, placed, "0", 1.0, True, None)


def said(whole: VideoReading) -> dict[str, str]:
    return {fact.label: fact.text for fact in film_facts(known(whole), whole)}


@pytest.mark.parametrize(
    ("whole", "packets", "bits"),
    [
        (reading(6, 0, 11), "65 % of 17 packets", "0 % of 60 bits"),
        (reading(374, 0, 458), "55 % of 832 packets", "0 % of 3740 bits"),
        (reading(996, 0, 0, wrong=4), "0.4 % of 1000 packets", "0.04 % of 10000 bits"),
        (reading(0, 3, 2), "100 % of 5 packets", None),
        (reading(999, 0, 1), "0.10 % of 1000 packets", "0 % of 9990 bits"),
        (reading(1, 0, 999), "99.90 % of 1000 packets", "0 % of 10 bits"),
    ],
)
def test_rates_name_what_they_count_and_have_no_digit_that_chance_has_made(
    whole: VideoReading, packets: str, bits: str | None
) -> None:
    figures = said(whole)
    assert figures["Packet error rate"] == packets
    assert figures.get("Bit error rate") == bits


@pytest.mark.parametrize(
    ("count", "total", "interval"),
    [
        (0, 10, "0 to 28 %"),
        (10, 10, "72 to 100 %"),
        (9, 10, "60 to 98.2 %"),
        (999, 1000, "99.44 to 99.982 %"),
        (1, 1_000_000, "0.000018 to 0.00057 %"),
    ],
)
def test_an_interval_is_written_without_exponents_and_tells_nearly_all_from_all(
    count: int, total: int, interval: str
) -> None:
    assert error_rate(count, total, "packets")[1] == f"{interval} at 95 %"


def test_lost_packets_are_told_from_wrong_bits() -> None:
    whole = reading(6, 1, 11, wrong=2)
    (sentence,) = sentences_of(known(whole), whole, None)
    assert sentence.startswith("Of 14 lost packets no frame shows 11 whole")
    assert "3 were in view and misread" in sentence
    assert "not placed" not in sentence
    assert "1 frames that were not placed" in sentences_of(known(whole, 1), whole, None)[0]
    whole = reading(6, 0, 11)
    assert "misread" not in sentences_of(known(whole), whole, None)[0]
    whole = reading(6, 0, 0)
    assert sentences_of(known(whole), whole, None) == ()
