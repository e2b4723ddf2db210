"""Lessons: a list, steps that set their scene, and questions answered on demand."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest
from gui.user import User
from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.command_line import PANES
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.files.file_controller import sample_photos
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Session
from occ_gui.lessons import lesson_controller
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.window.main_window import MainWindow
from occ_model.effects.registry import NAMES
from occ_model.errors import SceneFileError
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons


@pytest.fixture
def guide(application: Application, user: User, qtbot: QtBot) -> LessonView:
    """Open the lessons by the menu."""
    user.choose("&Lessons")
    guide = application.shell.pane("lessons").view
    qtbot.waitUntil(lambda: guide.isVisible() and bool(guide.list.choices))
    return guide


def choose_sent(application: Application, sent: str) -> None:
    """Choose what was sent, as with the mouse."""
    chosen = application.view("photo").form.sent
    chosen.show_key(sent)
    chosen.chosen.emit(sent)


def in_front(application: Application, name: str) -> bool:
    return not application.window.docks[name].visibleRegion().isEmpty()


def test_opening_the_lessons_lists_them_and_changes_nothing(
    application: Application, guide: LessonView, small_scene: Scene
) -> None:
    titles = [lesson.title for lesson in lessons().lessons]
    assert len(titles) == 12
    for button, title in zip(guide.list.choices, titles, strict=True):
        assert button.text().startswith(title)
        assert button.toolTip()
    assert application.store.scene == small_scene
    assert application.store.undo_stack.count() == 0


def test_each_pane_that_a_step_names_is_a_dock() -> None:
    named = {step.pane for lesson in lessons().lessons for step in lesson.steps}
    assert named <= set(PANES)


def test_a_step_sets_its_scene_and_shows_its_pane_and_question(
    application: Application, guide: LessonView, user: User, qtbot: QtBot, small_scene: Scene
) -> None:
    lesson = lessons().lessons[0]
    guide.list.choices[0].click()
    user.wait_until_idle()
    step = lesson.steps[0]
    assert application.store.scene == step.scene
    assert application.store.undo_stack.count() == 1
    assert guide.step.question.text() == step.question
    assert "step 1 of 3" in guide.step.place.text()
    assert not guide.step.back.isEnabled()
    # The row of the story shows the profile, and all the larger without another pane of it.
    assert step.pane == "profile"
    assert application.story.rows.profile.isVisible()
    assert application.window.docks["profile"].isHidden()
    user.choose("&Undo")
    assert application.store.scene == small_scene


def test_a_step_shows_the_pane_that_the_story_does_not_have(
    application: Application, guide: LessonView, user: User, qtbot: QtBot
) -> None:
    lesson = next(each for each in lessons().lessons if each.steps[0].pane == "accuracy")
    guide.list.choices[lessons().lessons.index(lesson)].click()
    user.wait_until_idle()
    qtbot.waitUntil(lambda: in_front(application, "accuracy"))


def test_the_answer_is_shown_on_demand_until_the_next_step(guide: LessonView, user: User) -> None:
    guide.list.choices[1].click()
    assert not guide.step.answer.isVisible()
    guide.step.reveal.click()
    assert guide.step.answer.isVisible()
    assert "<i>t</i><sub>r</sub>" in guide.step.answer.text()
    assert guide.step.reveal.text() == "Hide the explanation"
    guide.step.next.click()
    assert not guide.step.answer.isVisible()
    assert guide.step.reveal.text() == "Show the explanation"
    user.wait_until_idle()


def test_back_next_and_again_move_and_set_the_scene(
    application: Application, guide: LessonView, user: User
) -> None:
    steps = lessons().lessons[0].steps
    guide.list.choices[0].click()
    guide.step.next.click()
    assert application.store.scene == steps[1].scene
    application.store.change(switching_frequency=9e3)
    guide.step.again.click()
    assert application.store.scene == steps[1].scene
    guide.step.back.click()
    assert application.store.scene == steps[0].scene
    guide.step.next.click()
    guide.step.next.click()
    assert guide.step.next.text() == "Done"
    assert application.store.scene == steps[2].scene
    user.wait_until_idle()


def test_progress_is_kept_and_what_is_done_is_ticked(
    application: Application, guide: LessonView, user: User
) -> None:
    guide.list.choices[0].click()
    guide.step.next.click()
    guide.step.all.click()
    assert "step 2 of 3" in guide.list.choices[0].text()
    application.window.docks["lessons"].hide()
    user.choose("&Lessons")
    guide.list.choices[0].click()
    assert "step 2 of 3" in guide.step.place.text()
    guide.step.next.click()
    guide.step.next.click()
    assert guide.end.title.text() == "Done: What is a rolling shutter?"
    guide.end.all.click()
    assert guide.list.choices[0].text().startswith("✓ ")
    assert "steps" in guide.list.choices[1].text()
    guide.list.choices[0].click()
    assert "step 1 of 3" in guide.step.place.text()
    user.wait_until_idle()


def test_a_sample_photo_is_open_only_while_steps_need_it(
    application: Application, guide: LessonView, user: User, qtbot: QtBot
) -> None:
    opened: list[str] = []
    application.photos.opened.connect(lambda p: opened.append("" if p is None else p.path.stem))
    guide.list.choices[5].click()
    user.wait_until_idle()
    qtbot.waitUntil(lambda: in_front(application, "photo"))
    assert application.store.scene == lessons().lessons[5].steps[0].scene
    guide.step.again.click()
    user.wait_until_idle()
    guide.step.next.click()
    user.wait_until_idle()
    assert opened == ["led-1khz", "packets-6khz"]
    guide.step.all.click()
    guide.list.choices[1].click()
    user.wait_until_idle()
    assert opened == ["led-1khz", "packets-6khz", ""]


def test_a_photo_of_the_users_own_is_out_of_sight_while_a_lesson_needs_none(
    application: Application, guide: LessonView, user: User, photo_file: Any
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    choose_sent(application, "read")
    application.window.bring_to_front("lessons")
    guide.list.choices[1].click()
    user.wait_until_idle()
    assert application.photos.path is None
    guide.step.all.click()
    user.wait_until_idle()
    assert application.photos.path == photo_file
    assert application.view("photo").form.choice().sent == "read"
    assert in_front(application, "lessons")


@pytest.mark.whole
def test_the_photos_give_the_numbers_that_the_answers_state(
    application: Application, guide: LessonView, user: User
) -> None:
    guide.list.choices[5].click()
    user.wait_until_idle()
    for expected in ("12.8", "8.9"):
        user.choose("&Match photo")
        found = application.view("photo").result.values["readout_time"].text()
        value = float(found.split()[0])  # with no condition: the frequency is told
        assert f"{value:.1f}" == expected, found
        if expected == "12.8":
            guide.step.next.click()
            user.wait_until_idle()
    user.choose("&Apply to the scene")
    assert application.store.scene.transmitter.code == 345
    assert application.controls.code.number.value() == 345


@pytest.mark.own_window
def test_lessons_that_cannot_be_read_give_a_sentence(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    def fail() -> None:
        raise SceneFileError("1.toml is no lesson: it is a <song>.")

    monkeypatch.setattr(lesson_controller, "lessons", fail)
    user.choose("&Lessons")
    guide = application.shell.pane("lessons").view
    qtbot.waitUntil(lambda: "<song>" in guide.list.message.text())
    assert guide.list.choices == []


def test_a_step_about_a_photo_shows_its_verdict_first_and_takes_its_frequency_as_certain(
    application: Application, guide: LessonView, user: User
) -> None:
    story, photo = application.story, application.view("photo")
    choose_sent(application, "square")  # of the user's own photo before
    guide.list.choices[5].click()
    for frequency in (2e3, 6e3):
        user.wait_until_idle()
        assert photo.form.sent.key() == "auto"
        assert photo.form.certain.isChecked()
        assert application.photos.choice.certain == {"switching_frequency": frequency}
        assert photo.verdict.isVisible()
        assert not story.verdict.isVisible()
        guide.step.next.click()
    user.wait_until_idle()
    assert guide.end.isVisible()
    assert story.verdict.isVisible()
    assert not photo.verdict.isVisible()


def test_the_frequency_of_a_step_with_a_sample_photo_is_that_of_the_sample() -> None:
    truths = {path.stem: Scene.from_toml(path.with_suffix(".toml").read_text(encoding="utf-8"))
              for path in sample_photos()}  # fmt: skip
    steps = [step for lesson in lessons().lessons for step in lesson.steps if step.photo]
    assert steps
    for step in steps:
        truth = truths[step.photo].transmitter.switching_frequency
        assert step.scene.transmitter.switching_frequency == truth, step.goal


@pytest.mark.parametrize("is_left", [True, False])
def test_a_sample_that_is_still_being_read_is_not_opened_after_its_step(
    application: Application, guide: LessonView, user: User, is_left: bool
) -> None:
    (place,) = (i for i, each in enumerate(lessons().lessons) if each.name.startswith("lab-1"))
    with_photo = [i for i, step in enumerate(lessons().lessons[place].steps) if step.photo]
    photos = application.photos
    guide.list.choices[place].click()
    for _ in range(with_photo[0]):
        guide.step.next.click()
    assert photos.awaited is not None
    if is_left:
        guide.step.all.click()
    else:
        for _ in with_photo:
            guide.step.next.click()
    user.wait_until_idle()
    assert photos.path is None
    assert application.window.modes.mode == "lessons"


def test_a_missing_photo_is_reported(
    application: Application,
    guide: LessonView,
    user: User,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(lesson_controller, "sample_photos", list)
    guide.list.choices[5].click()
    assert user.message == "The photo led-1khz is missing."
    user.wait_until_idle()


def test_the_lessons_stand_at_the_right_of_what_they_explain(
    application: Application, guide: LessonView, qtbot: QtBot
) -> None:
    window = application.window
    dock, picture = window.docks["lessons"], application.view("picture")
    assert window.modes.mode == "lessons"
    qtbot.waitUntil(lambda: not dock.visibleRegion().isEmpty())
    assert dock.height() > window.height() // 2
    assert dock.geometry().left() > picture.mapTo(window, picture.rect().center()).x()


def test_the_list_follows_the_theme(application: Application, guide: LessonView) -> None:
    for theme, is_light in (("dark", False), ("light", True), ("dark", False), ("system", True)):
        application.options.theme.choose(theme)
        QApplication.processEvents()
        picture = guide.list.choices[0].grab().toImage()
        back = picture.pixelColor(picture.width() - 12, picture.height() // 2)
        assert (back.lightness() > 128) == is_light, theme


@pytest.mark.parametrize("how", ["all", "done"])
def test_a_lesson_has_a_state_of_its_own_and_returns_the_users(
    application: Application, guide: LessonView, user: User, small_scene: Scene, how: str
) -> None:
    application.settings.set_tolerance(7.0)
    application.settings.set_noise("exact")
    application.store.force("jpeg", True)
    mine = application.settings.settings
    guide.list.choices[0].click()
    user.wait_until_idle()
    assert application.settings.settings == FIRST_SETTINGS
    application.store.force("vignetting", True)
    application.settings.set_tolerance(30.0)
    application.store.change(distance=2.0)
    guide.step.next.click()
    assert application.settings.settings == FIRST_SETTINGS
    if how == "all":
        guide.step.all.click()
    else:
        guide.step.next.click()
        guide.step.next.click()
    user.wait_until_idle()
    assert (application.store.scene, application.settings.settings) == (small_scene, mine)
    assert "end of the lesson" in user.entry("&Undo").text()


def test_the_users_photo_returns_after_a_lesson(
    application: Application, guide: LessonView, user: User, photo_file: Any
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    guide.list.choices[5].click()
    user.wait_until_idle()
    assert application.photos.path != photo_file
    guide.step.all.click()
    user.wait_until_idle()
    assert application.photos.path == photo_file


@pytest.mark.whole
def test_a_photo_opened_before_the_lessons_were_ever_shown_returns_with_all_that_was_found(
    application: Application, user: User, qtbot: QtBot
) -> None:
    photo, sample = application.view("photo"), sample_photos()[0]
    application.open_photo(sample)
    user.wait_until_idle()
    choose_sent(application, "square")
    application.shell.pane("photo").parts.draw(Region(100, 800, 0, 900))
    user.choose("&Match photo")

    def state() -> tuple[object, ...]:
        # A pattern is cut where its label is narrow, and whole in the tooltip.
        shown = {
            name: label.toolTip() if name == "pattern" else label.text()
            for name, label in photo.result.values.items()
        }
        title = photo.verdict.heading
        return (
            application.shell.pane("photo").matching.match, photo.form.choice(),
            application.photos.choice.certain, photo.form.certain.isChecked(),
            application.shell.pane("photo").parts.part, shown, title, photo.result.isHidden(),
            photo.result.stale.isHidden(), application.photos.path,
        )  # fmt: skip

    before = state()
    assert before[0] is not None
    assert before[3]
    user.choose("&Lessons")
    guide = application.shell.pane("lessons").view
    qtbot.waitUntil(lambda: bool(guide.list.choices))
    guide.list.choices[5].click()
    guide.step.next.click()
    user.wait_until_idle()
    assert application.photos.path != sample
    choose_sent(application, "read")
    guide.step.all.click()
    user.wait_until_idle()
    assert state() == before


def begin_with_photo(
    application: Application, guide: LessonView, user: User, size: QSize
) -> MainWindow:
    """Begin the lesson about a photo in a window of this size."""
    window = application.window
    window.modes.switch("lessons")
    window.resize(size)
    user.wait_until_idle()
    guide.list.choices[5].click()
    user.wait_until_idle()
    return window


@pytest.mark.own_window  # one that had other panes before may be a few pixels wider
def test_a_lesson_beside_its_photo_fits_into_a_small_window(
    application: Application, guide: LessonView, user: User, qtbot: QtBot
) -> None:
    window = begin_with_photo(application, guide, user, QSize(1000, 700))
    qtbot.waitUntil(lambda: application.view("photo").placement.isVisible())
    assert window.minimumSizeHint().width() <= 1000
    assert window.width() == 1000


def test_in_a_large_window_a_lesson_leaves_its_photo_the_height_that_it_does_not_need(
    application: Application, guide: LessonView, user: User, qtbot: QtBot
) -> None:
    window = begin_with_photo(application, guide, user, QSize(1920, 1080))
    lesson, photo = window.docks["lessons"], window.docks["photo"]
    least = photo.minimumSizeHint().height()
    qtbot.waitUntil(lambda: photo.height() > 1.4 * least)
    assert lesson.height() >= lesson.sizeHint().height()


def test_a_photo_opened_during_a_lesson_stays_open(
    application: Application, guide: LessonView, user: User, photo_file: Any
) -> None:
    guide.list.choices[1].click()
    application.open_photo(photo_file)
    user.wait_until_idle()
    guide.step.all.click()
    user.wait_until_idle()
    assert application.photos.path == photo_file


def test_a_crash_during_a_lesson_leaves_the_users_own_state(
    application: Application,
    guide: LessonView,
    user: User,
    small_scene: Scene,
    photo_file: Path,
    tmp_path: Path,
) -> None:
    autosave = application.kept.autosave
    autosave.resume(SessionFile(tmp_path, NAMES), Session(), scene_wins=True)
    application.settings.set_tolerance(7.0)
    application.open_photo(photo_file)
    user.wait_until_idle()
    before = application.store.store.workspace
    guide.list.choices[5].click()
    user.wait_until_idle()
    assert application.store.scene != before.scene
    assert application.photos.path != photo_file
    autosave.write()
    record = json.loads((tmp_path / "session-1.json").read_text(encoding="utf-8"))
    assert record["in_use"]
    assert Scene.from_toml(record["scene"]) == before.scene
    assert record["settings"] == asdict(before.settings)
    assert record["photo"]["path"] == str(photo_file)
    guide.step.all.click()
    user.wait_until_idle()
    application.store.change(distance=2.0)
    autosave.write()
    record = json.loads((tmp_path / "session-1.json").read_text(encoding="utf-8"))
    assert Scene.from_toml(record["scene"]).pose.distance == 2.0
    autosave.end()


def test_a_window_closed_during_a_lesson_keeps_the_users_scene(
    application: Application,
    guide: LessonView,
    user: User,
    small_scene: Scene,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    written: list[Scene] = []
    autosave = application.kept.autosave
    monkeypatch.setattr(autosave, "end", lambda: written.append(application.store.scene))
    guide.list.choices[0].click()
    user.wait_until_idle()
    assert application.store.scene != small_scene
    application.window.close()
    assert written == [small_scene]
