"""Simulated films are read: the clock within its errors, and the payload if all was in view."""

import math
import tracemalloc
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from each_case import each_case
from simulated_films import Judged, film, judge

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.results.video import VideoFrame
from occ_model.scene.recording import Recording
from occ_model.video.read_frame import FrameReader, TimedFrame, read_by_itself

_VALUES = ("switching_frequency", "readout_time", "gap")
SCENE = occ.load_preset("phone-68us").replace(
    rows=32,
    columns=720,
    readout_time=36e-6,
    switching_frequency=3.1e3,
    exposure_time=150e-6,
    payload="text:HELLO",
    framing="raw",
    line_code="manchester",
    panel_width=0.8,
    panel_height=1.5,
    distance=0.5,
)
"""A view of 26 ms has 80 chips and a packet 134, so no frame shows a whole packet."""


class Frames(occ.Video):
    """A film with given frames."""

    def __init__(self, frames: list[VideoFrame], columns: int) -> None:
        self.title, self.frames_ = "frames", frames
        self.shape, self.frame_rate = (frames[0].image.shape[0], columns), None
        self.frame_count = len(frames)

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        return iter(self.frames_[first:])

    def frame(self, index: int) -> VideoFrame:
        return self.frames_[index]


def record_frames(
    scene: occ.Scene, count: int, recording: Recording | None = None
) -> list[VideoFrame]:
    return list(occ.render_video(scene, count, recording))


_READ: dict[tuple[object, ...], tuple[VideoFrame, TimedFrame]] = {}


@pytest.fixture(autouse=True)
def chips_are_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Read each picture only once per scene, as most tests differ only in the stated times."""
    usual = FrameReader.read

    def read_cached(reader: FrameReader, frame: VideoFrame) -> TimedFrame:
        key = (id(frame.image), frame.exposure_time, reader.enhanced, reader.decoder)
        if key not in _READ:
            _READ[key] = frame, usual(reader, frame)
        _, timed = _READ[key]
        reading = replace(timed.reading, index=frame.index, time=frame.time)
        return replace(timed, reading=reading)

    monkeypatch.setattr(FrameReader, "read", read_cached)


@cache
def film_of_scene() -> list[VideoFrame]:
    """Return 33 frames of the scene for all tests that do not change them.

    The reader does not get the scene and the start that simulated frames contain.
    """
    return [replace(frame, scene=None, start=None) for frame in record_frames(SCENE, 33)]


@cache
def whole_reading() -> occ.VideoReading:
    """Return the reading of the first 32 of them."""
    return reading_of(film_of_scene()[:32], SCENE)


def reading_of(frames: list[VideoFrame], scene: occ.Scene) -> occ.VideoReading:
    return occ.decode_video(Frames(frames, scene.camera.columns), scene)


def assert_correct(judged: Judged) -> None:
    """Check a film's clock and payload against the truth."""
    truth, period = judged.film.truth, judged.film.recording.frame_period
    assert judged.reading.clock.is_sure
    assert abs(judged.error("switching_frequency")[0]) < 20e-6 * truth["switching_frequency"]
    assert abs(judged.error("readout_time")[0]) < 5e-4 * truth["readout_time"]
    assert abs(judged.error("gap")[0]) < 5e-3 * period
    for name in _VALUES:
        off, error = judged.error(name)
        assert abs(off) < 5.0 * error
    if judged.all_seen:
        assert judged.is_right, judged.reading.failure


def test_a_film_gives_its_clock_and_the_payload() -> None:
    assert_correct(judge(film(2, seconds=1.0)))


def test_packets_longer_than_a_frame_are_joined_chip_by_chip() -> None:
    reading = whole_reading()
    assert reading.failure is None
    assert reading.payload == "HELLO"
    assert reading.read == 0
    assert 0.0 < reading.complete_at < 1.0


