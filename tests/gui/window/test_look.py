"""Contrasts of every theme, sizes of text, and a style sheet without colours of its own."""

import re
from collections.abc import Iterator

import pytest
from gui.kinds import add_widget
from gui.user import User
from PySide6.QtCore import QPoint, QRect
from PySide6.QtGui import QFont, QImage, QPainter, QPalette
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QStyle, QStyleOptionButton
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.widgets.building import heading_font
from occ_gui.widgets.colours import contrast
from occ_gui.widgets.state_look import State, colours_of
from occ_gui.window.docks import floating_place
from occ_gui.window.style_sheet import SHEET, style_sheet
from occ_gui.window.theme import SIZES, palette_of
from occ_model.files.resources import resource_names

ROLE = QPalette.ColorRole
THEMES = ("light", "dark")
LEAST_CONTRASTS = {
    7.0: [
        (ROLE.WindowText, ROLE.Window), (ROLE.Text, ROLE.Base), (ROLE.Text, ROLE.AlternateBase),
        (ROLE.ButtonText, ROLE.Button), (ROLE.ToolTipText, ROLE.ToolTipBase),
    ],
    4.5: [
        (ROLE.Text, ROLE.Window), (ROLE.ButtonText, ROLE.Midlight), (ROLE.Link, ROLE.Base),
        (ROLE.HighlightedText, ROLE.Highlight), (ROLE.PlaceholderText, ROLE.Base),
        (ROLE.Link, ROLE.Window), (ROLE.LinkVisited, ROLE.Base),
    ],
    3.0: [
        (ROLE.Mid, ROLE.Window), (ROLE.Mid, ROLE.Base), (ROLE.Accent, ROLE.Window),
        (ROLE.Accent, ROLE.Base), (ROLE.Highlight, ROLE.Window), (ROLE.Highlight, ROLE.Base),
        (ROLE.Accent, ROLE.Button),
    ],
}  # fmt: skip
"""Least contrast of running text, of other words, and of frames, marks and focus."""


@pytest.mark.parametrize("theme", THEMES)
def test_words_and_frames_have_the_contrast_that_they_need(theme: str) -> None:
    palette = palette_of(theme)
    for least, pairs in LEAST_CONTRASTS.items():
        for front, back in pairs:
            assert contrast(palette.color(front), palette.color(back)) >= least, (front, back)
    for state in State:
        colours = colours_of(state, palette)
        assert contrast(colours.ink, colours.paper) >= 4.5, state


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("checked", [True, False])
@pytest.mark.parametrize("how", ["at rest", "hovered", "pressed", "pressed by a key", "focused"])
def test_a_button_can_be_read_in_every_state(
    qtbot: QtBot, theme: str, checked: bool, how: str
) -> None:
    palette = palette_of(theme)
    # A button without text has the background's colour in its middle.
    button = add_widget(qtbot, QPushButton())
    button.setPalette(palette)
    button.setStyleSheet(style_sheet(palette))
    button.setCheckable(True)
    button.setChecked(checked)
    button.resize(80, 24)
    option = QStyleOptionButton()
    button.initStyleOption(option)
    state = QStyle.StateFlag
    option.state |= {
        "at rest": state.State_None,
        "hovered": state.State_MouseOver,
        "pressed": state.State_MouseOver | state.State_Sunken,
        "pressed by a key": state.State_Sunken | state.State_HasFocus,
        "focused": state.State_HasFocus,
    }[how]
    image = QImage(button.size(), QImage.Format.Format_RGB32)
    painter = QPainter(image)
    button.style().drawControl(QStyle.ControlElement.CE_PushButton, option, painter, button)
    painter.end()
    text = ROLE.HighlightedText if checked else ROLE.ButtonText
    assert contrast(palette.color(text), image.pixelColor(40, 12)) >= 4.5


