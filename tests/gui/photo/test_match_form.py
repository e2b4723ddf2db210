"""Form of a match: every choice of the model, known values, progress and cancelling."""

from dataclasses import replace
from pathlib import Path

import pytest
from gui.combo_box import choose
from gui.kinds import collect
from gui.photo.photo_bench import LiveView
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.values.choices import MatchChoice
from occ_model.photo.match import ESTIMATES, PATTERN_SOURCES
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match


def test_every_option_of_the_models_match_can_be_chosen(view: LiveView) -> None:
    sent = [view.form.sent.itemData(place) for place in range(view.form.sent.count())]
    estimates = [view.form.estimate.itemData(p) for p in range(view.form.estimate.count())]
    assert set(sent) == {*PATTERN_SOURCES, "lamp"}
    assert estimates == list(ESTIMATES)


def test_the_button_asks_for_a_match_as_it_is_chosen(view: LiveView, qtbot: QtBot) -> None:
    asked = collect(view.form.asked)
    qtbot.mouseClick(view.form.start, Qt.MouseButton.LeftButton)
    choose(qtbot, view.form.sent, "lamp")
    choose(qtbot, view.form.estimate, "switching_frequency")
    view.form.gamma.click()
    view.form.lamp.selectAll()
    qtbot.keyClicks(view.form.lamp, "1.5 kHz")
    qtbot.mouseClick(view.form.start, Qt.MouseButton.LeftButton)
    assert asked == [MatchChoice(), MatchChoice("lamp", 1500.0, "switching_frequency", True)]


def test_what_is_known_beside_the_estimate_is_shown(view: LiveView, qtbot: QtBot) -> None:
    view.change(scene=occ.Scene().replace(switching_frequency=7e3, readout_time=9e-6))
    frequency, readout = (view.form.known[n] for n in ("switching_frequency", "readout_time"))
    assert (frequency.text(), readout.isVisible()) == ("7 kHz", False)
    assert view.form.hint.text() == "chips or levels per second"
    for key in ("scene", "read", "auto", "lamp"):
        choose(qtbot, view.form.sent, key)
        assert view.form.lamp.isVisible() == (key == "lamp")
    lamp = view.form.known["lamp_frequency"]
    assert (lamp.text(), lamp.isVisible(), lamp.isEnabled()) == ("1 kHz", True, False)
    assert not frequency.isVisible()
    assert not view.form.hint.isVisible()
    choose(qtbot, view.form.estimate, "switching_frequency")
    assert (readout.text(), frequency.isVisible()) == ("9 µs", False)
    assert not view.form.hint.isVisible()


def test_choosing_a_lamp_confirms_its_frequency_until_another_choice(
    view: LiveView, qtbot: QtBot
) -> None:
    assert not view.form.certain.isChecked()
    choose(qtbot, view.form.sent, "lamp")
    assert view.choice.certain == {"lamp_frequency": 1e3}
    view.form.certain.click()
    assert not view.form.certain.isChecked()
    assert view.form.hint.text() == "1 kHz is only assumed: enter the frequency of your lamp."
    view.form.lamp.selectAll()
    qtbot.keyClicks(view.form.lamp, "1.5 kHz\r")
    assert view.form.certain.isChecked()
    assert not view.form.hint.isVisible()
    assert view.choice.certain == {"lamp_frequency": 1.5e3}
    choose(qtbot, view.form.sent, "auto")
    assert view.choice.certain == {}
    assert not view.form.certain.isChecked()


def test_a_match_of_outdated_inputs_is_marked(view: LiveView, match: Match) -> None:
    scene = occ.Scene().replace(switching_frequency=2e3)
    view.change(scene=scene)
    view.show_matched(match)
    for frequency, stale in ((2e3, False), (1e3, True), (2e3, False)):
        view.change(scene=scene.replace(switching_frequency=frequency, exposure_time=5e-5))
        assert view.result.warning.isVisible() == stale
    view.change(scene=scene.replace(switching_frequency=1e3))
    assert view.result.warning.text() == "Found with 2 kHz; the scene has 1 kHz now: match again."
    # A frequency that is certain for the photo does not depend on the scene's.
    view.confirm({"switching_frequency": 2e3})
    assert not view.result.warning.isVisible()
    view.confirm({"switching_frequency": 3e3})
    assert view.result.warning.isVisible()
    view.show_matched(replace(match, switching_frequency=1e3))
    assert not view.result.warning.isVisible()


