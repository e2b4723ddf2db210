"""Lessons: a list, steps that set their scene, and questions answered on demand."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from gui.lessons.conftest import Lessons
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from small_rooms import small_room

from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.files.file_controller import sample_photos
from occ_gui.lessons import lesson_controller
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.values.choices import RoomChoice
from occ_gui.window.theme import ThemeController
from occ_model.errors import SceneFileError
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons


def test_opening_the_lessons_lists_them_and_changes_nothing(
    bench: Lessons, guide: LessonView, small_scene: Scene
) -> None:
    titles = [lesson.title for lesson in lessons().lessons]
    assert len(titles) == 13
    for button, title in zip(guide.list.choices, titles, strict=True):
        assert button.text().startswith(title)
    assert bench.scenes.scene == small_scene
    assert bench.scenes.undo_stack.count() == 0
    guide.list.choices[1].click()
    assert not guide.step.explanation.isVisible()
    guide.step.reveal.click()
    assert guide.step.explanation.isVisible()
    assert "<i>t</i><sub>r</sub>" in guide.step.explanation.text()
    assert guide.step.reveal.text() == "Hide the explanation"
    guide.step.next.click()
    assert not guide.step.explanation.isVisible()
    assert guide.step.reveal.text() == "Show the explanation"


def test_back_next_and_again_set_the_scene_and_progress_is_kept_and_ticked(
    bench: Lessons, guide: LessonView
) -> None:
    steps = lessons().lessons[0].steps
    guide.list.choices[0].click()
    guide.step.next.click()
    assert bench.scenes.scene == steps[1].scene
    bench.scenes.change(switching_frequency=9e3)
    guide.step.reset.click()
    assert bench.scenes.scene == steps[1].scene
    guide.step.back.click()
    assert bench.scenes.scene == steps[0].scene
    guide.step.next.click()
    guide.step.all_lessons.click()
    assert guide.list.choices[0].text().endswith("(step 2 of 3)")
    assert guide.list.choices[1].text().endswith(" steps)")
    bench.see("lessons", False)
    bench.see("lessons")
    guide.list.choices[0].click()
    assert "step 2 of 3" in guide.step.position.text()
    guide.step.next.click()
    assert guide.step.next.text() == "Done"
    assert bench.scenes.scene == steps[2].scene
    guide.step.next.click()
    assert guide.end.title.text() == "Done: What is a rolling shutter?"
    guide.end.all_lessons.click()
    assert guide.list.choices[0].text().startswith("✓ ")
    guide.list.choices[0].click()
    assert "step 1 of 3" in guide.step.position.text()


def test_a_sample_photo_is_open_only_while_steps_need_it(bench: Lessons, guide: LessonView) -> None:
    names: list[str] = []
    bench.photos.opened.connect(lambda p: names.append("" if p is None else p.path.stem))
    bench.press(guide.list.choices[5])
    assert bench.scenes.scene == lessons().lessons[5].steps[0].scene
    bench.press(guide.step.reset)
    bench.press(guide.step.next)
    assert names == ["led-1khz", "packets-6khz"]
    guide.step.all_lessons.click()
    bench.press(guide.list.choices[1])
    assert names == ["led-1khz", "packets-6khz", ""]


def test_the_users_photo_is_shown_where_a_lesson_is_about_it_or_it_was_opened_during_the_lesson(
    bench: Lessons, guide: LessonView, photo_file: Path
) -> None:
    bench.open(photo_file)
    bench.choose_sent("read")
    bench.press(guide.list.choices[1])
    assert bench.photos.choice.path is None
    bench.press(guide.step.all_lessons)
    assert bench.photos.choice.path == photo_file
    assert bench.photos.choice.form.sent == "read"
    bench.press(guide.list.choices[5])
    assert bench.photos.choice.path != photo_file
    bench.press(guide.step.all_lessons)
    assert bench.photos.choice.path == photo_file
    (sheet,) = [choice for choice in guide.list.choices if "readout" in choice.text()]
    sheet.click()
    for _ in range(3):
        guide.step.next.click()
    bench.wait_until_idle()
    assert bench.photos.choice.path == photo_file, "a lab sheet is about it"
    other = Path(shutil.copy(photo_file, photo_file.with_name("other.png")))
    bench.photos.open(other)  # during a lesson
    bench.wait_until_idle()
    bench.press(guide.step.all_lessons)
    assert bench.photos.choice.path == other


@pytest.mark.parametrize("error", [SceneFileError("a <song>."), RecursionError("too <song>")])
def test_lessons_that_cannot_be_read_are_reported_in_a_sentence(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def fail() -> None:
        raise error

    monkeypatch.setattr(lesson_controller, "lessons", fail)
    bench = Lessons(qtbot, small_scene)
    assert "<song>" in bench.guide.list.message.text()
    assert bench.guide.list.choices == []


def test_steps_name_samples_with_their_frequency() -> None:
    scenes = {path.stem: Scene.from_toml(path.with_suffix(".toml").read_text(encoding="utf-8"))
              for path in sample_photos()}  # fmt: skip
    steps = [step for lesson in lessons().lessons for step in lesson.steps if step.photo]
    assert steps
    for step in steps:
        frequency = scenes[step.photo].transmitter.switching_frequency
        assert step.scene.transmitter.switching_frequency == frequency, step.goal


@pytest.mark.parametrize("is_left", [True, False])
def test_a_sample_that_is_still_being_read_is_not_opened_after_its_step(
    bench: Lessons, guide: LessonView, is_left: bool
) -> None:
    (place,) = (i for i, each in enumerate(lessons().lessons) if each.name.startswith("lab-1"))
    with_photo = [i for i, step in enumerate(lessons().lessons[place].steps) if step.photo]
    photos = bench.photos
    guide.list.choices[place].click()
    for _ in range(with_photo[0]):
        guide.step.next.click()
    assert not photos.loading.task.is_idle
    if is_left:
        guide.step.all_lessons.click()
    else:
        for _ in with_photo:
            guide.step.next.click()
    bench.wait_until_idle()
    assert photos.choice.path is None


def test_a_missing_photo_is_reported(
    bench: Lessons, guide: LessonView, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lesson_controller, "sample_photos", list)
    guide.list.choices[5].click()
    assert bench.said[-1] == "The photo led-1khz is missing."


def test_the_list_follows_the_theme(guide: LessonView) -> None:
    themes = ThemeController()
    for theme, is_light in (("dark", False), ("light", True), ("dark", False), ("system", True)):
        themes.choose(theme)
        QApplication.processEvents()
        picture = guide.list.choices[0].grab().toImage()
        back = picture.pixelColor(picture.width() - 12, picture.height() // 2)
        assert (back.lightness() > 128) == is_light, theme


def view_of(workspace: Workspace) -> tuple[object, ...]:
    """Return what a step's question may be about besides the scene and the photo."""
    return (
        workspace.settings, workspace.decoder, workspace.picture_kind, workspace.is_enhanced,
        workspace.overlay, workspace.frame_rate,
    )  # fmt: skip


