"""The verdict of a match: its word, sign and reasons, on a plate that is read in any theme."""

from dataclasses import replace

import pytest
from gui.photo.photo_bench import LiveView
from PySide6.QtGui import QPalette
from pytestqt.qtbot import QtBot

from occ_gui.photo.verdict_view import SIGNS, VerdictView
from occ_gui.widgets.contrast import contrast
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Alternative, Match
from occ_model.results.photo_table import DOUBTFUL, SURE, VERDICTS

READABLE = 4.5
ONLY = "Only the exposure time, and with it the start time, is doubtful."
REASONS = ("Only 1.2 periods of 21 chips are in view.", "The correlation is 0.85.")
PLAIN = Alternative("a smooth curve", "", 0.91, 12.34)
READ = Alternative("chips that were read", "1100", 0.95, -3.21, 7.2e-6, 2e3, 8e-5)


@pytest.fixture
def verdict(qtbot: QtBot) -> VerdictView:
    verdict = VerdictView()
    qtbot.addWidget(verdict)
    return verdict


def test_each_verdict_has_a_sign_of_its_own() -> None:
    assert set(SIGNS) == set(VERDICTS)
    assert len(set(SIGNS.values())) == len(SIGNS)


@pytest.mark.parametrize("word", [SURE, DOUBTFUL])
def test_a_verdict_is_a_word_with_a_sign_on_a_readable_plate(
    verdict: VerdictView, word: str
) -> None:
    verdict.show_verdict(word, REASONS)
    assert verdict.word.text() == f"{SIGNS[word]} {word}"
    assert verdict.reasons.text().splitlines() == [f"• {reason}" for reason in REASONS]
    palette = verdict.word.palette()
    plate = palette.color(QPalette.ColorRole.Window)
    ink = palette.color(QPalette.ColorRole.WindowText)
    assert verdict.word.autoFillBackground()
    assert contrast(plate, ink) > READABLE


def test_a_verdict_without_reasons_takes_no_place_for_them(verdict: VerdictView) -> None:
    verdict.show_verdict(SURE, ())
    assert verdict.reasons.isHidden()


def test_an_outdated_verdict_is_not_shown_as_the_present_one(verdict: VerdictView) -> None:
    verdict.show_verdict(SURE, ())
    verdict.show_outdated(True)
    assert verdict.word.text() == "Before: sure"
    assert not verdict.word.autoFillBackground()
    verdict.show_verdict(DOUBTFUL, REASONS)
    assert verdict.word.text() == "◐ doubtful"


def test_the_verdict_stands_above_the_figures(view: LiveView, photo: Photo, match: Match) -> None:
    view.open(photo)
    view.show_matched(replace(match, reasons=REASONS))
    result = view.result
    assert result.verdict.word.text() == "◐ doubtful"
    assert result.verdict.geometry().bottom() < result.figures.geometry().top()
    view.show_matched(match)
    assert result.verdict.word.text() == "● sure"
    assert result.verdict.reasons.isHidden()


def test_a_doubtful_exposure_is_said_beside_what_is_sure(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.result.show_certain({"switching_frequency": 2e3})
    view.show_matched(replace(match, exposure_reasons=REASONS))
    result = view.result
    assert result.verdict.word.text() == "● sure"
    assert result.verdict.reasons.text().splitlines() == [
        f"• {ONLY} {REASONS[0]}", f"• {REASONS[1]}",
    ]  # fmt: skip
    assert result.values["exposure_time"].text() == "62.50 ± 0.21 µs (doubtful)"
    assert result.values["start_time"].text().endswith(" (doubtful)")
    assert "doubtful" not in result.values["readout_time"].text()
    view.show_matched(replace(match, reasons=REASONS[:1], exposure_reasons=REASONS[1:]))
    assert result.verdict.word.text() == "◐ doubtful"
    assert result.verdict.reasons.text() == "\n".join(f"• {reason}" for reason in REASONS)


def test_the_figures_that_a_verdict_rests_on_are_shown(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(replace(photo, exposure_time=1 / 16000))
    view.show_matched(match)
    texts = {name: label.text() for name, label in view.result.values.items()}
    assert texts["periods"] == f"{3 * 2e3 * 14.5777e-6 / 4:.3g}"
    assert texts["exposed"] == "0.125"
    assert texts["duty"] == "lit for 50 % of a period (given)"
    assert texts["exposure_time"] == "62.50 ± 0.21 µs"
    assert texts["noted"] == "62.5 µs"


def test_other_explanations_are_told_with_what_they_rest_on(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(match)
    assert not view.result.values["alternative"].isVisible()
    view.show_matched(replace(match, alternatives=(READ, PLAIN)))
    assert view.result.values["alternative"].text().splitlines() == [
        "• chips that were read: correlation 0.950, log-likelihood lower by 3.2; "
        "readout time 7.2 µs, exposed for 80 µs",
        "• a smooth curve: correlation 0.910, log-likelihood higher by 12.3",
    ]


def test_an_outdated_match_is_covered_at_once_and_not_used(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(match)
    view.show_match_outdated("of another part of the photo", usable=False)
    result = view.result
    assert result.mark.isVisible()
    assert result.mark.text == "of another part of the photo"
    assert result.verdict.word.text().startswith("Before")
    assert not result.apply.isEnabled()
    assert not result.save.isEnabled()
    view.show_match_outdated("", usable=True)
    assert not result.mark.isVisible()
    assert result.verdict.word.text() == "● sure"
    assert result.apply.isEnabled()
