"""All about the open photo: what it is, what is asked of a match, and what that found."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.match_choice import MatchChoice
from occ_gui.photo.match_form import SQUARE_FREQUENCY
from occ_gui.photo.match_result import with_uncertainty
from occ_gui.photo.photo_view import PhotoView
from occ_gui.picture.placement import Placement
from occ_model.photo.match import ESTIMATES, PATTERN_SOURCES
from occ_model.photo.reading.load import CHANNELS, SCAN_AXES, Photo
from occ_model.results import Match, Region, Stripes
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS

READOUT = PARAMETERS["readout_time"]


@pytest.fixture
def view(qtbot: QtBot) -> PhotoView:
    view = PhotoView()
    qtbot.addWidget(view)
    view.resize(380, 500)
    view.show()
    view.show_scene(occ.Scene())
    return view


@pytest.fixture
def match() -> Match:
    profile = np.array([10.0, 20.0, 30.0])
    stripes = Stripes(Region(0, 9, 0, 3), profile, profile, profile + 1, 2.0, 0.1, 0.125)
    return Match(
        scene=occ.Scene(), stripes=stripes, readout_time=14.5777e-6, switching_frequency=2e3,
        exposure_time=62.5e-6, start_time=1e-4, gamma=2.22,
        uncertainties={"readout_time": 2.7e-10, "exposure_time": 2.1e-7, "start_time": 3e-7},
        pattern="1001", pattern_was_read=True, profile=profile + 2.0, correlation=0.99123,
    )  # fmt: skip


def choose(qtbot: QtBot, control: Any, key: str) -> None:
    """Choose a word with the keys."""
    control.setFocus()
    qtbot.keyClick(control, Qt.Key.Key_Home)
    for _ in range(control.findData(key)):
        qtbot.keyClick(control, Qt.Key.Key_Down)
    assert control.key() == key


def test_without_a_photo_there_is_a_way_to_open_one(view: PhotoView, qtbot: QtBot) -> None:
    assert not view.form.isVisible()
    (button,) = [b for b in view.findChildren(type(view.form.start)) if b.isVisible()]
    with qtbot.waitSignal(view.open_asked):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_what_is_known_of_a_photo_is_shown_with_its_units(view: PhotoView, photo: Photo) -> None:
    noted = replace(
        photo,
        exposure_time=1 / 8000,
        iso=12800.0,
        f_number=1.8,
        camera="Maker Model 5",
        turned=True,
    )
    view.show_photo(noted)
    facts = view.facts
    assert facts.name.toolTip().endswith("stripes.png")
    assert facts.size_line.toolTip() == "Maker Model 5, 60 x 100 px, grey, turned"
    assert facts.notes.toolTip() == "125 µs, ISO 12800, f/1.8"
    assert facts.use_settings.isEnabled()


def test_a_photo_without_notes_offers_none(view: PhotoView, photo: Photo) -> None:
    view.show_photo(photo)
    assert view.facts.size_line.toolTip() == "100 x 60 px, grey"
    assert not view.facts.use_settings.isEnabled()


def test_using_the_photos_settings_is_told(view: PhotoView, photo: Photo, qtbot: QtBot) -> None:
    view.show_photo(replace(photo, iso=400.0))
    with qtbot.waitSignal(view.facts.settings_asked):
        qtbot.mouseClick(view.facts.use_settings, Qt.MouseButton.LeftButton)


def test_every_channel_and_scan_axis_of_the_model_can_be_chosen(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    received: list[str] = []
    view.facts.channel_chosen.connect(received.append)
    view.facts.scan_axis_chosen.connect(received.append)
    choices = ((view.facts.channel, CHANNELS), (view.facts.scan_axis, SCAN_AXES))
    for control, keys in choices:
        assert [control.itemData(place) for place in range(control.count())] == list(keys)
        choose(qtbot, control, keys[1])
    assert received == [CHANNELS[1], SCAN_AXES[1]]
    view.facts.show_reading("red", "lines")
    assert (view.facts.channel.key(), view.facts.scan_axis.key()) == ("red", "lines")
    assert len(received) == 2


def test_everything_that_the_model_can_be_asked_for_can_be_chosen(view: PhotoView) -> None:
    sent = [view.form.sent.itemData(place) for place in range(view.form.sent.count())]
    estimates = [view.form.estimate.itemData(p) for p in range(view.form.estimate.count())]
    assert set(sent) == {*PATTERN_SOURCES, "square"}
    assert estimates == list(ESTIMATES)


def test_the_button_asks_for_a_match_as_it_is_chosen(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    asked: list[MatchChoice] = []
    view.form.asked.connect(asked.append)
    qtbot.mouseClick(view.form.start, Qt.MouseButton.LeftButton)
    choose(qtbot, view.form.sent, "square")
    choose(qtbot, view.form.estimate, "switching_frequency")
    view.form.gamma.click()
    view.form.square.selectAll()
    qtbot.keyClicks(view.form.square, "1.5 kHz")
    qtbot.mouseClick(view.form.start, Qt.MouseButton.LeftButton)
    assert asked == [MatchChoice(), MatchChoice("square", 1500.0, "switching_frequency", True)]


def test_a_frequency_is_asked_for_where_a_square_wave_was_sent_and_nowhere_else(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    for key in ("scene", "square", "read", "auto"):
        choose(qtbot, view.form.sent, key)
        assert view.form.square.isVisible() == (key == "square")


def test_what_is_known_beside_the_estimate_is_told(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.show_scene(occ.Scene().replace(switching_frequency=7e3, readout_time=9e-6))
    frequency, readout = (view.form.known[n] for n in ("switching_frequency", "readout_time"))
    assert (frequency.text(), readout.isVisible()) == ("7 kHz", False)
    assert view.form.hint.toolTip() == "chips: a blinking LED of 3.5 kHz"
    choose(qtbot, view.form.sent, "square")
    assert (frequency.text(), frequency.isEnabled()) == ("2 kHz", False)
    assert view.form.hint.toolTip() == "chips: a blinking LED of 1 kHz"
    choose(qtbot, view.form.estimate, "switching_frequency")
    assert (readout.text(), frequency.isVisible(), view.form.hint.text()) == ("9 µs", False, "")


def test_what_is_known_can_be_entered_where_it_is_asked_for(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.show_scene(occ.Scene())
    received: list[tuple[str, float]] = []
    view.form.edited.connect(lambda name, value, _: received.append((name, value)))
    for name, typed in (("switching_frequency", "2kHz"), ("readout_time", "9us")):
        field = view.form.known[name]
        field.selectAll()
        qtbot.keyClicks(field, typed)
        qtbot.mouseClick(view.form.start, Qt.MouseButton.LeftButton)
        choose(qtbot, view.form.estimate, "switching_frequency")
    assert received == [("switching_frequency", 2e3), ("readout_time", pytest.approx(9e-6))]


def test_a_match_of_what_is_no_longer_known_is_told_from_one_that_is(
    view: PhotoView, photo: Photo, match: Match
) -> None:
    view.show_photo(photo)
    scene = occ.Scene().replace(switching_frequency=2e3)
    view.show_scene(scene)
    view.show_match(match)
    for frequency, stale in ((2e3, False), (1e3, True), (2e3, False)):
        view.show_scene(scene.replace(switching_frequency=frequency, exposure_time=5e-5))
        assert view.result.stale.isVisible() == stale
    view.show_scene(scene.replace(switching_frequency=1e3))
    assert view.result.stale.text() == "Found with 2 kHz; the scene has 1 kHz now: match again."
    view.show_match(replace(match, switching_frequency=1e3))
    assert not view.result.stale.isVisible()


def test_the_keyboard_stays_at_the_match_while_it_runs_and_after(
    view: PhotoView, photo: Photo, match: Match, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.activateWindow()
    qtbot.waitActive(view)
    view.form.start.setFocus()
    view.show_match_begun()
    assert view.form.cancel.hasFocus()
    view.show_match(match)
    assert view.form.start.hasFocus()


def test_a_frequency_that_cannot_be_is_refused_and_the_last_one_stays(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    choose(qtbot, view.form.sent, "square")
    view.form.square.selectAll()
    qtbot.keyClicks(view.form.square, "fast")
    with qtbot.waitSignal(view.form.refused):
        qtbot.keyClick(view.form.square, Qt.Key.Key_Return)
    assert view.form.choice().square_frequency == SQUARE_FREQUENCY.default


def test_while_a_match_runs_its_progress_and_a_way_out_take_the_buttons_place(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    form = view.form
    assert (form.start.isVisible(), form.progress.isVisible()) == (True, False)
    view.show_match_begun()
    assert (form.start.isVisible(), form.progress.isVisible()) == (False, True)
    view.show_progress(0.25)
    assert form.progress.value() == form.progress.maximum() / 4
    with qtbot.waitSignal(form.cancelled):
        qtbot.mouseClick(form.cancel, Qt.MouseButton.LeftButton)
    view.show_match_cancelled()
    assert (form.start.isVisible(), form.progress.isVisible()) == (True, False)


def test_what_was_found_stands_with_its_uncertainty_in_the_units_of_the_screen(
    view: PhotoView, photo: Photo, match: Match
) -> None:
    view.show_photo(photo)
    view.show_match(match)
    texts = {name: label.text() for name, label in view.result.values.items()}
    assert texts["readout_time"] == "14.57770 ± 0.00027 µs"
    assert texts["exposure_time"] == "62.50 ± 0.21 µs"
    assert texts["switching_frequency"] == "2 kHz (given)"
    assert texts["chip"] == f"{1 / (2e3 * 14.5777e-6):.3f} columns, 4 chips a period"
    assert texts["correlation"] == "0.9912, RMSE 2.00 grey levels"
    assert texts["saturated"].startswith("12.5 %")
    assert view.result.values["pattern"].toolTip() == "1001 (read)"


def test_a_blinking_led_is_told_by_its_cycles_too(
    view: PhotoView, photo: Photo, match: Match
) -> None:
    view.show_photo(photo)
    view.show_match(replace(match, pattern="10"))
    text = view.result.values["switching_frequency"].text()
    assert text == "2 kHz (given): blinks at 1 kHz"


def test_what_was_not_estimated_is_not_shown(view: PhotoView, photo: Photo, match: Match) -> None:
    view.show_photo(photo)
    with_gamma = replace(match, uncertainties={"gamma": 0.05}, other_exposures=(1e-3, 2e-3))
    for found, there in ((match, False), (with_gamma, True)):
        view.show_match(found)
        titles = [label.text() for label in view.result.findChildren(QLabel) if label.isVisible()]
        assert ("Gamma" in titles) == there
        assert ("1 ms or 2 ms" in titles) == there


@pytest.mark.parametrize(
    ("value", "spread", "text"),
    [
        (14.5777e-6, 2.7e-10, "14.57770 ± 0.00027 µs"),
        (14.5777e-6, 3e-6, "14.6 ± 3.0 µs"),
        (14.5777e-6, 40e-6, "15 ± 40 µs"),
        (0.0, 1e-7, "0.00000010 s"),
        (8e-6, None, "8 µs"),
        (8e-6, float("nan"), "8 µs"),
        (8e-6, float("inf"), "8 µs"),
        (8e-6, 0.0, "8 µs"),
        (8e-6, 1e-30, "8.000000000000 ± 0.000000000000 µs"),
    ],
)
def test_a_value_is_written_as_far_as_its_uncertainty_leaves_it_sure(
    value: float, spread: float | None, text: str
) -> None:
    assert isinstance(READOUT, Quantity)
    assert text in with_uncertainty(READOUT, value, spread)


def test_a_failure_is_a_sentence_and_what_was_found_before_stays(
    view: PhotoView, photo: Photo, match: Match
) -> None:
    view.show_photo(photo)
    view.show_match(match)
    view.show_match_begun()
    view.show_match_failed("No scene explains these stripes.")
    assert view.failure.text() == "No scene explains these stripes."
    assert view.failure.isVisible()
    assert view.result.isVisible()
    assert view.form.start.isVisible()
    view.show_match_begun()
    assert not view.failure.isVisible()
    view.show_match(match)
    assert not view.failure.isVisible()


def test_without_a_match_there_is_nothing_to_apply(
    view: PhotoView, photo: Photo, match: Match, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.show_match(match)
    for button, signal in (
        (view.result.apply, view.result.apply_asked),
        (view.result.save, view.result.save_asked),
    ):
        with qtbot.waitSignal(signal):
            qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    view.show_match(None)
    assert not view.result.isVisible()


def test_the_fields_show_where_the_photo_lies_and_tell_nothing(
    view: PhotoView, photo: Photo
) -> None:
    received: list[Placement] = []
    view.placement.placed.connect(received.append)
    view.show_photo(photo)
    view.show_placement(Placement(862.237, 3.5, 1.25), by_hand=True)
    form = view.placement
    assert (form.column.value(), form.row.value(), form.scale.value()) == (862.24, 3.5, 1.25)
    assert form.reset.isEnabled()
    assert received == []
    view.show_placement(Placement(), by_hand=False)
    assert not form.reset.isEnabled()


def test_a_field_that_is_changed_moves_the_photo_and_leaves_the_others_digits(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    received: list[Placement] = []
    view.placement.placed.connect(received.append)
    view.show_photo(photo)
    view.show_placement(Placement(862.237123, 3.5, 1.0), by_hand=False)
    field = view.placement.row
    field.selectAll()
    qtbot.keyClicks(field, "10")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert received == [Placement(862.237123, 10.0, 1.0)]


def test_moving_by_mouse_and_resetting_are_told(
    view: PhotoView, photo: Photo, qtbot: QtBot
) -> None:
    view.show_photo(photo)
    view.show_placement(Placement(), by_hand=True)
    with qtbot.waitSignal(view.placement.moving_chosen) as moving:
        qtbot.mouseClick(view.placement.by_mouse, Qt.MouseButton.LeftButton)
    assert moving.args == [True]
    with qtbot.waitSignal(view.placement.reset_asked):
        qtbot.mouseClick(view.placement.reset, Qt.MouseButton.LeftButton)