@pytest.mark.parametrize("number", range(13))
def test_each_step_sets_all_that_it_asks_about_and_the_end_restores_it(
    bench: Lessons, guide: LessonView, small_scene: Scene, number: int
) -> None:
    first, store = Workspace(small_scene), bench.store
    room = RoomChoice("mine.toml", small_room(), None, 0.03)
    own = replace(
        store.workspace, decoder="matched",
        settings=replace(FIRST_SETTINGS, tolerance=7.0, force={"jpeg": True}),
        picture_kind="receiver", is_enhanced=True, overlay="split", frame_rate=24.0, room=room,
    )  # fmt: skip
    store.put(own)
    guide.list.choices[number].click()
    for step in lessons().lessons[number].steps:
        bench.wait_until_idle()
        assert view_of(store.workspace) == view_of(
            replace(first, decoder=step.decoder or first.decoder)
        )
        assert store.workspace.scene == step.scene
        assert store.workspace.room == (first.room if step.pane == "room" else room)
        # Changes during a step belong to the lesson, not to the user's work.
        changed = replace(FIRST_SETTINGS, tolerance=30.0, force={"vignetting": True})
        store.put(
            replace(
                store.workspace, decoder="sequence", picture_kind="receiver", overlay="difference",
                settings=changed,
            )
        )  # fmt: skip
        guide.step.next.click()
    bench.wait_until_idle()
    assert guide.end.isVisible()
    assert store.workspace == own
    assert store.undo_stack.undoText() == "end of the lesson"
    guide.end.all_lessons.click()
    bench.press(guide.list.choices[number])
    assert view_of(store.workspace) == view_of(first)
    bench.press(guide.step.all_lessons)
    assert store.workspace == own


def test_undo_within_a_step_loses_nothing_of_the_users(
    bench: Lessons, guide: LessonView, small_scene: Scene
) -> None:
    own = replace(
        bench.store.workspace, decoder="matched", picture_kind="receiver", is_enhanced=True
    )
    bench.store.put(own)
    bench.press(guide.list.choices[1])
    bench.scenes.undo_stack.undo()
    assert bench.scenes.scene == small_scene
    guide.step.next.click()
    bench.press(guide.step.all_lessons)
    assert bench.store.workspace == own
