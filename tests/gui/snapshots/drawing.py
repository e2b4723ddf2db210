"""Draws a widget into an array, once its layout has come to rest."""

import numpy as np
from gui.snapshots.difference import Colours
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

_ROUNDS = 50


def show(qtbot: QtBot, widget: QWidget, width: int, height: int) -> None:
    qtbot.addWidget(widget)
    widget.resize(width, height)
    widget.show()
    QApplication.processEvents()


def drawn(widget: QWidget) -> Colours:
    """Draw a widget with one pixel a pixel, shape (height, width, 3)."""
    image = QImage(widget.size(), QImage.Format.Format_RGB888)
    widget.render(image)
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).copy()


def settled(widget: QWidget) -> Colours:
    """Draw a widget again and again until it stays the same three times: layouts take rounds."""
    pictures = [drawn(widget)]
    for _ in range(_ROUNDS):
        QApplication.processEvents()
        pictures.append(drawn(widget))
        if len(pictures) > 3 and all(np.array_equal(p, pictures[-1]) for p in pictures[-4:-1]):
            return pictures[-1]
    raise AssertionError("the widget never comes to rest")
