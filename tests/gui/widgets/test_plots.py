"""Plots: their axes, curves and legends, and how far the wheel zooms them."""

import sys

import pyqtgraph as pg
import pytest
from gui.kinds import GreyPicture, add_widget
from gui.mouse import turn_wheel, views_of
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPalette, QPen
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.files.file_controller import sample_photos
from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.colours import SIMULATION, thin
from occ_gui.widgets.plot import LineLegend, Plot, Sample, new_plot


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


@pytest.fixture
def legend(qtbot: QtBot) -> LineLegend:
    legend = add_widget(qtbot, LineLegend())
    legend.add_line("solid", QPen(QColor("black")), "a solid line")
    legend.add_line("dashed", QPen(QColor("black"), 1, Qt.PenStyle.DashLine), "a dashed line")
    legend.show()
    return legend


def visible_texts(legend: LineLegend) -> list[str]:
    labels = legend.findChildren(QLabel)
    return [label.text() for label in labels if label.isVisible() and label.text()]


def test_an_entry_is_shown_or_hidden_by_its_key(legend: LineLegend) -> None:
    legend.show_line("solid", True)
    legend.show_line("dashed", False)
    assert visible_texts(legend) == ["a solid line"]
    legend.show_line("dashed", True)
    assert visible_texts(legend) == ["a solid line", "a dashed line"]


def test_samples_of_one_colour_differ_by_their_dashes(
    legend: LineLegend, grey_picture: GreyPicture
) -> None:
    for key in ("solid", "dashed"):
        legend.show_line(key, True)
    samples = legend.findChildren(Sample)
    solid, dashed = (int((grey_picture(sample) < 100).sum()) for sample in samples)
    assert 0 < dashed < solid


NOTCHES = 100
"""Each shows a third more, or less: as many as lead from any picture to the end."""

_MOST_TICKS = 300
"""Of an axis: what is drawn at every painting."""


def ticks(view: pg.GraphicsView) -> int:
    """Count what the axes of a plot would draw, without drawing it."""
    sides = ("left", "bottom") if isinstance(view, pg.PlotWidget) else ()
    axes = [view.getAxis(side) for side in sides]
    levels = [level for axis in axes for level in axis.tickValues(*axis.range, 600)]
    return sum(len(values) for _, values in levels)


def spans(box: pg.ViewBox) -> list[float]:
    return [high - low for low, high in box.viewRange()]


@pytest.mark.whole
def test_every_plot_of_the_window_has_an_end_to_its_zoom(
    application: Application, qtbot: QtBot
) -> None:
    application.open_photo(sample_photos()[0])
    for dock in application.window.docks.values():
        dock.show()
    application.window.actions_by_name["pin_a"].trigger()
    qtbot.waitUntil(
        lambda: application.is_idle and application.shell.pane("accuracy").study.is_idle
    )
    views = views_of(application.window)
    assert len(views) >= 9
    for view in views:
        box = view.getViewBox() if isinstance(view, pg.PlotWidget) else view.centralWidget
        first = box.viewRect()
        for towards in (-1, 1):
            box.setRange(first, padding=0.0)
            turn_wheel(view, towards * NOTCHES)
            reached = spans(box)
            turn_wheel(view, towards)
            # Looked at before anything is drawn: without an end, drawing would fill the memory.
            assert spans(box) == pytest.approx(reached)
            assert ticks(view) < _MOST_TICKS
            view.grab()
    QApplication.processEvents()


@given(
    middle=st.floats(-1e15, 1e15),
    span=st.floats(1e-9, 1e300),
    size=st.floats(0.0, 4000.0),
    side=st.sampled_from(["left", "bottom"]),
)
def test_an_axis_of_logarithms_has_no_more_ticks_than_pixels(
    qapp: QApplication, middle: float, span: float, size: float, side: str
) -> None:
    axis = LogAxis(side, least=-3)
    levels = axis.tickValues(middle - span / 2, middle + span / 2, size)
    assert sum(len(values) for _, values in levels) <= size + 20
    for spacing, values in levels:
        assert len(axis.tickStrings(values, 1.0, spacing)) == len(values)


def test_an_axis_that_cannot_be_numbered_stays_empty_with_a_note(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    monkeypatch.setattr(sys, "excepthook", lambda _kind, error, _trace: told.append(str(error)))

    def fail(*_range: float) -> None:
        raise OverflowError("too many decades")

    plot = add_widget(qtbot, new_plot("Test", "column", "level", QPalette()))
    for side in ("left", "bottom"):
        monkeypatch.setattr(plot.getAxis(side), "tickValues", fail)
    plot.grab()
    assert told == ["too many decades"] * 2
