"""Input in the real widgets changes the scene, the picture and every pane."""

import gc
import math
import re
from collections.abc import Callable

import numpy as np
import pytest
from gui.user import User
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QLabel, QMessageBox, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.scene import gesture
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.scene.scene import Scene

Picture = Callable[[QWidget], NDArray[np.uint8]]


def test_a_key_on_a_slider_changes_scene_field_and_picture(
    qtbot: QtBot, application: Application, user: User, grey_picture: Picture
) -> None:
    row = user.row("distance")
    assert isinstance(row, QuantityRow)
    application.story.show_whole_picture(True)
    before = grey_picture(application.view("picture"))
    qtbot.keyClick(row.slider, Qt.Key.Key_PageUp)
    user.wait_until_idle()
    assert application.store.scene.pose.distance == row.field.value() > 1.2
    assert not np.array_equal(grey_picture(application.view("picture")), before)


def test_a_typed_number_reaches_the_profile_and_the_band_model(
    application: Application, user: User
) -> None:
    application.settings.set_tolerance(math.inf)
    user.enter("exposure_time", "136 us")
    scene = application.store.scene
    assert scene.camera.exposure_time == 136e-6
    _, profile = application.view("profile").simulation.getOriginalDataset()
    assert np.array_equal(profile, occ.column_profile(scene))
    assert "136 µs" in application.view("profile").reason.text()


def test_bits_typed_arrive_in_the_decode_result(
    qtbot: QtBot, application: Application, user: User
) -> None:
    bits = application.controls.code.bits
    bits.clear()
    qtbot.keyClicks(bits, "0000000101")
    qtbot.keyClick(bits, Qt.Key.Key_Return)
    user.wait_until_idle()
    assert application.controls.code.number.value() == 5
    assert application.view("decode").strip.accessibleDescription().startswith("sent 0000000101")


def test_a_drag_of_a_slider_is_undone_as_one_step(
    application: Application, user: User, small_scene: Scene
) -> None:
    slider = user.slider("iso")
    slider.setSliderDown(True)
    for position in range(200, 700, 100):
        slider.setValue(position)
    slider.setSliderDown(False)
    user.wait_until_idle()
    assert application.store.scene != small_scene
    user.choose("&Undo")
    assert application.store.scene == small_scene


def test_a_loaded_preset_is_shown_until_the_scene_is_edited(
    application: Application, user: User
) -> None:
    preset = application.controls.preset
    assert preset.currentIndex() == -1
    name = user.choose_next_preset()
    assert application.store.scene == occ.load_preset(name)
    user.enter("iso", "123")
    assert preset.currentIndex() == -1
    user.choose("&Undo")
    assert preset.currentData() == name


def test_undo_and_redo_bring_the_controls_and_the_picture_back(
    application: Application, user: User, grey_picture: Picture
) -> None:
    application.story.show_whole_picture(True)
    pictures = [grey_picture(application.view("picture"))]
    user.enter("distance", "2 m")
    pictures.append(grey_picture(application.view("picture")))
    assert not np.array_equal(pictures[0], pictures[1])
    for text, distance, picture in (("&Undo", 1.2, pictures[0]), ("&Redo", 2.0, pictures[1])):
        assert "distance" in user.entry(text).text()
        user.choose(text)
        assert user.row("distance").field.value() == distance
        assert np.array_equal(grey_picture(application.view("picture")), picture)


def test_the_window_tells_how_long_simulating_and_reading_took(
    qtbot: QtBot, application: Application
) -> None:
    labels = application.window.statusBar().findChildren(QLabel)
    pattern = r"simulated in [\d.]+ ms, read in [\d.]+ ms"
    assert any(re.fullmatch(pattern, label.toolTip()) for label in labels)
    application.window.show_timing(0.0123, 0.0091)
    # The label takes its new width when the event loop runs.
    qtbot.waitUntil(lambda: "simulated in 12.3 ms, read in 9.1 ms" in {x.text() for x in labels})


def test_quick_steps_of_a_field_are_undone_at_once(
    qtbot: QtBot, application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gesture, "_PAUSE_MS", 60_000)  # however slow the machine
    before = application.store.scene
    for _ in range(3):
        qtbot.keyClick(user.row("distance").field, Qt.Key.Key_Up)
        user.wait_until_idle()
    assert application.store.scene.pose.distance > 1.2
    user.choose("&Undo")
    assert application.store.scene == before


def test_about_tells_the_version(
    user: User, application: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    monkeypatch.setattr(QMessageBox, "about", lambda *texts: told.append(texts[2]))
    user.choose("&About")
    assert occ.__version__ in told[0]


def open_and_close(qtbot: QtBot, scene: Scene) -> None:
    application = Application(Workspace(scene))
    application.window.show()
    for pane in application.window.docks:  # some are made when they are first seen
        application.window.bring_to_front(pane)
        QApplication.processEvents()
    qtbot.waitUntil(lambda: application.is_idle)
    application.window.close()
    application.window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_nothing_of_an_application_outlives_it(qtbot: QtBot, small_scene: Scene) -> None:
    gc.collect()
    before = QApplication.topLevelWidgets()
    open_and_close(qtbot, small_scene)
    for _ in range(2):  # what a first pass frees may hold widgets of another cycle
        gc.collect()
    assert [widget for widget in QApplication.topLevelWidgets() if widget not in before] == []


def test_closing_during_a_simulation_delivers_nothing_afterwards(application: Application) -> None:
    arrived: list[int] = []
    application.simulation.snapshot_shown.connect(
        lambda shown: arrived.append(shown.frame.image.size)
    )
    application.store.change(rows=4608)
    application.window.close()
    QApplication.processEvents()
    assert arrived == []
