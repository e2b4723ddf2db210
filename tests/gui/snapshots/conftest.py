"""One look on every machine - style, theme, font, size - and pictures to compare it with."""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from gui.shared_window import SharedWindow
from gui.snapshots.drawing import LEAST_SIMILARITY, MOST_COLOUR, difference, settled
from PIL import Image
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication, QWidget

from occ_gui.window.theme import palette_of

PICTURES = Path(__file__).with_name("pictures")


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
def matches_its_picture(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[..., None]:
    """Compare a widget with its stored picture, or store it anew under --renew-snapshots."""

    def compare(widget: QWidget, name: str) -> None:
        path, found = PICTURES / f"{name}.png", settled(widget)
        if request.config.getoption("--renew-snapshots"):
            # Refined by k-means: a rare colour would be lost among many greys otherwise.
            Image.fromarray(found).quantize(256, kmeans=1).save(path, optimize=True)
            return
        assert path.exists(), f"{path} is missing: pytest --renew-snapshots stores it"
        with Image.open(path) as picture:
            seen = difference(found, np.asarray(picture.convert("RGB")))
        Image.fromarray(found).save(tmp_path / path.name)
        assert seen.is_small, (
            f"{tmp_path / path.name} differs from {path}: {seen}; allowed: a similarity from "
            f"{LEAST_SIMILARITY} and a colour to {MOST_COLOUR}. Look at both; if the new one is "
            "as it should be, pytest --renew-snapshots stores it."
        )

    return compare
