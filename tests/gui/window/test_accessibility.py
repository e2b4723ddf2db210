"""A screen reader reads each value with its unit, and the Tab key follows the reading order."""

from itertools import groupby, pairwise

import pytest
from gui.user import User
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QGridLayout, QLineEdit, QMainWindow, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.values.modes import MODES
from occ_gui.window.reading_order import focus_stops

VALUE, DESCRIPTION = QAccessible.Text.Value, QAccessible.Text.Description


def face_of(widget: QWidget) -> QAccessibleInterface:
    return QAccessible.queryAccessibleInterface(widget)


def test_a_slider_and_its_field_announce_the_value_with_its_unit(
    application: Application, user: User
) -> None:
    for name, row in application.controls.main_rows().items():
        for step in (100, 700):
            row.slider.setValue(step)
            value = row.field.text()
            assert face_of(row.field).text(VALUE) == value
            unit = value.split(" ")[-1] if " " in value else ""
            text = face_of(row.slider).text(DESCRIPTION)
            assert text.endswith(unit)
            number = pytest.approx(float(value.split(" ")[0]), rel=1e-3)
            assert float(text.split(" ")[0]) == number, name
    user.enter("exposure_time", "250 us")
    slider = application.controls.main_rows()["exposure_time"].slider
    assert face_of(slider).text(DESCRIPTION) == "250 µs"


MOST = 150
"""More keys than the focus needs to come round in any mode."""

SLACK = 6
"""Pixels by which neighbours may overlap."""


def place_of(widget: QWidget, window: QWidget) -> QRect:
    return QRect(widget.mapTo(window, QPoint()), widget.size())


def walk(window: QWidget, key: Qt.Key) -> list[QWidget]:
    """Press a key until the focus comes round, and return the widgets on its way."""
    window.setFocus()
    stops: list[QWidget] = []
    for _ in range(MOST):
        QTest.keyClick(QApplication.focusWidget() or window, key)
        widget = QApplication.focusWidget()
        if widget in stops:
            assert widget is stops[0], f"the key is caught at {widget.accessibleName()}"
            return stops
        stops.append(widget)
    raise AssertionError("the focus does not come round")


def pane_of(widget: QWidget, window: QWidget) -> QWidget:
    """Return the part of the window in which a widget lies."""
    while (parent := widget.parentWidget()) is not window:
        assert parent is not None
        widget = parent
    return widget


def comes_after(place: QRect, other: QRect) -> bool:
    """Whether a place is read after another: it is lower, or in a column to the right."""
    return place.bottom() > other.top() + SLACK or place.left() >= other.right() - SLACK


def show_mode(application: Application, qtbot: QtBot, mode: str) -> None:
    application.window.resize(1280, 800)
    application.window.modes.switch(mode)
    qtbot.waitUntil(lambda: application.is_idle)
    # When panes are shown for the first time, the window may cease to be active.
    application.window.activateWindow()
    qtbot.waitUntil(application.window.isActiveWindow)


def frequent_controls(application: Application) -> set[QWidget]:
    """Return some of the controls that users need most."""
    rows = [row for row in application.controls.main_rows().values() if not row.isHidden()]
    buttons = application.window.toolbar.buttons.values()
    return {
        *(row.slider for row in rows), *(row.field for row in rows), application.controls.preset,
        application.story.decoder, application.story.whole_picture,
        *(button for button in buttons if button.isEnabled() and button.isVisible()),
    }  # fmt: skip


@pytest.mark.parametrize(
    "mode", [pytest.param(m, marks=() if m == "explore" else pytest.mark.whole) for m in MODES]
)
def test_the_tab_key_goes_through_every_mode_in_reading_order_and_back(
    application: Application, qtbot: QtBot, mode: str
) -> None:
    window = application.window
    show_mode(application, qtbot, mode)
    stops = walk(window, Qt.Key.Key_Tab)
    assert stops[0] is window.toolbar.modes
    assert walk(window, Qt.Key.Key_Backtab) == stops[::-1]
    if mode == "explore":
        assert frequent_controls(application) <= set(stops)
    panes = [pane for pane, _ in groupby(pane_of(stop, window) for stop in stops)]
    assert len(panes) == len(set(panes)), "a pane is left and entered again"
    paths = [panes, *(list(each) for _, each in groupby(stops, lambda s: pane_of(s, window)))]
    for path in paths:
        for one, after in pairwise(path):
            if one.isAncestorOf(after):  # which may have been scrolled
                continue
            is_next = comes_after(place_of(after, window), place_of(one, window))
            assert is_next, (one, place_of(one, window), after, place_of(after, window))


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 1, 0, 2)])
def test_rows_come_before_columns_in_any_order_of_creation(
    qtbot: QtBot, order: tuple[int, ...]
) -> None:
    window, middle = QMainWindow(), QWidget()
    qtbot.addWidget(window)
    window.setCentralWidget(middle)
    grid = QGridLayout(middle)
    fields = {place: QLineEdit() for place in order}
    for place, field in fields.items():
        grid.addWidget(field, place // 2, place % 2)
    window.show()
    qtbot.waitExposed(window)
    assert list(focus_stops(window)) == [fields[place] for place in range(4)]
