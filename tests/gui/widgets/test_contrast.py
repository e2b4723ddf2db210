"""Drawn colours have sufficient contrast to their background, light or dark."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette, QPen
from PySide6.QtWidgets import QApplication, QCheckBox, QMainWindow
from pytestqt.qtbot import QtBot

from occ_gui.profile.profile_view import ProfileView
from occ_gui.widgets.colours import contrast, lighten_for, pen_on
from occ_gui.window.style_sheet import style_sheet
from occ_gui.window.theme import ThemeController, palette_of
from occ_model import colours

CURVES = [getattr(colours, name) for name in dir(colours) if name.isupper()]


@pytest.mark.parametrize(
    ("one", "other", "ratio"),
    [("#000000", "#ffffff", 21.0), ("#777777", "#ffffff", 4.48), ("#ff0000", "#0000ff", 2.15)],
)
def test_the_contrast_is_that_of_published_examples(one: str, other: str, ratio: float) -> None:
    assert contrast(QColor(one), QColor(other)) == pytest.approx(ratio, abs=0.005)
    assert contrast(QColor(other), QColor(one)) == contrast(QColor(one), QColor(other))


@pytest.mark.parametrize("colour", CURVES)
def test_curves_are_visible_in_the_dark_theme_and_have_the_colours_of_print_in_the_light_one(
    colour: str,
) -> None:
    dark = palette_of("dark")
    ink = lighten_for(dark, QColor(colour))
    assert contrast(ink, dark.color(QPalette.ColorRole.Base)) >= 4.5
    assert ink.hslHue() == pytest.approx(QColor(colour).hslHue(), abs=2)
    assert lighten_for(palette_of("light"), QColor(colour)) == QColor(colour)


def test_no_ink_can_be_seen_on_itself_and_the_search_ends() -> None:
    palette = palette_of("dark")
    for paper in ("#000000", "#7f7f7f", "#ffffff"):
        palette.setColor(QPalette.ColorRole.Base, QColor(paper))
        for ink in ("#000000", "#0000ff", "#7f7f7f", "#ffffff"):
            assert lighten_for(palette, QColor(ink)).isValid()


def test_only_the_colour_of_a_pen_changes() -> None:
    pen = QPen(QColor(colours.SIMULATION), 3, Qt.PenStyle.DashLine)
    seen = pen_on(palette_of("dark"), pen)
    assert (seen.width(), seen.style()) == (3, Qt.PenStyle.DashLine)
    assert seen.color() != pen.color()


def test_curves_follow_the_theme(qtbot: QtBot) -> None:
    themes, view = ThemeController(), ProfileView()
    qtbot.addWidget(view)
    for theme in ("dark", "light"):
        themes.choose(theme)
        QApplication.processEvents()
        assert view.simulation.opts["pen"].color() == lighten_for(
            palette_of(theme), QColor(colours.SIMULATION)
        )
    themes.choose("system")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_frame_of_an_empty_check_box_can_be_seen(qtbot: QtBot, theme: str) -> None:
    themes = ThemeController()
    themes.choose(theme)
    window, box = QMainWindow(), QCheckBox()
    window.setStyleSheet(style_sheet(palette_of(theme)))
    window.setCentralWidget(box)
    qtbot.addWidget(window)
    window.show()
    back = box.palette().color(QPalette.ColorRole.Window)
    picture = box.grab().toImage()
    row = [picture.pixelColor(column, picture.height() // 2) for column in range(16)]
    assert max(contrast(pixel, back) for pixel in row) >= 3.0  # WCAG 2.1, 1.4.11
    themes.choose("system")
