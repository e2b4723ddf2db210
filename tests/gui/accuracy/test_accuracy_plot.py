"""The plot shows points as they are measured, and until then those of earlier scenes, faded."""

import math
from itertools import pairwise

import numpy as np
import pytest
from gui.kinds import show_widget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.accuracy.accuracy_plot import COLOURS, SYMBOLS, AccuracyPlot
from occ_gui.accuracy.named_points import choose_points
from occ_gui.widgets.axes import NUMBER_LENGTH, LogAxis
from occ_model.effects.plan import effect_sets_of
from occ_model.results.accuracy import LEAST_ERROR, AccuracyPoint, Forecast
from occ_model.scene.scene import SimulationSettings

ALL = ("vignetting", "jpeg")
POINTS = (
    AccuracyPoint("integration", "1 sample", 1e-5, 50.0),
    AccuracyPoint("integration", "closed form", 1e-4, 1e-14),
    AccuracyPoint("effects", "paper's model", 1e-3, 15.0),
    AccuracyPoint("effects", "+ Vignetting", 1e-2, 1.0, effects=ALL[:1]),
    AccuracyPoint("effects", "+ JPEG", 3e-2, 0.0, effects=ALL),
    AccuracyPoint("effects", "this plan", 1e-2, 0.5, current=True, effects=ALL[1:]),
    AccuracyPoint("path", "profile path", 1e-4, 0.4),
    AccuracyPoint("draft", "draft 1/4", 3e-3, 0.3),
)
NAMED = [point for point in POINTS if point.name != "+ Vignetting"]


@pytest.fixture
def plot(qtbot: QtBot) -> AccuracyPlot:
    return show_widget(qtbot, AccuracyPlot(), 500, 240)


def measure(plot: AccuracyPlot, points: tuple[AccuracyPoint, ...] = POINTS) -> None:
    plot.show_study_begun()
    for number, point in enumerate(points, 1):
        plot.show_point(point, number, len(POINTS))


def names(plot: AccuracyPlot) -> list[str]:
    return [each.point.name for s in plot.scatters.values() for each in s.data["data"]]


def test_each_point_has_its_time_error_and_marker_and_the_present_one_a_ring(
    plot: AccuracyPlot,
) -> None:
    measure(plot)
    for part, scatter in plot.scatters.items():
        of_part = sorted(1e3 * point.seconds for point in NAMED if point.part == part)
        xs, ys = scatter.getData()
        assert sorted(10**x for x in xs) == pytest.approx(of_part)
        errors = sorted(max(p.error, LEAST_ERROR) for p in NAMED if p.part == part)
        assert sorted(10**y for y in ys) == pytest.approx(errors)
    assert len(set(SYMBOLS.values())) == len({c.name() for c in COLOURS.values()}) == 4
    xs, ys = plot.rings.getData()
    assert [10**x for x in xs] == pytest.approx([10.0])
    assert [10**y for y in ys] == pytest.approx([0.5])
    scatter = plot.scatters["path"]
    assert scatter.opts["tip"](x=0.0, y=0.0, data=scatter.data["data"][0]) == (
        "profile only: 0.1 ms, 0.4 levels\n(columns alone, whole pictures)"
    )


def test_all_points_are_in_view_and_progress_is_shown(plot: AccuracyPlot) -> None:
    measure(plot, POINTS[:3])
    assert plot.title.toolTip().endswith(f"measuring… 3 of {len(POINTS)}")
    measure(plot)
    plot.show_study_finished()
    assert plot.title.toolTip().endswith(": measured")
    (left, right), (bottom, top) = plot.plot.getViewBox().viewRange()
    for point in POINTS:
        assert left < math.log10(1e3 * point.seconds) < right
        assert bottom < math.log10(max(point.error, LEAST_ERROR)) < top


