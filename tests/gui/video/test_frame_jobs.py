"""Jobs of a frame: what is shown of it is what the model says of that very frame."""

import math
from dataclasses import replace

import numpy as np
import pytest

import occ_model as occ
from occ_gui.video.frame_jobs import FrameRequest, shown_frame, start_of
from occ_model.errors import OccError
from occ_model.results.video import Video
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@pytest.fixture
def request_of(film_scene: Scene) -> FrameRequest:
    return FrameRequest(
        film=None, live=None, index=3, scene=film_scene, settings=SimulationSettings(),
        recording=occ.Recording(frame_rate=30.0),
    )  # fmt: skip


def test_without_a_film_the_simulated_frame_is_shown_and_read(
    request_of: FrameRequest, film: Video
) -> None:
    shown = shown_frame(request_of)
    assert shown.film is None
    assert shown.simulated is not None
    assert shown.story is not None
    assert np.array_equal(shown.simulated.image, film.frame(3).image)
    assert shown.time == film.frame(3).time
    reading = shown.story.reading
    assert shown.story.knows_light
    assert reading.scene == film.frame(3).scene
    assert tuple(reading.decoded.bits.tolist()) == reading.sent != ()


def test_a_film_stands_beside_its_simulation_and_its_rows_are_its_own(
    request_of: FrameRequest, film: Video
) -> None:
    other = request_of.scene.replace(code=5)
    shown = shown_frame(replace(request_of, film=film, scene=other))
    assert shown.film is not None
    assert shown.simulated is not None
    assert shown.story is not None
    assert np.array_equal(shown.film.image, film.frame(3).image)
    assert not np.array_equal(shown.simulated.image, shown.film.image)
    assert not shown.story.knows_light
    assert shown.story.reading.sent == ()
    decoded = occ.decode(film.frame(3).image, other)
    assert shown.story.reading.decoded.code == decoded.code
    assert shown.film.region == decoded.region
    assert shown.film.caption.startswith("Simulated film: frame 4, 0.1000 s")


def test_a_draft_lies_where_the_whole_picture_does(request_of: FrameRequest) -> None:
    large = request_of.scene.replace(rows=1000)
    draft = shown_frame(replace(request_of, scene=large, draft_step=8)).simulated
    whole = shown_frame(replace(request_of, scene=large)).simulated
    assert draft is not None
    assert whole is not None
    assert "draft" in draft.caption
    assert (draft.rows_step, whole.rows_step) == (8, 1)
    assert draft.region is not None
    assert whole.region is not None
    assert abs(draft.region.first_row - whole.region.first_row) <= 8
    assert abs(draft.region.last_row - whole.region.last_row) <= 8


def test_a_scene_that_cannot_be_filmed_is_a_sentence_and_a_frame_that_is_not_there_refused(
    request_of: FrameRequest, film: Video
) -> None:
    fast = occ.Recording(frame_rate=1000.0)
    shown = shown_frame(replace(request_of, film=film, recording=fast))
    assert shown.simulated is None
    assert "Reading out 1600 columns" in shown.instead
    assert shown.film is not None
    alone = shown_frame(replace(request_of, recording=fast))
    assert (alone.story, alone.time) == (None, None)
    with pytest.raises(OccError):
        shown_frame(replace(request_of, film=film, index=99))


def test_the_simulation_is_in_phase_with_a_film_of_the_same_code(
    request_of: FrameRequest, film: Video
) -> None:
    for index in range(6):
        shown = shown_frame(replace(request_of, film=film, index=index))
        assert shown.simulated is not None
        assert shown.simulated.caption == "Simulated: in phase with the film"
        assert shown.story is not None
        start = start_of(shown.story.reading.decoded, request_of.scene)
        truth = film.frame(index).scene
        assert start is not None
        assert truth is not None
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
