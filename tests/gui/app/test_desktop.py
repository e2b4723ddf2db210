"""Title, themes, keys, the palette, the readout at the mouse, and held brightness."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.kinds import GreyPicture, add_widget, collect
from gui.stores import store_of
from gui.user import User
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QMessageBox
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.help.help_window import HelpWindow
from occ_gui.help.pages import docs_folder, heading_id
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.scene.scene_store import SceneStore, new_gesture
from occ_gui.values.modes import PICTURE
from occ_gui.widgets.plot import Plot
from occ_gui.window.command_lists import (
    Command,
    CommandPalette,
    ShortcutSheet,
    commands_of,
    shortcuts_of,
)
from occ_model.scene.scene import Scene


def test_save_asks_for_a_file_once_and_the_title_marks_changes(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    dialogs: list[str] = []

    def ask(*_arguments: object) -> tuple[str, str]:
        dialogs.append("")
        return str(tmp_path / "mine"), ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", ask)
    window = application.window
    for iso in ("200", "300"):
        user.enter("iso", iso)
        user.choose("&Save scene")
    assert dialogs == [""]
    assert window.windowTitle().startswith("mine.toml[*]")
    assert not window.isWindowModified()
    user.enter("iso", "400")
    assert window.isWindowModified()
    application.scene_store.undo_stack.undo()
    assert not window.isWindowModified()
    assert "iso = 300.0" in (tmp_path / "mine.toml").read_text(encoding="utf-8")


@pytest.mark.own_window
def test_closing_asks_whether_to_save_what_the_file_of_the_scene_does_not_have(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    window, path, buttons = application.window, tmp_path / "lab.toml", QMessageBox.StandardButton
    asked: list[str] = []

    def answer(button: QMessageBox.StandardButton) -> None:
        def ask(*shown: object) -> QMessageBox.StandardButton:
            asked.append(str(shown[2]))
            return button

        monkeypatch.setattr(QMessageBox, "question", ask)

    answer(buttons.Cancel)
    user.enter("iso", "200")
    assert application.document.may_close()  # it has no file, and the next start shows it again
    application.files.save_scene(path)
    assert application.document.may_close()
    assert asked == []
    user.enter("iso", "300")
    window.close()
    assert window.isVisible()
    assert "lab.toml" in asked[0]
    monkeypatch.setattr(application.files, "save_scene", lambda _path: None)  # the disk is full
    answer(buttons.Save)
    assert not application.document.may_close()
    monkeypatch.undo()
    answer(buttons.Save)
    assert application.document.may_close()
    assert "iso = 300.0" in path.read_text(encoding="utf-8")
    user.enter("iso", "400")
    answer(buttons.Discard)
    window.close()
    assert not window.isVisible()
    assert "iso = 300.0" in path.read_text(encoding="utf-8")


def test_undo_and_redo_name_a_preset_as_the_list_does(application: Application, user: User) -> None:
    application.presets.load("phone-136us")
    user.choose("&Undo")
    assert user.message == "Undone: preset Phone, 136 µs."
    keys = {key.toString() for key in application.window.actions_by_name["redo"].shortcuts()}
    assert {"Ctrl+Y", "Ctrl+Shift+Z"} <= keys


def test_reset_is_one_step_and_the_menu_offers_an_animation(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    user.enter("iso", "200")
    before = application.scene_store.scene
    user.choose("Reset &scene")
    assert application.presets.name_of(application.scene_store.scene) == "phone-68us"
    application.scene_store.undo_stack.undo()
    assert application.scene_store.scene == before
    paths: list[str] = []
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *words: (paths.append(words[2]), ("", ""))[1]
    )
    user.choose("Distance…")
    assert [Path(path).name for path in paths] == ["distance.gif"]


def lightness_of_the_plots(application: Application) -> set[bool]:
    plots = application.window.findChildren(Plot)
    assert len(plots) > 4
    return {plot.backgroundBrush().color().lightness() > 128 for plot in plots}


def test_the_theme_changes_all_drawings(
    application: Application, user: User, grey_picture: GreyPicture
) -> None:
    themes = application.options.theme
    for pane in ("spectrum", "equations"):
        user.bring_to_front(pane)
    before = QApplication.palette().color(QPalette.ColorRole.Window)
    for theme, is_light in (("light", True), ("dark", False)):
        user.choose({"dark": "&Dark", "light": "&Light"}[theme])
        QApplication.processEvents()
        assert themes.theme == theme
        assert lightness_of_the_plots(application) == {is_light}
        window = application.window.palette().color(QPalette.ColorRole.Window)
        assert (window.lightness() > 128) == is_light
        rows = application.story.rows
        for row in (rows.light, rows.profile, rows.columns):
            assert (np.median(grey_picture(row)) > 128) == is_light
        axis = application.view("profile").plot.getAxis("left").textPen().color()
        assert (axis.lightness() < 128) == is_light
        ring = application.view("accuracy").plot.rings.opts["pen"].color()
        assert (ring.lightness() < 128) == is_light
    user.choose("&System")
    assert QApplication.palette().color(QPalette.ColorRole.Window) == before


def test_the_sheet_lists_every_entry_with_keys_and_every_pane_has_a_page_of_the_manual(
    application: Application, qtbot: QtBot
) -> None:
    rows = list(shortcuts_of(application.window.menuBar()))
    assert ("File", "Save scene", "Ctrl+S") in rows
    assert ("Edit", "Keep the brightness", "Ctrl+B") in rows
    assert len(rows) > 15
    sheet = ShortcutSheet(rows, application.window)
    assert sheet.table.rowCount() == len(rows)
    manual = add_widget(qtbot, HelpWindow(docs_folder()))
    pages = application.shell.pane("help").pages
    assert set(pages) == {*application.window.docks, PICTURE}
    for page in pages.values():
        name, _, heading = page.partition("#")
        text = (docs_folder() / name).read_text(encoding="utf-8")
        titles = [heading_id(line.lstrip("#")) for line in text.splitlines() if line[:1] == "#"]
        assert not heading or heading in titles, page
        manual.show_page(page)
        assert manual.browser.source().fileName() == name


def test_the_palette_finds_and_runs_a_command_by_keys_only(
    application: Application, qtbot: QtBot
) -> None:
    runs: list[str] = []
    commands = [
        Command(f"File: {name}", "", partial(runs.append, name))
        for name in ("Save scene", "Save scene as…", "Quit")
    ]
    palette = CommandPalette(commands, application.window)
    palette.show()
    qtbot.keyClicks(palette.line, "sce save")
    assert palette.list.count() == 2
    qtbot.keyClick(palette.line, Qt.Key.Key_Down)
    qtbot.keyClick(palette.line, Qt.Key.Key_Return)
    assert palette.chosen is commands[1]
    assert palette.result() == QDialog.DialogCode.Accepted
    palette = CommandPalette(commands, application.window)
    qtbot.keyClicks(palette.line, "nothing like it")
    qtbot.keyClick(palette.line, Qt.Key.Key_Return)
    assert palette.chosen is None


def test_the_palette_finds_an_entry_by_its_search_words_and_jumps_to_a_parameter(
    application: Application,
) -> None:
    window = application.window
    commands = commands_of(window.menuBar(), application.controls, window.bring_to_front)
    palette = CommandPalette(commands, window)
    for words, title in (
        ("gif", "Animation of a slider: Exposure time"),
        ("animation", "Animation of a slider: Exposure time"),
        ("film", "Open film"),
        ("film", "Animation of a slider: Exposure time"),
        ("bits", "Mode: Limits"),
        ("pdf", "Column profile"),
        ("full screen", "Full screen"),
        ("projector", "Full screen"),
    ):
        palette.line.setText(words)
        texts = [palette.list.item(place).text() for place in range(palette.list.count())]
        assert any(title in text for text in texts), (words, title, texts)
        by_name = [words in text.casefold() for text in texts]
        assert by_name == sorted(by_name, reverse=True), words  # matches in the name come first
    (jump,) = [each for each in commands if each.matches(["f-number", "main"])]
    other = next(each for each in commands if each.matches(["panel and camera", "gamma"]))
    window.activateWindow()
    for command in (other, jump):
        command.run()
        QApplication.processEvents()
        field = window.focusWidget()
        assert field.isVisible()
    assert field is application.controls.main_rows()["f_number"].field


def test_the_status_line_shows_what_is_under_the_mouse(
    application: Application, qtbot: QtBot
) -> None:
    application.story.show_whole_picture(True)
    readout, view = application.window.readout, application.view("picture").simulation.graphics
    qtbot.mouseMove(view.viewport(), view.viewport().rect().center())
    qtbot.waitUntil(lambda: readout.text().startswith("Simulation: column "))
    application.window.bring_to_front("profile")
    QApplication.processEvents()
    plot = application.view("profile").plot
    place = plot.mapFromScene(plot.getViewBox().sceneBoundingRect().center())
    qtbot.mouseMove(plot.viewport(), QPoint(place))
    qtbot.waitUntil(lambda: readout.text().startswith("Profile: column "))


@pytest.fixture
def hold(qtbot: QtBot) -> tuple[SceneStore, SceneEditor, list[str]]:
    store = store_of(Scene().replace(exposure_time=100e-6, iso=200.0))
    editor = SceneEditor(store)
    messages = collect(editor.brightness.status_message)
    editor.brightness.switch(True)
    return store, editor, messages


def product(store: SceneStore) -> float:
    return store.scene.camera.iso * store.scene.camera.exposure_time


def test_held_brightness_sets_the_iso_speed_in_the_same_step_and_reports_its_limit(
    hold: Any,
) -> None:
    store, editor, messages = hold
    before, light = store.scene, product(store)
    gesture = new_gesture()
    for time in (90e-6, 50e-6, 60e-6):
        editor.edit("exposure_time", time, gesture)
        assert product(store) == pytest.approx(light, rel=1e-12)
    assert store.undo_stack.count() == 1
    store.undo_stack.undo()
    assert store.scene == before
    assert messages == []
    light = product(store)
    editor.edit("exposure_time", 1e-9, new_gesture())
    assert "cannot be kept" in messages[-1]
    assert product(store) < light
    editor.edit("exposure_time", 100e-6, new_gesture())
    assert product(store) == pytest.approx(light, rel=1e-12)


def test_a_brightness_set_by_hand_is_held_from_then_on(hold: Any) -> None:
    store, editor, _ = hold
    editor.edit("iso", 400.0, new_gesture())
    editor.edit("exposure_time", 50e-6, new_gesture())
    assert store.scene.camera.iso == pytest.approx(800.0)
    editor.brightness.switch(False)
    editor.edit("exposure_time", 100e-6, new_gesture())
    assert store.scene.camera.iso == pytest.approx(800.0)


def test_the_view_menu_hides_the_strips_and_the_choice_is_stored(application: Application) -> None:
    strips, entry = application.slider_strips.strips.values(), "slider_strips"
    for are_shown in (False, True):
        application.window.actions_by_name[entry].trigger()
        QApplication.processEvents()
        assert {strip.isVisible() for strip in strips} == {are_shown}
        assert application.background_rates.slider_strips.is_idle or are_shown
        assert application.preferences.slider_strips == are_shown


def test_each_button_of_the_welcome_page_leads_to_its_mode(
    application: Application, user: User, small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    dialogs: list[object] = []
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *a: dialogs.append(a) or ("", ""))
    page = application.shell.pane("welcome")
    modes = {"photo": "photo", "explore": "explore", "bars": "limits", "learn": "lessons"}
    for task, mode in modes.items():
        assert application.scene_store.scene == small_scene
        user.choose("&Welcome…")
        page.dialog.buttons[task].click()
        user.wait_until_idle()
        assert application.window.modes.mode == mode
        assert page.dialog is None
        assert len(dialogs) == 1  # opened by the first button only
        asks_for_lamp = application.shell.pane("bands").view.lamp.form.lamp.isVisible()
        assert asks_for_lamp == (task == "bars")
    place = application.shell.pane("lessons").view.step.position.text()
    assert place == "What is a rolling shutter? · step 1 of 3"
