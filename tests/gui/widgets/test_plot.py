"""A plot shows the name of its lower axis only if it is high enough."""

import pytest
from gui.kinds import add_widget
from PySide6.QtCore import QEvent
from PySide6.QtGui import QImage, QPainter, QPalette
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.widgets.pens import SIMULATION, thin
from occ_gui.widgets.plot import Plot, new_plot


@pytest.fixture
def plot(qtbot: QtBot) -> Plot:
    plot = new_plot("Test", "column", "level", QPalette())
    plot.setMinimumHeight(20)
    qtbot.addWidget(plot)
    plot.show()
    return plot


def is_named(plot: Plot) -> bool:
    return bool(plot.getAxis("bottom").label.isVisible())


def test_a_low_plot_leaves_the_name_out_and_each_one_where_it_is_not_wanted(plot: Plot) -> None:
    for height, named in ((200, True), (60, False), (100, True)):
        plot.resize(300, height)
        assert is_named(plot) == named
    plot.resize(300, 200)
    plot.name_bottom(False)
    assert not is_named(plot)
    for height in (60, 200):
        plot.resize(300, height)
        assert not is_named(plot)
    plot.name_bottom(True)
    assert is_named(plot)


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_a_curve_is_two_pixels_wide_on_every_screen(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, ratio: float
) -> None:
    plot = add_widget(qtbot, new_plot("name", "x", "y", QPalette()))
    curve = plot.add_curve(thin(SIMULATION))
    monkeypatch.setattr(plot, "devicePixelRatioF", lambda: ratio)
    QApplication.sendEvent(plot, QEvent(QEvent.Type.DevicePixelRatioChange))
    assert curve.opts["pen"].widthF() == 2.0 * ratio


@pytest.mark.parametrize("low", [0.0, 0.13, 0.31])
def test_numbers_stand_at_whole_pixels(plot: Plot, low: float) -> None:
    """Between two pixels, each version of Qt draws them otherwise."""
    plot.resize(301, 203)
    plot.setRange(xRange=(low, low + 7.0), yRange=(low, low + 7.0), padding=0.0)
    image = QImage(8, 8, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    for side in ("left", "bottom"):
        *_, numbers = plot.getAxis(side).generateDrawSpecs(painter)
        assert len(numbers) > 2
        assert all(box == box.toRect().toRectF() for box, *_ in numbers)
    painter.end()
