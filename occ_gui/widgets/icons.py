"""Icons: drawings in SVG, in the colours of a palette and sharp on any screen."""

from functools import cache

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap

from occ_model.files.resources import resource_text

PROGRAM = "occ-explorer"

PROGRAM_SIZES = (16, 32, 48, 64, 128, 256)  # sides of the program's icon in pixels

_FOLDER, _ENDING = "icons", ".svg"
_INK = "currentColor"  # what the drawings name in place of a colour, as in CSS


@cache
def _drawing(name: str) -> str:
    return resource_text(_FOLDER, f"{name}{_ENDING}")


def icon(name: str, palette: QPalette, size: int, ratio: float) -> QIcon:
    """Draw an icon for a screen, in the text colours of a palette.

    ``size``: width and height, independent of the screen.
    ``ratio``: pixels of the screen that each of them takes.
    """
    found = QIcon()
    for mode, group in (
        (QIcon.Mode.Normal, QPalette.ColorGroup.Active),
        (QIcon.Mode.Disabled, QPalette.ColorGroup.Disabled),
    ):
        colour = palette.color(group, QPalette.ColorRole.WindowText)
        found.addPixmap(pixmap(name, colour, size, ratio), mode)
    return found


def program_icon() -> QIcon:
    found = QIcon()
    for size in PROGRAM_SIZES:
        found.addPixmap(pixmap(PROGRAM, QColor(), size, 1.0))
    return found


def pixmap(name: str, colour: QColor, size: int, ratio: float) -> QPixmap:
    """Draw an icon in one colour; the parameters are those of :func:`icon`."""
    # Loaded with the first icon that is seen, not with the program.
    from PySide6.QtSvg import QSvgRenderer

    side = round(size * ratio)
    drawn = QPixmap(side, side)
    drawn.fill(Qt.GlobalColor.transparent)
    painter = QPainter(drawn)
    QSvgRenderer(QByteArray(_drawing(name).replace(_INK, colour.name()).encode())).render(painter)
    painter.end()
    drawn.setDevicePixelRatio(ratio)
    return drawn
