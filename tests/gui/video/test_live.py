"""Live camera: cameras are listed, the newest picture wins, and the device is always released."""

from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event

import cv2
import numpy as np
import pytest
from film_source import ListedSource
from gui.user import PATIENCE_S

from occ_gui.video import camera
from occ_gui.video.camera import CameraDevice, CameraSource, LivePicture, find_cameras
from occ_gui.video.live_controller import LiveVideo
from occ_model.errors import VideoError


class FakeCapture:
    """A fake of OpenCV's camera."""

    def __init__(self, *_: object) -> None:
        self.values = {cv2.CAP_PROP_EXPOSURE: 157.0, cv2.CAP_PROP_AUTO_EXPOSURE: 3.0}
        self.refused: set[int] = set()
        self.is_released = False
        self.pictures = [np.zeros((2, 3, 3), dtype=np.uint8)]

    def isOpened(self) -> bool:  # noqa: N802 - OpenCV's name
        return True

    def getBackendName(self) -> str:  # noqa: N802 - OpenCV's name
        return "V4L2"

    def set(self, name: int, value: float) -> bool:
        if name in self.refused:
            return False
        self.values[name] = value
        return True

    def get(self, name: int) -> float:
        return self.values.get(name, 0.0)

    def read(self) -> tuple[bool, np.ndarray | None]:
        return (True, self.pictures.pop()) if self.pictures else (False, None)

    def release(self) -> None:
        self.is_released = True


@pytest.fixture
def capture(monkeypatch: pytest.MonkeyPatch) -> FakeCapture:
    capture = FakeCapture()
    monkeypatch.setattr(cv2, "VideoCapture", lambda *_: capture)
    return capture


def test_a_system_with_a_list_is_asked_for_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(camera, "IS_LINUX", True)
    for folder, index, name in (
        ("video0", "0", "Webcam\n"), ("video1", "1", "Webcam\n"), ("video10", "0", ""),
        ("video2", "0", "Other"), ("radio0", "0", "Radio"),
    ):  # fmt: skip
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "index").write_text(index)
        (tmp_path / folder / "name").write_text(name)
    assert find_cameras(tmp_path) == (
        CameraDevice(0, "Webcam"),
        CameraDevice(2, "Other"),
        CameraDevice(10, "/dev/video10"),
    )
    assert find_cameras(tmp_path / "nothing") == ()


