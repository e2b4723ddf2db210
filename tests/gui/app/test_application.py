"""Input in the real widgets changes the scene, the picture and every pane."""

import gc
import math
import re

import numpy as np
import pytest
from gui.kinds import GreyPicture
from gui.user import User
from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QLabel, QMessageBox
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.scene.parameter_rows import QuantityRow
from occ_model.scene.scene import Scene


def test_a_key_on_a_slider_changes_scene_field_and_picture(
    qtbot: QtBot, application: Application, user: User, grey_picture: GreyPicture
) -> None:
    row = user.row("distance")
    assert isinstance(row, QuantityRow)
    application.story.show_whole_picture(True)
    before = grey_picture(application.view("picture"))
    qtbot.keyClick(row.slider, Qt.Key.Key_PageUp)
    user.wait_until_idle()
    assert application.store.scene.pose.distance == row.field.value() > 1.2
    assert not np.array_equal(grey_picture(application.view("picture")), before)


def test_a_typed_number_reaches_the_profile_and_bits_the_decode_result(
    application: Application, user: User, qtbot: QtBot
) -> None:
    application.settings.set_tolerance(math.inf)
    user.enter("exposure_time", "136 us")
    scene = application.store.scene
    assert scene.camera.exposure_time == 136e-6
    _, profile = application.view("profile").simulation.getOriginalDataset()
    assert np.array_equal(profile, occ.column_profile(scene))
    assert "136 µs" in application.view("profile").reason.text()
    bits = application.controls.code.bits
    bits.clear()
    qtbot.keyClicks(bits, "0000000101")
    qtbot.keyClick(bits, Qt.Key.Key_Return)
    user.wait_until_idle()
    assert application.controls.code.number.value() == 5
    assert application.view("decode").strip.accessibleDescription().startswith("sent 0000000101")


def test_undo_and_redo_bring_the_controls_and_the_picture_back(
    application: Application, user: User, grey_picture: GreyPicture
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


def test_a_drag_of_a_slider_is_undone_as_one_step(
    application: Application, user: User, small_scene: Scene
) -> None:
    slider = user.slider("iso")
    slider.setSliderDown(True)
    for position in (200, 400, 600):
        slider.setValue(position)
    slider.setSliderDown(False)
    assert application.store.scene != small_scene
    assert application.store.undo_stack.count() == 1
    user.choose("&Undo")
    assert application.store.scene == small_scene


def test_the_window_tells_how_long_simulating_and_reading_took_and_its_version(
    qtbot: QtBot, application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    labels = application.window.statusBar().findChildren(QLabel)
    pattern = r"simulated in [\d.]+ ms, read in [\d.]+ ms"
    assert any(re.fullmatch(pattern, label.toolTip()) for label in labels)
    application.window.show_timing(0.0123, 0.0091)
    # The label takes its new width when the event loop runs.
    qtbot.waitUntil(lambda: "simulated in 12.3 ms, read in 9.1 ms" in {x.text() for x in labels})
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
