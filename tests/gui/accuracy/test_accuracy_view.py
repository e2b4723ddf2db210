"""Within one move of a slider the user sees which effect came in, and what it costs."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from gui.user import User
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.accuracy import controller
from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.cost_measurement import SceneCosts
from occ_gui.accuracy.effect_rows import EffectRow
from occ_gui.app.application import Application
from occ_gui.simulation.snapshot import Snapshot
from occ_model.effects.plan import plan_with
from occ_model.results.effect_costs import Forecast


@pytest.fixture
def in_front(application: Application, monkeypatch: pytest.MonkeyPatch) -> Application:
    """Bring the pane to the front, and let no study begin."""
    monkeypatch.setattr(controller, "IDLE_MS", 3_600_000)
    application.window.bring_to_front("accuracy")
    return application


def row(application: Application, effect: str) -> EffectRow:
    (found,) = [
        row for row in application.view("accuracy").table.effects.rows if row.effect == effect
    ]
    return found


def choose(qtbot: QtBot, application: Application, effect: str, key: Qt.Key) -> None:
    qtbot.keyClick(application.view("accuracy").table.switches[effect], key)


def test_an_effect_included_by_a_slider_is_marked_with_its_cost(
    in_front: Application, user: User
) -> None:
    assert not row(in_front, "led-edges").included
    slider = user.slider("edge_time")
    slider.setValue(200)
    user.wait_until_idle()
    shown = row(in_front, "led-edges")
    assert (shown.included, shown.new) == (True, True)
    assert "Switched in: LED rise and fall." in in_front.view("accuracy").summary.toolTip()
    slider.setValue(205)  # the mark stays while the slider goes on
    user.wait_until_idle()
    assert row(in_front, "led-edges").new


def test_the_mark_goes_to_what_is_switched_next(in_front: Application, user: User) -> None:
    user.enter("edge_time", "5 us")
    user.enter("vignetting_exponent", "4")
    assert not row(in_front, "led-edges").new
    assert row(in_front, "vignetting").new
    user.enter("edge_time", "0")
    edges = row(in_front, "led-edges")
    assert (edges.included, edges.new) == (False, True)
    assert "Switched out: LED rise and fall." in in_front.view("accuracy").summary.toolTip()


@pytest.mark.own_window
def test_the_status_line_says_it_also_while_the_pane_is_behind(
    application: Application, user: User
) -> None:
    user.enter("edge_time", "5 us")
    assert (
        application.view("accuracy").table.effects.rows == ()
    )  # nothing is drawn that nobody sees
    tips = [label.toolTip() for label in application.window.statusBar().findChildren(QLabel)]
    assert any(tip.startswith("Switched in: LED rise and fall") for tip in tips)
    application.window.bring_to_front("accuracy")
    assert row(application, "led-edges").new


def test_what_was_switched_is_news_for_a_while_only(
    in_front: Application, user: User, qtbot: QtBot
) -> None:
    user.enter("edge_time", "5 us")
    assert row(in_front, "led-edges").new
    in_front.scene._news._forgetting.setInterval(0)
    in_front.scene._news._forgetting.start()
    qtbot.waitUntil(lambda: not row(in_front, "led-edges").new)
    assert "Switched" not in in_front.view("accuracy").summary.toolTip()
    tips = [label.toolTip() for label in in_front.window.statusBar().findChildren(QLabel)]
    assert not any(tip.startswith("Switched") for tip in tips)


def test_a_higher_tolerance_leaves_effects_out(
    qtbot: QtBot, in_front: Application, user: User
) -> None:
    assert row(in_front, "sensor-noise").included
    tolerance = in_front.view("accuracy").tolerance
    qtbot.waitUntil(lambda: bool(tolerance.marks))
    tolerance.slider.setValue(tolerance.slider.minimum() + 1)
    user.wait_until_idle()
    assert 10.0 < in_front.settings.settings.tolerance < math.inf
    assert not row(in_front, "sensor-noise").included


def test_each_mark_of_the_slider_has_a_plan_of_its_own(
    qtbot: QtBot, in_front: Application, user: User
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=300, columns=400)
    in_front.store.put(scene, "scene")
    user.wait_until_idle()
    slider = in_front.view("accuracy").tolerance.slider
    qtbot.waitUntil(lambda: slider.maximum() in range(6, 190))
    plans = []
    for position in range(slider.minimum(), slider.maximum() + 1):
        slider.setValue(position)
        plans.append(plan_with(scene, in_front.settings.settings).included)
    assert len(set(plans)) == len(plans)


def test_a_switch_forces_its_effect_and_the_picture_changes(
    qtbot: QtBot, in_front: Application, user: User
) -> None:
    pictures: list[Any] = []
    in_front.simulation.snapshot_shown.connect(lambda shown: pictures.append(shown.frame.image))
    for _ in range(2):  # auto, on, off
        choose(qtbot, in_front, "sensor-noise", Qt.Key.Key_Down)
        user.wait_until_idle()
    assert in_front.settings.settings.force == {"sensor-noise": False}
    assert "by hand" in row(in_front, "sensor-noise").reason
    choose(qtbot, in_front, "sensor-noise", Qt.Key.Key_Home)
    user.wait_until_idle()
    assert in_front.settings.settings.force == {}
    assert not np.array_equal(pictures[-2], pictures[-1])


def test_both_ends_of_the_slider_are_the_bare_model_and_the_exact_one(
    qtbot: QtBot, in_front: Application, user: User
) -> None:
    slider, field = (
        in_front.view("accuracy").tolerance.slider,
        in_front.view("accuracy").tolerance.field,
    )
    slider.setValue(slider.minimum())
    user.wait_until_idle()
    assert in_front.settings.settings.tolerance == math.inf
    assert field.lineEdit().text() == "∞ levels"
    assert not any(row.included for row in in_front.view("accuracy").table.effects.rows[:-1])
    slider.setValue(slider.maximum())
    user.wait_until_idle()
    assert in_front.settings.settings.tolerance == 0.0
    assert row(in_front, "sensor-noise").included


def test_a_move_of_the_slider_is_answered_before_the_picture_is(
    qtbot: QtBot, in_front: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    ask = in_front.simulation.runner.ask
    monkeypatch.setattr(in_front.simulation.runner, "ask", lambda _request: None)
    slider = in_front.view("accuracy").tolerance.slider
    slider.setValue(slider.minimum())
    summary = in_front.view("accuracy").summary
    qtbot.waitUntil(lambda: "Switches out: " in summary.toolTip())
    assert summary.toolTip().startswith("Next: ")
    assert row(in_front, "sensor-noise").pending is False
    ask(in_front.simulation.ages.present)
    qtbot.waitUntil(lambda: summary.toolTip().startswith("This picture: "))
    assert row(in_front, "sensor-noise").pending is None


def test_a_selected_effect_is_shown_with_the_plans_reason(
    in_front: Application, user: User
) -> None:
    in_front.view("accuracy").table.choose("sensor-noise")
    detail = in_front.view("accuracy").detail
    assert detail.title.text() == "Shot and read noise"
    assert "tolerance 0.5" in detail.reason.text()


def test_observable_and_noise_are_chosen(qtbot: QtBot, in_front: Application, user: User) -> None:
    for control in (in_front.view("accuracy").observable, in_front.view("accuracy").noise):
        qtbot.keyClick(control, Qt.Key.Key_Down)
    user.wait_until_idle()
    settings = in_front.settings.settings
    assert (settings.observable, settings.noise) == ("profile", "exact")


@pytest.mark.parametrize("text", ["-1", "little"])
def test_a_wrong_tolerance_is_refused_and_the_field_restored(
    qtbot: QtBot, in_front: Application, user: User, text: str
) -> None:
    field = in_front.view("accuracy").tolerance.field
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert user.message.startswith("Tolerance cannot be ")
    assert "allowed: from 0 levels" in user.message
    assert field.value() == in_front.settings.settings.tolerance == 0.5
    assert field.lineEdit().text() == "0.5 levels"


def test_the_stated_time_is_the_sum_of_the_rows(in_front: Application) -> None:
    assert in_front.view("accuracy").summary.toolTip().startswith("This picture: ")
    rows = in_front.view("accuracy").table.effects.rows
    total = sum(row.seconds for row in rows if row.seconds is not None and row.included)
    time = f"{1e3 * total:.0f}" if total >= 0.1 else f"{1e3 * total:.1f}"
    assert f"{time} ms" in in_front.view("accuracy").summary.toolTip()


def test_every_control_of_the_pane_has_a_name_and_a_tooltip(in_front: Application) -> None:
    pane = in_front.view("accuracy")
    controls = [pane.tolerance.slider, pane.tolerance.field, pane.observable, pane.noise]
    assert all(control.accessibleName() and control.toolTip() for control in controls)


def test_the_study_runs_in_front_and_ends_when_the_scene_changes(
    qtbot: QtBot, application: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(controller, "IDLE_MS", 1)
    title = application.view("accuracy").plot.title
    application.window.bring_to_front("accuracy")
    qtbot.waitUntil(lambda: " of " in title.toolTip())
    application.store.change(iso=200.0)
    assert title.toolTip().endswith("stopped")
    assert application.shell.pane("accuracy").study.runner.is_idle
    qtbot.waitUntil(lambda: title.toolTip().endswith(": measured"))
    qtbot.waitUntil(lambda: application.shell.pane("accuracy").study.is_idle)


def test_behind_another_pane_no_study_is_made(
    qtbot: QtBot, application: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(controller, "IDLE_MS", 1)
    application.window.bring_to_front("accuracy")
    qtbot.waitUntil(lambda: not application.shell.pane("accuracy").study.runner.is_idle)
    application.window.modes.switch("explore")
    qtbot.waitUntil(lambda: application.shell.pane("accuracy").study.is_idle)
    application.store.change(iso=200.0)
    qtbot.waitUntil(lambda: application.is_idle)
    qtbot.wait(50)
    assert application.shell.pane("accuracy").study.is_idle
    assert application.shell.pane("accuracy").study.runner.is_idle


def test_nothing_is_drawn_of_a_pane_that_is_not_seen(
    qtbot: QtBot, snapshot_of: Callable[..., Snapshot]
) -> None:
    view = AccuracyView()
    qtbot.addWidget(view)
    snapshot = snapshot_of()
    view.show_snapshot(snapshot)
    view.show_costs(SceneCosts(snapshot.request))
    view.show_forecast(snapshot.request, Forecast(snapshot.frame.plan, 0.1, 0.0, is_measured=True))
    assert not view.summary._full
    view.set_seen(True)
    assert view.summary._full
    assert view.table.model().rowCount() > 3
