"""Simulated films, read: the clock within its errors, the payload where all of it was in view."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated_films import FILMS, Film, Judged, film, judge

import occ_model as occ
from occ_model.results.video import VideoFrame
from occ_model.scene.recording import Recording
from occ_model.video.read_frame import read_by_itself

_VALUES = ("switching_frequency", "readout_time", "gap")
_EVERYDAY = (3,)
_WHOLE = range(0, 24, 3)
"""Some of each frame rate, framing and line code; tests/benchmarks/film_reading.py reads all."""

_FRAMES = 100
"""Most frames of a film here: what many frames a second show sooner is as exact."""

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
"""Eighty chips in a view of 26 ms, of packets of 134 chips: no frame shows a packet whole."""


class Frames(occ.Video):
    """A film of given frames."""

    def __init__(self, frames: list[VideoFrame], columns: int) -> None:
        self.title, self.frames_ = "frames", frames
        self.shape, self.frame_rate = (frames[0].image.shape[0], columns), None
        self.frame_count = len(frames)

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        return iter(self.frames_[first:])

    def frame(self, index: int) -> VideoFrame:
        return self.frames_[index]


def recorded(scene: occ.Scene, count: int, recording: Recording | None = None) -> list[VideoFrame]:
    return list(occ.render_video(scene, count, recording))


@cache
def film_of_scene() -> list[VideoFrame]:
    """Forty frames and one of the scene, for all who only look at them."""
    return recorded(SCENE, 41)


@cache
def whole_reading() -> occ.VideoReading:
    """What the first forty of them give."""
    return reading_of(film_of_scene()[:40], SCENE)


def reading_of(frames: list[VideoFrame], scene: occ.Scene) -> occ.VideoReading:
    return occ.decode_video(Frames(frames, scene.camera.columns), scene)


def assert_as_demanded(judged: Judged) -> None:
    """The demands on one film's clock and payload, each beside the truth."""
    truth, period = judged.film.truth, judged.film.recording.frame_period
    assert judged.reading.clock is not None
    assert judged.reading.clock.is_sure
    assert abs(judged.error("switching_frequency")[0]) < 20e-6 * truth["switching_frequency"]
    assert abs(judged.error("readout_time")[0]) < 5e-4 * truth["readout_time"]
    assert abs(judged.error("gap")[0]) < 5e-3 * period
    for name in _VALUES:
        off, error = judged.error(name)
        assert abs(off) < 5.0 * error
    if judged.all_seen:
        assert judged.is_right, judged.reading.failure


@pytest.mark.parametrize("number", _EVERYDAY)
def test_a_film_gives_its_clock_and_the_payload(number: int) -> None:
    short = film(number, seconds=2.5)
    assert_as_demanded(judge(short))


@pytest.mark.whole
def test_films_give_their_clocks_and_payloads_with_errors_that_hold() -> None:
    judged = [judge(film(number, most_frames=_FRAMES)) for number in _WHOLE]
    read = [one for one in judged if one.reading.clock is not None]
    for one in read:
        assert_as_demanded(one)
    # Of packets of more than 2,000 chips hardly any frame shows the header: that is said.
    unread = [one for one in judged if one.reading.clock is None]
    assert len(unread) <= 1
    for one in unread:
        assert one.film.scene.transmitter.payload_length == 1024
        assert one.reading.failure is not None
        assert not one.reading.bits.size
    ratios = [off / error for one in read for off, error in map(one.error, _VALUES)]
    inside = float(np.mean(np.abs(ratios) < 1.0))
    assert inside == pytest.approx(0.68, abs=2.5 * math.sqrt(0.68 * 0.32 / len(ratios)))


def test_packets_longer_than_a_frame_are_joined_chip_by_chip() -> None:
    reading = whole_reading()
    assert reading.failure is None
    assert reading.payload == "HELLO"
    assert reading.read == 0
    assert reading.complete_at is not None
    assert 0.0 < reading.complete_at < 1.0


def test_a_reading_needs_no_exact_readout_time_or_frequency() -> None:
    rough = SCENE.replace(readout_time=36.2e-6, switching_frequency=3.09e3)
    reading = reading_of(film_of_scene()[:30], rough)
    assert reading.payload == "HELLO"
    assert reading.clock is not None
    clock = reading.clock
    assert clock.switching_frequency.value == pytest.approx(3.1e3, rel=1e-6)
    assert clock.readout_time.value == pytest.approx(36e-6, rel=1e-4)
    assert clock.frame_period.value == pytest.approx(1.0 / 30.0, rel=1e-9)


def test_what_is_known_grows_frame_by_frame_and_ends_as_the_reading() -> None:
    steps = list(occ.decode_frames(film_of_scene()[:40], SCENE))
    known = [step.known for step in steps]
    assert known == sorted(known)
    assert [step.frames for step in steps] == list(range(1, 41))
    assert not steps[0].complete
    assert "·" in steps[0].payload
    assert steps[-1].payload == whole_reading().payload == "HELLO"


def test_sub_packets_are_joined_by_their_numbers() -> None:
    scene = SCENE.replace(framing="c-ook", payload="text:sub-packets join")
    reading = reading_of(recorded(scene, 45), scene)
    assert reading.payload == "sub-packets join"
    assert {packet.part for packet in reading.packets if packet.is_read} <= set(range(8))
    assert reading.doubled == reading.read - len(
        {packet.part for packet in reading.packets if packet.is_read}
    )
    assert reading.bit_error_rate == 0.0


