"""Plots: their curves and axes."""

import sys

import pytest
from gui.kinds import add_widget, show_widget
from hypothesis import given, strategies as st
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.colours import SIMULATION, thin_pen
from occ_gui.widgets.plot import new_plot


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_a_curve_is_two_pixels_wide_on_every_screen(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, ratio: float
) -> None:
    plot = add_widget(qtbot, new_plot("name", "x", "y"))
    curve = plot.add_curve(thin_pen(SIMULATION))
    monkeypatch.setattr(plot, "devicePixelRatioF", lambda: ratio)
    QApplication.sendEvent(plot, QEvent(QEvent.Type.DevicePixelRatioChange))
    assert curve.opts["pen"].widthF() == 2.0 * ratio


@pytest.mark.parametrize(
    ("size", "is_whole"), [((360, 200), True), ((360, 86), False), ((150, 86), False)], ids=str
)
def test_the_name_of_an_axis_is_whole_or_shortened_by_dots_with_its_tip_and_never_cut_off(
    qtbot: QtBot, size: tuple[int, int], is_whole: bool
) -> None:
    names = {"left": "root mean square error", "bottom": "column of the region, from its left edge"}
    plot = show_widget(qtbot, new_plot("name", names["bottom"], names["left"]), *size)
    for _ in range(2):  # set anew in a plot of this size, too
        QApplication.processEvents()
        for side, name in names.items():
            label = plot.getAxis(side).label
            place = label.mapRectToScene(label.boundingRect())
            inside = plot.viewport().rect().toRectF().adjusted(-6, -6, 6, 6)  # margins of the text
            assert inside.contains(place)
            shown, tip = label.toPlainText().strip(), label.toolTip()
            assert (shown, tip) == (name, "") or (shown[:1] in {"…", ""} and tip == name)
            assert name.endswith(shown.removeprefix("…").strip())
            assert side != "left" or (shown == name) == is_whole
            plot.setLabel(side, name)


def test_the_numbers_of_an_axis_stand_as_they_are(qtbot: QtBot) -> None:
    plot = show_widget(qtbot, new_plot("name", "x", "light"), 360, 200)
    plot.setYRange(0.0, 0.8)
    QApplication.processEvents()
    axis = plot.getAxis("left")
    assert axis.label.toPlainText().strip() == "light"
    assert axis.autoSIPrefixScale == 1.0


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
    reported: list[str] = []
    monkeypatch.setattr(sys, "excepthook", lambda _kind, error, _trace: reported.append(str(error)))

    def fail(*_range: float) -> None:
        raise OverflowError("too many decades")

    plot = add_widget(qtbot, new_plot("Test", "column", "level"))
    for side in ("left", "bottom"):
        monkeypatch.setattr(plot.getAxis(side), "tickValues", fail)
    plot.grab()
    assert reported == ["too many decades"] * 2
