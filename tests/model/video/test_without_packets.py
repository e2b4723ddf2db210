"""A film without packets is described: lamps and their clock, bursts, blinking frames."""

import re

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.video import VideoFrame
from occ_model.results.video_reading import VideoReading
from occ_model.video.reader import VideoReader

COLUMNS, FRAME_RATE, READOUT = 600, 30.0, 25e-6
SCENE = occ.load_preset("phone-136us").replace(
    rows=40, columns=COLUMNS, readout_time=1.004 * READOUT, switching_frequency=8e3
)
"""The receiver's assumptions, whose readout time is wrong by 0.4 %."""


def stripes(frame: int, chips: str, frequency: float) -> np.ndarray:
    """Draw a frame of the lamp's level at each column's time, averaged over a tenth of a chip."""
    times = frame / FRAME_RATE + READOUT * np.arange(COLUMNS)
    parts = [times * frequency + part / 100.0 for part in range(10)]
    levels = np.array([int(chip) for chip in chips])
    lit = np.mean([levels[np.floor(part).astype(int) % len(levels)] for part in parts], axis=0)
    return np.asarray(30.0 + 180.0 * lit)


def read(pictures: list[np.ndarray]) -> VideoReading:
    random = np.random.default_rng(38)
    frames = [
        VideoFrame(
            number,
            number / FRAME_RATE,
            np.clip(np.tile(line, (40, 1)) + random.normal(0.0, 2.0, (40, COLUMNS)), 0, 255).astype(
                np.uint8
            ),
        )
        for number, line in enumerate(pictures)
    ]
    reader = VideoReader(SCENE)
    for frame in frames:
        reader.add(frame)
    return reader.reading()


@pytest.mark.parametrize(
    ("chips", "chip_rate"), [("10", 2345.0), ("1110000000", 6000.0), ("1111111100", 5123.0)]
)
def test_a_lamp_gives_its_clock(chips: str, chip_rate: float) -> None:
    found = read([stripes(number, chips, chip_rate) for number in range(8)])
    assert found.failure.startswith("A lamp is lit once in each period: its stripes")
    assert "header" not in found.failure
    frequency, readout = found.clock.lamp_frequency, found.clock.readout_time
    cycles = chip_rate / len(chips)
    others = [
        frequency.value,
        *(0.5 * one.switching_frequency.value for one in found.clock.alternatives),
    ]
    assert min(abs(one - cycles) for one in others) < 4.0 * frequency.error + 1e-6 * cycles
    if len(others) == 1:
        assert readout.value == pytest.approx(READOUT, abs=3.0 * readout.error)
    assert 0.0 < readout.error < 0.005 * READOUT


def test_the_failure_of_an_overexposed_film_states_the_overexposure() -> None:
    frames = [stripes(number, "10", 2345.0) for number in range(8)]
    dim, bright = read(frames), read([4.0 * frame for frame in frames])
    assert "Overexposed" not in dim.failure
    assert bright.failure.startswith("A lamp is lit once in each period")
    assert re.search(
        r" Overexposed: [3-5]\d % of the panel's columns are saturated", bright.failure
    )


def test_stripes_in_some_frames_are_bursts() -> None:
    square, dark = stripes(0, "10", 2345.0), np.full(COLUMNS, 30.0)
    found = read([square if number // 3 % 2 else dark for number in range(12)])
    # The lamp may be out of view in the others.
    assert "Only 6 of 12 frames show them. " in found.failure
    assert "burst" not in found.failure
    assert found.clock is None


def test_whole_frames_that_blink_are_described() -> None:
    found = read([np.full(COLUMNS, 200.0 if number // 2 % 2 else 30.0) for number in range(10)])
    assert found.failure.startswith(
        "Whole frames are bright or dark: 4 of 10 are bright, and that changes 4 times"
    )
    # A global shutter shows a fast lamp in this way, as does a lamp switched by hand.
    assert found.failure.endswith(
        "No frame shows stripes that repeat. No frame contains packets as the scene sends them."
    )
    assert "slow" not in found.failure


def test_frames_that_blink_regularly_give_their_frequency() -> None:
    found = read([np.full(COLUMNS, 200.0 if number // 3 % 2 else 30.0) for number in range(36)])
    assert re.search(r"They blink at 5\.0+ ± 0\.\d+ Hz, or at that much above", found.failure)


def test_the_beat_is_how_fast_stripes_pass_through_the_frames() -> None:
    found = read([stripes(number, "10", 2400.0 - 3.4) for number in range(12)])
    beat = found.clock.beat
    assert abs(beat.value + 1.7) < 4.0 * beat.error
    assert beat.error < 0.01


def test_a_repeated_pattern_is_not_a_lamp() -> None:
    found = read([stripes(number, "1101000", 5000.0) for number in range(6)])
    assert found.failure.startswith("The stripes repeat after 56.")
    assert found.clock is None


def test_frames_that_show_nothing_and_hardly_change_fail_without_a_description() -> None:
    found = read([np.full(COLUMNS, 35.0 if number // 2 % 2 else 30.0) for number in range(5)])
    assert found.failure.startswith("None of 5 frames shows chips")


def test_if_nine_of_ten_frames_show_a_pulse_packets_are_not_mentioned() -> None:
    sent = [*["10"] * 9, "1101000"]
    found = read([stripes(number, chips, 5000.0) for number, chips in enumerate(sent)])
    assert found.failure.startswith("A lamp is lit once in each period")
    assert found.failure.endswith("No frame contains packets as the scene sends them.")
