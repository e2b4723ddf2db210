"""Three doors lead a new user into the program, once and whenever they are asked for."""

from pathlib import Path
from typing import Any, cast

import pytest
from gui.kinds import add_widget, show_widget
from gui.pane_bench import PaneBench
from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.start import Start
from occ_gui.core.workspace import Workspace
from occ_gui.files.preferences import Preferences
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Kept
from occ_gui.welcome.feature import welcome
from occ_gui.welcome.welcome import Door, Welcome, WelcomeDialog
from occ_model.scene.scene import Scene


@pytest.fixture
def doors(qtbot: QtBot) -> WelcomeDialog:
    return show_widget(qtbot, WelcomeDialog())


def test_the_page_comes_by_itself_only_once(qtbot: QtBot, small_scene: Scene) -> None:
    bench, files = PaneBench(qtbot, small_scene), cast("Any", None)  # which no door asks for
    page: Welcome = bench.add(
        welcome(cast("Any", bench.window), bench.shell, Preferences(None), files)
    )
    page.show_once()
    assert page.dialog is not None
    page.dialog.close()
    assert page.dialog is None
    page.show_once()
    assert page.dialog is None


@pytest.mark.parametrize("asked", [False, True])
def test_a_start_that_names_a_scene_is_no_first_one(asked: bool, tmp_path: Path) -> None:
    file, workspace = SessionFile(tmp_path), Workspace(Scene())
    assert Start(workspace, asked, session_file=file).is_new != asked
    file.write(Kept(workspace), in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    assert not Start(workspace, asked, session_file=again).is_new
    again.close()


def test_each_door_says_what_is_behind_it_and_its_title_stands_out(doors: WelcomeDialog) -> None:
    for door in doors.doors.values():
        assert door.accessibleName()
        assert door.accessibleDescription().endswith(".")
        assert not door.grab().isNull()
    for door in doors.findChildren(Door):
        title, sentence = door._title.font(), door._sentence.font()
        assert title.bold()
        assert not sentence.bold()
        assert title.pointSizeF() > sentence.pointSizeF()


def test_the_picture_of_a_door_follows_the_theme(qtbot: QtBot) -> None:
    door = add_widget(qtbot, Door("door-photo", "Title", "Sentence."))
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