def test_a_reading_does_not_need_the_exact_readout_time_or_frequency() -> None:
    rough = SCENE.replace(readout_time=36.2e-6, switching_frequency=3.09e3)
    reading = reading_of(film_of_scene()[:22], rough)
    assert reading.payload == "HELLO"
    assert reading.clock is not None
    clock = reading.clock
    assert clock.switching_frequency.value == pytest.approx(3.1e3, rel=1e-6)
    assert clock.readout_time.value == pytest.approx(36e-6, rel=1e-4)
    assert clock.frame_period.value == pytest.approx(1.0 / 30.0, rel=1e-9)


def test_knowledge_grows_frame_by_frame_up_to_the_final_reading() -> None:
    steps = list(occ.decode_frames(film_of_scene()[:32], SCENE))
    known = [step.known for step in steps]
    assert known == sorted(known)
    assert [step.frames for step in steps] == list(range(1, 33))
    assert not steps[0].complete
    assert "·" in steps[0].payload
    assert steps[-1].payload == whole_reading().payload == "HELLO"


def test_sub_packets_are_joined_by_their_numbers() -> None:
    scene = SCENE.replace(framing="c-ook", payload="text:sub-packets join")
    reading = reading_of(record_frames(scene, 24), scene)
    assert reading.payload == "sub-packets join"
    assert {packet.part for packet in reading.packets if packet.is_read} <= set(range(8))
    assert reading.doubled == reading.read - len(
        {packet.part for packet in reading.packets if packet.is_read}
    )
    assert reading.bit_error_rate == 0.0


def test_packets_read_and_lost_are_those_of_exact_counting() -> None:
    reading = reading_of_short_packets()
    assert reading.payload == str(0b10110010)
    sent = 1.0 * 3.1e3 / 20.0
    assert len(reading.packets) == pytest.approx(sent, abs=1.0)
    assert reading.read + reading.lost == len(reading.packets)
    seen = [packet for packet in reading.packets if packet.seen == 1.0 and packet.frame is not None]
    assert reading.read == len(seen)
    assert all(packet.correct for packet in seen)
    assert reading.rates(5)[0].start == reading.frames[0].time


SHORT = SCENE.replace(payload="", bits=8, code=0b10110010, framing="paper",
                      line_code="differential-manchester")  # fmt: skip


@cache
def film_of_short_packets() -> list[VideoFrame]:
    return record_frames(SHORT, 30)


def change_times(times: Iterable[float]) -> list[VideoFrame]:
    """Return the film of short packets with other stated times."""
    both = zip(film_of_short_packets(), times, strict=True)
    return [replace(frame, time=float(time)) for frame, time in both]


def assert_adds_up(reading: occ.VideoReading) -> None:
    """Check that all figures of a reading refer to the same packets and the same time."""
    windows = reading.rates(4)
    assert reading.read + reading.lost == len(reading.packets)
    assert sum(window.packets for window in windows) == len(reading.packets)
    assert sum(window.packets_lost for window in windows) == reading.lost
    assert sum(packet.is_right for packet in reading.packets.in_view) == reading.read
    assert {packet.number for packet in reading.packets.in_view} <= {*range(len(reading.packets))}
    assert [packet.number for packet in reading.packets[:99]] == list(
        range(min(99, len(reading.packets)))
    )
    if reading.complete_after is not None:
        assert 0.0 < reading.complete_after <= reading.duration * (1.0 + 1e-9)


@cache
def reading_of_short_packets() -> occ.VideoReading:
    return reading_of(film_of_short_packets(), SHORT)


@pytest.mark.parametrize(
    ("jump", "after"), [(0.6, 1), (3600.0, 15), (3.15e7, 29), (-0.5, 15), (-3600.0, 1)]
)
def test_the_time_between_two_parts_of_a_film_is_in_none_of_its_figures(
    jump: float, after: int
) -> None:
    steady = reading_of_short_packets()
    times = np.arange(30) / 30.0
    times[after:] += jump
    reading = reading_of(change_times(times), SHORT)
    assert_adds_up(reading)
    assert (reading.payload, reading.read) == (steady.payload, steady.read)
    assert len(reading.packets) == pytest.approx(len(steady.packets), abs=2)
    assert reading.duration == pytest.approx(steady.duration)
    assert reading.bits_per_second == pytest.approx(steady.bits_per_second)
    assert reading.complete_after == pytest.approx(steady.complete_after)
    clock = reading.clock
    off = clock.switching_frequency.value - SHORT.transmitter.switching_frequency
    assert abs(off) < 5.0 * clock.switching_frequency.error
    assert clock.frame_period.value == pytest.approx(1.0 / 30.0, rel=1e-8)
    jumped, of_which = reading.problems
    assert "times jump by" in jumped
    assert of_which.startswith("The clock is that of frames ")


