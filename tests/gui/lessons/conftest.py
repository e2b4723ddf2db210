"""The lessons with controls and a photo, without the window around them."""

from dataclasses import replace
from pathlib import Path

import pytest
from gui.pane_bench import ControlsBench
from PySide6.QtWidgets import QAbstractButton
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import lessons
from occ_gui.files.preferences import Preferences
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.lessons.pane import LessonPane
from occ_gui.photo.photo_controller import PhotoController
from occ_model.scene.scene import Scene


class Lessons(ControlsBench):
    """The pane of the lessons in front, beside the controls."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.photos = PhotoController(self.store, self.results_store)
        feature = lessons(self.scenes, self.results_store, self.controls, Preferences(None))
        self.pane: LessonPane = self.add(feature)
        self.pane.noted.connect(self.said.append)
        self.guide: LessonView = self.pane.view

    def answer(self, text: str) -> str:
        answer_field = self.guide.step.answer_field
        answer_field.field.setText(text)
        answer_field.check.click()
        self.wait_until_idle()
        return answer_field.sentence.text()

    def press(self, button: QAbstractButton) -> None:
        button.click()
        self.wait_until_idle()

    def open(self, photo: Path) -> None:
        self.photos.open(photo)
        self.wait_until_idle()

    def choose_sent(self, sent: str) -> None:
        workspace = self.store.workspace
        form = replace(workspace.photo.form, sent=sent)
        self.store.put(replace(workspace, photo=replace(workspace.photo, form=form)))

    def wait_until_idle(self) -> None:
        task = self.photos.loading.task
        self._qtbot.waitUntil(lambda: self.shell.is_idle and task.is_idle)

    def stop(self) -> None:
        self.shell.stop()
        self.photos.loading.task.stop()


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Lessons:
    return Lessons(qtbot, small_scene)


@pytest.fixture
def guide(bench: Lessons) -> LessonView:
    return bench.guide