def test_the_keyboard_stays_at_the_match_while_it_runs_and_after(
    view: LiveView, match: Match, qtbot: QtBot
) -> None:
    view.activateWindow()
    qtbot.waitActive(view)
    view.form.start.setFocus()
    view.show_running(True)
    assert view.form.cancel.hasFocus()
    view.show_matched(match)
    assert view.form.start.hasFocus()


def test_a_running_match_shows_progress_and_a_cancel_button(view: LiveView, qtbot: QtBot) -> None:
    form = view.form
    assert (form.start.isVisible(), form.progress.isVisible()) == (True, False)
    view.show_running(True)
    assert (form.start.isVisible(), form.progress.isVisible()) == (False, True)
    form.show_progress(0.25)
    assert form.progress.value() == form.progress.maximum() / 4
    with qtbot.waitSignal(form.cancelled):
        qtbot.mouseClick(form.cancel, Qt.MouseButton.LeftButton)
    view.show_running(False)
    assert (form.start.isVisible(), form.progress.isVisible()) == (True, False)


def test_a_known_value_is_certain_once_it_is_entered_or_ticked(
    view: LiveView, qtbot: QtBot
) -> None:
    view.change(scene=occ.Scene().replace(switching_frequency=7e3))
    assert not view.form.certain.isChecked()
    qtbot.mouseClick(view.form.certain, Qt.MouseButton.LeftButton)
    assert view.choice.certain == {"switching_frequency": 7e3}
    view.change(scene=occ.Scene().replace(switching_frequency=8e3))  # by a slider, say
    assert not view.form.certain.isChecked()
    field = view.form.known["switching_frequency"]
    field.selectAll()
    qtbot.keyClicks(field, "9 kHz\r")
    view.change(scene=occ.Scene().replace(switching_frequency=9e3))
    assert view.form.certain.isChecked()
    assert view.choice.certain == {"switching_frequency": 9e3}
    choose(qtbot, view.form.estimate, "switching_frequency")
    assert not view.form.certain.isChecked()
    choose(qtbot, view.form.estimate, "readout_time")
    qtbot.mouseClick(view.form.certain, Qt.MouseButton.LeftButton)
    assert view.choice.certain == {}


def test_a_refused_known_value_says_why_at_its_field_until_it_is_corrected(
    view: LiveView, qtbot: QtBot
) -> None:
    view.change(scene=occ.Scene())
    view.form.edited.connect(
        lambda name, value, _: view.change(scene=occ.Scene().replace(**{name: value}))
    )
    refused = collect(view.form.refused)
    fields = {"auto": view.form.known["switching_frequency"], "lamp": view.form.lamp}
    for sent, field in fields.items():
        choose(qtbot, view.form.sent, sent)
        shown, notice = field.text(), field.notice
        for text, sentence in (("0", "cannot be 0 Hz"), ("1,000 Hz", "thousands")):
            field.selectAll()
            qtbot.keyClicks(field, text)
            qtbot.keyClick(field, Qt.Key.Key_Return)
            assert notice.isVisible()
            assert sentence in notice.text()
            assert field.text() == shown
        with qtbot.waitSignal(view.form.accepted):
            field.selectAll()
            qtbot.keyClicks(field, "1,5 kHz")
            qtbot.keyClick(field, Qt.Key.Key_Return)
        assert field.value() == 1500.0
        assert not notice.isVisible()
    assert len(refused) == 4


@pytest.mark.parametrize("how", ["another photo", "several photos"])
def test_what_was_said_of_one_photo_is_not_assumed_of_the_next(
    view: LiveView, photo: Photo, qtbot: QtBot, how: str
) -> None:
    view.form.certain.click()
    view.form.match_lamp()
    others = [Path("b.png"), Path("c.png")]
    if how == "several photos":
        view.list_files(tuple(others))
    view.open(replace(photo, path=others[0]))
    assert (view.form.sent.key(), view.form.certain.isChecked()) == ("auto", False)
    assert not view.form.lamp.isVisible()
    assert "Only assumed here" in view.form.hint.text()
    choose(qtbot, view.form.sent, "lamp")
    assert view.form.certain.isChecked()
    view.form.certain.click()
    assert "only assumed: enter" in view.form.hint.text()  # it was certain for this one
    view.form.certain.click()
    assert "assumed" not in view.form.hint.text()
    view.open(replace(photo, path=others[1]))  # one table is of one lamp
    is_listed = how == "several photos"
    assert (view.form.sent.key(), view.form.certain.isChecked()) == (
        "lamp" if is_listed else "auto", is_listed,
    )  # fmt: skip
