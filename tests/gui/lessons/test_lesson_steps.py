"""A step of a lesson: its answer is checked, its control marked, its end reported."""

from dataclasses import replace
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from gui.kinds import add_widget
from gui.lessons.conftest import Lessons
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.files.file_controller import sample_photos
from occ_gui.lessons import answers
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.lessons.step_page import StepPage
from occ_model.figures import drawing
from occ_model.results.teaching import CheckedAnswer
from occ_model.teaching.answers import check_answer
from occ_model.teaching.lessons import lessons


def test_a_number_is_checked_against_the_model_and_kept(bench: Lessons, guide: LessonView) -> None:
    guide.list.choices[0].click()
    assert guide.step.answer_field.unit.text() == "columns"
    assert bench.answer("40") == "✗  Not yet: that is too low. Try again."
    assert bench.answer("65") == "≈  Close, but a little too high. Look again."
    assert bench.answer("many").startswith("?  ")
    assert bench.answer("62.5") == "✓  Right. The model gives 62.5 columns."
    guide.step.next.click()
    assert guide.step.answer_field.field.text() == ""
    assert not guide.step.answer_field.sentence.isVisible()
    guide.step.back.click()
    assert guide.step.answer_field.field.text() == "62.5"
    assert "Right" in guide.step.answer_field.sentence.text()


