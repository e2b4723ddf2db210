"""Icons of states, points of legends and the bar of a state, as they are drawn."""

import numpy as np
import pytest
from gui.kinds import add_widget
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter, QPalette
from pytestqt.qtbot import QtBot

from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.plot import marker
from occ_gui.widgets.state_bar import StateBar
from occ_gui.widgets.state_look import _BADGES, State


@pytest.mark.parametrize("state", _BADGES)
def test_the_outline_of_an_icon_is_the_same_on_both_sides(state: State) -> None:
    points = _BADGES[state].toList()
    corners = {(point.x(), point.y()) for point in points}
    assert corners == {(-x, y) for x, y in corners}
    assert len(corners) == len(points)


@pytest.mark.parametrize("fill", [None, QColor("red")])
def test_a_legends_point_is_a_ring_or_filled(qtbot: QtBot, fill: QColor | None) -> None:
    image = QImage(40, 40, QImage.Format.Format_Grayscale8)
    image.fill(0)
    palette = QPalette()
    palette.setColor(QPalette.ColorRole.Text, QColor("white"))
    painter = QPainter(image)
    marker("o", 20.0, fill)(painter, QRectF(0, 0, 40, 40), palette)
    painter.end()
    grey = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(40, -1)[:, :40]
    assert (grey[20] > 0).any()
    assert bool(grey[20, 20]) == (fill is not None)


def test_the_bar_of_a_state_holds_its_title_and_its_sentence(qtbot: QtBot) -> None:
    bar = add_widget(qtbot, StateBar())
    bar.resize(400, bar.minimumSizeHint().height())
    bar.show()
    for part in (bar.title, bar.sentence):
        assert bar.rect().adjusted(0, 1, 0, -1).contains(part.geometry())


def test_a_logarithmic_axis_has_ticks_at_both_its_ends(qtbot: QtBot) -> None:
    (_, numbered), (_, between) = LogAxis("left").tickValues(0.0, 2.0, 400.0)
    ticks = sorted([*numbered, *between])
    assert (ticks[0], ticks[-1], len(ticks)) == (0.0, 2.0, 19)
    assert len(set(ticks)) == len(ticks)
