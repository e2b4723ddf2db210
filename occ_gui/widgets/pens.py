"""Colours and pens that plots, rows and legends share."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor, QPen

from occ_model import colours

SIMULATION = QColor(colours.SIMULATION)
BAND = QColor(colours.BAND)
PHOTO = QColor(colours.PHOTO)
THRESHOLD = QColor(colours.THRESHOLD)
REGION = QColor(colours.REGION)
NOISE = QColor(colours.NOISE)
BEFORE = QColor("#8A8A8A")
"""Colour of the results before the last change: grey, which nothing else uses."""


def thin(colour: QColor, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """Return a pen of width one, as of lines that divide and mark."""
    pen = QPen(QBrush(colour), 1.0, style)
    pen.setCosmetic(True)
    return pen
