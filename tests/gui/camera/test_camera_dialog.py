"""*Measure my camera*: two pictures, one sentence, the bars over them, and the scene's time."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from camera_measurements import make_measurement
from gui.kinds import add_widget, collect
from gui.stores import store_of
from PIL import Image
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.camera import jobs
from occ_gui.camera.camera_controller import CameraController
from occ_gui.camera.camera_dialog import CameraDialog
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_model.results.camera import CameraMeasurement


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, float]]:
    """Replace the measurement; return the number of pictures and the mains of each."""
    calls: list[tuple[int, float]] = []

    def measure(photos: list[occ.Photo], mains: float, **_: object) -> CameraMeasurement:
        calls.append((len(photos), mains))
        if photos[0].path.stem == "bent":
            raise occ.MatchError("The bars are bent.")
        return make_measurement(mains=mains, reasons=("Why.",) if len(photos) == 1 else ())

    monkeypatch.setattr(jobs, "measure_camera", measure)
    return calls


@pytest.fixture
def store() -> SceneStore:
    return store_of(occ.load_preset("phone-68us"))


@pytest.fixture
def controller(
    qtbot: QtBot, store: SceneStore, asked: list[tuple[int, float]]
) -> Iterator[CameraController]:
    controller = CameraController(add_widget(qtbot, QWidget()), store, Preferences())
    controller.show()
    yield controller
    controller.stop()


def dialog_of(controller: CameraController) -> CameraDialog:
    assert controller.dialog is not None
    return controller.dialog


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    paths = [tmp_path / name for name in ("one.png", "two.png", "bent.png")]
    for path in paths:
        Image.fromarray(np.full((30, 40), 120, np.uint8)).save(path)
    return paths


def measure(qtbot: QtBot, controller: CameraController, paths: list[Path]) -> str:
    controller.measure(paths)
    qtbot.waitUntil(lambda: controller.is_idle)
    return dialog_of(controller).answer.line.text()


def test_two_pictures_give_one_sentence_and_set_the_scene(
    qtbot: QtBot, controller: CameraController, store: SceneStore, files: list[Path]
) -> None:
    said = collect(controller.status_message)
    line = measure(qtbot, controller, files[:2])
    assert line == make_measurement().sentence
    dialog_of(controller).use.click()
    assert store.scene.camera.readout_time == make_measurement().readout_time
    assert said == ["The scene's readout time is 27.5 µs."]


def test_the_mains_of_the_dialog_are_used_at_once(
    qtbot: QtBot, controller: CameraController, asked: list[tuple[int, float]], files: list[Path]
) -> None:
    measure(qtbot, controller, files[:2])
    mains = dialog_of(controller).mains
    mains.setCurrentIndex(1)
    mains.activated.emit(1)
    qtbot.waitUntil(lambda: controller.is_idle)
    assert asked == [(2, 50.0), (2, 60.0)]


def test_a_second_picture_joins_a_first_that_is_doubtful(
    qtbot: QtBot, controller: CameraController, asked: list[tuple[int, float]], files: list[Path]
) -> None:
    assert "doubtful" in measure(qtbot, controller, files[:1])
    assert "Why." in dialog_of(controller).answer.details.text()
    assert "sure" in measure(qtbot, controller, files[1:2])
    assert [count for count, _ in asked] == [1, 2]


def test_a_refusal_says_why_and_gives_no_time(
    qtbot: QtBot, controller: CameraController, files: list[Path]
) -> None:
    assert measure(qtbot, controller, files[2:]) == "The bars are bent."
    assert not dialog_of(controller).use.isEnabled()


def test_unreadable_and_too_many_pictures_are_refused(
    qtbot: QtBot, controller: CameraController, files: list[Path], tmp_path: Path
) -> None:
    assert "3 pictures were chosen" in measure(qtbot, controller, files)
    assert "none.png" in measure(qtbot, controller, [tmp_path / "none.png"])


def test_dropped_and_chosen_files_are_measured(
    qtbot: QtBot,
    controller: CameraController,
    asked: list[tuple[int, float]],
    files: list[Path],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in files[:2]])
    event = QDropEvent(
        QPointF(), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton,
        Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    dialog_of(controller).dropEvent(event)
    qtbot.waitUntil(lambda: controller.is_idle)
    chosen = ([str(path) for path in files[:2]], "")
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: chosen)
    dialog_of(controller).choose.click()
    qtbot.waitUntil(lambda: controller.is_idle)
    assert [count for count, _ in asked] == [2, 2]
