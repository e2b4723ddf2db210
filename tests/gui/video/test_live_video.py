"""Live film: the newest picture wins, what ends it is said, and the device is always released."""

from collections.abc import Callable
from threading import Event

import numpy as np
import pytest
from film_source import FilmSource
from gui.video.conftest import ListedSource

from occ_gui.video.frame_source import LivePicture
from occ_gui.video.live_video import LiveVideo
from occ_model.errors import VideoError
from occ_model.results.video import Video


def numbered(count: int) -> list[np.ndarray]:
    """Make pictures of two lines and three columns, each of its own grey level."""
    return [np.full((2, 3), number, dtype=np.uint8) for number in range(count)]


class StepwiseSource(ListedSource):
    """Gives a picture whenever a test lets it."""

    def __init__(self, pictures: list[np.ndarray]) -> None:
        super().__init__(pictures)
        self.may, self.waits = Event(), Event()

    def read(self) -> LivePicture | None:
        self.waits.set()
        self.may.wait(60)
        self.may.clear()
        return super().read()


def give_one(source: StepwiseSource) -> None:
    """Let a source give a picture, and wait until it has been taken in."""
    assert source.waits.wait(60)
    source.waits.clear()
    source.may.set()
    assert source.waits.wait(60)


def test_the_newest_picture_wins_and_none_comes_twice() -> None:
    source = StepwiseSource(numbered(4))
    video = LiveVideo(source, "columns")
    video.start()
    frames = iter(video)
    for _ in range(3):
        give_one(source)
    assert next(frames).image[0, 0] == 2
    give_one(source)
    frame = next(frames)
    assert frame.image[0, 0] == 3
    assert frame.index == 3
    source.may.set()
    assert next(frames, None) is None
    assert video.arrived == 4
    video.stop()


def test_lines_become_columns_and_colours_their_luma() -> None:
    pixels = np.arange(6, dtype=np.uint8).reshape(2, 3)
    for axis, expected in (("columns", pixels), ("lines", pixels.T)):
        video = LiveVideo(ListedSource([pixels]), axis)
        video.start()
        assert next(iter(video)).image.tolist() == expected.tolist()
        video.stop()
    pixels = np.zeros((2, 3, 3), dtype=np.uint8)
    pixels[..., 1] = 200  # green
    video = LiveVideo(ListedSource([pixels]), "columns")
    video.start()
    assert next(iter(video)).image.tolist() == np.full((2, 3), round(0.587 * 200)).tolist()
    video.stop()


def test_what_ends_without_being_asked_to_says_so_and_what_is_stopped_has_no_problem() -> None:
    source = ListedSource(numbered(1))
    video = LiveVideo(source, "columns")
    video.start()
    list(video)
    video._thread.join(60)
    assert video.problem == "Listed gives no more pictures: it has ended or is unplugged."
    assert not source.is_open
    source = StepwiseSource(numbered(2))
    video = LiveVideo(source, "columns")
    video.start()
    give_one(source)
    source.may.set()
    video.stop()
    assert video.has_ended
    assert video.problem is None
    assert not source.is_open


def test_the_device_of_the_film_before_is_released_first() -> None:
    before, source = StepwiseSource(numbered(2)), ListedSource(numbered(1))
    first = LiveVideo(before, "columns")
    first.start()
    give_one(before)
    first.end()
    second = LiveVideo(source, "columns", after=first)
    second.start()
    assert not source.is_open
    assert before.is_open
    before.may.set()
    assert len(list(second)) == 1
    assert not before.is_open


@pytest.mark.parametrize("error", [VideoError("It is away."), RuntimeError("driver")])
def test_a_device_that_cannot_be_opened_is_a_sentence(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> None:
        raise error

    source = ListedSource([])
    monkeypatch.setattr(source, "open", fail)
    video = LiveVideo(source)
    video.start()
    assert list(video) == []
    video._thread.join(60)
    assert video.problem is not None
    assert str(error) in video.problem


def test_the_exposure_is_held_between_two_pictures() -> None:
    source = StepwiseSource(numbered(3))
    answers: list[bool] = []
    video = LiveVideo(source, "columns")
    video.start()
    video.lock_exposure(True, answers.append)
    give_one(source)
    give_one(source)
    assert (source.locked, answers) == ([True], [True])
    source.may.set()
    video.stop()


def test_what_has_passed_is_not_kept() -> None:
    video = LiveVideo(ListedSource(numbered(1)))
    with pytest.raises(VideoError, match="is not kept"):
        video.frame(0)
    assert not video.simulated


def test_a_film_stands_in_for_a_camera(film: Video, monkeypatch: pytest.MonkeyPatch) -> None:
    slept: list[float] = []
    naps: Callable[[float], None] = slept.append
    monkeypatch.setattr("film_source.sleep", naps)
    monkeypatch.setattr("film_source.monotonic", lambda: 7.0)
    source = FilmSource(film, "A film")
    source.open()
    pictures = []
    while (picture := source.read()) is not None:
        pictures.append(picture)
    assert [p.time for p in pictures] == [f.time for f in film]
    assert slept == pytest.approx([f.time for f in film])
    assert source.lock_exposure(True)
    source.close()
    assert source.read() is None
