"""Modes: a layout for each task, reached by keys and tabs, that comes back as it was left."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path

import pytest
from gui.user import User
from PySide6.QtCore import QEvent, QObject, QSettings, QSize, Qt
from PySide6.QtGui import QAccessible, QResizeEvent
from PySide6.QtWidgets import QApplication, QTabBar, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app import command_line
from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace
from occ_gui.window.modes.mode import HOMES, MODES, PICTURE
from occ_model.files.resources import resource_names
from occ_model.scene.scene import Scene

NAMES = list(MODES)
CONTROL, RIGHT = Qt.KeyboardModifier.ControlModifier, Qt.DockWidgetArea.RightDockWidgetArea


def bar(application: Application) -> QTabBar:
    return application.window.toolbar.modes


def shown(application: Application) -> set[str]:
    """Give the names of the panes that are not hidden."""
    return {name for name, dock in application.window.docks.items() if not dock.isHidden()}


def in_front(application: Application, name: str) -> bool:
    return not application.window.docks[name].visibleRegion().isEmpty()


def has_icon(tabs: QTabBar, place: int) -> bool:
    return not tabs.tabIcon(place).isNull()


def test_the_command_line_knows_the_modes_of_the_window() -> None:
    assert tuple(MODES) == command_line.MODES


def test_each_mode_shows_panes_that_there_are(application: Application) -> None:
    for mode in MODES.values():
        assert {*mode.panes, *mode.widths, *mode.heights} <= set(application.window.docks)
        assert mode.main == PICTURE or mode.main in mode.panes


def test_each_mode_has_an_icon() -> None:
    assert set(resource_names("icons", ".svg")) >= set(MODES)


@pytest.mark.parametrize("place", range(len(MODES)))
def test_control_and_a_digit_choose_a_mode(
    application: Application, qtbot: QtBot, place: int
) -> None:
    application.window.modes.switch(NAMES[(place + 1) % len(NAMES)])
    application.window.activateWindow()
    qtbot.keyClick(application.window, Qt.Key(Qt.Key.Key_1 + place), CONTROL)
    mode = NAMES[place]
    assert application.window.modes.mode == mode
    assert bar(application).currentIndex() == place
    assert shown(application) == set(MODES[mode].panes)
    assert application.story.isVisible() == bool(MODES[mode].centre)


def test_the_tabs_choose_a_mode_by_the_arrow_keys(application: Application, qtbot: QtBot) -> None:
    bar(application).setFocus()
    qtbot.keyClick(bar(application), Qt.Key.Key_Right)
    assert application.window.modes.mode == NAMES[1]
    entry = application.window.actions_by_name[f"mode_{NAMES[1]}"]
    assert entry.isChecked()


def test_a_screen_reader_hears_the_modes_and_the_active_one(application: Application) -> None:
    application.window.modes.switch("limits")
    face = QAccessible.queryAccessibleInterface(bar(application))
    tabs = [face.child(place) for place in range(len(NAMES))]
    assert face.role() == QAccessible.Role.PageTabList
    words = [tab.text(QAccessible.Text.Name) for tab in tabs]
    assert words == ["Explore", "Photo", "Limits", "Effects", "Lessons", "Video", "Room"]
    assert [tab.state().selected for tab in tabs] == [name == "limits" for name in NAMES]


def test_a_mode_comes_back_as_it_was_left(application: Application) -> None:
    window = application.window
    window.modes.switch("limits")
    window.docks["controls"].hide()
    window.addDockWidget(RIGHT, window.docks["equations"])
    window.docks["equations"].show()
    left = shown(application)
    window.modes.switch("effects")
    assert shown(application) == set(MODES["effects"].panes)
    window.modes.switch("limits")
    assert shown(application) == left == {"map", "bench", "bands", "equations"}
    window.actions_by_name["reset_layout"].trigger()
    assert shown(application) == set(MODES["limits"].panes)


@pytest.mark.parametrize("pane", HOMES)
def test_a_hidden_pane_is_shown_in_the_mode_about_it(
    application: Application, qtbot: QtBot, pane: str
) -> None:
    window = application.window
    window.modes.switch("effects" if pane != "accuracy" else "limits")
    window.docks[pane].hide()
    window.bring_to_front(pane)
    qtbot.waitUntil(lambda: in_front(application, pane))
    assert window.modes.mode == HOMES[pane]


def test_a_pane_that_is_open_stays_in_its_mode(application: Application, qtbot: QtBot) -> None:
    window = application.window
    window.modes.switch("effects")
    window.docks["map"].toggleViewAction().trigger()
    window.bring_to_front("map")
    qtbot.waitUntil(lambda: in_front(application, "map"))
    assert window.modes.mode == "effects"


@pytest.mark.parametrize(("width", "with_icons"), [(1000, False), (1120, True)])
def test_the_narrowest_usual_window_shows_every_mode_beside_the_tools_and_a_wider_one_its_icon(
    application: Application, qtbot: QtBot, width: int, with_icons: bool
) -> None:
    window, tabs = application.window, bar(application)
    window.resize(width, 700)
    widths = set()
    for place, mode in enumerate(NAMES):
        window.modes.switch(mode)
        if with_icons:
            qtbot.waitUntil(partial(has_icon, tabs, place))
        qtbot.waitUntil(lambda: tabs.tabRect(len(NAMES) - 1).right() < tabs.width())
        widths.add(tabs.sizeHint().width())
    assert len(widths) == 1, "the tabs move when another one is chosen"
    assert all(b.isVisible() for b in window.toolbar.buttons.values())


@pytest.mark.parametrize("mode", ["limits", "effects"])
def test_the_pane_of_a_mode_has_most_of_the_window(
    application: Application, qtbot: QtBot, mode: str
) -> None:
    window = application.window
    window.modes.switch(mode)
    for size in (QSize(1920, 1080), QSize(1000, 700)):
        window.resize(size)

        def check(size: QSize = size) -> None:
            pane = window.docks[MODES[mode].main]
            assert pane.width() >= 0.6 * size.width()
            assert pane.height() >= 0.7 * size.height()

        qtbot.waitUntil(check)
        assert window.size() == size


def test_a_mode_that_was_left_in_a_wider_window_does_not_widen_it(application: Application) -> None:
    window = application.window
    window.resize(1920, 1000)
    QApplication.processEvents()
    window.modes.switch("effects")
    window.resize(1000, 700)
    QApplication.processEvents()
    window.modes.switch("explore")
    QApplication.processEvents()
    assert window.size() == QSize(1000, 700)


class Widths(QObject):
    """Notes every width that a window takes."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.seen: set[int] = set()
        window.installEventFilter(self)

    def eventFilter(self, _of: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if isinstance(event, QResizeEvent):
            self.seen.add(event.size().width())
        return False


@pytest.mark.parametrize("other", ["limits", "effects", "photo", "video", "lessons"])
def test_no_change_of_the_mode_widens_the_window_even_for_a_moment(
    application: Application, other: str
) -> None:
    window = application.window
    window.resize(1000, 700)
    QApplication.processEvents()
    widths = Widths(window)  # a maximized window would keep the largest of them
    for mode in (other, "explore", other):
        window.modes.switch(mode)
        QApplication.processEvents()
    assert widths.seen <= {1000}


def test_a_photo_is_opened_in_the_mode_for_it(
    application: Application, user: User, photo_file: Path
) -> None:
    application.window.modes.switch("limits")
    application.open_photo(photo_file)
    user.wait_until_idle()
    assert application.window.modes.mode == "photo"


Start = Callable[..., AbstractContextManager[Application]]


@pytest.fixture
def start(qtbot: QtBot, small_scene: Scene, tmp_path: Path) -> Start:
    """Start windows that keep their layout in the same file."""

    @contextmanager
    def begin() -> Iterator[Application]:
        kept = QSettings(str(tmp_path / "kept.ini"), QSettings.Format.IniFormat)
        application = Application(Workspace(small_scene), kept)
        application.options.layout.restore()
        application.window.show()
        qtbot.waitUntil(lambda: application.is_idle)
        yield application
        application.options.layout.keep()
        application.window.close()
        application.stop()
        application.window.deleteLater()
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    return begin


def test_mode_and_layouts_are_there_at_the_next_start(start: Start) -> None:
    with start() as application:
        application.window.modes.switch("effects")
        application.window.docks["controls"].hide()
        application.window.modes.switch("limits")
    with start() as application:
        assert application.window.modes.mode == "limits"
        assert bar(application).currentIndex() == NAMES.index("limits")
        assert shown(application) == set(MODES["limits"].panes)
        application.window.modes.switch("effects")
        assert shown(application) == {"accuracy"}


@pytest.mark.whole
def test_a_maximized_window_opens_maximized(start: Start) -> None:
    for maximized in (True, False):
        with start() as application:
            window = application.window
            window.showMaximized() if maximized else window.showNormal()
        with start() as application:
            assert application.window.isMaximized() == maximized
