"""Modes: a layout for each task, chosen by keys and tabs, which keeps the user's changes."""

from dataclasses import replace
from functools import partial
from itertools import combinations
from pathlib import Path

import pytest
from gui.user import User
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAccessible, QResizeEvent
from PySide6.QtWidgets import QApplication, QTabBar, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.values.choices import PhotoChoice
from occ_gui.values.modes import MODES, STORY

NAMES = list(MODES)
SETTLED_MS = 200  # in which a window arranges its docks
CONTROL, RIGHT = Qt.KeyboardModifier.ControlModifier, Qt.DockWidgetArea.RightDockWidgetArea


def bar(application: Application) -> QTabBar:
    return application.window.toolbar.modes


def open_panes(application: Application) -> set[str]:
    return {name for name, dock in application.window.docks.items() if not dock.isHidden()}


def is_in_front(application: Application, name: str) -> bool:
    return not application.window.docks[name].visibleRegion().isEmpty()


def panes_of(application: Application, mode: str) -> set[str]:
    return {*application.window.modes.panes.places_in(mode)}


def test_panes_declare_places_in_every_mode_one_of_them_as_its_main_pane(
    application: Application,
) -> None:
    panes = application.window.modes.panes
    assert {mode for pane in panes.values() for mode in pane.places} == {*MODES}
    for mode, layout in MODES.items():
        mains = [name for name, place in panes.places_in(mode).items() if place.is_main]
        # The subject of Explore is the story in the middle.
        assert len(mains) == (0 if layout.centre == STORY and mode != "lessons" else 1), mode


def test_control_and_a_digit_choose_a_mode(application: Application, qtbot: QtBot) -> None:
    application.window.modes.switch(NAMES[-1])
    application.window.activateWindow()
    for place, mode in enumerate(NAMES):
        qtbot.keyClick(application.window, Qt.Key(Qt.Key.Key_1 + place), CONTROL)
        assert application.window.modes.mode == mode
        assert bar(application).currentIndex() == place
        assert open_panes(application) == panes_of(application, mode)
        assert application.story.isVisible() == bool(MODES[mode].centre)


def test_the_tabs_choose_a_mode_by_the_arrow_keys_and_a_screen_reader_hears_it(
    application: Application, qtbot: QtBot
) -> None:
    bar(application).setFocus()
    qtbot.keyClick(bar(application), Qt.Key.Key_Right)
    assert application.window.modes.mode == NAMES[1]
    entry = application.window.actions_by_name[f"mode_{NAMES[1]}"]
    assert entry.isChecked()
    application.window.modes.switch("limits")
    face = QAccessible.queryAccessibleInterface(bar(application))
    tabs = [face.child(place) for place in range(len(NAMES))]
    assert face.role() == QAccessible.Role.PageTabList
    words = [tab.text(QAccessible.Text.Name) for tab in tabs]
    assert words == ["Explore", "Photo", "Limits", "Effects", "Lessons", "Video", "Room"]
    assert [tab.state().selected for tab in tabs] == [name == "limits" for name in NAMES]


def test_a_mode_keeps_its_layout_and_a_pane_that_is_open_in_it_stays_there(
    application: Application, qtbot: QtBot
) -> None:
    window = application.window
    window.modes.switch("limits")
    window.docks["controls"].hide()
    window.addDockWidget(RIGHT, window.docks["equations"])
    window.docks["equations"].show()
    left = open_panes(application)
    window.modes.switch("effects")
    assert open_panes(application) == panes_of(application, "effects")
    window.modes.switch("limits")
    assert open_panes(application) == left == {"map", "bench", "bands", "equations"}
    window.actions_by_name["reset_layout"].trigger()
    assert open_panes(application) == panes_of(application, "limits")
    window.modes.switch("effects")
    window.docks["map"].toggleViewAction().trigger()
    window.bring_to_front("map")
    qtbot.waitUntil(lambda: is_in_front(application, "map"))
    assert window.modes.mode == "effects"


