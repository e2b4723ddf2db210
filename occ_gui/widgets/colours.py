"""Colours and pens of plots, rows and legends, with sufficient contrast by WCAG 2.1."""

from functools import lru_cache

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor, QPalette, QPen

from occ_model import colours

_LEAST_CONTRAST = 4.5  # between text and its background by WCAG 2.1 (success criterion 1.4.3)
_LIGHTNESS_STEP = 108  # percent by which each step multiplies the lightness


def luminance(colour: QColor) -> float:
    """Return a colour's relative luminance, 0 to 1, by WCAG 2.1."""
    parts = (colour.redF(), colour.greenF(), colour.blueF())
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(first: QColor, second: QColor) -> float:
    """Return the contrast ratio of two colours, 1 to 21, by WCAG 2.1."""
    dark, light = sorted((luminance(first), luminance(second)))
    return (light + 0.05) / (dark + 0.05)


def lighten_for(palette: QPalette, colour: QColor) -> QColor:
    """Lighten a colour to the least contrast on a dark background; keep it on a light one."""
    return QColor(_lighten(palette.color(QPalette.ColorRole.Base).rgba(), colour.rgba()))


@lru_cache(maxsize=256)
def _lighten(paper_rgba: int, ink_rgba: int) -> QColor:
    paper, ink = QColor.fromRgba(paper_rgba), QColor.fromRgba(ink_rgba)
    while luminance(paper) < luminance(ink) < 1.0 and contrast(ink, paper) < _LEAST_CONTRAST:
        # In HSL, a growing lightness leads to white; in HSV, a growing value ends at pure blue.
        ink = QColor.fromHslF(
            ink.hslHueF(), ink.hslSaturationF(), min(1.0, ink.lightnessF() * _LIGHTNESS_STEP / 100)
        )
    return ink


def mix_colours(upper: QColor, lower: QColor, fraction: float) -> QColor:
    """Return the opaque colour that results from one colour over another with this opacity."""
    parts = zip(upper.getRgb()[:3], lower.getRgb()[:3], strict=True)  # type: ignore[index]
    return QColor(*(round(fraction * a + (1.0 - fraction) * b) for a, b in parts))


def pen_on(palette: QPalette, pen: QPen) -> QPen:
    """Return a pen with a colour of sufficient contrast to the palette's background."""
    visible_pen = QPen(pen)
    visible_pen.setColor(lighten_for(palette, pen.color()))
    return visible_pen


SIMULATION = QColor(colours.SIMULATION)
BAND = QColor(colours.BAND)
PHOTO = QColor(colours.PHOTO)
THRESHOLD = QColor(colours.THRESHOLD)
REGION = QColor(colours.REGION)
NOISE = QColor(colours.NOISE)
BEFORE = QColor("#8A8A8A")
"""Colour of the results from before the last change: a grey that nothing else uses."""


def thin_pen(colour: QColor, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """Return a pen of width one, for lines that divide or mark."""
    pen = QPen(QBrush(colour), 1.0, style)
    pen.setCosmetic(True)
    return pen