def test_an_answer_still_under_check_at_the_end_is_recorded_afterwards(
    bench: Lessons, guide: LessonView, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on, answer_field = Event(), guide.step.answer_field

    def check_late(*question: Any) -> CheckedAnswer:
        assert go_on.wait(20)
        return check_answer(*question)

    guide.list.choices[0].click()
    bench.answer("65")  # near, and recorded until another one is given
    monkeypatch.setattr(answers, "check_answer", check_late)
    for text, button in (("62.5", guide.step.next), ("25", guide.step.next)):
        answer_field.field.setText(text)
        answer_field.check.click()
        button.click()
    answer_field.field.setText("27.6")
    answer_field.check.click()
    guide.step.next.click()
    assert guide.end.isVisible()
    assert guide.end.answers.text().count("The model computes…") == 3
    assert "Look again" not in guide.end.answers.text()
    assert not guide.end.report.isEnabled()
    go_on.set()
    bench.wait_until_idle()
    assert "62.5 columns. Right." in guide.end.answers.text()
    assert "27.6 ms. Right." in guide.end.answers.text()
    assert "computes" not in guide.end.answers.text()
    assert guide.end.report.isEnabled()


def test_check_formula_explanation_and_report_use_the_present_scene(
    bench: Lessons, guide: LessonView
) -> None:
    guide.list.choices[0].click()
    bench.scenes.change(readout_time=27.54e-6)
    assert "too high" in bench.answer("62.5")
    assert bench.answer("18") == "✓  Right. The model gives 18.2 columns."
    guide.step.reveal.click()
    assert "18.2 columns" in guide.step.equation.toPlainText()
    assert guide.step.equation.toPlainText().count("Columns") == 1
    assert "own scene (Readout time: 8 µs): One state lasts" in guide.step.explanation.text()
    lesson = bench.pane.controller.current
    (first, *others) = bench.pane.answers.list_steps(lesson)
    assert first.scene == bench.scenes.scene
    assert [each.scene for each in others] == [each.step.question_scene for each in others]


def test_the_values_of_a_question_must_be_set_before_an_answer_is_judged(
    bench: Lessons, guide: LessonView
) -> None:
    guide.list.choices[0].click()
    guide.step.next.click()
    sentence = guide.step.answer_field.sentence
    assert "Right" in bench.answer("25")  # a prediction
    bench.scenes.change(readout_time=20e-6)
    assert "has changed" not in sentence.text()  # the question is about this value
    bench.scenes.change(readout_time=19e-6)
    assert "has changed" in sentence.text()
    assert bench.answer("25") == "→  First set Readout time to 20 µs, as in the question."
    bench.scenes.change(readout_time=20e-6)
    assert "Right" in bench.answer("25")
    assert "own scene" not in guide.step.explanation.text()
    bench.scenes.change(readout_time=18e-6)
    assert sentence.text().endswith("The scene has changed since: check again.")
    guide.step.reset.click()
    assert "has changed" not in sentence.text()


@pytest.fixture
def page(qtbot: QtBot) -> StepPage:
    page = add_widget(qtbot, StepPage())
    page.show_step(lessons().lessons[0], 0, None)
    return page


def test_question_answer_and_check_stay_in_view_however_long_the_text(
    page: StepPage, qtbot: QtBot
) -> None:
    lesson = lessons().lessons[0]
    long = replace(lesson.steps[0], text="A word and another. " * 300, equation="")
    page.show_step(replace(lesson, steps=(long,)), 0, None)
    page.resize(300, 420)
    page.show()
    qtbot.waitExposed(page)
    for widget in (page.question, page.answer_field.field, page.answer_field.check):
        assert page.rect().contains(QRect(widget.mapTo(page, QPoint()), widget.size()))
        assert not widget.visibleRegion().isEmpty()
    page.reveal.click()
    qtbot.waitUntil(lambda: not page.explanation.visibleRegion().isEmpty())


def test_a_step_states_what_is_changed_and_which_numbers_belong_to_which_scene(
    bench: Lessons, guide: LessonView
) -> None:
    guide.list.choices[0].click()
    changed = guide.step.changes
    assert not changed.isVisible()
    bench.scenes.change(readout_time=19e-6)
    assert changed.isVisible()
    assert "Readout time is 19 µs instead of 8 µs." in changed.text()
    assert "check and report are of your scene" in changed.text()
    guide.step.reset.click()
    assert not changed.isVisible()
    bench.scenes.change(readout_time=19e-6)
    guide.step.next.click()
    assert not changed.isVisible()
    # The question of the second step is about this value.
    bench.scenes.change(readout_time=20e-6)
    assert not changed.isVisible()
    bench.scenes.change(readout_time=21e-6, iso=200.0, distance=1.0)
    assert changed.text().count(" instead of ") == 2
    assert "and 1 more" in changed.text()


def test_the_control_of_a_step_is_marked_and_the_others_are_dimmed(
    bench: Lessons, guide: LessonView, qtbot: QtBot
) -> None:
    guide.list.choices[0].click()
    rows = bench.controls.panels["Main"].rows
    assert guide.step.control.text() == "Change: Readout time"
    assert bench.pane.spotlight.is_on
    assert rows["readout_time"].graphicsEffect() is None
    assert rows["iso"].graphicsEffect() is not None
    qtbot.waitUntil(lambda: not rows["readout_time"].visibleRegion().isEmpty())
    for name, row in rows.items():
        assert row.isEnabled() is (name == "readout_time")
    field = bench.row("exposure_time").field
    tip, before = field.toolTip(), bench.scenes.scene
    assert tip.startswith("This step of the lesson is about “Readout time”.")
    bench.enter("exposure_time", "90 µs")
    assert bench.scenes.scene == before
    bench.enter("readout_time", "20 µs")
    assert bench.scenes.scene.camera.readout_time == 20e-6
    guide.step.all_lessons.click()
    assert not bench.pane.spotlight.is_on
    assert rows["iso"].graphicsEffect() is None
    assert all(row.isEnabled() for row in rows.values())
    assert tip.endswith(field.toolTip())
    assert "This step" not in field.toolTip()


def test_the_animation_moves_while_it_is_visible_and_stops_at_a_click(
    bench: Lessons, guide: LessonView, qtbot: QtBot
) -> None:
    guide.list.choices[0].click()
    animation = guide.step.animation
    start = animation.moment
    qtbot.waitUntil(lambda: animation.moment > start)
    qtbot.mouseClick(animation, Qt.MouseButton.LeftButton)
    assert not animation.is_playing
    qtbot.keyClick(animation, Qt.Key.Key_Space)
    assert animation.is_playing
    guide.step.next.click()
    guide.step.next.click()
    assert not animation.is_playing


def test_the_end_shows_the_answers_and_saves_them_as_a_report(
    bench: Lessons, guide: LessonView, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    guide.list.choices[0].click()
    bench.answer("62.5")
    for _ in range(3):
        guide.step.next.click()
    assert "62.5 columns. Right." in guide.end.answers.text()
    assert guide.end.answers.text().count("no answer") == 2
    path = tmp_path / "report"
    guide.end.author.setText("Ada $x_1$ ")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    bench.press(guide.end.report)
    assert list(tmp_path.iterdir()) == [], "the dialog was cancelled"
    monkeypatch.setitem(drawing.STYLE, "figure.constrained_layout.use", False)  # slow
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    bench.press(guide.end.report)
    assert path.with_suffix(".pdf").read_bytes().startswith(b"%PDF")
    assert bench.said[-1] == "Saved report.pdf"
    assert bench.pane.reports.author == "Ada $x_1$"


def test_the_end_leads_to_the_next_lesson_and_a_second_click_saves_nothing(
    bench: Lessons, guide: LessonView, qtbot: QtBot
) -> None:
    guide.list.choices[0].click()
    for _ in range(2):
        guide.step.next.click()
    done = guide.step.next
    spot = done.mapTo(guide, done.rect().center())
    qtbot.mouseClick(done, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(guide.end.isVisible)
    report = guide.end.report
    assert not QRect(report.mapTo(guide, QPoint()), report.size()).contains(spot)
    assert guide.end.next.text() == "Next lesson: Past the shutter speed"
    guide.end.next.click()
    assert guide.step.position.text().startswith("Past the shutter speed · step 1")
    guide.step.all_lessons.click()
    guide.list.choices[-1].click()
    while guide.step.next.text() != "Done":
        guide.step.next.click()
    guide.step.next.click()
    assert not guide.end.next.isVisible()


def test_a_teachers_lesson_is_listed_and_a_damaged_one_is_named(
    bench: Lessons, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    step = 'preset = "phone-68us"\ntext = "a"\nquestion = "b?"\nanswer = "c"'
    (tmp_path / "mine.toml").write_text(f'title = "Mine"\n[[step]]\n{step}', encoding="utf-8")
    (tmp_path / "bad.toml").write_text(f'title = "Bad"\n[[stop]]\n{step}', encoding="utf-8")
    monkeypatch.setenv("OCC_LESSONS", str(tmp_path))
    bench.see("lessons", False)
    bench.see("lessons")
    guide = bench.guide
    assert any(choice.text().startswith("Mine") for choice in guide.list.choices)
    assert "bad is not a lesson: line 2: a lesson has no key 'stop'" in guide.list.problems.text()


def test_the_folder_of_lessons_is_made_and_opened(
    guide: LessonView, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    opened: list[str] = []
    monkeypatch.setenv("OCC_LESSONS", str(tmp_path / "own"))
    monkeypatch.setattr(
        QDesktopServices, "openUrl", lambda url: opened.append(url.toLocalFile()) is None
    )
    guide.list.folder.click()
    assert opened == [str(tmp_path / "own")]
    assert [path.name for path in (tmp_path / "own").iterdir()] == ["my-first-lesson.toml"]


def test_a_sample_that_was_open_before_a_lab_sheet_returns_with_the_users_choices(
    bench: Lessons, guide: LessonView
) -> None:
    (sheet,) = [choice for choice in guide.list.choices if "readout" in choice.text()]
    (sample,) = [path for path in sample_photos() if path.stem == "led-1khz"]
    bench.open(sample)
    bench.choose_sent("lamp")
    sheet.click()
    for _ in range(2):
        guide.step.next.click()
    bench.wait_until_idle()
    assert bench.photos.choice.path == sample  # in place of a photo of one's own
    assert bench.photos.choice.form.sent == "auto"
    bench.press(guide.step.back)
    assert bench.photos.choice.path is None
    bench.press(guide.step.all_lessons)
    assert bench.photos.choice.path == sample
    assert bench.photos.choice.form.sent == "lamp"
