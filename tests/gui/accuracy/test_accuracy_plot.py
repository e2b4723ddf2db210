"""The plot shows the points as they come, and until then those before, faint."""

import math

import pytest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.accuracy.accuracy_plot import COLOURS, SYMBOLS, AccuracyPlot
from occ_gui.widgets.axes import LogAxis
from occ_model.results import ACCURACY_PARTS, LEAST_ERROR, AccuracyPoint

POINTS = (
    AccuracyPoint("integration", "1 sample", 1e-5, 50.0),
    AccuracyPoint("integration", "closed form", 1e-4, 1e-14, current=True),
    AccuracyPoint("effects", "paper's model", 1e-3, 15.0),
    AccuracyPoint("effects", "+ Vignetting", 1e-2, 1.0),
    AccuracyPoint("effects", "this plan", 1e-2, 0.5, current=True),
    AccuracyPoint("path", "profile path", 1e-4, 0.4),
    AccuracyPoint("noise", "reused plane", 2e-2, 0.01),
)


@pytest.fixture
def plot(qtbot: QtBot) -> AccuracyPlot:
    plot = AccuracyPlot()
    qtbot.addWidget(plot)
    plot.resize(500, 240)
    plot.show()
    return plot


def measure(plot: AccuracyPlot, points: tuple[AccuracyPoint, ...] = POINTS) -> None:
    plot.show_study_begun()
    for number, point in enumerate(points, 1):
        plot.show_point(point, number, len(POINTS))


def names(plot: AccuracyPlot) -> list[str]:
    return [p.name for scatter in plot.scatters.values() for p in scatter.data["data"]]


def test_each_point_is_at_its_time_and_error_with_its_marker(plot: AccuracyPlot) -> None:
    measure(plot)
    for part, scatter in plot.scatters.items():
        of_part = [point for point in POINTS if point.part == part]
        xs, ys = scatter.getData()
        assert [10**x for x in xs] == pytest.approx([1e3 * p.seconds for p in of_part])
        expected = [max(p.error, LEAST_ERROR) for p in of_part]
        assert [10**y for y in ys] == pytest.approx(expected)
    assert len(set(SYMBOLS.values())) == len({c.name() for c in COLOURS.values()}) == 4


def test_the_settings_at_hand_are_ringed(plot: AccuracyPlot) -> None:
    measure(plot)
    xs, ys = plot.rings.getData()
    assert [10**x for x in xs] == pytest.approx([0.1, 10.0])
    assert [10**y for y in ys] == pytest.approx([LEAST_ERROR, 0.5])


def test_all_points_are_in_view_and_progress_is_shown(plot: AccuracyPlot) -> None:
    measure(plot, POINTS[:3])
    assert plot.title.toolTip().endswith("measuring… 3 of 7")
    measure(plot)
    plot.show_study_finished()
    assert plot.title.toolTip().endswith(": measured")
    (left, right), (bottom, top) = plot.plot.getViewBox().viewRange()
    for point in POINTS:
        assert left < math.log10(1e3 * point.seconds) < right
        assert bottom < math.log10(max(point.error, LEAST_ERROR)) < top


def test_the_last_complete_points_stay_faint_until_new_ones_come(plot: AccuracyPlot) -> None:
    measure(plot)
    plot.show_study_finished()
    measure(plot, POINTS[:2])
    plot.show_study_outdated()
    assert plot.title.toolTip().endswith(": stopped")
    assert sorted(names(plot)) == sorted(point.name for point in POINTS)
    assert all(scatter.opacity() < 0.5 for scatter in plot.scatters.values())
    plot.show_study_begun()
    assert sorted(names(plot)) == sorted(point.name for point in POINTS)
    plot.show_point(POINTS[0], 1, 7)
    assert names(plot) == ["1 sample"]
    assert all(scatter.opacity() == 1.0 for scatter in plot.scatters.values())


def test_points_measured_before_the_scene_moved_are_called_so(plot: AccuracyPlot) -> None:
    measure(plot)
    plot.show_study_finished()
    plot.show_study_outdated()
    assert plot.title.toolTip().endswith(": of the previous scene")


def test_why_nothing_was_measured_is_shown(plot: AccuracyPlot) -> None:
    plot.show_study_begun()
    plot.show_study_failed("The panel is behind the camera.")
    assert plot.title.toolTip().endswith("The panel is behind the camera.")


def test_the_effects_steps_are_numbered_and_named_where_they_fit(
    plot: AccuracyPlot,
) -> None:
    measure(plot)
    assert plot.key.text() == "0  paper's model\n1  + Vignetting\n2  this plan"
    assert not plot.key.isVisible()
    plot.resize(900, 240)
    assert plot.key.isVisible()


def test_a_point_tells_its_name_time_and_error(plot: AccuracyPlot) -> None:
    measure(plot)
    tip = plot.scatters["path"].opts["tip"]
    assert tip(x=0.0, y=0.0, data=POINTS[5]) == "profile path: 0.1 ms, 0.4 levels"


def test_a_view_that_the_user_moved_stays_until_asked_to_fit(plot: AccuracyPlot) -> None:
    measure(plot, POINTS[:2])
    box = plot.plot.getViewBox()
    box.setRange(xRange=(0.0, 1.0), yRange=(0.0, 1.0), padding=0)
    box.sigRangeChangedManually.emit([True, True])
    plot.show_point(POINTS[2], 3, 7)
    assert box.viewRange() == [[0.0, 1.0], [0.0, 1.0]]
    plot._fit_button.click()
    assert box.viewRange()[1][0] < math.log10(LEAST_ERROR)


def test_the_legend_names_every_part_and_explains_it(plot: AccuracyPlot) -> None:
    texts = [label.text() for label in plot.legend.findChildren(QLabel) if label.text()]
    assert texts == ["exposure", "effects", "path", "noise", "now"]
    parents = [label.parentWidget() for label in plot.legend.findChildren(QLabel)]
    tips = {parent.toolTip() for parent in parents if parent is not None}
    assert set(ACCURACY_PARTS.values()) < tips


def test_a_logarithmic_axis_is_numbered_at_powers_of_ten(qtbot: QtBot) -> None:
    axis = LogAxis("left", least=-3)
    (_, numbered), (_, between) = axis.tickValues(-3.2, 1.2, 300.0)
    assert axis.tickStrings(numbered, 1.0, 1.0) == ["≤ 0.001", "0.01", "0.1", "1", "10"]
    assert set(axis.tickStrings(between, 1.0, 0.1)) == {""}
    assert all(-3.2 <= tick <= 1.2 for tick in between)
    (_, fewer), _ = axis.tickValues(-3.7, 1.7, 60.0)
    assert axis.tickStrings(fewer, 1.0, 1.0) == ["≤ 0.001", "0.1", "10"]
    (_, inside), _ = axis.tickValues(-3.01, 1.01, 300.0)  # those at the ends would be cut off
    assert axis.tickStrings(inside, 1.0, 1.0) == ["0.01", "0.1", "1"]
