"""Three doors lead a new user into the program, once and whenever they are asked for."""

import pytest
from gui.user import User
from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.start import Start
from occ_gui.files.session_record import Session
from occ_gui.welcome.door import Door
from occ_gui.welcome.welcome_dialog import WelcomeDialog
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@pytest.fixture
def doors(application: Application, user: User, qtbot: QtBot) -> WelcomeDialog:
    user.choose("&Welcome…")
    dialog = application.shell.pane("welcome").dialog
    assert dialog is not None
    qtbot.waitUntil(dialog.isVisible)
    return dialog


def test_the_first_door_begins_the_first_lesson(
    application: Application, doors: WelcomeDialog, user: User
) -> None:
    doors.doors["learn"].click()
    user.wait_until_idle()
    assert application.window.modes.mode == "lessons"
    place = application.shell.pane("lessons").view.step.place.text()
    assert place == "What is a rolling shutter? · step 1 of 3"
    assert application.shell.pane("welcome").dialog is None


def test_the_second_door_asks_for_a_photo(
    application: Application, doors: WelcomeDialog, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[object] = []
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *a: asked.append(a) or ("", ""))
    doors.doors["photo"].click()
    assert application.window.modes.mode == "photo"
    assert len(asked) == 1


def test_the_third_door_changes_nothing_of_the_scene(
    application: Application, doors: WelcomeDialog, small_scene: Scene
) -> None:
    doors.doors["explore"].click()
    assert application.window.modes.mode == "explore"
    assert application.store.scene == small_scene


def test_the_page_comes_by_itself_only_once(
    application: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    stored: dict[str, str] = {}
    preferences = application.preferences
    monkeypatch.setattr(preferences, "recall", lambda key: stored.get(key, ""))
    monkeypatch.setattr(preferences, "keep", stored.__setitem__)
    application.shell.pane("welcome").show_once()
    dialog = application.shell.pane("welcome").dialog
    assert dialog is not None
    dialog.close()
    assert application.shell.pane("welcome").dialog is None
    application.shell.pane("welcome").show_once()
    assert application.shell.pane("welcome").dialog is None


@pytest.mark.parametrize(("asked", "scene", "is_new"), [(False, None, True), (True, None, False)])
def test_a_start_that_names_a_scene_is_no_first_one(
    asked: bool, scene: Scene | None, is_new: bool
) -> None:
    start = Start(Scene(), SimulationSettings(), asked, None, Session(scene), None, fresh=False)
    assert start.is_new == is_new
    later = Start(Scene(), SimulationSettings(), asked, None, Session(Scene()), None, fresh=False)
    assert not later.is_new


def test_each_door_says_what_is_behind_it(doors: WelcomeDialog) -> None:
    for door in doors.doors.values():
        assert door.accessibleName()
        assert door.accessibleDescription().endswith(".")
        assert not door.grab().isNull()


def test_the_title_of_a_door_stands_out_and_its_texts_fit(doors: WelcomeDialog) -> None:
    for door in doors.findChildren(Door):
        title, sentence = door._title.font(), door._sentence.font()
        assert title.bold()
        assert not sentence.bold()
        assert title.pointSizeF() > sentence.pointSizeF()
        for label in (door._title, door._sentence):
            assert label.wordWrap()
            assert door.rect().contains(label.geometry())
            assert label.heightForWidth(label.width()) <= label.height()


def test_the_picture_of_a_door_follows_the_theme(qtbot: QtBot) -> None:
    door = Door("door-photo", "Title", "Sentence.")
    qtbot.addWidget(door)
    pictures = []
    for colour in ("black", "white"):
        palette = door.palette()
        palette.setColor(QPalette.ColorRole.ButtonText, QColor(colour))
        door.setPalette(palette)
        pictures.append(door._picture.pixmap().toImage())
    assert pictures[0] != pictures[1]


@pytest.mark.parametrize("points", [9.0, 12.0, 18.0])
def test_the_doors_are_alike_and_show_all_their_texts_however_large(
    qapp: QApplication, qtbot: QtBot, points: float
) -> None:
    before = qapp.font()
    font = QFont(before)
    font.setPointSizeF(points)
    qapp.setFont(font)
    try:
        dialog = WelcomeDialog()
    finally:
        qapp.setFont(before)
    qtbot.addWidget(dialog)
    dialog.show()
    assert dialog.width() < 1000
    assert dialog.height() < 700
    assert len({(door.width(), door.height()) for door in dialog.doors.values()}) == 1
    for door in dialog.doors.values():
        left, right = door._sentence.x(), door.width() - door._sentence.geometry().right() - 1
        assert left == right
        for label in (door._picture, door._title, door._sentence):
            assert door.rect().contains(label.geometry())
            assert label.height() >= max(label.heightForWidth(label.width()), 1)
            assert label.width() >= label.minimumSizeHint().width()
        assert door._sentence.geometry().bottom() < door.height() - door._picture.y()
