"""The toolbar: icons of menu entries, named, sharp on every screen and in every theme."""

import re

import numpy as np
import pytest
from gui.kinds import add_widget
from PySide6.QtGui import (
    QColor,
    QIcon,
    QImage,
    QPalette,
    QUndoCommand,
    QUndoStack,
)
from PySide6.QtWidgets import QMenu
from pytestqt.qtbot import QtBot
from shiboken6 import delete

from occ_gui.app.application import Application
from occ_gui.widgets.icons import icon, pixmap
from occ_gui.window.command_lists import entries
from occ_gui.window.modes import MODES
from occ_gui.window.theme import palette_of
from occ_gui.window.toolbar import TOOLS, ToolButton
from occ_model.files.resources import resource_text

DRAWN = {drawing for group in TOOLS for drawing in group.values()}
ICONS = sorted({*DRAWN, *MODES})
"""Those of the toolbar; other drawings of the folder are pictures with colours."""


def opacity(image: QImage) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """Return how opaque each pixel is, shape (height, width)."""
    image = image.convertToFormat(QImage.Format.Format_Alpha8)
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
    return rows[:, : image.width()].copy()


def test_each_button_is_an_entry_of_the_menus(application: Application) -> None:
    bar = application.window.menuBar()
    known = {action for _, action in entries(bar)}
    known |= {menu.menuAction() for menu in bar.findChildren(QMenu)}
    buttons = application.window.toolbar.buttons
    assert {button.shown for button in buttons.values()} <= known
    assert {"open_photo", "undo", "redo", "before", "pin_a", "pin_b"} <= set(buttons)
    assert {"fit", "export", "theme"} <= set(buttons)


def test_a_click_does_what_the_entry_does(application: Application) -> None:
    buttons = application.window.toolbar.buttons
    assert not buttons["undo"].isEnabled()
    application.store.change(iso=200.0)
    assert buttons["undo"].isEnabled()
    buttons["undo"].click()
    assert application.store.scene.value("iso") == 100.0
    buttons["before"].click()
    assert application.view("picture").before.chosen.isChecked()
    application.view("picture").before.chosen.click()
    assert not buttons["before"].isChecked()


def test_tooltips_name_the_keys_of_the_entry(application: Application) -> None:
    for name, button in application.window.toolbar.buttons.items():
        keys = button.shown.shortcut().toString(button.shown.shortcut().SequenceFormat.NativeText)
        assert button.accessibleName() in button.toolTip(), name
        assert keys in button.toolTip(), name


def test_icons_name_no_colour_of_their_own() -> None:
    for name in ICONS:
        text = resource_text("icons", f"{name}.svg")
        colours = set(re.findall(r'(?:stroke|fill)="([^"]*)"', text))
        assert "currentColor" in colours, name
        assert colours <= {"currentColor", "none"}, name


@pytest.mark.parametrize("ratio", [1.0, 1.25, 2.0])
def test_icons_are_drawn_in_the_pixels_of_the_screen(qapp: object, ratio: float) -> None:
    for name in ICONS:
        drawn = pixmap(name, QColor("#336699"), 20, ratio)
        assert drawn.width() == drawn.height() == round(20 * ratio)
        assert drawn.devicePixelRatio() == ratio
        image = drawn.toImage()
        seen = opacity(image)
        assert 0.05 < np.mean(seen > 128) < 0.8, name
        assert not seen[0, 0]
        row, column = np.unravel_index(np.argmax(seen), seen.shape)
        assert image.pixelColor(int(column), int(row)).name() == "#336699"


def test_twice_the_pixels_show_finer_edges(qapp: object) -> None:
    coarse, fine = (opacity(pixmap("theme", QColor("black"), 20, r).toImage()) for r in (1, 2))
    blown_up = np.kron(coarse, np.ones((2, 2), dtype=np.uint8))
    assert np.mean(fine != blown_up) > 0.1


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_icons_have_the_colour_of_the_text(qapp: object, theme: str) -> None:
    palette = palette_of(theme)
    found = icon("theme", palette, 20, 1.0)
    for mode, group in (
        (QIcon.Mode.Normal, QPalette.ColorGroup.Active),
        (QIcon.Mode.Disabled, QPalette.ColorGroup.Disabled),
    ):
        image = found.pixmap(20, mode).toImage()
        wanted = palette.color(group, QPalette.ColorRole.WindowText).name()
        assert image.pixelColor(14, 10).name() == wanted


def test_another_theme_draws_the_icons_anew(application: Application, qtbot: QtBot) -> None:
    button = application.window.toolbar.buttons["theme"]
    qtbot.waitUntil(lambda: not button.icon().isNull())
    for theme, is_light in (("dark", True), ("light", False)):
        application.options.theme.choose(theme)

        def check(is_light: bool = is_light) -> None:
            colour = button.icon().pixmap(20).toImage().pixelColor(14, 10)
            assert (colour.lightness() > 128) == is_light

        qtbot.waitUntil(check)
    application.options.theme.choose("system")


def test_a_button_asks_nothing_of_an_entry_that_is_deleted(qtbot: QtBot) -> None:
    stack = QUndoStack()
    undo = stack.createUndoAction(stack)
    stack.push(QUndoCommand("change of ISO speed"))
    button = add_widget(qtbot, ToolButton("undo", undo))
    assert button.isEnabled()
    with qtbot.captureExceptions() as raised:
        delete(stack)
    assert raised == []
