"""One look on every machine - style, theme, font, size - and pictures to compare it with."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from gui.shared_window import SharedWindow
from gui.snapshots.gallery import Gallery
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.window.theme import palette_of


@pytest.fixture(scope="session")
def font(qapp: QApplication) -> QFont:
    """The font of all tests, without the hints that other systems follow otherwise."""
    font = QFont("DejaVu Sans", 9)
    font.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    font.setStyleStrategy(QFont.StyleStrategy.NoSubpixelAntialias)
    return font


@pytest.fixture(autouse=True)
def one_look(qapp: QApplication, font: QFont, kept_window: SharedWindow) -> Iterator[None]:
    """Draw in Fusion, in the light theme and in one font, and put back what was before."""
    kept_window.close()  # all of it would be styled anew, twice a test
    style, palette, other_font = qapp.style().objectName(), qapp.palette(), qapp.font()
    qapp.setStyle("Fusion")
    qapp.setPalette(palette_of("light"))
    qapp.setFont(font)
    yield
    qapp.setFont(other_font)
    qapp.setPalette(palette)
    qapp.setStyle(style)


@pytest.fixture
def gallery(request: pytest.FixtureRequest, qtbot: QtBot, tmp_path: Path) -> Gallery:
    return Gallery(qtbot, tmp_path, is_renewed=request.config.getoption("--renew-snapshots"))
