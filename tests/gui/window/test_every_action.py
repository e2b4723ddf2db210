"""Every action, button, list and check box of the window is connected, named and explained."""

import re
from collections import Counter
from collections.abc import Iterator

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QLineEdit,
    QMenu,
    QMenuBar,
    QScrollBar,
    QTabBar,
    QWidget,
)

from occ_gui.app.application import Application
from occ_gui.window.command_lists import menu_entries
from occ_model.teaching.lessons import lessons

READ_LATER = ("Fit gamma too",)
"""Boxes without a connection, because a button reads them."""

CONTROLS = (QAbstractButton, QComboBox, QAbstractSlider, QAbstractSpinBox, QLineEdit, QTabBar)


def controls_of(window: QWidget) -> Iterator[QWidget]:
    """Yield the user's controls, without those that Qt itself puts into lists, tabs and docks."""
    for widget in window.findChildren(QWidget):
        parent = widget.parentWidget()
        if (
            isinstance(widget, CONTROLS)
            and not isinstance(widget, QScrollBar)
            and not isinstance(parent, QAbstractSpinBox | QComboBox | QTabBar)
            and not widget.objectName().startswith(("qt_", "ScrollLeft", "ScrollRight"))
            and widget.metaObject().className() != "QTableCornerButton"
            and not isinstance(widget, QTabBar)
        ):
            yield widget


def path_to(widget: QObject) -> str:
    names: list[str] = []
    at: QObject | None = widget
    while at is not None:
        names.append(type(at).__name__)
        at = at.parent()
    return " in ".join(names[:4])


def name_of(widget: QWidget) -> str:
    text = widget.text() if isinstance(widget, QAbstractButton) else ""
    return widget.accessibleName() or text


SIGNALS = {
    QAbstractButton: ("2clicked(bool)", "2toggled(bool)", "2clicked()", "2pressed()"),
    QComboBox: ("2activated(int)", "2textActivated(QString)", "2currentIndexChanged(int)"),
    QAbstractSlider: ("2valueChanged(int)",),
    QLineEdit: ("2editingFinished()", "2textEdited(QString)", "2textChanged(QString)"),
}


def list_missing(widget: QWidget) -> list[str]:
    """Return what a control lacks."""
    is_connected = name_of(widget) in READ_LATER or all(
        sum(map(widget.receivers, names))
        for kind, names in SIGNALS.items()
        if isinstance(widget, kind)
    )
    takes_tab = bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus)
    needed = {
        "name": bool(name_of(widget)),
        "tip": bool(widget.toolTip()),
        "connection": is_connected,
        "focus by the Tab key": takes_tab or not widget.isEnabled(),
    }
    return [what for what, is_there in needed.items() if not is_there]


def test_each_pane_can_be_hidden_and_shown_and_its_controls_are_named_explained_and_connected(
    application: Application,
) -> None:
    window = application.window
    names = {step.pane for lesson in lessons().lessons for step in lesson.steps}
    assert names - {""} <= set(window.docks)
    for name, dock in window.docks.items():
        assert dock.objectName() == name  # which a stored layout contains
        assert dock.windowTitle()
        toggle = dock.toggleViewAction()
        if name not in window.modes.panes.places_in("explore"):
            assert not dock.isVisible()
            toggle.trigger()
        for on in (True, False, True):
            assert dock.isVisible() == toggle.isChecked() == dock.widget().isVisible() == on
            toggle.trigger()
    controls = list(controls_of(window))
    # Among them are those of panes that are made late.
    late = {"Pin A", "Show the explanation", "Column whose exposure is shown"}
    assert late <= set(map(name_of, controls))
    missing = [(each, list_missing(each)) for each in controls]
    assert [(name_of(each), path_to(each), what) for each, what in missing if what] == []


def all_entries(application: Application) -> list[tuple[str, QAction]]:
    return list(menu_entries(application.window.menuBar()))


def test_keys_are_unique_and_each_entry_has_a_letter_unique_in_its_menu(
    application: Application,
) -> None:
    actions = {action for _, action in all_entries(application)}  # one may stand in two menus
    keys = Counter(key.toString() for action in actions for key in action.shortcuts())
    assert [key for key, count in keys.items() if count > 1] == []
    bar = application.window.menuBar()
    menus: list[QMenuBar | QMenu] = [bar, *bar.findChildren(QMenu)]
    for menu in menus:
        letters = Counter(
            match[1].lower()
            for action in menu.actions()
            if (match := re.search(r"&(\w)", action.text().replace("&&", "")))
        )
        assert [letter for letter, count in letters.items() if count > 1] == [], letters
    names = {figure.title for figure in application.shell.figures.values()}
    for path, action in all_entries(application):
        text = action.text()
        lists = ("Open recent", "Open sample photo", "View", "Animation of a slider")
        by_name = path.endswith(lists) or any(text.startswith(name) for name in names)
        assert "&" in text or by_name, (path, text)


def test_each_entry_is_connected(application: Application) -> None:
    for path, action in all_entries(application):
        group = action.actionGroup()
        receivers = action.receivers("2triggered(bool)") + action.receivers("2toggled(bool)")
        if group is not None:
            receivers += group.receivers("2triggered(QAction*)")
        assert receivers > 0, (path, action.text())
