"""The toolbar: named icons of menu entries, sharp on every screen and in every theme."""

from gui.kinds import add_widget
from PySide6.QtGui import QColor, QUndoCommand, QUndoStack
from PySide6.QtWidgets import QMenu
from pytestqt.qtbot import QtBot
from shiboken6 import delete

from occ_gui.app.application import Application
from occ_gui.values.modes import MODES
from occ_gui.widgets.icons import pixmap
from occ_gui.window.command_lists import menu_entries
from occ_gui.window.style_sheet import style_sheet
from occ_gui.window.theme import palette_of
from occ_gui.window.toolbar import TOOLS, ToolButton


def test_each_button_is_an_entry_of_the_menus(application: Application) -> None:
    # Qt's own menu cannot hide the toolbar, as it could not show it again.
    assert not application.window.toolbar.toggleViewAction().isVisible()
    bar = application.window.menuBar()
    actions = {action for _, action in menu_entries(bar)}
    actions |= {menu.menuAction() for menu in bar.findChildren(QMenu)}
    buttons = application.window.toolbar.buttons
    assert {button.source for button in buttons.values()} <= actions
    assert {"open_photo", "undo", "redo", "before", "pin_a", "pin_b"} <= set(buttons)
    assert {"fit", "export", "theme"} <= set(buttons)


def test_a_click_does_what_the_entry_does(application: Application) -> None:
    buttons = application.window.toolbar.buttons
    assert not buttons["undo"].isEnabled()
    application.scene_store.change(iso=200.0)
    assert buttons["undo"].isEnabled()
    buttons["undo"].click()
    assert application.scene_store.scene.value("iso") == 100.0
    buttons["before"].click()
    assert application.view("picture").before.checkbox.isChecked()
    application.view("picture").before.checkbox.click()
    assert not buttons["before"].isChecked()


def test_tooltips_name_the_keys_of_the_entry(application: Application) -> None:
    for name, button in application.window.toolbar.buttons.items():
        keys = button.source.shortcut().toString(button.source.shortcut().SequenceFormat.NativeText)
        assert button.accessibleName() in button.toolTip(), name
        assert keys in button.toolTip(), name


def test_every_icon_is_drawn_in_one_colour_and_in_the_pixels_of_the_screen(qapp: object) -> None:
    drawings = {drawing for group in TOOLS for drawing in group.values()}
    for name in {*drawings, *MODES}:
        icon = pixmap(name, QColor("#336699"), 20, 2.0)
        assert (icon.width(), icon.devicePixelRatio()) == (40, 2.0)
        image = icon.toImage()
        colours = [image.pixelColor(x, y) for x in range(40) for y in range(40)]
        assert {colour.name() for colour in colours if colour.alpha() == 255} == {"#336699"}, name


def test_another_theme_redraws_the_icons_and_has_a_style_sheet_of_its_colours(
    application: Application, qtbot: QtBot
) -> None:
    button = application.window.toolbar.buttons["theme"]
    qtbot.waitUntil(lambda: not button.icon().isNull())
    for theme, is_light in (("dark", True), ("light", False)):
        application.options.theme.choose(theme)
        assert application.window.styleSheet() == style_sheet(palette_of(theme))

        def check(is_light: bool = is_light) -> None:
            colour = button.icon().pixmap(20).toImage().pixelColor(14, 10)
            assert (colour.lightness() > 128) == is_light

        qtbot.waitUntil(check)
    application.options.theme.choose("system")


def test_a_button_ignores_an_entry_that_is_deleted(qtbot: QtBot) -> None:
    stack = QUndoStack()
    undo = stack.createUndoAction(stack)
    stack.push(QUndoCommand("change of ISO speed"))
    button = add_widget(qtbot, ToolButton("undo", undo))
    assert button.isEnabled()
    with qtbot.captureExceptions() as raised:
        delete(stack)
    assert raised == []
