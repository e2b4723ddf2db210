"""Text scale: sizes of text relative to the application's font."""

from typing import TypeVar

from PySide6.QtGui import QFont
from PySide6.QtWidgets import QLabel

Label = TypeVar("Label", bound=QLabel)


_HEADING = 16 / 13  # size of a heading relative to text: 16 pixels if text has 13


def resize_font(font: QFont, factor: float) -> QFont:
    found = QFont(font)
    if font.pointSizeF() > 0.0:
        found.setPointSizeF(factor * font.pointSizeF())
    else:  # a font whose size is given in pixels
        found.setPixelSize(round(factor * font.pixelSize()))
    return found


def heading_font(font: QFont) -> QFont:
    found = resize_font(font, _HEADING)
    found.setBold(True)
    return found


def embolden(label: Label, factor: float = 1.0) -> Label:
    """Make the text of a label bold, and change its size by a factor; return the label."""
    font = label.font()
    font.setBold(True)
    if factor != 1.0:  # a label with a size of its own does not follow the application's size
        font = resize_font(font, factor)
    label.setFont(font)
    return label
