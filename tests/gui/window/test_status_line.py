"""The texts of the status line never overlap, and a text that is too long ends in dots."""

from pathlib import Path

import pytest
from gui.kinds import show_widget
from gui.user import User
from PySide6.QtCore import QRect
from PySide6.QtWidgets import QApplication, QLabel, QStatusBar
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.window.status_line import StatusLine

LONG = "Switching frequency is '1,000 Hz', which means 1 Hz or 1 kHz, " * 6
READOUT = "Picture: column 1234, row 1200, camera level 123, receiver level 234"


def texts_of(bar: QStatusBar) -> list[tuple[QLabel, QRect]]:
    """Find the visible labels of a status bar, with their places in it."""
    labels = [label for label in bar.findChildren(QLabel) if label.isVisible() and label.text()]
    return [
        (label, QRect(label.mapTo(bar, label.rect().topLeft()), label.size())) for label in labels
    ]


def check_texts(bar: QStatusBar) -> None:
    """Check that no text exceeds its label, and that labels do not overlap or exceed the bar."""
    texts = texts_of(bar)
    for label, place in texts:
        width = label.fontMetrics().horizontalAdvance(label.text())
        assert width <= label.contentsRect().width()
        assert bar.rect().contains(place)
        assert not any(place.intersects(other) for one, other in texts if one is not label)


@pytest.fixture
def line(qtbot: QtBot) -> StatusLine:
    return show_widget(qtbot, StatusLine())


@pytest.mark.parametrize(
    ("width", "points", "is_loading"), [(300, 24, True), (800, 9, False), (1280, 16, True)]
)
def test_texts_never_overlap(line: StatusLine, width: int, points: int, is_loading: bool) -> None:
    font = line.font()
    font.setPointSize(points)
    line.setFont(font)
    line.resize(width, line.sizeHint().height())
    for message in ("", "Saved scene.toml", LONG):
        line.showMessage(message)
        line.show_plan_change(LONG)
        line.readout.set_full_text(READOUT)
        line.show_timing(1.2345, 0.6789)
        line.loading_bar.setVisible(is_loading)
        QApplication.processEvents()
        assert len(texts_of(line)) >= (3 if width > 300 else 0)
        check_texts(line)


def test_a_change_of_the_plan_is_shown_until_the_next_message_or_its_end(
    line: StatusLine, qtbot: QtBot
) -> None:
    def texts() -> list[str]:
        return [label.text() for label, _ in texts_of(line)]

    line.resize(800, 24)
    line.show_plan_change("Switched in: JPEG")
    assert texts() == ["Switched in: JPEG"]
    line.showMessage("Saved scene.toml")
    QApplication.processEvents()
    assert texts() == ["Saved scene.toml"]
    line.clearMessage()
    assert texts() == []
    line.show_plan_change("Switched in: JPEG")
    line.show_plan_change("")
    qtbot.waitUntil(lambda: texts() == [])


def test_times_are_shown_to_three_digits(line: StatusLine) -> None:
    line.resize(1600, 24)
    line.show_times(False)
    line.show_timing(0.01234, 1.28971)
    assert line.timing.isHidden()
    line.show_times(True)
    QApplication.processEvents()
    texts = [label.text() for label in line.findChildren(QLabel)]
    assert "simulated in 12.3 ms, read in 1.29 s" in texts


def test_an_open_photo_is_named_in_every_mode_but_its_own(
    application: Application, user: User, photo_file: Path
) -> None:
    window, line = application.window, application.window.statusBar()
    assert isinstance(line, StatusLine)
    badge = line.photo
    assert not badge.isVisible()
    user.open_photo(photo_file)
    assert not badge.isVisible()
    window.resize(1000, 700)
    window.modes.switch("explore")
    window.show_message("A sentence that is longer than the window is wide. " * 9)
    QApplication.processEvents()
    assert badge.isVisible()
    assert badge.width() >= badge.sizeHint().width()
    assert photo_file.name in badge.accessibleName()
    application.photos.close()
    user.wait_until_idle()
    assert not badge.isVisible()
