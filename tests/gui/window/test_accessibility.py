"""Who hears the window finds each control by name, its value with unit, in the order it is read."""

from collections.abc import Iterator
from itertools import pairwise

import pytest
from gui.kinds import not_none
from gui.user import User
from PySide6.QtCore import QObject, QPoint
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.control_panel import MAIN
from occ_gui.window.modes.mode import MODES

NAME, VALUE, DESCRIPTION = (
    QAccessible.Text.Name, QAccessible.Text.Value, QAccessible.Text.Description,
)  # fmt: skip
ROLE = QAccessible.Role
HANDLED = {
    ROLE.Button, ROLE.ButtonMenu, ROLE.CheckBox, ROLE.RadioButton, ROLE.ComboBox, ROLE.Slider,
    ROLE.SpinBox, ROLE.PageTab, ROLE.PageTabList, ROLE.MenuItem,
}  # fmt: skip
"""Roles of what a user handles."""

ROW = 40
"""Pixels: a slider and the button above it are read as one row."""


def face_of(widget: QWidget) -> QAccessibleInterface:
    return not_none(QAccessible.queryAccessibleInterface(widget))


def faces_in(face: QAccessibleInterface) -> Iterator[QAccessibleInterface]:
    """Yield all that is seen in a face, as a screen reader walks."""
    for place in range(face.childCount()):
        child = face.child(place)
        if child is not None and child.isValid() and not child.state().invisible:
            yield child
            # What a list shows when it is open is not there before.
            if child.role() not in (ROLE.ComboBox, ROLE.SpinBox):
                yield from faces_in(child)


def object_name(face: QAccessibleInterface) -> str:
    """Return Qt's own name of what a face is of, or lies in."""
    known: list[QObject | None] = [face.object(), face.parent().object()]
    return next((each.objectName() for each in known if each is not None), "")


def enter(application: Application, qtbot: QtBot, mode: str) -> None:
    application.window.modes.switch(mode)
    qtbot.waitUntil(lambda: application.is_idle)
    QApplication.processEvents()


def test_everything_that_is_handled_has_a_name(application: Application, qtbot: QtBot) -> None:
    for mode in MODES:
        enter(application, qtbot, mode)
        handled = [f for f in faces_in(face_of(application.window)) if f.role() in HANDLED]
        assert len(handled) > 20
        # Qt's own buttons of docks, and what it puts into a table or a tab bar to scroll it.
        nameless = [
            (str(face.role()), face.rect())
            for face in handled
            if not face.text(NAME) and not object_name(face)
        ]
        assert nameless == [], mode


def test_the_parts_of_the_first_screen_are_found_by_name(
    application: Application, user: User
) -> None:
    user.wait_until_idle()
    names = {face.text(NAME) for face in faces_in(face_of(application.window))}
    wanted = {
        "Explore", "Photo", "Limits", "Effects", "Lessons", "Open photos", "Undo", "Export",
        "Theme", "Measure", "Verdict on the code", "Light", "Picture", "Profile", "Code",
        "Exposure time", "Distance", "Play: Exposure time", "Preset", "Code as bits",
    }  # fmt: skip
    assert wanted <= names
    verdict = face_of(application.story.verdict)
    assert verdict.text(NAME) == "Verdict on the code"
    assert verdict.text(DESCRIPTION).startswith("Code 718 read, all bits right.")


def test_the_cards_of_the_limits_are_found_by_name(application: Application, qtbot: QtBot) -> None:
    enter(application, qtbot, "limits")
    names = {face.text(NAME) for face in faces_in(face_of(application.shell.pane("map").view))}
    for decoder in application.shell.pane("map").view.cards.cards:
        assert f"Highest frequency, {decoder}" in names
        assert f"Go to the highest frequency, {decoder}" in names


def test_a_slider_and_its_field_tell_the_value_with_its_unit(
    application: Application, user: User
) -> None:
    for name in MAIN:
        row = application.controls.main_rows()[name]
        for step in (100, 700):
            row.slider.setValue(step)
            value = row.field.text()
            assert face_of(row.field).text(VALUE) == value
            unit = value.split(" ")[-1] if " " in value else ""
            told = face_of(row.slider).text(DESCRIPTION)
            assert told.endswith(unit)
            expected = pytest.approx(float(value.split(" ")[0]), rel=1e-3)
            assert float(told.split(" ")[0]) == expected, name
    user.enter("exposure_time", "250 us")
    slider = application.controls.main_rows()["exposure_time"].slider
    assert face_of(slider).text(DESCRIPTION) == "250 µs"


def test_the_tab_key_goes_through_the_story_as_it_is_read(
    application: Application, user: User
) -> None:
    user.wait_until_idle()
    window, story = application.window, application.story
    story.decoder.setFocus()
    tops = []
    while (widget := window.focusWidget()) is not None and story.isAncestorOf(widget):
        tops.append(widget.mapTo(window, QPoint()).y())
        window.focusNextChild()
    assert len(tops) == 10
    assert all(after >= before - ROW for before, after in pairwise(tops)), tops
