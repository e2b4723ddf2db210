"""Menus and docks: every entry does something, every pane can be hidden and shown again."""

from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import SIGNAL, QMimeData, Qt, QUrl
from PySide6.QtGui import QAction, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QApplication,
    QCheckBox,
    QComboBox,
    QGraphicsView,
    QLineEdit,
    QMenu,
    QPushButton,
    QSlider,
    QTabBar,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.command_line import PANES
from occ_gui.values.placement import MODES as OVERLAYS
from occ_gui.window.modes.mode import MODES


def menus(menu: QWidget) -> Iterator[QMenu]:
    """Walk over the menus of a menu bar, and the menus in them."""
    for action in menu.actions():
        below = action.menu()
        if isinstance(below, QMenu):
            yield below
            yield from menus(below)


def entries(menu: QMenu) -> list[QAction]:
    return [a for a in menu.actions() if not a.isSeparator() and a.menu() is None]


def listeners(action: QAction) -> int:
    return sum(action.receivers(SIGNAL(s)) for s in ("triggered(bool)", "toggled(bool)"))


def test_nothing_is_deleted_beside_quit_and_presets_are_deleted_where_they_are_saved(
    application: Application,
) -> None:
    actions = application.window.actions_by_name
    (file,) = [menu for menu in menus(application.window.menuBar()) if menu.title() == "&File"]
    assert actions["quit"] in file.actions()
    assert actions["delete_preset"] not in file.actions()
    found = [entries(menu) for menu in menus(application.window.menuBar())]
    (photo,) = [each for each in found if actions["delete_preset"] in each]
    assert photo.index(actions["delete_preset"]) == photo.index(actions["save_match"]) + 1


def test_every_menu_entry_is_connected(application: Application) -> None:
    found = list(menus(application.window.menuBar()))
    assert len(found) >= 9
    for menu in found:
        dead = menu.addAction("an entry that does nothing")
        alone = listeners(dead)
        menu.removeAction(dead)
        for action in entries(menu):
            group = action.actionGroup()
            if group is not None:
                assert group.receivers(SIGNAL("triggered(QAction*)")), action.text()
            else:
                assert listeners(action) > alone, action.text()


def test_no_two_entries_of_a_menu_share_a_letter(application: Application) -> None:
    for menu in [application.window.menuBar(), *menus(application.window.menuBar())]:
        texts = [action.text() for action in menu.actions()]
        letters = [text[text.index("&") + 1].lower() for text in texts if "&" in text]
        doubles = {letter for letter, times in Counter(letters).items() if times > 1}
        assert doubles == set(), texts


def test_no_two_entries_share_a_shortcut(application: Application) -> None:
    keys = [
        action.shortcut().toString()
        for menu in menus(application.window.menuBar())
        for action in entries(menu)
        if not action.shortcut().isEmpty()
    ]
    assert len(keys) >= 5
    assert len(set(keys)) == len(keys)


def test_every_dock_can_be_hidden_and_shown_again(application: Application) -> None:
    docks = application.window.docks
    assert set(docks) == set(PANES)
    for name, dock in docks.items():
        toggle = dock.toggleViewAction()
        if name not in MODES["explore"].panes:
            assert not dock.isVisible()
            toggle.trigger()
        assert dock.isVisible()
        assert toggle.isChecked()
        toggle.trigger()
        assert not dock.isVisible()
        toggle.trigger()
        assert dock.isVisible()
        assert dock.widget().isVisible()


def test_docks_have_names_that_a_saved_arrangement_can_refer_to(application: Application) -> None:
    for name, dock in application.window.docks.items():
        assert dock.objectName() == name
        assert dock.windowTitle()


@pytest.mark.own_window
def test_quit_closes_the_window(application: Application) -> None:
    application.window.actions_by_name["quit"].trigger()
    assert not application.window.isVisible()


def test_what_cannot_be_done_is_not_offered(application: Application) -> None:
    by_text = {a.text(): a for menu in menus(application.window.menuBar()) for a in entries(menu)}
    with_photo = ("&Close photo", "&Match", "&Apply", "Save match", "&Use this")
    for text in (*with_photo, "&Undo", "&Redo"):
        (found,) = [action for key, action in by_text.items() if key.startswith(text)]
        assert not found.isEnabled(), text


def test_one_scan_axis_is_chosen_at_a_time(application: Application) -> None:
    axes = application.window.menus.scan_axes.actions()
    assert [axis.data() for axis in axes if axis.isChecked()] == ["auto"]
    axes[2].trigger()
    assert [axis.data() for axis in axes if axis.isChecked()] == ["lines"]


