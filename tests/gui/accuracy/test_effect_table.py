"""The table states the error and time of each effect, and whether the plan includes it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from gui.kinds import SnapshotOf, add_widget, collect
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from pytestqt.qtbot import QtBot

from occ_gui.accuracy.effect_cells import find_levels, find_position
from occ_gui.accuracy.effect_rows import (
    EFFECT,
    ERROR,
    EVERYTHING_ELSE,
    STAGE,
    SWITCH,
    TIME,
    find_slowest,
    make_rows,
)
from occ_gui.accuracy.effect_table import EffectTable
from occ_gui.widgets.building import resize_font
from occ_model.results.accuracy import (
    EffectCrop,
    EffectDifference,
    Forecast,
    MeasuredCosts,
    TimeFractions,
)
from occ_model.results.frame import Frame

ROLE = Qt.ItemDataRole


@pytest.fixture
def frame(snapshot_of: SnapshotOf) -> Frame:
    """Simulate a scene with noise and LED edges and without anything else."""
    frame = snapshot_of(edge_time=5e-6).frame
    timings = {"exposure": 1e-3, "led-edges": 0.25e-3, "sensor-noise": 0.0302, "image": 2e-3}
    return replace(frame, timings=timings)


def costs_of(frame: Frame, **measured: EffectDifference) -> MeasuredCosts:
    differences = {name.replace("_", "-"): each for name, each in measured.items()}
    return MeasuredCosts(TimeFractions.of(frame), differences=differences)


def difference(effect: str, error: float) -> EffectDifference:
    grey = np.full((16, 40), 90, dtype=np.uint8)
    crop = EffectCrop(grey, grey + 5, grey, 4, is_averaged=False)
    return EffectDifference(effect, error, np.full(8, error), crop, crop)


@pytest.fixture
def table(qtbot: QtBot, frame: Frame) -> EffectTable:
    table = add_widget(qtbot, EffectTable())
    table.resize(640, 260)
    table.show_rows(make_rows(frame, costs_of(frame), switched=()))
    table.show()
    return table


def cell(table: EffectTable, effect: str, column: int, role: int = ROLE.DisplayRole) -> object:
    names = [row.effect for row in table.effects.rows]
    return table.effects.index(names.index(effect), column).data(role)


def test_every_effect_has_a_row_in_the_order_that_light_travels_and_times_add_up(
    table: EffectTable, frame: Frame
) -> None:
    rows = table.effects.rows
    assert [row.effect for row in rows[:-1]] == [d.effect for d in frame.plan.decisions]
    assert rows[-1].effect == EVERYTHING_ELSE
    texts = [table.effects.index(place, STAGE).data() for place in range(len(rows))]
    stages = [stage for stage in texts if stage]
    assert stages == ["Light", "Optics", "Sensor", "File"]
    assert cell(table, "led-edges", STAGE) == "Light"
    rows = make_rows(frame, costs_of(frame), switched=())
    total = sum(row.seconds for row in rows if row.seconds is not None)
    assert total == pytest.approx(sum(frame.timings.values()), rel=1e-12)
    assert rows[-1].seconds == pytest.approx(3e-3)


def test_a_row_states_error_time_and_reason_and_an_absent_effect_is_grey(
    table: EffectTable, frame: Frame
) -> None:
    (decision,) = [d for d in frame.plan.decisions if d.effect == "led-edges"]
    assert cell(table, "led-edges", ERROR) == f"≈ {decision.estimate:.2g}"
    assert cell(table, "led-edges", TIME) == "0.25"
    assert cell(table, "led-edges", EFFECT) == "● LED rise and fall"
    assert decision.reason in str(cell(table, "led-edges", EFFECT, ROLE.ToolTipRole))
    assert cell(table, "sensor-noise", TIME) == "30.2"
    assert cell(table, "fixed-pattern", TIME) == "with noise"
    cells = [cell(table, "jpeg", column) for column in (EFFECT, ERROR, TIME)]
    assert cells == ["○ JPEG", "none", ""]
    grey = cell(table, "jpeg", EFFECT, ROLE.ForegroundRole)
    assert isinstance(grey, QColor)
    assert cell(table, "led-edges", EFFECT, ROLE.ForegroundRole) is None


def test_a_measured_error_replaces_the_estimate(table: EffectTable, frame: Frame) -> None:
    (decision,) = [d for d in frame.plan.decisions if d.effect == "led-edges"]
    measured = costs_of(frame, led_edges=difference("led-edges", 0.71))
    table.show_rows(make_rows(frame, measured, switched=()))
    assert cell(table, "led-edges", ERROR) == "0.71"
    meaning = str(cell(table, "led-edges", ERROR, ROLE.ToolTipRole))
    assert "measured" in meaning
    assert f"{decision.estimate:.2g} levels were estimated" in meaning


def test_the_line_of_the_tolerance_is_dragged_along_the_axis_of_errors(
    table: EffectTable, qtbot: QtBot
) -> None:
    table.resize(900, 400)
    table.show()
    area = table.visualRect(table.effects.index(2, ERROR))
    tolerances = collect(table.tolerance_dragged)
    for levels in (0.1, 5.0, 80.0):
        at = QPoint(round(find_position(levels, area)), area.center().y())
        qtbot.mousePress(table.viewport(), Qt.MouseButton.LeftButton, pos=at)
        qtbot.mouseRelease(table.viewport(), Qt.MouseButton.LeftButton, pos=at)
        assert tolerances[-1] == pytest.approx(levels, rel=0.1)
    for place, levels in ((area.left() - 5, 0.0), (area.right() + 50, math.inf)):
        assert find_levels(place, area) == levels


def test_an_error_has_a_colour_only_beyond_the_tolerance(table: EffectTable) -> None:
    place = [row.effect for row in table.effects.rows].index("sensor-noise")
    area = table.visualRect(table.effects.index(place, ERROR))
    limit = table.effects.rows[place].limit
    for tolerance, has_colour in ((limit / 2.0, True), (2.0 * limit, False)):
        table.show_tolerance(tolerance)
        image = table.viewport().grab().toImage()
        end = image.pixelColor(round(find_position(limit, area)), area.center().y())
        assert (end.saturation() > 100, end.saturation() < 20) == (has_colour, not has_colour)


def test_pending_switches_are_shown_and_new_ones_tinted(table: EffectTable, frame: Frame) -> None:
    without = replace(
        frame.plan,
        decisions=tuple(
            replace(d, included=d.included and d.effect != "led-edges")
            for d in frame.plan.decisions
        ),
    )
    pending = Forecast(without, 0.01, 0.7, is_measured=False)
    table.show_rows(make_rows(frame, costs_of(frame), (), pending))
    assert cell(table, "led-edges", EFFECT) == "● → ○ LED rise and fall"
    assert cell(table, "led-edges", EFFECT, ROLE.BackgroundRole) is not None
    assert cell(table, "sensor-noise", EFFECT) == "● Shot and read noise"
    table.show_rows(make_rows(frame, costs_of(frame), switched=("sensor-noise",)))
    assert cell(table, "led-edges", EFFECT, ROLE.BackgroundRole) is None
    assert cell(table, "sensor-noise", EFFECT, ROLE.BackgroundRole) is not None


def test_rows_grow_with_the_text(table: EffectTable, qtbot: QtBot) -> None:
    low = table.rowHeight(0)
    table.setFont(resize_font(table.font(), 2.0))
    qtbot.waitUntil(lambda: table.rowHeight(0) > low)
    assert table.rowHeight(0) > table.fontMetrics().height()


def test_a_switch_reports_the_choice_for_its_effect_and_shows_forced_ones(
    table: EffectTable, qtbot: QtBot
) -> None:
    effects = [row.effect for row in table.effects.rows if row.effect != EVERYTHING_ELSE]
    assert list(table.switches) == effects
    choices: list[tuple[str, object]] = []
    table.switched.connect(lambda *choice: choices.append(choice))
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Home):
        qtbot.keyClick(table.switches["jpeg"], key)
    assert choices == [("jpeg", True), ("jpeg", False), ("jpeg", None)]
    choices.clear()
    table.show_force({"jpeg": True, "flicker": False})
    texts = {effect: switch.currentText() for effect, switch in table.switches.items()}
    assert {e: t for e, t in texts.items() if t != "plan"} == {"jpeg": "on", "flicker": "off"}
    table.show_force({})
    assert {switch.currentText() for switch in table.switches.values()} == {"plan"}
    assert choices == []


def test_the_first_effect_in_detail_is_the_slowest_within_the_scatter_of_times(
    frame: Frame,
) -> None:
    rows = make_rows(frame, costs_of(frame), switched=())
    assert find_slowest(rows) == "sensor-noise"
    slower = replace(frame, timings={**frame.timings, "led-edges": 0.05})
    assert find_slowest(make_rows(slower, costs_of(slower), switched=())) == "led-edges"
    assert find_slowest([row for row in rows if row.effect == EVERYTHING_ELSE]) == ""
    longer = replace(frame, timings={**frame.timings, "led-edges": 0.032})
    rows = make_rows(longer, costs_of(longer), switched=())
    assert find_slowest(rows) == "led-edges"
    assert find_slowest(rows, "sensor-noise") == "sensor-noise"


def click_on(table: EffectTable, column: int, qtbot: QtBot) -> list[str]:
    """Click on the title of a column; return the effects in their order."""
    header = table.horizontalHeader()
    place = QPoint(header.sectionViewportPosition(column) + 12, header.height() // 2)
    qtbot.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=place)
    return [row.effect for row in table.effects.rows]


def test_a_click_on_a_title_sorts_rows_and_switches(
    table: EffectTable, frame: Frame, qtbot: QtBot
) -> None:
    measured = {"sensor_noise": difference("sensor-noise", 3.0)}
    measured["led_edges"] = difference("led-edges", 7.0)
    table.show_rows(make_rows(frame, costs_of(frame, **measured), switched=()))
    light = [row.effect for row in table.effects.rows]
    table.choose("led-edges")
    for column, first in ((TIME, "sensor-noise"), (ERROR, "led-edges")):
        order = click_on(table, column, qtbot)
        assert order[0] == first, "the most comes first"
        assert order[-1] == EVERYTHING_ELSE
        place = order.index("led-edges")
        switch = table.indexWidget(table.effects.index(place, SWITCH))
        assert switch is table.switches["led-edges"]
        assert table.currentIndex().row() == place
        assert cell(table, "led-edges", STAGE) == "Light"
    order = click_on(table, ERROR, qtbot)
    assert order.index("sensor-noise") < order.index("led-edges"), "the least first"
    names = click_on(table, EFFECT, qtbot)[:-1]
    labels = {row.effect: row.label for row in table.effects.rows}
    assert names == sorted(names, key=lambda name: labels[name].casefold())
    assert click_on(table, STAGE, qtbot) == light


def test_only_a_row_that_has_changed_is_drawn_again_however_rows_are_sorted(
    table: EffectTable, frame: Frame, qtbot: QtBot
) -> None:
    names = click_on(table, EFFECT, qtbot)
    changed: list[str] = []
    table.effects.dataChanged.connect(lambda first, *_: changed.append(names[first.row()]))
    measured = costs_of(frame, led_edges=difference("led-edges", 0.71))
    table.show_rows(make_rows(frame, measured, switched=()))
    assert changed == ["led-edges"]


def test_repeated_measurements_do_not_shuffle_rows(
    table: EffectTable, frame: Frame, qtbot: QtBot
) -> None:
    def show(**seconds: float) -> list[str]:
        timings = {name.replace("_", "-"): time for name, time in seconds.items()}
        again = replace(frame, timings={**frame.timings, **timings})
        table.show_rows(make_rows(again, costs_of(again), switched=()))
        return [row.effect for row in table.effects.rows][:2]

    show(led_edges=0.030, sensor_noise=0.031)
    assert click_on(table, TIME, qtbot)[:2] == ["sensor-noise", "led-edges"]
    assert show(led_edges=0.033, sensor_noise=0.031) == ["sensor-noise", "led-edges"]
    assert show(led_edges=0.060, sensor_noise=0.031) == ["led-edges", "sensor-noise"]
    assert show(led_edges=0.031, sensor_noise=0.033) == ["led-edges", "sensor-noise"]


def test_the_time_of_an_effect_is_that_of_the_median_run() -> None:
    runs = [
        TimeFractions({"jpeg": jpeg, "defocus": defocus}, {"image": image}, {}, True)
        for jpeg, defocus, image in ((4.0, 1.0, 3.0), (2.0, 9.0, 4.0), (2.5, 1.5, 8.0))
    ]
    fractions = TimeFractions.of_runs(runs)
    assert (fractions.effects, fractions.stages) == ({"jpeg": 2.5, "defocus": 1.5}, {"image": 8.0})
    assert fractions.scatter == {"jpeg": 0.5, "defocus": 0.5}
    assert fractions.seconds == 12.0
    assert TimeFractions.of_runs(runs[:1]).scatter == {"jpeg": 0.0, "defocus": 0.0}
