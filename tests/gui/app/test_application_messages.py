"""Invalid input is answered in the status line until the sentence no longer applies."""

import logging
from pathlib import Path
from typing import Any

import pytest
from gui.user import User
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QLabel
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.scene.scene import Scene

BEHIND_THE_CAMERA: dict[str, Any] = {"distance": 0.1, "yaw": 1.2}


def test_the_sentence_goes_once_the_scene_has_a_picture_again_and_an_intermediate_leaves_none(
    application: Application, user: User
) -> None:
    application.store.change(**BEHIND_THE_CAMERA)
    user.wait_until_idle()
    user.choose("&Undo")
    assert user.message == "Undone: change of distance and yaw."
    application.store.change(**BEHIND_THE_CAMERA)
    application.store.change(distance=1.0, yaw=0.0)
    user.wait_until_idle()
    assert user.message == ""


def test_the_opened_file_is_named_until_after_its_picture(
    application: Application, user: User, tmp_path: Path, small_scene: Scene
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(small_scene.replace(iso=200.0).to_toml(), encoding="utf-8")
    application.files.open_scene(path)
    user.wait_until_idle()
    assert user.message == "Opened mine.toml"


def test_no_sentence_stands_in_the_status_line_beside_the_one_in_view(
    application: Application, user: User, qtbot: QtBot
) -> None:
    window = application.window
    (line,) = [
        label
        for label in window.statusBar().findChildren(ElidedLabel)
        if label.accessibleName() == "Message"
    ]
    application.store.change(distance=0.05, yaw=1.2)
    user.wait_until_idle()
    said = window.statusBar().currentMessage()
    assert said.startswith("Turned like this")
    qtbot.waitUntil(lambda: said in application.story.verdict.accessibleDescription())
    qtbot.waitUntil(lambda: not line.text())
    window.toolbar.modes.setCurrentIndex(1)  # the photo's, without the banner of the simulation
    qtbot.waitUntil(lambda: line.toolTip() != "")
    assert not application.story.verdict.isVisible()
    window.toolbar.modes.setCurrentIndex(0)
    qtbot.waitUntil(lambda: not line.text())
    application.store.undo_stack.undo()
    user.wait_until_idle()
    assert not window.statusBar().currentMessage()


@pytest.mark.own_window
def test_an_exception_in_a_slot_is_a_sentence_and_in_the_log_and_the_window_works_on(
    application: Application, user: User, qtbot: QtBot, caplog: pytest.LogCaptureFixture
) -> None:
    def broken() -> None:
        raise ZeroDivisionError("a mistake")

    with capture_exceptions(), caplog.at_level(logging.ERROR):
        application.error_reports.install()
        QTimer.singleShot(0, broken)
        qtbot.waitUntil(lambda: bool(user.message))
        application.error_reports.remove()
    assert "ZeroDivisionError: a mistake" in user.message
    assert "Your work is still there." in user.message
    assert "Traceback" in caplog.text
    application.window.statusBar().clearMessage()
    user.enter("iso", "456")
    assert (application.store.scene.camera.iso, user.message) == (456.0, "")


@pytest.mark.own_window
def test_the_status_line_says_what_the_plan_switches_and_what_its_pane_refuses(
    application: Application, user: User, qtbot: QtBot
) -> None:
    def tips() -> list[str]:
        labels = application.window.statusBar().findChildren(QLabel)
        return [label.toolTip() for label in labels if label.toolTip().startswith("Switched in: ")]

    user.enter("edge_time", "5 us")
    assert any(tip.startswith("Switched in: LED rise and fall") for tip in tips())
    news = application.scene._news._forgetting
    news.setInterval(0)
    news.start()
    qtbot.waitUntil(lambda: not tips())
    view = application.view("accuracy")
    assert view.table.effects.rows == ()  # nothing is drawn that nobody sees
    view.tolerance.refused.emit("Tolerance cannot be little.")
    assert user.message == "Tolerance cannot be little."
    application.settings.set_tolerance(-1.0)
    assert user.message.startswith("Tolerance cannot be -1")


@pytest.mark.whole
def test_each_preset_says_nothing(application: Application, user: User) -> None:
    for _ in occ.presets():
        name = user.choose_next_preset()
        assert user.message == "", name
        assert application.store.scene == occ.load_preset(name)
