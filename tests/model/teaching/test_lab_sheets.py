"""Lab sheets can be completed with the sample photos, and their reports show the measurements."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from matches import match_with

from occ_model.errors import OutputError
from occ_model.figures.drawing import house_style
from occ_model.figures.lesson_report import (
    describe_match,
    draw_page,
    split_into_pages,
    write_lesson_report,
)
from occ_model.results.match import Match
from occ_model.results.teaching import AnsweredStep, CheckedAnswer, Lesson
from occ_model.scene.scene import Scene
from occ_model.teaching.answers import check_answer
from occ_model.teaching.lessons import ACTIONS, lessons

SHEETS = [lesson for lesson in lessons().lessons if lesson.is_sheet]


@pytest.fixture(scope="module")
def match() -> Match:
    """Match the sample photo of the sheet on the readout time."""
    scene = SHEETS[1].steps[3].scene.replace(readout_time=12.8e-6)
    return match_with(scene=scene, readout_time=12.8e-6, pattern="10", pattern_was_read=False)


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda sheet: sheet.name)
def test_a_sheet_goes_from_the_transmitter_to_a_matched_photo(sheet: Lesson) -> None:
    assert [step.action for step in sheet.steps if step.action] == list(ACTIONS)
    for step in sheet.steps:
        if step.own_photo:
            assert step.pane == "photo"
            assert step.photo


def test_an_answer_about_a_photo_needs_its_match(match: Match) -> None:
    step = SHEETS[1].steps[3]
    assert "Match the photo first" in check_answer(step, "12.8").sentence
    assert check_answer(step, "12.8", match).outcome == "right"
    # The match of the student's photo, not of the sample.
    other = replace(match, scene=match.scene.replace(readout_time=20e-6))
    assert check_answer(step, "12.8", other).outcome == "wrong"
    assert check_answer(step, "20", other).outcome == "right"


def test_a_pattern_has_no_code(match: Match) -> None:
    step = SHEETS[2].steps[3]
    assert "no code" in check_answer(step, "345", match).sentence


def few_rows(sheet: Lesson, place: int) -> Scene:
    """Different rows for each step."""
    return sheet.steps[place].scene.replace(rows=200 + place)


def answer_step(sheet: Lesson, match: Match) -> list[AnsweredStep]:
    given = CheckedAnswer("about 12.8 µs *exactly*", "right", "That is what it shows.")
    return [
        AnsweredStep(
            step, given, few_rows(sheet, place), match if step.own_photo else None, "mine.jpg"
        )
        for place, step in enumerate(sheet.steps)
    ]


def test_every_step_is_on_one_page(match: Match) -> None:
    for sheet in SHEETS:
        steps = answer_step(sheet, match)
        pages = list(split_into_pages(steps))
        assert [each for _, page in pages for each in page] == steps
        assert [first for first, _ in pages] == [
            1 + sum(len(page) for _, page in pages[:place]) for place in range(len(pages))
        ]


@pytest.mark.usefixtures("plain_figures")
def test_a_report_of_several_pages_is_a_document(match: Match, tmp_path: Path) -> None:
    steps = answer_step(SHEETS[1], match)
    path = tmp_path / "report.pdf"
    write_lesson_report(path, SHEETS[1], steps, author="A. Student", date="2026-11-22")
    content = path.read_bytes()
    assert content.startswith(b"%PDF")
    assert content.count(b"/Type /Page ") == len(list(split_into_pages(steps))) > 1
    with pytest.raises(OutputError, match=r"has 2 pages; allowed ending: \.pdf"):
        write_lesson_report(tmp_path / "report.png", SHEETS[1], steps)
    assert not (tmp_path / "report.png").exists()


def test_a_report_has_author_and_date_apart_and_a_match_in_sentences_with_whole_values(
    match: Match, tmp_path: Path
) -> None:
    steps = answer_step(SHEETS[1], match)[3:]
    path = tmp_path / "report.svg"
    write_lesson_report(path, SHEETS[1], steps, author="A. Student", date="2026-11-22")
    assert "A. Student, 2026-11-22" in path.read_text(encoding="utf-8")
    doubtful = replace(match, reasons=("Only 2 periods are in view.",))
    (step, *_) = [each for each in steps if each.match is not None]
    page = draw_page("title", "about", "foot", [replace(step, match=doubtful)], 1)
    (found,) = [text for each in page.texts if "residual" in (text := each.get_text())]
    assert found.replace("\n", " ").endswith(" levels. Only 2 periods are in view.")
    assert re.search(r"readout time 12\.8\d*\xa0±\xa00\.0", found.replace("\n", " "))


def test_a_match_is_described_with_verdict_errors_and_reasons(match: Match) -> None:
    doubtful = replace(match, reasons=("Only 2 periods are in view.",))
    assert describe_match(match, "").startswith("sure; readout time ")
    assert describe_match(doubtful, "a.jpg").startswith("photo a.jpg: doubtful; readout time ")
    assert describe_match(doubtful, "a.jpg").endswith(" levels. Only 2 periods are in view.")


def test_every_axis_of_a_report_names_its_unit_and_covers_no_text(match: Match) -> None:
    for number, page in split_into_pages(answer_step(SHEETS[1], match)):
        with house_style():
            figure = draw_page("A sheet", "A. Student", "", page, number)
        axes = figure.axes
        assert axes
        assert all("grey level" in ax.get_ylabel() for ax in axes)
        below = [ax for ax in axes if ax.xaxis.get_tick_params()["labelbottom"]]
        assert all("column" in ax.get_xlabel() for ax in below)
        assert len(below) == len(page)
        written = [text.get_window_extent() for text in figure.texts if text.get_text()]
        assert all(ax.xaxis.get_tightbbox().count_overlaps(written) == 0 for ax in below)


@pytest.mark.parametrize(
    ("given", "stated"),
    [("62.5", "62.5 µs"), (" 1e-3 ", "1e-3 µs"), ("62.5 ns", "62.5 ns"), ("sixty", "sixty")],
)
def test_a_number_alone_has_the_unit_that_it_was_asked_in(given: str, stated: str) -> None:
    step = SHEETS[1].steps[3]
    assert step.check.asked_in == "µs"
    assert step.with_unit(given) == stated
