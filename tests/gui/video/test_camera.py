"""Cameras: those that the system lists, one that is not there, and whether exposure is held."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from gui.kinds import not_none

from occ_gui.video import camera
from occ_gui.video.camera import CameraDevice, CameraSource, find_cameras
from occ_model.errors import VideoError


class FakeCapture:
    """A camera as OpenCV gives it."""

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
    monkeypatch.setattr(camera, "_IS_LINUX", True)
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
    monkeypatch.setattr(camera, "_IS_LINUX", False)
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
    picture = not_none(source.read())
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


@pytest.mark.parametrize(("is_linux", "kind"), [(True, cv2.CAP_V4L2), (False, cv2.CAP_ANY)])
def test_a_camera_is_opened_the_way_its_system_has(
    monkeypatch: pytest.MonkeyPatch, is_linux: bool, kind: int
) -> None:
    asked: list[tuple[int, ...]] = []

    def opened(*how: int) -> FakeCapture:
        asked.append(how)
        return FakeCapture()

    monkeypatch.setattr(camera, "_IS_LINUX", is_linux)
    monkeypatch.setattr(cv2, "VideoCapture", opened)
    CameraSource(CameraDevice(2, "Webcam")).open()
    assert asked == [(2, kind)]
