"""Lessons in the window: their panes, the story, the photo's pane and the session beside them."""

import json
from dataclasses import asdict, replace
from pathlib import Path

import pytest
from gui.soak_actions import smaller_lessons
from gui.user import User
from matches import match_with
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.files.session import SessionFile
from occ_gui.lessons import lesson_controller
from occ_gui.lessons.lesson_view import LessonView
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons


@pytest.fixture
def guide(
    application: Application, user: User, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> LessonView:
    monkeypatch.setattr(lesson_controller, "lessons", smaller_lessons)
    user.choose("&Lessons")
    guide = application.shell.pane("lessons").view
    qtbot.waitUntil(lambda: guide.isVisible() and bool(guide.list.choices))
    return guide


def choose_sent(application: Application, sent: str) -> None:
    combo_box = application.view("photo").form.sent
    combo_box.show_key(sent)
    combo_box.chosen.emit(sent)


def is_in_front(application: Application, name: str) -> bool:
    return not application.window.docks[name].visibleRegion().isEmpty()


def test_a_step_sets_its_scene_and_shows_its_question_and_a_pane_without_a_row_in_the_story(
    application: Application, guide: LessonView, user: User, qtbot: QtBot, small_scene: Scene
) -> None:
    lesson = smaller_lessons().lessons[0]
    user.press(guide.list.choices[0])
    step = lesson.steps[0]
    assert application.scene_store.scene == step.scene
    assert application.scene_store.undo_stack.count() == 1
    assert guide.step.question.text() == step.question
    assert "step 1 of 3" in guide.step.position.text()
    assert not guide.step.back.isEnabled()
    # The row of the story shows the profile, larger than beside a pane of it.
    assert step.pane == "profile"
    assert application.story.rows.profile.isVisible()
    assert application.window.docks["profile"].isHidden()
    user.choose("&Undo")
    assert application.scene_store.scene == small_scene
    guide.step.all_lessons.click()
    lesson = next(each for each in lessons().lessons if each.steps[0].pane == "accuracy")
    guide.list.choices[lessons().lessons.index(lesson)].click()
    user.wait_until_idle()
    qtbot.waitUntil(lambda: is_in_front(application, "accuracy"))


def test_a_step_about_a_photo_shows_its_verdict_and_treats_its_frequency_as_certain(
    application: Application, guide: LessonView, user: User
) -> None:
    story, photo = application.story, application.view("photo")
    choose_sent(application, "lamp")  # of the user's own photo before
    guide.list.choices[5].click()
    for known in ({"lamp_frequency": 1e3}, {"switching_frequency": 6e3}):
        user.wait_until_idle()
        assert photo.form.sent.key() == "auto"
        assert photo.form.certain.isChecked()
        assert application.photos.choice.certain == known
        assert photo.verdict.isVisible()
        assert not story.verdict.isVisible()
        guide.step.next.click()
    user.wait_until_idle()
    assert guide.end.isVisible()
    assert story.verdict.isVisible()
    assert not photo.verdict.isVisible()


def test_a_crash_or_a_closed_window_during_a_lesson_leaves_the_users_own_state(
    application: Application, guide: LessonView, user: User, photo_file: Path, tmp_path: Path
) -> None:
    session = application.session
    session.begin(SessionFile(tmp_path), names_scene=True)
    application.settings.set_tolerance(7.0)
    store = application.scene_store.store
    store.put(
        replace(store.workspace, decoder="matched", picture_kind="receiver", is_enhanced=True)
    )
    user.open_photo(photo_file)
    before = application.scene_store.store.workspace
    user.press(guide.list.choices[5])
    assert application.scene_store.scene != before.scene
    assert application.photos.choice.path != photo_file
    session.write()
    record = json.loads((tmp_path / "session-1.json").read_text(encoding="utf-8"))
    assert record["in_use"]
    assert Scene.from_toml(record["scene"]) == before.scene
    assert record["settings"] == asdict(before.settings)
    assert application.scene_store.store.workspace.decoder == "threshold"
    values = [record["view"][name] for name in ("decoder", "picture_kind", "is_enhanced")]
    assert values == ["matched", "receiver", True]
    assert record["photo"]["path"] == str(photo_file)
    user.press(guide.step.all_lessons)
    application.scene_store.change(distance=2.0)
    session.write()
    record = json.loads((tmp_path / "session-1.json").read_text(encoding="utf-8"))
    assert Scene.from_toml(record["scene"]).pose.distance == 2.0
    user.press(guide.list.choices[0])
    application.window.close()
    record = json.loads((tmp_path / "session-1.json").read_text(encoding="utf-8"))
    assert not record["in_use"]
    assert Scene.from_toml(record["scene"]) == before.scene.replace(distance=2.0)
    assert record["view"]["decoder"] == "matched"


def test_a_lesson_keeps_the_number_of_visible_columns_while_the_scene_changes(
    application: Application, guide: LessonView, user: User
) -> None:
    story = application.story
    usual = story.rows.axis.span
    user.press(guide.list.choices[0])
    span = story.rows.axis.span
    assert story.rows.ranges["packets"].text() == "250 columns"
    assert span == pytest.approx(250, rel=0.05)
    for readout in (20e-6, 4e-6):
        user.change(readout_time=readout)
        assert story.rows.axis.span == pytest.approx(span)
    user.press(guide.step.all_lessons)
    assert story.rows.ranges["packets"].text() == "2 packets"
    assert story.rows.axis.span == pytest.approx(usual)
    user.change(pattern="10")
    assert story.rows.ranges["packets"].text() == "2 periods"


def test_a_lab_sheet_has_buttons_for_its_actions(
    application: Application, guide: LessonView, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    match = match_with(scene=occ.Scene().replace(readout_time=12.8e-6))
    monkeypatch.setattr(occ, "match_photo", lambda *_, **__: match)
    (sheet,) = [choice for choice in guide.list.choices if "readout" in choice.text()]
    sheet.click()
    assert not guide.step.action.isVisible()
    for _ in range(3):
        guide.step.next.click()
    user.wait_until_idle()
    assert guide.step.action.text() == "Match the photo"
    form = guide.step.answer_field

    def answer() -> str:
        form.field.setText("12.8")
        form.check.click()
        user.wait_until_idle()
        return str(form.sentence.text())

    assert "Match the photo first" in answer()
    user.press(guide.step.action)
    assert "Right. The match gives" in answer()
    # The lesson stays beside the photo.
    assert application.window.modes.mode == "lessons"
    assert guide.isVisible()
    dock, window = application.window.docks["lessons"], application.window
    assert dock.height() > window.height() // 2
    assert application.view("photo").isVisible()
    lessons = application.shell.pane("lessons")
    assert lessons.controller.current is not None
    first, *_, last = lessons.answers.list_steps(lessons.controller.current)[:4]
    assert last.match is application.shell.pane("photo").matching.match is match
    assert last.photo == "led-1khz.jpg"
    assert first.match is None
    user.press(guide.step.all_lessons)