@pytest.mark.parametrize(
    "kind", [QSlider, QAbstractSpinBox, QComboBox, QLineEdit, QCheckBox, QPushButton]
)
def test_every_control_of_the_window_has_a_name_and_a_tooltip(
    application: Application, kind: type[QWidget]
) -> None:
    controls = application.window.findChildren(kind)
    assert controls
    for control in controls:
        if isinstance(control.parentWidget(), QAbstractSpinBox):
            continue
        text = control.text() if isinstance(control, QCheckBox | QPushButton) else ""
        assert control.accessibleName() or text, control
        assert control.toolTip(), control


def test_every_picture_and_plot_has_a_name(application: Application) -> None:
    graphics = application.window.findChildren(QGraphicsView)
    assert len(graphics) >= 3
    for view in graphics:
        assert view.accessibleName(), view


def test_there_are_as_many_bars_of_tabs_as_groups_of_panes(
    application: Application, qtbot: QtBot
) -> None:
    window = application.window

    def tabs() -> list[list[str]]:
        found = [bar for bar in window.findChildren(QTabBar) if bar.parent() is window]
        return [
            [bar.tabText(place) for place in range(bar.count())] for bar in found if bar.isVisible()
        ]

    def is_shown(wanted: list[list[str]]) -> bool:
        return sorted(tabs()) == wanted

    for mode in ("photo", "explore", "limits", "photo"):
        window.modes.switch(mode)
        of_photo = [["Column profile", "Photos"], ["Photo", "Scene"]]
        wanted = of_photo if mode == "photo" else []
        qtbot.waitUntil(partial(is_shown, wanted))


def test_one_way_of_showing_the_photo_is_chosen_at_a_time(application: Application) -> None:
    modes = application.window.menus.overlays.actions()
    assert [mode.data() for mode in modes] == list(OVERLAYS)
    for action in (*modes, modes[0]):
        action.trigger()
        assert [mode.data() for mode in modes if mode.isChecked()] == [action.data()]
        assert application.view("picture").mode.key() == action.data()


def drop(application: Application, *urls: QUrl) -> None:
    """Let go of something over the middle of the window."""
    data = QMimeData()
    data.setUrls(list(urls))
    place = application.window.rect().center()
    actions, button = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton
    no_key = Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(place, actions, data, button, no_key)
    QApplication.sendEvent(application.window, enter)
    assert enter.isAccepted()
    QApplication.sendEvent(application.window, QDropEvent(place, actions, data, button, no_key))


def test_the_window_alone_takes_drops_and_reports_them(
    application: Application, tmp_path: Path
) -> None:
    told: list[list[Path]] = []
    application.window.dropped.connect(told.append)
    drop(application, QUrl.fromLocalFile(str(tmp_path / "a.png")), QUrl("https://example.org/b"))
    assert told == [[tmp_path / "a.png"]]
    takers = [w for w in application.window.findChildren(QWidget) if w.acceptDrops()]
    assert takers == []


def test_text_is_not_taken_for_files(application: Application) -> None:
    data = QMimeData()
    data.setText("a.png")
    enter = QDragEnterEvent(
        application.window.rect().center(), Qt.DropAction.CopyAction, data,
        Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    enter.ignore()
    QApplication.sendEvent(application.window, enter)
    assert not enter.isAccepted()


@pytest.mark.parametrize("height", [800, 1080])
@pytest.mark.own_window
def test_a_pane_that_opens_below_the_middle_is_high_enough(
    application: Application, qtbot: QtBot, height: int
) -> None:
    window = application.window
    window.resize(1280, height)
    window.bring_to_front("compare")
    compare = window.docks["compare"]
    qtbot.waitUntil(lambda: compare.height() > 0.25 * height)
    # The height that the user gives it stays, also when it is brought to the front again.
    window.resizeDocks([compare], [180], Qt.Orientation.Vertical)
    qtbot.waitUntil(lambda: compare.height() < 0.25 * height)
    given = compare.height()
    window.bring_to_front("compare")
    qtbot.wait(50)
    assert compare.height() == given


@pytest.mark.parametrize(("name", "side"), [("compare", "height"), ("equations", "width")])
def test_a_pane_that_the_menu_opens_is_large_enough(
    application: Application, qtbot: QtBot, name: str, side: str
) -> None:
    window = application.window
    window.resize(1280, 800)
    dock = window.docks[name]
    dock.toggleViewAction().trigger()
    qtbot.waitUntil(lambda: getattr(dock, side)() >= 0.25 * getattr(window, side)())