def test_a_hidden_pane_is_shown_in_the_mode_about_it(
    application: Application, qtbot: QtBot
) -> None:
    window = application.window
    homes = {name: window.modes.panes.home_of(name) for name in window.docks}
    homes = {name: home for name, home in homes.items() if home}
    assert set(homes.values()) == {*MODES} - {"explore"}
    for pane, home in homes.items():
        window.modes.switch("effects" if pane != "accuracy" else "limits")
        window.docks[pane].hide()
        window.bring_to_front(pane)
        qtbot.waitUntil(partial(is_in_front, application, pane))
        assert window.modes.mode == home
    window.modes.switch("explore")
    window.tabifyDockWidget(window.docks["profile"], window.docks["decode"])
    for pane in ("decode", "profile", "decode"):
        window.bring_to_front(pane)
        qtbot.waitUntil(partial(is_in_front, application, pane))


def test_a_pane_that_opens_below_a_lesson_has_a_good_part_of_its_height(
    application: Application, qtbot: QtBot
) -> None:
    window = application.window
    window.resize(1280, 1000)
    window.modes.switch("lessons")
    lesson, opened = window.docks["lessons"], window.docks["equations"]
    window.bring_into_view("equations")
    qtbot.waitUntil(lambda: opened.height() > 0.5 * lesson.height())


class Widths(QObject):
    """Records every width of a window."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.values: set[int] = set()
        window.installEventFilter(self)

    def eventFilter(self, _of: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if isinstance(event, QResizeEvent):
            self.values.add(event.size().width())
        return False


def test_no_change_of_the_mode_widens_the_window_even_for_a_moment(
    application: Application,
) -> None:
    window = application.window
    window.resize(1000, 700)
    QApplication.processEvents()
    widths = Widths(window)  # a maximized window would keep the largest of them
    for mode in ("effects", "photo", "lessons"):
        for each in (mode, "explore", mode):
            window.modes.switch(each)
            QApplication.processEvents()
    assert widths.values <= {1000}


@pytest.mark.parametrize("size", [(1024, 700), (1280, 800), (1920, 1080)])
def test_a_pane_that_needs_less_height_than_when_it_was_seen_covers_nothing_below(
    application: Application, user: User, photo_file: Path, size: tuple[int, int]
) -> None:
    window = application.window
    user.open_photo(photo_file)
    needed = window.docks["profile"].minimumHeight()
    store = application.scene_store.store
    store.put(replace(store.workspace, photo=PhotoChoice()), "no photo")
    window.modes.switch("explore")
    user.wait_until_idle()
    window.modes.layouts.clear()
    window.resize(*size)
    window.modes.switch("photo")
    profile = window.docks["profile"]
    assert profile.minimumSizeHint().height() < needed
    assert profile.geometry().bottom() < window.statusBar().geometry().top()


@pytest.mark.own_window  # each pane is made when it is first open_panes
def test_panes_without_room_side_by_side_become_tabs_and_the_window_keeps_its_width(
    application: Application, qtbot: QtBot
) -> None:
    window = application.window
    window.resize(1280, 800)
    QApplication.processEvents()
    widths = Widths(window)
    for pane, by_menu in (("spectrum", 0), ("profile", 1), ("compare", 0), ("bench", 1)):
        if by_menu:
            window.docks[pane].toggleViewAction().trigger()
        else:
            window.bring_to_front(pane)
        qtbot.waitUntil(partial(is_in_front, application, pane))
        qtbot.wait(SETTLED_MS)
    assert widths.values <= {1280}
    visible = [dock for dock in window.docks.values() if not dock.visibleRegion().isEmpty()]
    for one, other in combinations(visible, 2):
        assert not one.geometry().intersects(other.geometry()), (one.objectName(), other)


@pytest.mark.own_window  # each pane is made when it is first open_panes
@pytest.mark.parametrize("by_menu", [False, True])
def test_panes_without_room_above_one_another_become_tabs_and_the_window_keeps_its_height(
    application: Application, qtbot: QtBot, by_menu: bool
) -> None:
    window = application.window
    window.resize(1280, 800)
    window.modes.switch("effects")
    QApplication.processEvents()
    for pane in ("decode", "photo", "equations"):
        if by_menu:
            window.docks[pane].toggleViewAction().trigger()
        else:
            window.bring_into_view(pane)
        qtbot.waitUntil(partial(is_in_front, application, pane))
        qtbot.wait(SETTLED_MS)
        assert window.height() == 800, pane
    assert not window.docks["accuracy"].visibleRegion().isEmpty()  # the mode's main pane
