"""The legend names every curve that is drawn, however narrow it is."""

import pytest
from pytestqt.qtbot import QtBot

from occ_gui.story.curve_legend import CurveLegend
from occ_gui.widgets.pens import BAND, SIMULATION, THRESHOLD, thin

KEYS = ("simulation", "band", "threshold")


@pytest.fixture
def legend(qtbot: QtBot) -> CurveLegend:
    pens = zip(KEYS, (SIMULATION, BAND, THRESHOLD), strict=True)
    legend = CurveLegend({key: (thin(pen), key) for key, pen in pens}, usual=KEYS)
    qtbot.addWidget(legend)
    return legend


@pytest.mark.parametrize("width", [60, 120, 250, 900])
def test_every_entry_lies_within_the_legend(legend: CurveLegend, width: int) -> None:
    legend.show_lines(KEYS, "no band model here")
    height = legend.heightForWidth(width)
    places = legend._placed(legend._widths(), width)
    line = legend.fontMetrics().height()
    for (left, row), entry in zip(places, legend._widths(), strict=True):
        assert left == 0 or left + entry <= width
        assert (row + 1) * line <= height
    assert len(set(places)) == len(places)


def test_a_wide_legend_is_one_line_and_keeps_its_height_when_a_curve_goes(
    legend: CurveLegend,
) -> None:
    legend.show_lines(KEYS)
    one = legend.fontMetrics().height() + 2
    assert legend.heightForWidth(900) == one
    heights = [legend.heightForWidth(width) for width in (120, 250, 400)]
    assert heights[0] > one
    legend.show_lines(KEYS[:1])
    assert [legend.heightForWidth(width) for width in (120, 250, 400)] == heights
