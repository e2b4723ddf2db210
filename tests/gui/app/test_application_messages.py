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


@pytest.mark.parametrize(
    ("name", "text", "shown"),
    [("exposure_time", "soon", 68e-6), ("distance", "-3 m", 1.2), ("bits", "3", 10)],
)
def test_a_bad_value_gives_a_sentence_and_the_picture_stays(
    application: Application, user: User, small_scene: Scene, name: str, text: str, shown: float
) -> None:
    results: list[object] = []
    application.simulation.snapshot_shown.connect(results.append)
    user.enter(name, text)
    assert "allowed" in user.message
    assert name == "bits" or name not in user.message  # but the label, which the user sees
    assert user.row(name).field.value() == shown
    assert application.store.scene == small_scene
    assert results == []


def test_a_scene_without_a_picture_says_why_and_the_last_stays(
    application: Application, user: User
) -> None:
    shown = application.view("picture")._frame
    application.store.change(**BEHIND_THE_CAMERA)
    user.wait_until_idle()
    assert "behind the camera" in user.message
    assert application.view("picture")._frame is shown


def test_the_sentence_goes_once_the_scene_has_a_picture_again(
    application: Application, user: User
) -> None:
    application.store.change(**BEHIND_THE_CAMERA)
    user.wait_until_idle()
    user.choose("&Undo")
    assert user.message == "Undone: change of distance and yaw."


def test_an_intermediate_scene_without_a_picture_leaves_no_text(
    application: Application, user: User
) -> None:
    application.store.change(**BEHIND_THE_CAMERA)
    application.store.change(distance=1.0, yaw=0.0)
    user.wait_until_idle()
    assert user.message == ""


def test_a_refusal_disappears_with_the_next_change(application: Application, user: User) -> None:
    user.enter("distance", "-3 m")
    user.enter("distance", "2 m")
    assert user.message == ""
    user.enter("distance", "-3 m")
    user.choose("&Undo")
    assert user.message == "Undone: change of distance."
    user.enter("distance", "-3 m")
    user.choose_next_preset()
    assert user.message == ""


def test_a_refusal_disappears_when_the_current_value_is_typed(user: User) -> None:
    user.enter("distance", "-3 m")
    assert user.message
    user.enter("distance", "1.2 m")
    assert user.message == ""


def test_the_opened_file_is_named_until_after_its_picture(
    application: Application, user: User, tmp_path: Path, small_scene: Scene
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(small_scene.replace(iso=200.0).to_toml(), encoding="utf-8")
    application.files.open_scene(path)
    user.wait_until_idle()
    assert user.message == "Opened mine.toml"


def test_a_photo_that_cannot_be_read_is_answered_by_a_sentence(
    application: Application, user: User, tmp_path: Path
) -> None:
    title = application.window.windowTitle()
    application.open_photo(tmp_path / "missing.png")
    user.wait_until_idle()
    assert "missing.png" in user.message
    assert application.window.windowTitle() == title


@pytest.mark.whole
def test_a_preset_that_has_a_picture_says_nothing(application: Application, user: User) -> None:
    for _ in occ.presets():
        user.choose_next_preset()
        assert user.message == ""
        assert application.store.scene in map(occ.load_preset, occ.presets())


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
