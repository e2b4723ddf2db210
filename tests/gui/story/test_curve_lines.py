"""The lines of a curve pass through all of its points, however few lines they are."""

from itertools import pairwise

import numpy as np
import pytest
from gui.kinds import add_widget
from pytestqt.qtbot import QtBot

from occ_gui.story.curve_legend import CurveLegend
from occ_gui.story.curve_lines import DASH, lines_of
from occ_gui.widgets.pens import BAND, SIMULATION, THRESHOLD, thin


@pytest.fixture
def stairs() -> tuple[np.ndarray, np.ndarray]:
    """Tops, slopes and noise, as profiles have them."""
    tops = np.repeat([20.0, 180.0, 180.0, 40.0], 25)
    slopes = np.interp(np.arange(100.0), np.arange(0.0, 101.0, 20.0), [5, 90, 10, 10, 200, 0])
    noise = np.random.default_rng(4).normal(100.0, 3.0, 50)
    ys = np.concatenate([tops, slopes, noise])
    return 96.0 + 1.7 * np.arange(len(ys)), ys


def test_every_point_lies_on_a_line(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    lines = lines_of(xs, ys)
    ends = [*(line.p1() for line in lines), lines[-1].p2()]
    drawn = np.interp(xs, [end.x() for end in ends], [end.y() for end in ends])
    np.testing.assert_allclose(drawn, ys, atol=1e-4)
    assert (ends[0].x(), ends[-1].x()) == (xs[0], xs[-1])
    assert all(one.p2() == other.p1() for one, other in pairwise(lines))


def test_a_straight_part_is_one_line(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    assert len(lines_of(xs[:100], ys[:100])) == 5  # three tops, and two edges between them
    assert len(lines_of(xs, 0.3 * xs - 2.0)) == 1


def test_dashes_cover_their_share_of_the_curve(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    solid, dashed = (
        sum(line.length() for line in lines) for lines in (lines_of(xs, ys), lines_of(xs, ys, DASH))
    )
    assert solid == pytest.approx(np.hypot(np.diff(xs), np.diff(ys)).sum())
    assert dashed / solid == pytest.approx(DASH[0] / sum(DASH), abs=0.02)
    for line in lines_of(xs, ys, DASH):
        middle = (line.x1() + line.x2()) / 2
        assert (line.y1() + line.y2()) / 2 == pytest.approx(np.interp(middle, xs, ys), abs=1e-4)


KEYS = ("simulation", "band", "threshold")


@pytest.fixture
def legend(qtbot: QtBot) -> CurveLegend:
    pens = zip(KEYS, (SIMULATION, BAND, THRESHOLD), strict=True)
    return add_widget(qtbot, CurveLegend({key: (thin(pen), key) for key, pen in pens}, usual=KEYS))


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
