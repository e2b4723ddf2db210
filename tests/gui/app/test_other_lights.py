"""A window whose scene sends no code speaks of lamps and periods, and reads nothing."""

import re
from typing import Any

import pytest
from gui.user import User
from gui.visible_texts import visible_texts
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.scene.control_panel import main_of
from occ_gui.values.modes import MODES
from occ_model.scene.light_words import describe_light

LIGHTS: dict[str, dict[str, Any]] = {
    "lamp": {"light": "lamp", "lamp_frequency": 1700.0, "duty": 0.3},
    "mains": {"light": "mains", "exposure_time": 2e-3, "iso": 50.0},
    "waveform": {"light": "waveform", "levels": "0 1 2 1 / 2"},
    "recorded": {"light": "waveform", "waveform_file": "0,1\n1e-4,0.2\n7e-4,0\n8e-4\n"},
    "pulses": {"light": "pulses", "pulse_frequency": 900.0, "pulse_length": 2e-4},
}

OF_CODES = re.compile(r"\b(chips?|bits?|headers?|packets?|raw pattern)\b", re.IGNORECASE)
_PANES = ("decode", "profile", "equations", "spectrum", "compare", "bands", "bench")


@pytest.mark.parametrize("light", LIGHTS)
def test_no_visible_text_of_any_pane_speaks_of_chips(
    application: Application, user: User, light: str
) -> None:
    window, store = application.window, application.scene_store
    user.put(store.scene.replace(**LIGHTS[light]), "light")
    for mode in (mode for mode in MODES if mode not in ("photo", "lessons")):
        user.switch(mode)
        _check_texts(application)
    window.modes.switch("explore")
    for pane in _PANES:
        user.bring_to_front(pane)
        _check_texts(application)
        window.hide_pane(pane)
    rows = application.story.rows
    assert OF_CODES.search(rows.light.describe_sent()) is None
    assert not rows.code.isVisible()
    results = application.results_store.results
    assert results.failure is None
    assert results.snapshot.results == {}
    assert application.background_rates.is_idle
    assert not any(strip.isVisible() for strip in application.slider_strips.strips.values())


def _check_texts(application: Application) -> None:
    texts = set(visible_texts(application.window))
    assert {text for text in texts if OF_CODES.search(text)} == set()


def test_the_verdict_names_the_lamp_its_bars_and_its_ratio(
    application: Application, user: User
) -> None:
    store, verdict = application.scene_store, application.story.verdict
    lamp = {"lamp_frequency": 2500.0, "duty": 0.3, "exposure_time": 120e-6, "readout_time": 8e-6}
    user.put(store.scene.replace(light="lamp", **lamp), "lamp")
    assert verdict.heading.startswith("Lamp of 2.5 kHz, duty 30 %: 50 columns from bar to bar")
    assert "t / period = 0.3" in {badge.text for badge in verdict.badges.badges}
    user.change(exposure_time=4e-4)
    assert verdict.heading == "Lamp of 2.5 kHz, duty 30 %: no bars"
    user.put(store.scene.replace(light="code", pattern="1000"), "pattern of a pulse")
    assert verdict.heading.startswith("Lamp of 2.5 kHz, duty 25 %: no bars")


def test_the_light_is_chosen_at_the_top_and_undone(
    application: Application, user: User, qtbot: QtBot
) -> None:
    controls, entries = application.controls, application.window.actions_by_name
    field: Any = getattr(controls.light, "field")  # noqa: B009 - the choice's own
    qtbot.keyClick(field, Qt.Key.Key_Down)
    user.wait_until_idle()
    assert application.scene_store.scene.transmitter.light == "lamp"
    shown = [name for name, row in controls.panels["Main"].rows.items() if row.isVisible()]
    assert tuple(shown) == main_of("lamp")
    assert not controls.code.isVisible()
    assert not entries["slider_strips"].isEnabled()
    user.enter("lamp_frequency", "239 Hz")
    assert describe_light(application.scene_store.scene.transmitter).startswith("lamp of 239 Hz")
    user.enter("lamp_frequency", "0 Hz")
    assert "Lamp frequency cannot be 0 Hz" in user.row("lamp_frequency").notice.text()
    entries["undo"].trigger()
    entries["undo"].trigger()
    user.wait_until_idle()
    assert field.currentText() == "code"
    assert controls.code.isVisible()
    assert entries["slider_strips"].isEnabled()


def test_what_the_tolerance_limits_is_no_decision_of_a_lamp(
    application: Application, user: User
) -> None:
    store = application.scene_store
    store.settings.set_observable("decision")
    user.change(light="lamp")
    assert store.settings.settings.observable == "signal"
    user.switch("effects")
    choice = application.shell.pane("accuracy").view.observable
    entry = choice.model().item(choice.findData("decision"))
    assert not entry.isEnabled()
    user.change(light="code")
    assert entry.isEnabled()
    assert application.results_store.results.failure is None


def test_figures_of_codes_are_away_while_a_lamp_is_sent(
    application: Application, user: User
) -> None:
    entries = application.window.actions_by_name
    of_codes = ["export_map", "export_bench", "export_decoding-matched"]
    for light in ("lamp", "code"):
        user.change(light=light)
        assert {entries[name].isEnabled() for name in of_codes} == {light == "code"}
        names = {figure.name for figure in application.shell.different_figures}
        assert ("map" in names) == (light == "code")
        assert "profile" in names


def test_the_limits_of_a_lamp_are_its_bars(application: Application, user: User) -> None:
    window = application.window
    user.switch("limits")
    bars, detection = (window.docks[name].widget() for name in ("bands", "map"))
    assert detection.visibleRegion().boundingRect().isValid()
    user.change(light="lamp")
    assert bars.visibleRegion().boundingRect().isValid()
    assert not detection.visibleRegion().boundingRect().isValid()
