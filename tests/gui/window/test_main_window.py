"""Menus, dropped files and the full screen."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from gui.kinds import collect, show_widget
from PySide6.QtCore import QMimeData, Qt, QUrl
from PySide6.QtGui import QAction, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QApplication, QGraphicsView, QMainWindow, QMenu, QProgressBar, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.values.choices import OVERLAYS
from occ_gui.window.menus import FullScreen


def menus(menu: QWidget) -> Iterator[QMenu]:
    for action in menu.actions():
        submenu = action.menu()
        if isinstance(submenu, QMenu):
            yield submenu
            yield from menus(submenu)


def entries(menu: QMenu) -> list[QAction]:
    return [a for a in menu.actions() if not a.isSeparator() and a.menu() is None]


def test_impossible_actions_are_disabled_and_every_picture_and_plot_has_a_name(
    application: Application,
) -> None:
    by_text = {a.text(): a for menu in menus(application.window.menuBar()) for a in entries(menu)}
    with_photo = ("&Close photo", "&Match", "&Apply", "Sa&ve match", "&Use this")
    for text in (*with_photo, "&Undo", "&Redo"):
        (entry,) = [action for key, action in by_text.items() if key.startswith(text)]
        assert not entry.isEnabled(), text
    graphics = application.window.findChildren(QGraphicsView)
    assert len(graphics) >= 3
    for view in (*graphics, *application.window.findChildren(QProgressBar)):
        assert view.accessibleName(), view


@pytest.mark.parametrize(
    ("menu", "keys"), [("scan_axes", ["auto", "columns", "lines"]), ("overlays", [*OVERLAYS])]
)
def test_one_entry_of_a_choice_is_marked_at_a_time(
    application: Application, menu: str, keys: list[str]
) -> None:
    entries = getattr(application.window.menus, menu).actions()
    assert [entry.data() for entry in entries] == keys
    for chosen in (*entries, entries[0]):
        chosen.trigger()
        assert [entry.data() for entry in entries if entry.isChecked()] == [chosen.data()]
    if menu == "overlays":
        entries[1].trigger()
        assert application.view("picture").mode.key() == entries[1].data()


def test_the_window_alone_takes_drops_of_files_and_reports_them(
    application: Application, tmp_path: Path
) -> None:
    drops = collect(application.window.dropped)
    files, text = QMimeData(), QMimeData()
    files.setUrls([QUrl.fromLocalFile(str(tmp_path / "a.png")), QUrl("https://example.org/b")])
    text.setText("a.png")
    place = application.window.rect().center()
    how = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    for data, is_accepted in ((text, False), (files, True)):
        enter = QDragEnterEvent(place, Qt.DropAction.CopyAction, data, *how)
        enter.ignore()
        QApplication.sendEvent(application.window, enter)
        assert enter.isAccepted() == is_accepted
    drop = QDropEvent(place, Qt.DropAction.CopyAction, files, *how)
    QApplication.sendEvent(application.window, drop)
    assert drops == [[tmp_path / "a.png"]]
    assert not any(w.acceptDrops() for w in application.window.findChildren(QWidget))


@pytest.fixture
def window(qtbot: QtBot) -> QMainWindow:
    """Show an empty window."""
    return show_widget(qtbot, QMainWindow(), 500, 300)


@pytest.mark.parametrize("maximized", [False, True])
def test_the_window_is_as_before_after_full_screen(window: QMainWindow, maximized: bool) -> None:
    if maximized:
        window.showMaximized()
    action = QAction(checkable=True)
    FullScreen(window, action)
    action.setChecked(True)
    assert window.isFullScreen()
    action.setChecked(False)
    assert not window.isFullScreen()
    assert window.isMaximized() == maximized


def test_the_entry_follows_the_desktop(window: QMainWindow) -> None:
    action = QAction(checkable=True)
    FullScreen(window, action)
    window.setWindowState(Qt.WindowState.WindowFullScreen)
    assert action.isChecked()
    window.showNormal()
    assert not action.isChecked()
