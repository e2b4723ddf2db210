"""The mark of an outdated result appears after a moment, and lets all input through."""

import pytest
from gui.kinds import GreyPicture, add_widget
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette, QPixmap
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.widgets.outdated_mark import DELAY, OutdatedMark


@pytest.fixture
def pane(qtbot: QtBot) -> QWidget:
    pane = add_widget(qtbot, QWidget())
    QVBoxLayout(pane).addWidget(QPushButton("press"))
    pane.resize(200, 100)
    pane.show()
    return pane


@pytest.fixture
def mark(pane: QWidget) -> OutdatedMark:
    return OutdatedMark(pane)


def test_a_result_that_stays_outdated_is_marked_and_one_that_is_a_moment_old_not(
    mark: OutdatedMark, qtbot: QtBot
) -> None:
    for age in (0.01, DELAY / 2, 0.9 * DELAY, 0.0, 0.5 * DELAY):
        mark.show_age(age, "computing…")
        assert mark.isHidden(), age
    mark.show_age(0.9 * DELAY, "computing…")
    qtbot.waitUntil(mark.isVisible)
    mark.show_age(2 * DELAY, "computing…")
    mark.show_age(0.8 * DELAY, "computing…")
    assert mark.isVisible()


def test_a_present_result_ends_the_wait_and_the_mark(mark: OutdatedMark, qtbot: QtBot) -> None:
    mark.show_age(2 * DELAY, "computing…")
    assert mark.isVisible()
    mark.show_age(0.0, "computing…")
    assert mark.isHidden()
    mark.show_age(0.5 * DELAY, "computing…")
    mark.show_age(0.0, "computing…")
    qtbot.wait(round(2e3 * DELAY))
    assert mark.isHidden()


def test_the_mark_covers_the_pane_and_lets_input_through(
    mark: OutdatedMark, pane: QWidget, qtbot: QtBot
) -> None:
    button = pane.findChild(QPushButton)
    mark.show_age(1.0, "computing…")
    pane.resize(320, 160)
    assert mark.geometry() == pane.rect()
    assert pane.childAt(button.geometry().center()) is button
    with qtbot.waitSignal(button.clicked):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_the_mark_dims_the_pane_and_says_why(mark: OutdatedMark, pane: QWidget) -> None:
    corner = pane.rect().bottomLeft()
    palette = pane.palette()
    pane.setAutoFillBackground(True)
    palette.setColor(QPalette.ColorRole.Window, QColor("black"))
    pane.setPalette(palette)
    mark.setPalette(QPalette(QColor("white")))
    assert pane.grab().toImage().pixelColor(corner).lightness() == 0
    mark.show_age(1.0, "of an earlier scene")
    assert mark.accessibleName() == "of an earlier scene"
    before = pane.grab().toImage()
    assert before.pixelColor(corner).lightness() > 64
    mark.show_age(1.0, "computing…")
    assert pane.grab().toImage() != before


def test_a_pane_within_a_marked_one_is_dimmed_once(qtbot: QtBot, grey_picture: GreyPicture) -> None:
    outer = add_widget(qtbot, QLabel())
    picture = QPixmap(200, 150)
    picture.fill(QColor("black"))
    outer.setPixmap(picture)
    inner = QLabel(outer)
    inner.setGeometry(100, 80, 90, 60)
    outer.resize(200, 150)
    outer.show()
    marks = [OutdatedMark(pane) for pane in (inner, outer)]
    levels = []
    for mark in marks:
        mark.show_age(1.0, "computing…")
        levels.append(grey_picture(outer)[130, 150])
    assert levels[0] == levels[1]
    marks[1].show_age(0.0, "")
    assert grey_picture(outer)[130, 150] == levels[0]
    assert grey_picture(outer)[30, 20] != levels[0]
