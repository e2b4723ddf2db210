"""Every plot can be zoomed as far as the wheel turns, and stays drawn in a moment."""

import sys

import pyqtgraph as pg
import pytest
from gui.kinds import add_widget
from gui.mouse import turn_wheel, views_of
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.files.file_controller import sample_photos
from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.plot import new_plot

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
