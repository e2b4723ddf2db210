"""The table says what the plan does with each effect, and what that costs."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QComboBox
from pytestqt.qtbot import QtBot

from occ_gui.accuracy.effect_table import BOUND, DECISION, EFFECT, REASON, TIME, EffectTable
from occ_gui.simulation.snapshot import Snapshot
from occ_model.results import Frame

ROLE = Qt.ItemDataRole


@pytest.fixture
def frame(snapshot_of: Callable[..., Snapshot]) -> Frame:
    """Simulate a scene with noise and LED edges and without anything else."""
    frame = snapshot_of(edge_time=5e-6).frame
    return replace(frame, timings={"led-edges": 0.25e-3, "sensor-noise": 0.0302})


@pytest.fixture
def table(qtbot: QtBot, frame: Frame) -> EffectTable:
    table = EffectTable()
    qtbot.addWidget(table)
    table.show_frame(frame, new=())
    table.show()
    return table


def cell(table: EffectTable, effect: str, column: int, role: int = ROLE.DisplayRole) -> object:
    names = [row.effect for row in table.effects.rows]
    return table.effects.index(names.index(effect), column).data(role)


def test_every_effect_of_the_plan_has_a_row_in_its_order(table: EffectTable, frame: Frame) -> None:
    labels = [
        table.effects.index(place, EFFECT).data() for place in range(table.effects.rowCount())
    ]
    assert labels == [decision.label for decision in frame.plan.decisions]


def test_a_row_says_bound_decision_time_and_reason(table: EffectTable, frame: Frame) -> None:
    (decision,) = [d for d in frame.plan.decisions if d.effect == "led-edges"]
    assert cell(table, "led-edges", BOUND) == f"{decision.bound:.2g}"
    assert cell(table, "led-edges", DECISION) == "● in"
    assert cell(table, "led-edges", TIME) == "0.25"
    assert cell(table, "led-edges", REASON) == decision.why
    assert decision.reason in str(cell(table, "led-edges", DECISION, ROLE.ToolTipRole))
    assert cell(table, "sensor-noise", TIME) == "30.2"
    assert cell(table, "fixed-pattern", TIME) == "0"


def test_an_absent_effect_is_grey_excluded_and_costs_nothing(table: EffectTable) -> None:
    assert [cell(table, "jpeg", column) for column in (BOUND, DECISION, TIME)] == [
        "none", "○ out", "",
    ]  # fmt: skip
    grey = cell(table, "jpeg", EFFECT, ROLE.ForegroundRole)
    assert isinstance(grey, QColor)
    assert cell(table, "led-edges", EFFECT, ROLE.ForegroundRole) is None


def test_what_has_just_been_switched_is_tinted_and_called_new(
    table: EffectTable, frame: Frame
) -> None:
    table.show_frame(frame, new=("led-edges",))
    assert cell(table, "led-edges", DECISION) == "● in, new"
    assert cell(table, "led-edges", EFFECT, ROLE.BackgroundRole) is not None
    assert cell(table, "sensor-noise", EFFECT, ROLE.BackgroundRole) is None
    table.show_frame(frame, new=())
    assert cell(table, "led-edges", DECISION) == "● in"
    assert cell(table, "led-edges", EFFECT, ROLE.BackgroundRole) is None


def test_only_rows_that_differ_are_drawn_again(table: EffectTable, frame: Frame) -> None:
    drawn: list[int] = []
    table.effects.dataChanged.connect(lambda first, _: drawn.append(first.row()))
    switches = dict(table.switches)
    table.show_frame(frame, new=())
    assert drawn == []
    table.show_frame(replace(frame, timings={**frame.timings, "led-edges": 1e-3}), new=())
    assert drawn == [0]
    assert table.switches == switches


def test_each_row_has_a_switch_that_is_named_and_explained(table: EffectTable) -> None:
    assert set(table.switches) == {row.effect for row in table.effects.rows}
    for row in table.effects.rows:
        switch = table.switches[row.effect]
        assert isinstance(switch, QComboBox)
        assert row.texts[EFFECT] in switch.accessibleName()
        assert "auto" in switch.toolTip()


def test_a_switch_tells_what_is_wanted_of_its_effect(table: EffectTable, qtbot: QtBot) -> None:
    received: list[tuple[str, object]] = []
    table.switched.connect(lambda *what: received.append(what))
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Home):
        qtbot.keyClick(table.switches["jpeg"], key)
    assert received == [("jpeg", True), ("jpeg", False), ("jpeg", None)]


def test_switches_show_what_is_forced_and_tell_nothing(table: EffectTable) -> None:
    received: list[object] = []
    table.switched.connect(lambda *what: received.append(what))
    table.show_force({"jpeg": True, "flicker": False})
    shown = {effect: switch.currentText() for effect, switch in table.switches.items()}
    assert {e: t for e, t in shown.items() if t != "auto"} == {"jpeg": "on", "flicker": "off"}
    table.show_force({})
    assert {switch.currentText() for switch in table.switches.values()} == {"auto"}
    assert received == []


def test_a_row_out_of_sight_is_brought_into_view(table: EffectTable) -> None:
    table.resize(400, 80)
    table.bring_into_view(["jpeg"])
    last = table.effects.index(table.effects.rowCount() - 1, EFFECT)
    assert table.viewport().rect().intersects(table.visualRect(last))
