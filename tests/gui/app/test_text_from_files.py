"""Names, titles and notes from files are shown as plain text, never as markup."""

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from gui.kinds import show_widget
from gui.stores import show
from gui.user import User
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import Qt as RichText, QTextDocument
from PySide6.QtWidgets import QApplication, QLabel, QMenu, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.lessons.answers import LessonAnswers
from occ_gui.lessons.lesson_controller import LessonController
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.widgets.building import ElidedLabel
from occ_gui.widgets.plain_text import in_tool_tip, strip_mnemonics
from occ_model.results.teaching import LoadedLessons
from occ_model.scene.presets import USER_FOLDER, delete_preset, save_preset
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import lessons

TAG = "<img src=nothing.png>"
NAME = f"{TAG} & <b>bold\n\x1b[31m\u202egnp"
SHOWN = f"{TAG} & <b>bold\\n\\x1b[31m\\u202egnp"
MODEL = 0x0110
"""EXIF tag of the camera's model."""


def render_tip(tip: str) -> str:
    """Return the text that Qt shows for a tooltip."""
    if not RichText.mightBeRichText(tip):
        return tip
    document = QTextDocument()
    document.setHtml(tip)
    return document.toPlainText()


@pytest.fixture
def hostile_photo(tmp_path: Path, photo_file: Path) -> Path:
    path = tmp_path / f"{NAME}.png"
    notes = Image.Exif()
    notes[MODEL] = TAG
    with Image.open(photo_file) as photo:
        photo.save(path, exif=notes)
    return path


def texts(window: QWidget) -> Iterator[str]:
    """Yield every text of a window that Qt may interpret as rich text."""
    for widget in window.findChildren(QWidget):
        yield widget.toolTip()
        if isinstance(widget, QLabel) and widget.textFormat() != Qt.TextFormat.PlainText:
            yield widget.text()
    for menu in window.findChildren(QMenu):
        if menu.toolTipsVisible():
            yield from (action.toolTip() for action in menu.actions())


@pytest.mark.parametrize("text", [NAME, TAG, "a < b & c", "&lt;b&gt;", "1\n2 <b>3</b>\n4", "<!--"])
def test_a_tool_tip_shows_a_text_letter_by_letter(qapp: QApplication, text: str) -> None:
    assert render_tip(in_tool_tip(text)).split() == text.split()
    assert render_tip(in_tool_tip(text)).count("\n") == text.count("\n")


def test_a_label_and_its_tool_tip_show_the_same_line(qtbot: QtBot) -> None:
    label = show_widget(qtbot, ElidedLabel(NAME), 4000, 20)
    assert (label.text(), render_tip(label.toolTip())) == (SHOWN, SHOWN)


def test_neither_a_files_name_nor_its_notes_become_markup(
    application: Application, user: User, hostile_photo: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(USER_FOLDER, str(hostile_photo.parent / "presets"))
    save_preset("hostile", Scene(), title=NAME)
    window = application.window
    application.presets.update()
    application.files.open_file(hostile_photo)
    user.wait_until_idle()
    facts = application.view("photo").facts
    assert render_tip(facts.name.toolTip()).endswith(f"{SHOWN}.png")
    assert render_tip(facts.size_line.toolTip()).startswith(f"{TAG}, ")
    assert window.windowTitle().startswith(f"{SHOWN}.png")
    combo = application.controls.preset
    place = combo.findData("hostile")
    assert render_tip(combo.itemData(place, Qt.ItemDataRole.ToolTipRole)) == SHOWN
    recent = window.menus.recent.actions()[0]
    assert strip_mnemonics(recent.text()) == f"{SHOWN}.png"
    assert render_tip(recent.toolTip()).endswith(f"{SHOWN}.png")
    scene = hostile_photo.with_suffix(".toml")
    application.files.save_scene(scene)
    assert window.statusBar().currentMessage() == f"Saved {SHOWN}.toml"
    application.scene_store.change(iso=321.0)
    application.files.open_scene(scene)
    assert window.statusBar().currentMessage() == f"Opened {SHOWN}.toml"
    undo = application.scene_store.undo_stack.undoText()
    assert strip_mnemonics(undo) == f"opening of {SHOWN}.toml"
    assert not any(RichText.mightBeRichText(text) and "<img" in text for text in texts(window))
    delete_preset("hostile")
    application.presets.update()
    assert combo.findData("hostile") == -1


def test_a_scene_files_name_does_not_mark_a_change(application: Application) -> None:
    show(application.scene_store.store, scene_file=Path("/a[*]b.toml"))
    assert application.window.windowTitle().startswith("a[*][*]b.toml[*]")


def test_a_lessons_title_is_plain_text(
    application: Application, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    hostile = tuple(replace(each, title=f"{TAG} & co") for each in lessons().lessons)
    monkeypatch.setattr("occ_gui.lessons.lesson_controller.lessons", lambda: LoadedLessons(hostile))
    view, answers = LessonView(), LessonAnswers()
    qtbot.addWidget(view)
    controller = LessonController(
        application.scene_store.store, application.results_store, view, answers
    )
    answers.task.stop()
    controller.set_visible(True)
    assert strip_mnemonics(view.list.choices[0].text()).startswith(f"{TAG} & co")
    controller.choose(hostile[0].name)
    assert view.step.position.textFormat() == Qt.TextFormat.PlainText
    assert view.step.position.text().startswith(f"{TAG} & co · step 1")


def test_a_name_that_is_not_utf_8_is_shown_and_listed(
    application: Application, user: User, photo_file: Path
) -> None:
    path = Path(os.fsdecode(os.fsencode(photo_file.parent) + b"/caf\xe9.png"))
    photo_file.rename(path)
    user.open_photo(path)
    assert application.view("photo").facts.name.text().endswith("caf\\udce9.png")
    application.files.save_scene(path.with_suffix(".toml"))
    assert application.window.statusBar().currentMessage() == "Saved caf\\udce9.toml"
    assert path.with_suffix(".toml").is_file()
    recent = application.window.menus.recent.actions()[0]
    assert recent.text() == "caf\\udce9.toml"
