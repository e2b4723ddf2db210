"""Text scale: four sizes of text, all relative to the application's font."""

from enum import Enum
from typing import TypeVar

from PySide6.QtGui import QFont
from PySide6.QtWidgets import QLabel

Label = TypeVar("Label", bound=QLabel)


class TextSize(Enum):
    """A size, as a factor of the application's font: 11, 13, 16 and 20 pixels of 13."""

    SMALL = 11 / 13
    BODY = 1.0
    HEADING = 16 / 13
    TITLE = 20 / 13


def resized(font: QFont, factor: float) -> QFont:
    found = QFont(font)
    if font.pointSizeF() > 0.0:
        found.setPointSizeF(factor * font.pointSizeF())
    else:  # a font whose size is given in pixels
        found.setPixelSize(round(factor * font.pixelSize()))
    return found


def scaled(font: QFont, size: TextSize, *, bold: bool = False) -> QFont:
    found = resized(font, size.value)
    found.setBold(bold)
    return found


def emboldened(label: Label, factor: float = 1.0) -> Label:
    """Set a label in bold, in a size that is so many times its own."""
    font = label.font()
    font.setBold(True)
    if factor != 1.0:  # a size that is set no longer follows that of the application
        font.setPointSizeF(factor * font.pointSizeF())
    label.setFont(font)
    return label