def test_a_system_without_a_list_is_tried(
    capture: FakeCapture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(camera, "IS_LINUX", False)
    assert [device.number for device in find_cameras()] == [0, 1, 2, 3]
    assert capture.is_released


def test_a_camera_that_is_not_there_is_a_sentence() -> None:
    source = CameraSource(CameraDevice(87, "Far away"))
    with pytest.raises(VideoError, match="The camera Far away cannot be opened"):
        source.open()
    assert source.read() is None
    assert not source.lock_exposure(True)
    source.close()


def test_a_camera_gives_pictures_until_it_is_unplugged(capture: FakeCapture) -> None:
    source = CameraSource(CameraDevice(0, "Webcam"))
    source.open()
    picture = source.read()
    assert picture.pixels.shape == (2, 3, 3)
    assert picture.time >= 0.0
    assert source.read() is None
    source.close()
    assert capture.is_released


def test_the_exposure_is_held_at_its_present_value(capture: FakeCapture) -> None:
    source = CameraSource(CameraDevice(0, "Webcam"))
    source.open()
    assert source.lock_exposure(True)
    assert capture.get(cv2.CAP_PROP_AUTO_EXPOSURE) == 1.0
    assert capture.get(cv2.CAP_PROP_EXPOSURE) == 157.0
    assert source.lock_exposure(False)
    assert capture.get(cv2.CAP_PROP_AUTO_EXPOSURE) == 3.0
    capture.refused.add(cv2.CAP_PROP_AUTO_EXPOSURE)
    assert not source.lock_exposure(True)


def test_a_closed_camera_chooses_its_exposure_again(capture: FakeCapture) -> None:
    source = CameraSource(CameraDevice(0, "Webcam"))
    source.open()
    assert source.lock_exposure(True)
    source.close()
    assert capture.get(cv2.CAP_PROP_AUTO_EXPOSURE) == 3.0


@pytest.mark.parametrize(("is_linux", "kind"), [(True, cv2.CAP_V4L2), (False, cv2.CAP_ANY)])
def test_a_camera_is_opened_the_way_its_system_has(
    monkeypatch: pytest.MonkeyPatch, is_linux: bool, kind: int
) -> None:
    asked: list[tuple[int, ...]] = []

    def opened(*how: int) -> FakeCapture:
        asked.append(how)
        return FakeCapture()

    monkeypatch.setattr(camera, "IS_LINUX", is_linux)
    monkeypatch.setattr(cv2, "VideoCapture", opened)
    CameraSource(CameraDevice(2, "Webcam")).open()
    assert asked == [(2, kind)]


def numbered(count: int) -> list[np.ndarray]:
    """Make pictures of two lines and three columns, each with its own grey level."""
    return [np.full((2, 3), number, dtype=np.uint8) for number in range(count)]


class StepwiseSource(ListedSource):
    """Gives a picture whenever a test lets it."""

    def __init__(self, pictures: list[np.ndarray]) -> None:
        super().__init__(pictures)
        self.may, self.waits = Event(), Event()

    def read(self) -> LivePicture | None:
        self.waits.set()
        self.may.wait(PATIENCE_S)
        self.may.clear()
        return super().read()

    def give_one(self) -> None:
        """Give a picture, and wait until the pane has received it."""
        assert self.waits.wait(PATIENCE_S)
        self.waits.clear()
        self.may.set()
        assert self.waits.wait(PATIENCE_S)


Start = Callable[..., LiveVideo]


@pytest.fixture
def start() -> Iterator[Start]:
    """Start films of sources, and end them after the test."""
    started: list[LiveVideo] = []

    def begin(source: ListedSource, axis: str = "columns", **how: LiveVideo) -> LiveVideo:
        started.append(LiveVideo(source, axis, **how))
        started[-1].start()
        return started[-1]

    yield begin
    for video in started:
        video.end()
        if isinstance(video.source, StepwiseSource):
            video.source.may.set()
        video.join()


def test_the_newest_picture_wins_and_none_comes_twice(start: Start) -> None:
    source = StepwiseSource(numbered(4))
    video = start(source)
    frames = iter(video)
    for _ in range(3):
        source.give_one()
    assert next(frames).image[0, 0] == 2
    source.give_one()
    frame = next(frames)
    assert frame.image[0, 0] == 3
    assert frame.index == 3
    source.may.set()
    assert next(frames, None) is None
    assert video.picture_count == 4


def test_lines_become_columns_and_colours_their_luma(start: Start) -> None:
    pixels = np.arange(6, dtype=np.uint8).reshape(2, 3)
    for axis, expected in (("columns", pixels), ("lines", pixels.T)):
        assert next(iter(start(ListedSource([pixels]), axis))).image.tolist() == expected.tolist()
    green = np.zeros((2, 3, 3), dtype=np.uint8)
    green[..., 1] = 200
    frame = next(iter(start(ListedSource([green]))))
    assert frame.image.tolist() == np.full((2, 3), round(0.587 * 200)).tolist()


def test_what_ends_without_being_asked_to_says_so_and_what_is_stopped_has_no_problem(
    start: Start,
) -> None:
    unplugged = ListedSource(numbered(1))
    video = start(unplugged)
    list(video)
    video.join()
    assert video.problem == "Listed delivers no more pictures: it ended or was unplugged."
    assert not unplugged.is_open
    source = StepwiseSource(numbered(2))
    video = start(source)
    source.give_one()
    video.end()
    source.may.set()
    video.join()
    assert (video.has_ended, video.problem, source.is_open) == (True, None, False)


def test_the_device_of_the_film_before_is_released_first(start: Start) -> None:
    before, source = StepwiseSource(numbered(2)), ListedSource(numbered(1))
    first = start(before)
    before.give_one()
    first.end()
    second = start(source, previous=first)
    assert (before.is_open, source.is_open) == (True, False)
    before.may.set()
    assert len(list(second)) == 1
    assert not before.is_open


@pytest.mark.parametrize("error", [VideoError("It is away."), RuntimeError("driver")])
def test_a_device_that_cannot_be_opened_is_a_sentence(
    error: Exception, monkeypatch: pytest.MonkeyPatch, start: Start
) -> None:
    def fail() -> None:
        raise error

    source = ListedSource([])
    monkeypatch.setattr(source, "open", fail)
    video = start(source)
    assert list(video) == []
    video.join()
    assert str(error) in video.problem


def test_the_exposure_is_held_between_two_pictures(start: Start) -> None:
    source = StepwiseSource(numbered(3))
    answers: list[bool] = []
    start(source).lock_exposure(True, answers.append)
    source.give_one()
    source.give_one()
    assert (source.locked, answers) == ([True], [True])


def test_past_pictures_are_not_kept() -> None:
    video = LiveVideo(ListedSource(numbered(1)))
    with pytest.raises(VideoError, match="is not kept"):
        video.frame(0)
    assert not video.simulated