def test_packets_read_and_lost_are_those_that_counting_gives() -> None:
    scene = SCENE.replace(payload="", bits=8, code=0b10110010, framing="paper",
                          line_code="differential-manchester")  # fmt: skip
    recording = Recording(frame_rate=30.0)
    frames = recorded(scene, 30, recording)
    reading = reading_of(frames, scene)
    assert reading.payload == str(0b10110010)
    sent = 1.0 * 3.1e3 / 20.0
    assert len(reading.packets) == pytest.approx(sent, abs=1.0)
    assert reading.read + reading.lost == len(reading.packets)
    seen = [packet for packet in reading.packets if packet.seen == 1.0 and packet.frame is not None]
    assert reading.read == len(seen)
    assert all(packet.correct for packet in seen)


def test_a_square_wave_leaves_aliases_and_they_are_said() -> None:
    scene = SCENE.replace(payload="", pattern="10", switching_frequency=4e3, exposure_time=1e-4)
    frames = Frames(recorded(scene, 30), scene.camera.columns)
    reading = occ.decode_video(frames, scene, readout_tolerance=0.03)
    assert reading.clock is not None
    assert not reading.clock.is_sure
    stated = [reading.clock.switching_frequency.value]
    stated += [frequency for frequency, _ in reading.clock.alternatives]
    # A wave of two chips, 30 frames a second: one each 60 Hz, from 4 kHz / 1.03 to 4 kHz / 0.97.
    assert sorted(round(frequency) for frequency in stated) == [3940, 4000, 4060, 4120]
    assert any("fit the frames alike" in problem for problem in reading.clock.problems)


def test_dropped_frames_that_the_times_hide_are_told() -> None:
    frames = film_of_scene()
    kept = frames[:20] + frames[21:]
    renumbered = [
        replace(frame, index=number, time=number / 30.0) for number, frame in enumerate(kept)
    ]
    reading = reading_of(renumbered, SCENE)
    assert reading.clock is not None
    assert any("frames were dropped" in problem for problem in reading.clock.problems)
    assert reading.clock.switching_frequency.value == pytest.approx(3.1e3, rel=20e-6)
    assert reading.payload == "HELLO"


def test_a_film_without_stripes_fails_with_a_sentence() -> None:
    dark = [
        VideoFrame(number, number / 30.0, np.full((24, 90), 7, np.uint8)) for number in range(5)
    ]
    reading = reading_of(dark, SCENE)
    assert reading.clock is None
    assert reading.packets == ()
    assert reading.failure is not None
    assert reading.failure.startswith("None of 5 frames shows chips; of the first one: No panel")


def near_the_null(frequency: float) -> occ.Scene:
    """The paper's phone, whose single chips all but vanish just below 2 / t = 14.7 kHz."""
    return occ.load_preset("phone-136us").replace(switching_frequency=frequency, rows=1152)


def test_where_the_enhanced_picture_is_read_the_film_is() -> None:
    scene = near_the_null(14.21e3)
    as_the_camera_gives_it = scene.replace(enhancement="none")
    assert occ.decode(occ.render(scene).image, scene).code == scene.transmitter.code
    assert occ.decode(occ.render(as_the_camera_gives_it).image, scene).code is None
    frames = recorded(scene, 2)
    alone = read_by_itself(frames[0].image, scene)
    assert alone.code == scene.transmitter.code
    assert alone.region is not None
    assert read_by_itself(frames[0].image, as_the_camera_gives_it).code is None
    assert reading_of(frames, scene).payload == str(scene.transmitter.code)
    assert reading_of(frames, as_the_camera_gives_it).failure is not None


def test_a_film_that_is_not_read_fails_with_the_words_of_a_single_picture() -> None:
    scene = near_the_null(14.6e3)
    still = occ.decode(occ.render(scene).image, scene).failure
    assert still is not None
    failure = reading_of(recorded(scene, 2), scene).failure
    assert failure is not None
    assert "none of 2 frames" in failure
    assert failure.endswith(still)


def test_too_short_a_film_says_how_much_was_not_in_view() -> None:
    reading = reading_of(film_of_scene()[:2], SCENE)
    assert reading.failure is not None
    assert "of 134 chips were in no frame" in reading.failure or "header" in reading.failure


def test_rates_over_time_add_up_to_those_of_the_film() -> None:
    scene = SCENE.replace(payload="text:abc", framing="preamble")
    reading = reading_of(recorded(scene, 30), scene)
    windows = reading.rates(5)
    assert sum(window.packets for window in windows) == len(reading.packets)
    assert sum(window.packets_lost for window in windows) == reading.lost
    assert windows[0].start == reading.frames[0].time


def test_a_tolerance_out_of_range_is_refused() -> None:
    with pytest.raises(occ.ParameterError, match=r"readout_tolerance is 0\.7"):
        occ.VideoReader(SCENE, readout_tolerance=0.7)


def test_stated_truth_is_not_looked_at() -> None:
    """A reader takes frames without the scene and the start that simulated ones have."""
    frames = [replace(frame, scene=None, start=None) for frame in film_of_scene()[:40]]
    assert reading_of(frames, SCENE).payload == "HELLO"


def test_the_films_differ_as_demanded() -> None:
    films: list[Film] = [film(number) for number in range(FILMS)]
    gaps = [one.recording.gap_ratio(one.scene) for one in films]
    assert min(gaps) < 0.05
    assert max(gaps) > 0.35
    assert {one.recording.frame_rate for one in films} >= {24.0, 240.0}
    assert max(one.recording.frame_jitter for one in films) >= 1e-4
    assert max(abs(one.recording.camera_drift) for one in films) > 9e-5
    assert {one.scene.transmitter.payload_length for one in films} >= {32, 1024}
    assert any(one.recording.path for one in films)
