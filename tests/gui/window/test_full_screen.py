"""Full screen is entered and left by the menu, and a maximized window is one again afterwards."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow
from pytestqt.qtbot import QtBot

from occ_gui.window.full_screen import FullScreen


@pytest.fixture
def window(qtbot: QtBot) -> QMainWindow:
    """Show a window of its own."""
    window = QMainWindow()
    qtbot.addWidget(window)
    window.resize(500, 300)
    window.show()
    return window


@pytest.mark.parametrize("maximized", [False, True])
def test_the_window_is_as_before_after_full_screen(window: QMainWindow, maximized: bool) -> None:
    if maximized:
        window.showMaximized()
    action = QAction()
    FullScreen(window, action)
    action.setChecked(True)
    assert window.isFullScreen()
    action.setChecked(False)
    assert not window.isFullScreen()
    assert window.isMaximized() == maximized


def test_the_entry_follows_the_desktop(window: QMainWindow) -> None:
    action = QAction()
    FullScreen(window, action)
    window.setWindowState(Qt.WindowState.WindowFullScreen)
    assert action.isChecked()
    window.showNormal()
    assert not action.isChecked()