def test_false_times_take_no_memory() -> None:
    reader = occ.VideoReader(SHORT)
    tracemalloc.start()
    for number, frame in enumerate(film_of_short_packets()[:9]):
        reader.add(replace(frame, time=9e6 * number))
    reader.reading()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6


def test_a_payload_is_complete_after_the_frames_it_needed() -> None:
    """Later frames are further and further apart."""
    frames = [film_of_short_packets()[number] for number in (*range(10), 12, 16, 21, 27)]
    reading = reading_of(frames, SHORT)
    assert reading.complete_after < 0.2
    assert reading.duration == pytest.approx(28 / 30)
    assert_adds_up(reading)


@pytest.mark.parametrize(
    ("times", "said"),
    [
        (60.0 * np.arange(30), "gives no clock"),
        (np.full(30, 7.0), "do not increase"),
        (1.0 - np.arange(30) / 30.0, "do not increase"),
        (3600.0 * (np.arange(30) % 2) + np.arange(30) / 30.0, "times jump by"),
        (np.random.default_rng(1).permutation(30) / 30.0, "times jump by"),
        (np.arange(30) / 60.0, "gives no clock"),
        (1e-300 * np.arange(30), "do not increase"),
    ],
)
def test_times_that_determine_no_clock_give_none_and_a_sentence(
    times: FloatArray, said: str
) -> None:
    reading = reading_of(change_times(times), SHORT)
    assert reading.payload == str(0b10110010)
    assert reading.clock is None
    assert len(reading.packets) == 0
    assert reading.rates(3) == ()
    assert any(said in problem for problem in reading.problems)


@each_case(
    [
        ({"time": math.nan}, "time of frame 3 is nan s; allowed: -1e+08 to 1e+08 s"),
        ({"time": -math.inf}, "time of frame 3 is -inf s"),
        ({"time": 1e308}, "time of frame 3 is 1e[+]308 s"),
        ({"time": "0:03"}, "time of frame 3 is '0:03' s"),
        ({"index": -1}, "index of a frame is -1"),
        (
            {"image": np.zeros((32, 721), np.uint8)},
            r"shape \(32, 721\); allowed: that of the first",
        ),
        ({"image": np.zeros((31, 720), np.uint8)}, r"shape \(31, 720\)"),
        ({"image": np.zeros(720, np.uint8)}, r"image of frame 3 is uint8 \(720,\); allowed"),
        ({"image": np.full((32, 720), 256.0)}, "image of frame 3 has values from 256 to 256"),
        ({"image": np.zeros((32, 720), bool)}, "image of frame 3 has pixels of type bool"),
        ({"image": None}, "image of frame 3 is None"),
        ({"exposure_time": math.nan}, "exposure_time is "),
    ]
)
def test_an_invalid_frame_is_refused_and_the_earlier_ones_are_kept(
    change: dict[str, object], said: str
) -> None:
    reader = occ.VideoReader(SHORT)
    for number, frame in enumerate(film_of_short_packets()[:6]):
        if number == 3:
            with pytest.raises(occ.ParameterError, match=said.replace("+08", "[+]08")):
                reader.add(replace(frame, **change))  # type: ignore[arg-type]
        reader.add(frame)
    without = reading_of(film_of_short_packets()[:6], SHORT)
    reading = reader.reading()
    assert reading.clock == without.clock
    assert (reading.read, reading.payload) == (without.read, without.payload)
    with pytest.raises(occ.ParameterError, match="frame is 3; allowed: a VideoFrame"):
        reader.add(3)  # type: ignore[arg-type]


