"""One move of a slider shows which effects are switched in or out, and their cost."""

import math

import pytest
from gui.kinds import collect
from gui.pane_bench import PaneBench
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.accuracy import pane
from occ_gui.accuracy.effect_rows import EffectRow
from occ_gui.accuracy.pane import AccuracyPane
from occ_gui.accuracy.plan_changes import PlanChanges
from occ_gui.app.panes import accuracy
from occ_model.effects.plan import plan_with
from occ_model.scene.scene import Scene


class Bench(PaneBench):
    """The pane in front, with the changes of the plan."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.plan_changes = PlanChanges()
        self.called_first.append(self.plan_changes.show_snapshot)
        self.plan_changes.changed.connect(self.results_store.show_switched)
        self.pane: AccuracyPane = self.add(accuracy(self.scenes, self.simulation))
        self.view = self.pane.view
        self.simulate()

    @property
    def summary(self) -> str:
        return f"{self.view.answer.line.text()} {self.view.answer.note.text()}"

    def row(self, effect: str) -> EffectRow:
        (row,) = [row for row in self.view.table.effects.rows if row.effect == effect]
        return row


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch) -> Bench:
    """Bring the pane to the front, and let no study begin."""
    monkeypatch.setattr(pane, "IDLE_MS", 3_600_000)
    return Bench(qtbot, small_scene)


def test_switched_effects_are_marked_for_a_while(bench: Bench, qtbot: QtBot) -> None:
    assert not bench.row("led-edges").included
    bench.simulate(edge_time=2e-6)
    edges = bench.row("led-edges")
    assert (edges.included, edges.is_new) == (True, True)
    assert "Switched in: LED rise and fall." in bench.summary
    bench.simulate(edge_time=2.1e-6)  # the mark stays while the slider moves
    assert bench.row("led-edges").is_new
    bench.simulate(edge_time=5e-6)
    bench.simulate(vignetting_exponent=4.0)
    assert not bench.row("led-edges").is_new
    assert bench.row("vignetting").is_new
    bench.simulate(edge_time=0.0)
    edges = bench.row("led-edges")
    assert (edges.included, edges.is_new) == (False, True)
    assert "Switched out: LED rise and fall." in bench.summary
    bench.simulate(edge_time=5e-6)
    assert bench.row("led-edges").is_new
    bench.plan_changes.mark_timer.setInterval(0)
    bench.plan_changes.mark_timer.start()
    qtbot.waitUntil(lambda: not bench.row("led-edges").is_new)
    assert "Switched" not in bench.summary


def test_each_mark_of_the_slider_has_a_plan_of_its_own(qtbot: QtBot, bench: Bench) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=300, columns=400)
    bench.scenes.put(scene, "scene")
    bench.simulate()
    slider = bench.view.tolerance.slider
    qtbot.waitUntil(lambda: slider.maximum() in range(6, 190))
    plans = []
    for position in range(slider.minimum(), slider.maximum() + 1):
        slider.setValue(position)
        plans.append(plan_with(scene, bench.settings.settings).included)
    assert len(set(plans)) == len(plans)


def test_effect_and_observable_are_chosen(qtbot: QtBot, bench: Bench) -> None:
    for _ in range(2):  # auto, on, off
        qtbot.keyClick(bench.view.table.switches["sensor-noise"], Qt.Key.Key_Down)
        bench.simulate()
    assert bench.settings.settings.force == {"sensor-noise": False}
    assert "switched off" in bench.row("sensor-noise").reason
    qtbot.keyClick(bench.view.table.switches["sensor-noise"], Qt.Key.Key_Home)
    qtbot.keyClick(bench.view.observable, Qt.Key.Key_Down)
    settings = bench.settings.settings
    assert (settings.force, settings.observable) == ({}, "profile")


def test_both_ends_of_the_slider_are_the_bare_model_and_the_exact_one(bench: Bench) -> None:
    slider, field = bench.view.tolerance.slider, bench.view.tolerance.field
    slider.setValue(slider.minimum())
    bench.simulate()
    assert bench.settings.settings.tolerance == math.inf
    assert field.lineEdit().text() == "∞ levels"
    assert not any(row.included for row in bench.view.table.effects.rows[:-1])
    slider.setValue(slider.maximum())
    bench.simulate()
    assert bench.settings.settings.tolerance == 0.0
    assert bench.row("sensor-noise").included


def test_the_next_plan_is_shown_before_its_picture(qtbot: QtBot, bench: Bench) -> None:
    slider = bench.view.tolerance.slider
    slider.setValue(slider.minimum())
    qtbot.waitUntil(lambda: "Switches out: " in bench.summary)
    assert bench.summary.startswith("A slider's next move: the picture in ")
    assert bench.row("sensor-noise").pending is False
    bench.simulate()
    qtbot.waitUntil(lambda: "Without effects: " in bench.summary or "Left out: " in bench.summary)
    assert bench.row("sensor-noise").pending is None


def test_a_selected_effect_has_its_error_and_the_time_is_the_sum_of_the_rows(
    bench: Bench,
) -> None:
    bench.view.table.choose("sensor-noise")
    detail = bench.view.detail
    assert detail.title.text() == "Shot and read noise"
    assert "Leaving it out" in detail.error.text()
    rows = bench.view.table.effects.rows
    total = sum(row.seconds for row in rows if row.seconds is not None and row.included)
    time = f"{1e3 * total:.0f}" if total >= 0.1 else f"{1e3 * total:.1f}"
    assert f"{time} ms" in bench.summary


def test_a_wrong_tolerance_is_refused_and_the_field_restored(qtbot: QtBot, bench: Bench) -> None:
    field = bench.view.tolerance.field
    field.selectAll()
    qtbot.keyClicks(field, "little")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    (sentence,) = bench.said
    assert sentence.startswith("Tolerance cannot be ")
    assert "allowed: from 0 levels" in sentence
    assert field.value() == bench.settings.settings.tolerance == 0.5
    assert field.lineEdit().text() == "0.5 levels"


def test_errors_of_a_decision_are_in_margins(qtbot: QtBot, bench: Bench) -> None:
    view = bench.view
    while bench.settings.settings.observable != "decision":
        qtbot.keyClick(view.observable, Qt.Key.Key_Down)
    bench.simulate()
    field = view.tolerance.field
    assert field.lineEdit().text().endswith(" margins")
    assert "margins" in view.plot.plot.getAxis("left").labelText
    assert "margins" in bench.row("sensor-noise").error_meaning
    assert "levels" not in bench.summary
    field.lineEdit().selectAll()
    qtbot.keyClicks(field, "0.25 margins\r")
    assert bench.settings.settings.tolerance == 0.25
    refusals = collect(view.tolerance.refused)
    field.lineEdit().selectAll()
    qtbot.keyClicks(field, "-1\r")
    assert refusals == ["Tolerance cannot be -1 margins; allowed: from 0 margins."]
    for control in (field, view.tolerance.slider):
        assert "levels" not in control.toolTip()
    while bench.settings.settings.observable != "image":
        qtbot.keyClick(view.observable, Qt.Key.Key_Up)
    bench.simulate()
    assert field.lineEdit().text() == "0.25 levels"
    assert "levels" in field.toolTip()


def test_an_unknown_error_has_no_number(bench: Bench) -> None:
    bench.simulate(luminance=0.5)
    row = bench.row("sensor-noise")
    assert (row.error_text, row.levels) == ("?", None)
    assert "not known" in row.error_meaning