def test_the_last_complete_points_stay_faint_until_new_ones_come_as_the_title_says(
    plot: AccuracyPlot,
) -> None:
    measure(plot)
    plot.show_study_finished()
    measure(plot, POINTS[:2])
    plot.show_study_outdated()
    assert plot.title.toolTip().endswith(": stopped")
    assert sorted(names(plot)) == sorted(point.name for point in NAMED)
    assert all(scatter.opacity() < 0.5 for scatter in plot.scatters.values())
    plot.show_study_begun()
    assert sorted(names(plot)) == sorted(point.name for point in NAMED)
    plot.show_point(POINTS[0], 1, 7)
    assert names(plot) == ["1 sample"]
    assert all(scatter.opacity() == 1.0 for scatter in plot.scatters.values())
    measure(plot)
    plot.show_study_finished()
    plot.show_study_outdated()
    assert plot.title.toolTip().endswith(": of the previous scene")
    plot.show_study_failed("The panel is behind the camera.")
    assert plot.title.toolTip().endswith("The panel is behind the camera.")


def test_the_present_setting_is_one_point_even_where_it_has_no_effects() -> None:
    bare = AccuracyPoint("effects", "this plan", 1e-3, 15.0, current=True)
    points = [*POINTS[:5], bare]
    names = [each.name for each in choose_points(points) if each.point.part == "effects"]
    assert names == ["now: picture, no effects", "picture, all effects"]


def test_a_range_that_the_user_chose_stays_until_it_is_fitted(plot: AccuracyPlot) -> None:
    measure(plot, POINTS[:2])
    box = plot.plot.getViewBox()
    box.setRange(xRange=(0.0, 1.0), yRange=(0.0, 1.0), padding=0)
    box.sigRangeChangedManually.emit([True, True])
    plot.show_point(POINTS[2], 3, 7)
    assert box.viewRange() == [[0.0, 1.0], [0.0, 1.0]]
    plot.fit_button.click()
    assert box.viewRange()[1][0] < math.log10(LEAST_ERROR)


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


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (2.29, 2.99, ["400", "600", "800"]),  # the number at an end would be cut off
        (2.6, 2.7, ["420", "440", "460", "480"]),
        (1.7, 2.2, ["60", "80", "100", "120", "140"]),
    ],
)
def test_a_logarithmic_axis_within_a_power_of_ten_is_numbered_at_round_values(
    qtbot: QtBot, low: float, high: float, texts: list[str]
) -> None:
    axis = LogAxis("bottom")
    (_, numbered), _ = axis.tickValues(low, high, 400.0)
    assert axis.tickStrings(numbered, 1.0, 1.0) == texts
    pixels = [400.0 * (place - low) / (high - low) for place in numbered]
    assert min(after - before for before, after in pairwise(pixels)) >= NUMBER_LENGTH["bottom"]


def test_each_plan_is_a_cross_at_the_limit_of_its_error(plot: AccuracyPlot) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=200)
    effect_sets = effect_sets_of(scene, SimulationSettings())
    seconds = (None, *(1e-3 * (place + 1) for place in range(len(effect_sets) - 1)))
    plot.show_effect_sets(Forecast(occ.plan(scene), None, None, False, effect_sets, seconds))
    limits = [max(each.error, LEAST_ERROR) for each in effect_sets[1:] if each.error < math.inf]
    crosses = plot.front_points.points()
    assert [10.0 ** cross.pos().y() for cross in crosses] == pytest.approx(limits)
    assert all(" ms, at most " in cross.data() for cross in crosses)


def test_no_cross_is_beaten_in_time_and_error_except_the_present_plan(plot: AccuracyPlot) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=200)
    chosen, effect_sets = occ.plan(scene), effect_sets_of(scene, SimulationSettings())
    seconds = np.random.default_rng(5).uniform(0.01, 0.1, len(effect_sets)).tolist()
    plot.show_effect_sets(Forecast(chosen, None, None, False, effect_sets, tuple(seconds)))
    errors = [cross.pos().y() for cross in plot.front_points.points()]
    beaten = [error for error, before in zip(errors[1:], errors, strict=False) if error >= before]
    present = [ring.pos().y() for ring in plot.front_ring.points()]
    assert len(present) == 1
    assert set(beaten) <= set(present)
    assert 1 < len(errors) < len(effect_sets)