@pytest.mark.parametrize("white", [1.0, 255.0])
def test_white_is_the_same_value_in_all_floating_point_frames(white: float) -> None:
    frames = film_of_short_packets()[:6]
    reader, scale = occ.VideoReader(SHORT), white / 255.0
    for frame in frames:
        pixels: Any = (frame.image * scale).astype(">f4")
        reader.add(replace(frame, image=pixels))
    assert reader.reading().clock == reading_of(frames, SHORT).clock
    pixels = frames[0].image / (255.0 * scale)
    other = replace(frames[0], index=6, time=0.2, image=pixels)
    if white == 1.0:
        with pytest.raises(occ.ParameterError, match="image of frame 6 has values from"):
            reader.add(other)
    else:
        assert not reader.add(other).frame.chips.size  # a dark frame among bright ones


def test_a_square_wave_leaves_aliases_that_are_stated() -> None:
    scene = SCENE.replace(payload="", pattern="10", switching_frequency=4e3, exposure_time=1e-4)
    frames = Frames(record_frames(scene, 16), scene.camera.columns)
    reading = occ.decode_video(frames, scene, readout_tolerance=0.03)
    assert not reading.clock.is_sure
    stated = [reading.clock.switching_frequency.value]
    stated += [other.switching_frequency.value for other in reading.clock.alternatives]
    # A wave of two chips at 30 frames per second: one every 60 Hz from 4 kHz / 1.03 to 4 kHz /
    # 0.97.
    assert sorted(round(frequency) for frequency in stated) == [3940, 4000, 4060, 4120]
    assert any("fit the frames equally well" in problem for problem in reading.clock.problems)


def test_dropped_frames_that_the_times_hide_are_reported() -> None:
    frames = film_of_scene()
    kept = frames[:20] + frames[21:]
    renumbered = [
        replace(frame, index=number, time=number / 30.0) for number, frame in enumerate(kept)
    ]
    reading = reading_of(renumbered, SCENE)
    assert any("frames were dropped" in problem for problem in reading.clock.problems)
    assert reading.clock.switching_frequency.value == pytest.approx(3.1e3, rel=20e-6)
    assert reading.payload == "HELLO"


def test_a_film_without_stripes_fails_with_a_sentence() -> None:
    dark = [
        VideoFrame(number, number / 30.0, np.full((24, 90), 7, np.uint8)) for number in range(5)
    ]
    reading = reading_of(dark, SCENE)
    assert reading.clock is None
    assert len(reading.packets) == 0
    assert reading.failure.startswith("None of 5 frames shows chips. The first one: No panel")


def near_the_null(frequency: float) -> occ.Scene:
    """Return the paper's phone, whose single chips almost vanish just below 2 / t = 14.7 kHz."""
    return occ.load_preset("phone-136us").replace(switching_frequency=frequency, rows=1152)


def test_if_the_enhanced_picture_is_read_so_is_the_film() -> None:
    scene = near_the_null(13.9e3)
    as_the_camera_gives_it = scene.replace(enhancement="none")
    assert occ.decode(occ.render(scene).image, scene).code == scene.transmitter.code
    assert occ.decode(occ.render(as_the_camera_gives_it).image, scene).code is None
    frames = record_frames(scene, 2)
    alone, is_enhanced = read_by_itself(frames[0].image, scene)
    assert (alone.code, is_enhanced) == (scene.transmitter.code, True)
    assert alone.region is not None
    alone, is_enhanced = read_by_itself(frames[0].image, as_the_camera_gives_it)
    assert (alone.code, is_enhanced) == (None, False)
    assert reading_of(frames, scene).payload == str(scene.transmitter.code)
    assert reading_of(frames, as_the_camera_gives_it).failure is not None


def test_a_film_that_is_not_read_fails_with_the_words_of_a_single_picture() -> None:
    scene = near_the_null(14.6e3)
    still = occ.decode(occ.render(scene).image, scene).failure
    assert still is not None
    failure = reading_of(record_frames(scene, 2), scene).failure
    assert "not known for any of 2 frames" in failure
    assert failure.endswith(still)


def test_a_film_that_is_too_short_states_how_much_was_not_in_view() -> None:
    reading = reading_of(film_of_scene()[:2], SCENE)
    assert "of 134 chips are in no frame" in reading.failure or "header" in reading.failure
