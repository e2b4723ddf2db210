"""Jobs of a film: frames and the reading are shown as the model computes them."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_gui.video import reading_controller
from occ_gui.video.film_reading import FilmReading, MarkState
from occ_gui.video.frame_jobs import FrameRequest, process_frame, start_of
from occ_gui.video.reading_controller import (
    ReadingRequest,
    marks_of_packets,
    read_film,
    sentences_of,
    state_of_frame,
    state_of_packet,
)
from occ_model.errors import OccError
from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets
from occ_model.results.video import Video
from occ_model.results.video_reading import FilmProgress, FrameReading, VideoReading
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.reading_facts import error_rate, film_facts


def packet(
    number: int, bits: list[int] | None, wrong: int | None, frame: int | None = 0
) -> PacketReading:
    read = None if bits is None else np.array(bits, dtype=np.uint8)
    return PacketReading(number, 0, 0.002 * number, frame, 1.0, read, wrong)


def test_packets_that_agree_and_frames_with_a_known_place_are_marked_as_read() -> None:
    found = [
        packet(0, [1, 0], 0),
        packet(1, [1, 1], 1),
        packet(2, [1, 0], None),
        packet(3, None, None),
    ]
    expected = [MarkState.READ, MarkState.LOST, MarkState.UNCHECKED, MarkState.LOST]
    assert [state_of_packet(each) for each in found] == expected
    marks = marks_of_packets(SentPackets((FilmPart(0.0, 0.008, 4, step=0.002),), tuple(found)))
    assert marks.states.tolist() == expected
    assert marks.ends.tolist() == pytest.approx([0.002, 0.004, 0.006, 0.008])
    assert not len(marks_of_packets(SentPackets()))
    chips = np.array([1, 0], dtype=np.uint8)
    assert state_of_frame(FrameReading(0, 0.0, chips=chips, place=3)) is MarkState.READ
    assert state_of_frame(FrameReading(0, 0.0, chips=chips)) is MarkState.UNCHECKED
    assert state_of_frame(FrameReading(0, 0.0, failure="Dark.")) is MarkState.LOST


def test_millions_of_packets_have_a_few_marks_that_cover_the_film() -> None:
    parts = (FilmPart(5.0, 1e5, 2_000_000, step=0.05), FilmPart(3e5, 1.0, 10, step=0.1))
    packets = SentPackets(parts, (packet(3, [1, 0], 0), packet(2_000_004, [1, 0], 0)))
    marks = marks_of_packets(packets)
    lost, read = MarkState.LOST, MarkState.READ
    assert marks.states.tolist() == [lost, read, lost, lost, read, lost]
    assert marks.starts.tolist() == pytest.approx([5.0, 5.15, 5.2, 3e5, 3e5 + 0.4, 3e5 + 0.5])
    assert marks.ends.tolist() == pytest.approx(
        [5.15, 5.2, 100_005.0, 3e5 + 0.4, 3e5 + 0.5, 3e5 + 1]
    )


def test_the_last_report_equals_the_models_reading_of_the_whole_film(
    film: Video, film_scene: Scene
) -> None:
    reports: list[Any] = []
    found = read_film(ReadingRequest(film, film_scene), reports.append)
    whole = occ.decode_video(film, film_scene)
    assert found.text == whole.payload == "718"
    assert found.times.tolist() == [frame.time for frame in film]
    assert len(found.packets) == len(whole.packets)
    read = np.count_nonzero(found.packets.states == MarkState.READ)
    figures = {fact.label: fact.text for fact in found.facts}
    assert figures["Packets"] == f"{whole.read} read, {whole.lost} lost"
    assert read == whole.read
    frequency, unit, _, error, _ = figures["Frequency"].split()
    assert unit == "kHz"
    assert float(error) == pytest.approx(whole.clock.switching_frequency.error, rel=0.05)
    assert 1e3 * float(frequency) == pytest.approx(whole.clock.switching_frequency.value, abs=1.0)


def test_a_live_film_keeps_the_last_frames_only(
    film: Video, film_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reading_controller, "MOST_LIVE", 4)
    found = read_film(ReadingRequest(film, film_scene, is_live=True), lambda _: None)
    assert found.times.tolist() == [frame.time for frame in film][-4:]
    assert len(found.states) == 4
    assert len(found.packets)
    assert (found.packets.ends > found.times[0]).all()
    assert (np.diff(found.packets.starts) > 0.0).all()


def test_nothing_is_known_of_a_film_without_frames(film_scene: Scene) -> None:
    class Empty(Video):
        title, shape, frame_rate, frame_count = "Empty", (1, 1), None, None

        def frames(self, first: int = 0) -> Any:
            return iter(())

        def frame(self, index: int) -> Any:
            raise NotImplementedError

    found = read_film(ReadingRequest(Empty(), film_scene), lambda _: None)
    assert isinstance(found, FilmReading)
    assert not len(found.times)
    assert found.facts == ()


def reading(right: int, unread: int, unseen: int, wrong: int = 0) -> VideoReading:
    kinds = [(0, 0)] * right + [(0, None)] * unread + [(None, None)] * unseen + [(0, 1)] * wrong
    packets = tuple(
        packet(number, None if errors is None else [0] * 10, errors, frame)
        for number, (frame, errors) in enumerate(kinds)
    )
    return VideoReading(
        frames=(FrameReading(0, 0.0), FrameReading(1, 0.03)), clock=None, certainty=1.0,
        packets=SentPackets((FilmPart(0.0, 0.06, len(packets)),), packets),
        bits=np.zeros(10, dtype=np.uint8), known=np.ones(24, dtype=bool), payload="0",
        complete_at=0.0, duration=0.06, failure=None,
    )  # fmt: skip


def progress_of(whole: VideoReading, placed: int = 2) -> FilmProgress:
    return FilmProgress(whole.frames[-1], 2, placed, "0", 1.0, True, None)


def texts_of_facts(whole: VideoReading) -> dict[str, str]:
    return {fact.label: fact.text for fact in film_facts(progress_of(whole), whole)}


@pytest.mark.parametrize(
    ("whole", "packets", "bits"),
    [
        (reading(6, 0, 11), "65 % of 17 packets", "0 % of 60 bits"),
        (reading(996, 0, 0, wrong=4), "0.4 % of 1000 packets", "0.04 % of 10000 bits"),
        (reading(0, 3, 2), "100 % of 5 packets", None),
        (reading(1, 0, 999), "99.90 % of 1000 packets", "0 % of 10 bits"),
    ],
)
def test_rates_name_what_they_count_and_have_only_significant_digits(
    whole: VideoReading, packets: str, bits: str | None
) -> None:
    figures = texts_of_facts(whole)
    assert figures["Packet loss"] == packets
    assert figures.get("Bit error rate") == bits


@pytest.mark.parametrize(
    ("count", "total", "interval"),
    [
        (0, 10, "0 to 28 %"),
        (10, 10, "72 to 100 %"),
        (999, 1000, "99.44 to 99.982 %"),
        (1, 1_000_000, "0.000018 to 0.00057 %"),
    ],
)
def test_an_interval_is_written_without_exponents_and_tells_nearly_all_from_all(
    count: int, total: int, interval: str
) -> None:
    assert error_rate(count, total, "packets")[1] == f"{interval} at 95 %"


def test_lost_packets_are_distinguished_from_wrong_bits() -> None:
    whole = reading(6, 1, 11, wrong=2)
    (sentence,) = sentences_of(progress_of(whole), whole, None)
    assert sentence.startswith("Lost: 11 packets sent between two frames, ")
    assert "Misread: 3 packets." in sentence
    assert "not placed" not in sentence
    assert (
        "or in 1 frame without a known place" in sentences_of(progress_of(whole, 1), whole, None)[0]
    )
    one, two = (
        sentences_of(progress_of(each), each, None)[0]
        for each in (reading(6, 0, 1), reading(6, 1, 1))
    )
    assert one.startswith("Lost: 1 packet sent between two frames")
    assert "Misread: 1 packet." in two
    whole = reading(6, 0, 11)
    assert "Misread" not in sentences_of(progress_of(whole), whole, None)[0]
    whole = reading(6, 0, 0)
    assert sentences_of(progress_of(whole), whole, None) == ()


@pytest.fixture
def request_of(film_scene: Scene) -> FrameRequest:
    return FrameRequest(
        film=None, live=None, index=3, scene=film_scene, settings=SimulationSettings(),
        recording=occ.Recording(frame_rate=30.0),
    )  # fmt: skip


def test_without_a_film_the_simulated_frame_is_shown_and_read(
    request_of: FrameRequest, film: Video
) -> None:
    shown = process_frame(request_of)
    assert shown.film is None
    assert np.array_equal(shown.simulated.image, film.frame(3).image)
    assert shown.time == film.frame(3).time
    reading = shown.story.reading
    assert shown.story.knows_light
    assert reading.scene == film.frame(3).scene
    assert tuple(reading.results["threshold"].bits.tolist()) == reading.sent != ()
    read = reading.results["threshold"].region
    ends = [each(axis=0).tolist() for each in (reading.corners.min, reading.corners.max)]
    assert ends[0] == [read.first_column - 0.5, read.first_row - 0.5]
    assert ends[1] == [read.last_column - 0.5, read.last_row - 0.5]
    # The rows say whether the frame was enhanced: the threshold depends on it.
    camera = occ.decode(film.frame(3).image, request_of.scene.replace(enhancement="none"))
    assert reading.results["threshold"].threshold == camera.threshold
    assert "frame 4, read by itself, not enhanced: code " in shown.story.title
    dim = occ.load_preset("phone-136us").replace(switching_frequency=13.9e3, rows=1152)
    enhanced = process_frame(replace(request_of, index=0, scene=dim))
    assert "read by itself, enhanced: code " in enhanced.story.title


def test_a_film_stands_beside_its_simulation_and_its_rows_are_its_own(
    request_of: FrameRequest, film: Video
) -> None:
    other = request_of.scene.replace(code=5)
    shown = process_frame(replace(request_of, film=film, scene=other))
    assert np.array_equal(shown.film.image, film.frame(3).image)
    assert not np.array_equal(shown.simulated.image, shown.film.image)
    assert not shown.story.knows_light
    assert shown.story.reading.sent == ()
    decoded = occ.decode(film.frame(3).image, other)
    assert shown.story.reading.results["threshold"].code == decoded.code
    assert shown.film.region == decoded.region
    assert shown.film.caption.startswith("Simulated film: frame 4, 0.1000 s")


def test_a_small_picture_is_exact_and_not_called_a_draft(request_of: FrameRequest) -> None:
    small = process_frame(replace(request_of, draft_step=8)).simulated
    assert small.rows_step == 1
    assert "draft" not in small.caption


def test_a_draft_lies_where_the_whole_picture_does(request_of: FrameRequest) -> None:
    large = request_of.scene.replace(rows=1000)
    draft = process_frame(replace(request_of, scene=large, draft_step=8)).simulated
    whole = process_frame(replace(request_of, scene=large)).simulated
    assert "draft" in draft.caption
    assert (draft.rows_step, whole.rows_step) == (8, 1)
    assert abs(draft.region.first_row - whole.region.first_row) <= 8
    assert abs(draft.region.last_row - whole.region.last_row) <= 8


def test_a_scene_that_cannot_be_filmed_gives_a_sentence_and_a_missing_frame_is_refused(
    request_of: FrameRequest, film: Video
) -> None:
    fast = occ.Recording(frame_rate=1000.0)
    shown = process_frame(replace(request_of, film=film, recording=fast))
    assert shown.simulated is None
    assert "Reading out 1600 columns" in shown.refusal
    assert shown.film is not None
    alone = process_frame(replace(request_of, recording=fast))
    assert (alone.story, alone.time) == (None, None)
    with pytest.raises(OccError):
        process_frame(replace(request_of, film=film, index=99))


def test_the_simulation_is_in_phase_with_a_film_of_the_same_code(
    request_of: FrameRequest, film: Video
) -> None:
    for index in range(6):
        shown = process_frame(replace(request_of, film=film, index=index))
        assert shown.simulated.caption == "Simulated: in phase with the film"
        start = start_of(shown.story.reading.results["threshold"], request_of.scene)
        truth = film.frame(index).scene
        assert start is not None
        packet = len(occ.packet(truth)) / truth.transmitter.switching_frequency
        error = math.remainder(start - truth.model.start_time, packet)
        assert abs(error) < 0.3 * truth.camera.readout_time


def test_without_the_same_code_there_is_no_phase(film_scene: Scene, film: Video) -> None:
    decoded = occ.decode(film.frame(0).image, film_scene)
    assert start_of(decoded, film_scene) is not None
    assert start_of(decoded, film_scene.replace(code=5)) is None
    assert start_of(decoded, film_scene.replace(pattern="10")) is None
    assert start_of(replace(decoded, chip_starts=None), film_scene) is None
    assert start_of(replace(decoded, headers=()), film_scene) is None