def test_the_sheet_has_the_colours_of_the_palette_only() -> None:
    assert re.findall(r"#[0-9a-fA-F]{3,8}\b(?![^{]*\{)", SHEET) == []
    for theme in THEMES:
        palette = palette_of(theme)
        known = {palette.color(role).name() for role in ROLE if role != ROLE.NColorRoles}
        sheet = style_sheet(palette)
        assert "palette(" not in sheet
        assert set(re.findall(r"#[0-9a-f]{6}\b", sheet)) <= known


def test_each_icon_of_the_sheet_is_a_file() -> None:
    named = set(re.findall(r"\{icons\}/(\w+)\.svg", SHEET))
    assert named == set(resource_names("icons/style", ".svg"))


def test_headings_follow_the_font() -> None:
    font = QFont("DejaVu Sans")
    font.setPixelSize(26)
    assert heading_font(font).pixelSize() == 32
    font.setPointSizeF(9.0)
    assert heading_font(font).pointSizeF() == pytest.approx(9 * 16 / 13, 0.05)
    assert heading_font(font).bold()


@pytest.mark.parametrize("corner", [QPoint(0, 0), QPoint(900, 500), QPoint(-300, -200)], ids=str)
def test_a_floating_pane_is_whole_on_the_screen_near_its_place(corner: QPoint) -> None:
    screen, place = QRect(0, 0, 1280, 800), QRect(corner, QRect(0, 0, 400, 300).size())
    floating = floating_place(place, screen)
    assert screen.contains(floating)
    assert floating.size() == place.size()
    if screen.contains(place.translated(24, 24)):
        assert (floating.topLeft() - place.topLeft()).manhattanLength() <= 48
    assert floating_place(QRect(0, 0, 2000, 1900), screen) == screen


@pytest.mark.qt_log_ignore("This plugin does not support")
def test_a_floating_pane_is_near_its_place(application: Application, qtbot: QtBot) -> None:
    dock = application.window.docks["controls"]
    application.window.resize(1000, 700)  # another test may leave it higher than the screen
    qtbot.waitUntil(lambda: dock.height() < 700)
    place = QRect(dock.mapToGlobal(QPoint()), dock.size())
    dock.setFloating(True)
    screen = dock.screen().availableGeometry()
    qtbot.waitUntil(lambda: dock.geometry() == floating_place(place, screen))
    dock.setFloating(False)


@pytest.fixture
def resizable(application: Application) -> Iterator[Application]:
    """Yield a window and reset its text size afterwards."""
    yield application
    application.options.text_size.reset()


def sizes(application: Application) -> list[float]:
    bar, scene = application.story.verdict, application.controls
    widgets = (
        bar.title, bar.sentence, scene.panels["Main"].labels["distance"], scene.preset,
        scene.code.bits, application.view("decode").verdict, application.view("accuracy").table,
    )  # fmt: skip
    QApplication.processEvents()  # windows receive another font by an event
    return [widget.font().pointSizeF() for widget in widgets]


def test_all_text_grows_by_one_factor_which_is_stored_and_can_be_reset(
    resizable: Application, user: User
) -> None:
    before, system = sizes(resizable), QApplication.font().pointSizeF()
    user.choose("Lar&ger text")
    assert resizable.preferences.recall("view/text_percent") == str(SIZES[1])
    assert user.message == f"Text at {SIZES[1]} %"
    user.choose("Lar&ger text")
    factor = SIZES[-1] / SIZES[0]
    assert QApplication.font().pointSizeF() == pytest.approx(factor * system)
    assert sizes(resizable) == pytest.approx([factor * size for size in before])
    user.choose("Lar&ger text")  # there is none larger
    assert sizes(resizable) == pytest.approx([factor * size for size in before])
    label = QLabel("new")
    assert label.font().pointSizeF() == pytest.approx(factor * system)
    user.choose("Smaller te&xt")
    user.choose("&Normal text size")
    assert sizes(resizable) == pytest.approx(before)
