"""The verdict on the photo, which is independent of the verdict on the simulation."""

from dataclasses import replace

import pytest
from gui.kinds import collect
from gui.photo.photo_bench import LiveView
from matches import match_of_lamp
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.photo.photo_verdict import PhotoVerdictBar, photo_caption
from occ_gui.widgets.state_look import State
from occ_model.photo.reading.load import Photo
from occ_model.results.match import PLAIN_STRIPES, Match
from occ_model.results.photo_table import PhotoRow

REASONS = ("Only 2 periods of 24 chips are in view.", "The correlation is 0.85.")


@pytest.fixture
def bar(view: LiveView) -> PhotoVerdictBar:
    view.verdict.resize(1400, 60)
    return view.verdict


def test_each_step_on_the_way_to_a_match_has_a_verdict(
    view: LiveView, bar: PhotoVerdictBar, photo: Photo, match: Match
) -> None:
    view.open(None)
    assert (bar.state, bar.heading) == (State.NEUTRAL, "No photo is open")
    view.open(photo)
    assert (bar.state, bar.heading) == (State.NEUTRAL, "Photo: no match yet")
    view.show_running(True)
    assert (bar.state, bar.heading) == (State.WAITING, "Photo: matching…")
    view.show_running(False)
    assert bar.state is State.NEUTRAL
    view.show_running(True)
    view.show_matched(None, *REASONS)
    assert (bar.state, bar.heading) == (State.BAD, "Photo: not matched")
    assert " ".join(REASONS) in bar.accessibleDescription()  # they are stated nowhere else
    view.show_matched(match)
    assert (bar.state, bar.heading) == (State.GOOD, "Photo: sure, if f = 2 kHz")
    view.open(None)
    assert bar.heading == "No photo is open"


def test_a_sure_match_says_what_was_found_and_what_it_depends_on(
    view: LiveView, bar: PhotoVerdictBar, match: Match
) -> None:
    view.show_matched(match)
    said = bar.accessibleDescription()
    assert "Photo: sure, if f = 2 kHz. Code of 2 kHz: your camera reads a line in " in said
    assert "in 14.57770 ± 0.00027 µs; " in said
    assert "; exposed for 62.50 ± 0.21 µs; sure." in said
    view.show_matched(match_of_lamp())  # named by the lamp's own frequency
    assert bar.heading == "Photo: sure, if it is a lamp of 1 kHz"
    assert "Lamp of 1 kHz: your camera reads" in bar.accessibleDescription()
    dimmed = match_of_lamp(0.6, uncertainties={**match.uncertainties, "duty": 0.01})
    view.show_matched(dimmed)
    assert "; lit for 60.0 ± 1.0 % of the time; exposed for " in bar.accessibleDescription()
    view.show_matched(replace(match, reasons=REASONS))
    assert (bar.state, bar.heading) == (State.DOUBTFUL, "Photo: doubtful")
    assert f"{REASONS[0]} And 1 more reason." in bar.accessibleDescription()


def test_a_match_whose_exposure_is_doubtful_is_not_called_sure_without_saying_so(
    view: LiveView, bar: PhotoVerdictBar, match: Match
) -> None:
    view.show_matched(replace(match, exposure_reasons=REASONS[:1]))
    assert (bar.state, bar.heading) == (
        State.GOOD, "Photo: sure, but for the exposure, if f = 2 kHz",
    )  # fmt: skip
    for told in (bar.accessibleDescription(), photo_caption(view.shown)):
        assert "exposed for 62.50 ± 0.21 µs (doubtful); sure otherwise." in told
    why = f"Only the exposure time, and with it the start time, is doubtful. {REASONS[0]}"
    assert why in view.result.reasons.text()


def test_bar_and_values_depend_on_the_same_value_until_it_is_confirmed(
    view: LiveView, bar: PhotoVerdictBar, match: Match
) -> None:
    for shown in (match, replace(match, pattern="10")):
        view.show_matched(shown)
        for certain in ({}, {"switching_frequency": 2e3}, {"switching_frequency": 4e3}):
            view.confirm(certain)
            is_assumed = certain.get("switching_frequency") != 2e3
            said = view.result.condition.text().removeprefix("These values hold only ").rstrip(".")
            condition = said.lower() if is_assumed else ""
            told = bar.accessibleDescription().lower()
            assert told.startswith(f"photo: sure{condition and ', '}{condition}. code of 2 khz: ")
            assert ("if " in told) == (not view.result.condition.isHidden()) == is_assumed


def test_an_open_photo_that_the_table_has_not_matched_says_why_until_it_is_matched_by_itself(
    view: LiveView, bar: PhotoVerdictBar, photo: Photo, match: Match
) -> None:
    view.change(row=PhotoRow(photo.path, "refused", REASONS[1]))
    assert (bar.state, bar.heading) == (State.BAD, "Photo: refused in the table")
    assert REASONS[1] in bar.accessibleDescription()
    view.confirm({"switching_frequency": 2e3})
    view.show_matched(match)
    assert bar.heading == "Photo: sure"  # the frequency is certain


def test_a_refusal_of_plain_stripes_has_the_button_that_says_what_they_are(
    view: LiveView, bar: PhotoVerdictBar, photo: Photo, qtbot: QtBot
) -> None:
    asked = collect(view.form.asked)
    view.open(photo)
    view.show_matched(None, *REASONS)
    assert bar.step.isHidden()
    view.show_matched(None, PLAIN_STRIPES, "They repeat after 40.0 columns.")
    assert not bar.step.isHidden()
    assert "as one of a lamp" in bar.step.toolTip()
    qtbot.mouseClick(bar.step, Qt.MouseButton.LeftButton)
    assert [one.sent for one in asked] == ["lamp"]
    assert not view.form.certain.isChecked()
    view.show_running(True)
    assert bar.step.isHidden()


def test_the_caption_of_a_figure_names_the_photo_and_the_verdict_on_its_match(
    view: LiveView, bar: PhotoVerdictBar, photo: Photo, match: Match
) -> None:
    view.open(None)
    assert photo_caption(view.shown) == ""
    view.open(photo)
    assert photo_caption(view.shown) == "photo stripes.png, not matched"
    view.show_matched(match)
    assert photo_caption(view.shown).startswith(
        "photo stripes.png. If f = 2 kHz: your camera reads a line in"
    )
    assert "exposed for 62.50 ± 0.21 µs; sure." in photo_caption(view.shown)
    view.change(scene=match.scene.replace(iso=50.0))  # the figure's picture is of another scene
    assert photo_caption(view.shown).startswith(
        "photo stripes.png, whose match is not this scene's. If f = 2 kHz"
    )
    view.change(part=match.region)
    assert photo_caption(view.shown) == "photo stripes.png, not matched"
