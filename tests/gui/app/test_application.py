"""The whole window: input changes scene, picture and panes, and invalid input is refused."""

import gc
import logging
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.kinds import GreyPicture
from gui.user import User
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtWidgets import QApplication, QLabel, QMessageBox
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.scene.parameter_rows import QuantityRow
from occ_gui.widgets.building import ElidedLabel
from occ_model.scene.scene import Scene


def test_a_key_on_a_slider_changes_scene_field_and_picture_and_can_be_undone_and_redone(
    qtbot: QtBot, application: Application, user: User, grey_picture: GreyPicture
) -> None:
    row = user.row("distance")
    assert isinstance(row, QuantityRow)
    application.story.show_whole_picture(True)
    before = grey_picture(application.view("picture"))
    qtbot.keyClick(row.slider, Qt.Key.Key_PageUp)
    user.wait_until_idle()
    moved = row.field.value()
    assert application.scene_store.scene.pose.distance == moved > 1.2
    after = grey_picture(application.view("picture"))
    assert not np.array_equal(after, before)
    for text, distance, picture in (("&Undo", 1.2, before), ("&Redo", moved, after)):
        assert "distance" in user.entry(text).text()
        user.choose(text)
        assert row.field.value() == distance
        assert np.array_equal(grey_picture(application.view("picture")), picture)


def test_a_typed_number_reaches_the_profile_and_bits_the_decode_result(
    application: Application, user: User, qtbot: QtBot
) -> None:
    application.settings.set_tolerance(math.inf)
    user.enter("exposure_time", "136 us")
    scene = application.scene_store.scene
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


def test_the_window_shows_the_times_of_simulation_and_reading_and_its_version(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    labels = application.window.statusBar().findChildren(QLabel)
    user.change(iso=200.0)
    pattern = r"simulated in (?!0 s)[\d.]+ m?s, read in (?!0 s)[\d.]+ m?s"
    assert any(re.fullmatch(pattern, label.toolTip()) for label in labels)
    abouts: list[str] = []
    monkeypatch.setattr(QMessageBox, "about", lambda *texts: abouts.append(texts[2]))
    user.choose("&About")
    assert occ.__version__ in abouts[0]


def open_and_close(qtbot: QtBot, scene: Scene) -> None:
    application = Application(Workspace(scene))
    application.window.show()
    for pane in application.window.docks:
        application.window.bring_to_front(pane)
        if pane != "controls":  # the others are made when they are first shown
            application.shell.pane(pane)
    qtbot.waitUntil(lambda: application.is_idle)
    sizes: list[int] = []
    application.simulation.snapshot_shown.connect(
        lambda snapshot: sizes.append(snapshot.frame.image.size)
    )
    application.scene_store.change(rows=4608)
    application.window.actions_by_name["quit"].trigger()
    QApplication.processEvents()
    assert sizes == []
    assert not application.window.isVisible()
    application.window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_quitting_during_a_simulation_delivers_no_picture_and_leaves_no_widget(
    qtbot: QtBot, small_scene: Scene
) -> None:
    gc.collect()
    before = QApplication.topLevelWidgets()
    open_and_close(qtbot, small_scene.replace(rows=60, columns=400))
    for _ in range(2):  # the first pass may free what keeps widgets of another cycle
        gc.collect()
    assert [widget for widget in QApplication.topLevelWidgets() if widget not in before] == []


BEHIND_THE_CAMERA: dict[str, Any] = {"distance": 0.1, "yaw": 1.2}


def test_a_failure_is_shown_in_one_place_until_a_picture_and_not_for_intermediate_scenes(
    application: Application, user: User, qtbot: QtBot
) -> None:
    user.change(**BEHIND_THE_CAMERA)
    user.choose("&Undo")
    assert user.message == "Undone: change of distance and yaw."
    application.scene_store.change(**BEHIND_THE_CAMERA)
    user.change(distance=1.0, yaw=0.0)
    assert user.message == ""
    # The status line does not repeat the sentence that is in view.
    window = application.window
    (line,) = [
        label
        for label in window.statusBar().findChildren(ElidedLabel)
        if label.accessibleName() == "Message"
    ]
    user.change(distance=0.05, yaw=1.2)
    message = window.statusBar().currentMessage()
    assert message.startswith("With these angles")
    qtbot.waitUntil(lambda: message in application.story.verdict.accessibleDescription())
    qtbot.waitUntil(lambda: not line.text())
    window.toolbar.modes.setCurrentIndex(1)  # the photo's, without the banner of the simulation
    qtbot.waitUntil(lambda: line.toolTip() != "")
    assert not application.story.verdict.isVisible()
    window.toolbar.modes.setCurrentIndex(0)
    qtbot.waitUntil(lambda: not line.text())
    application.scene_store.undo_stack.undo()
    user.wait_until_idle()
    assert not window.statusBar().currentMessage()


def test_an_exception_in_a_slot_is_reported_and_logged_and_the_window_works_on(
    application: Application, user: User, qtbot: QtBot, caplog: pytest.LogCaptureFixture
) -> None:
    def fail() -> None:
        raise ZeroDivisionError("a mistake")

    with capture_exceptions(), caplog.at_level(logging.ERROR):
        application.error_reports.install()
        QTimer.singleShot(0, fail)
        qtbot.waitUntil(lambda: bool(user.message))
        application.error_reports.remove()
    assert "ZeroDivisionError: a mistake" in user.message
    assert "Your work is not lost." in user.message
    assert "Traceback" in caplog.text
    application.window.statusBar().clearMessage()
    user.enter("iso", "456")
    assert (application.scene_store.scene.camera.iso, user.message) == (456.0, "")


def test_the_status_line_shows_what_the_plan_switches_and_what_its_pane_refuses(
    application: Application, user: User, qtbot: QtBot
) -> None:
    def tips() -> list[str]:
        labels = application.window.statusBar().findChildren(QLabel)
        return [label.toolTip() for label in labels if label.toolTip().startswith("Switched in: ")]

    user.enter("edge_time", "5 us")
    assert any(tip.startswith("Switched in: LED rise and fall") for tip in tips())
    news = application.scene.plan_changes.mark_timer
    news.timeout.emit()
    qtbot.waitUntil(lambda: not tips())
    view = application.view("accuracy")
    assert view.table.effects.rows == ()  # a hidden table is not filled
    view.tolerance.refused.emit("Tolerance cannot be little.")
    assert user.message == "Tolerance cannot be little."
    application.settings.set_tolerance(-1.0)
    assert user.message.startswith("Tolerance cannot be -1")


def test_the_next_accepted_change_removes_a_refusal(
    application: Application, user: User, tmp_path: Path
) -> None:
    damaged = tmp_path / "damaged.toml"
    damaged.write_text("format = ", encoding="utf-8")
    application.editor.brightness.switch(True)
    user.enter("exposure_time", "10 us")
    user.enter("exposure_time", "2 ms")
    assert user.message.startswith("The brightness cannot be kept")
    user.enter("distance", "1.3 m")
    assert user.message == ""
    application.files.open_dropped([damaged])
    assert "damaged.toml" in user.message
    room = application.scene_store.store.workspace.room
    application.scene_store.store.put(
        replace(application.scene_store.store.workspace, room=replace(room, focal_length=0.03))
    )
    assert user.message == ""


@pytest.mark.whole
def test_no_preset_shows_a_message(application: Application, user: User) -> None:
    for _ in occ.presets():
        name = user.choose_next_preset()
        assert user.message == "", name
        assert application.scene_store.scene == occ.load_preset(name)
