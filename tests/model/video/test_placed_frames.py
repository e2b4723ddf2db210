"""Frames are placed in what is sent though none of them shows by itself which part it is of."""

import math

import numpy as np

import occ_model as occ
from occ_model.results.video_reading import FrameReading
from occ_model.transmitter.packet import sent_chips
from occ_model.video.period import SentPeriod
from occ_model.video.placed_frames import PlacedFrames
from occ_model.video.read_frame import TimedFrame

SCENE = occ.Scene().replace(
    line_code="manchester", framing="c-ook", payload="hex:0123456789abcdeffedcba9876543210"
)
VIEW = 11.9
"""Chips in view: a preamble of 6 and less than the 6 of a sub-packet's number on either side."""

COLUMNS, FRAME_PERIOD = 240, 1 / 30
FREQUENCY = (400 + 9.3) / FRAME_PERIOD  # of eight sub-packets: the next frame begins 9.3 chips on
STEP = VIEW / COLUMNS


def frame(index: int, chips: np.ndarray) -> tuple[TimedFrame, int]:
    """A frame that shows some chips without an error, and the number of its first whole one."""
    time, column = index * FRAME_PERIOD, 0.5 * (COLUMNS - 1)
    begin = time * FREQUENCY
    first, end = math.ceil(begin), math.floor(begin + VIEW)
    seen = chips[np.arange(first, end) % len(chips)]
    ratios = np.where(seen == 1, 9.0, -9.0)
    reading = FrameReading(index, time, chips=seen, ratios=ratios, whole=(0, len(seen)))
    middle = begin + STEP * column - first
    return TimedFrame(reading, middle, 0.01, column, STEP, 1e-5 * STEP), first


def test_sub_packets_are_found_by_the_clock_where_no_frame_shows_a_number() -> None:
    period, chips = SentPeriod(SCENE.transmitter), sent_chips(SCENE.transmitter)
    readout = STEP / FREQUENCY
    placed = PlacedFrames(period, 1.002 * readout, 0.005)
    placed.columns = COLUMNS
    frames = [frame(index, chips) for index in range(5, 50)]
    headers = [period.places(timed.reading.chips) for timed, _ in frames]
    assert {len(places) for places in headers} == {0, period.parts}
    for timed, _ in frames:
        placed.add(timed)
    placed.settle()
    found = [placed.reading(number).place for number in range(len(frames))]
    assert found == [first % len(chips) for _, first in frames]
    assert placed.joined.known.all()
    assert ((placed.joined.ratios > 0.0) == chips).all()
