"""The line on a film states the payload once it is complete, the lamp, or why neither is known."""

from dataclasses import replace

import numpy as np
import pytest

from occ_model.results.clock import Clock, MeasuredValue
from occ_model.results.film_sentence import describe_film
from occ_model.results.sent_packets import SentPackets
from occ_model.results.video_reading import FilmProgress, FrameReading, VideoReading


def value(number: float, error: float = 0.01) -> MeasuredValue:
    return MeasuredValue(number, error)


CLOCK = Clock(
    value(200.0, 0.02), value(1e-5, 1e-8), value(1 / 30, 1e-6), value(1e-3, 1e-5), 1,
    drift=None, timing_noise=1e-6, frames=60,
)  # fmt: skip
PROGRESS = FilmProgress(FrameReading(0, 0.0), 60, 0, "", 0.0, False, None)


@pytest.fixture
def reading() -> VideoReading:
    bits = np.ones(10, dtype=np.uint8)
    return VideoReading(
        (), SentPackets(()), None, bits, bits.astype(bool), "718", 1.0, 0.1, 2.0, None,
        complete_after=0.133,
    )  # fmt: skip


def test_nothing_a_part_and_all_of_a_payload(reading: VideoReading) -> None:
    assert describe_film(PROGRESS, None) == "Nothing read yet in 60 frames."
    part = replace(PROGRESS, placed=3, payload="HE.LO", known=0.8)
    assert describe_film(part, None) == "“HE.LO”, 80 % of a packet known, is read so far."
    assert describe_film(part, reading) == "“718” read, complete after 133 ms."
    doubtful = replace(reading, certainty=0.93)
    assert describe_film(part, doubtful).endswith(
        "133 ms; all bits are right with a probability of 93 %."
    )


def test_a_failure_is_the_answer(reading: VideoReading) -> None:
    failed = replace(reading, complete_after=None, payload="", failure="No stripes were found.")
    assert describe_film(PROGRESS, failed) == "No stripes were found."


def test_a_lamp_has_its_frequency_with_its_error() -> None:
    lamp = replace(CLOCK, chips_of_cycle=2)
    assert describe_film(replace(PROGRESS, clock=lamp), None) == "A lamp of 100.000 ± 0.010 Hz."
    unsure = replace(lamp, timing_noise=None)
    sentence = describe_film(replace(PROGRESS, clock=unsure), None)
    assert sentence == "A lamp of 100.000 ± 0.010 Hz, not sure."
    assert "lamp" not in describe_film(replace(PROGRESS, clock=CLOCK), None)
