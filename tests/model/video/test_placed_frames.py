"""Frames are placed in the period even if none of them shows to which sub-packet it belongs."""

import math

import numpy as np

import occ_model as occ
from occ_model.results.video_reading import FrameReading
from occ_model.transmitter.scheme import sent_chips
from occ_model.video.known_timing import KnownTiming
from occ_model.video.period import SentPeriod
from occ_model.video.placed_frames import PART_UNKNOWN, PlacedFrames
from occ_model.video.read_frame import TimedFrame

SCENE = occ.Scene().replace(
    line_code="manchester", framing="c-ook", payload="hex:0123456789abcdeffedcba9876543210"
)
VIEW = 11.9
"""Chips in view: a preamble of 6, and fewer than the 6 of a sub-packet's number on each side."""

COLUMNS, FRAME_PERIOD = 240, 1 / 30
STEP = VIEW / COLUMNS


def make_frame(index: int, chips: np.ndarray, frequency: float) -> tuple[TimedFrame, int]:
    """Return a frame that shows chips without errors, and the number of its first whole one."""
    time, column = index * FRAME_PERIOD, 0.5 * (COLUMNS - 1)
    begin = time * frequency
    first, end = math.ceil(begin), math.floor(begin + VIEW)
    seen = chips[np.arange(first, end) % len(chips)]
    ratios = np.where(seen == 1, 9.0, -9.0)
    reading = FrameReading(index, time, chips=seen, ratios=ratios, whole=(0, len(seen)))
    middle = begin + STEP * column - first
    return TimedFrame(reading, middle, 0.01, column, STEP, 1e-5 * STEP), first


def place_frames(shift: float) -> tuple[PlacedFrames, list[TimedFrame], list[int]]:
    """Place frames that start this many chips apart, beginning after eight sub-packets."""
    period, chips = SentPeriod(SCENE.transmitter), sent_chips(SCENE.transmitter)
    frequency = (len(chips) + shift) / FRAME_PERIOD
    placed = PlacedFrames(period, KnownTiming(frequency, 1.002 * STEP / frequency, None, 0.005))
    placed.columns = COLUMNS
    frames, firsts = zip(
        *(make_frame(index, chips, frequency) for index in range(5, 50)), strict=True
    )
    for timed in frames:
        placed.add(timed)
    placed.settle()
    return placed, [*frames], [first % len(chips) for first in firsts]


def test_sub_packets_are_found_by_the_clock_if_no_frame_shows_a_number() -> None:
    placed, frames, firsts = place_frames(9.3)
    period, chips = SentPeriod(SCENE.transmitter), sent_chips(SCENE.transmitter)
    headers = [period.places(timed.reading.chips) for timed in frames]
    assert {len(places) for places in headers} == {0, period.parts}
    assert [placed.reading(number).place for number in range(len(frames))] == firsts
    assert placed.joined.known.all()
    assert ((placed.joined.ratios > 0.0) == chips).all()


def test_no_place_is_stated_if_the_sub_packets_numbers_stay_unknown() -> None:
    part = SentPeriod(SCENE.transmitter).part_length
    placed, frames, _ = place_frames(part - 0.02)  # always the same chips of a sub-packet
    assert placed.placed > 0
    for number in range(len(frames)):
        reading = placed.reading(number)
        assert (reading.place, reading.failure) == (None, PART_UNKNOWN)
