"""The user's presets in the window: saved, listed, replaced and deleted."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from gui.stores import show
from gui.user import User
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QInputDialog, QMessageBox

import occ_model as occ
from occ_gui.app.application import Application
from occ_model.scene.presets import (
    USER_FOLDER,
    delete_preset,
    preset_named,
    save_preset,
    user_presets,
)
from occ_model.scene.scene import Scene

Answer = Callable[[str, bool], None]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Let new windows read the user's own presets from a folder that contains an invalid file."""
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "rubbish.toml").write_bytes(b"\xff no preset")
    monkeypatch.setenv(USER_FOLDER, str(folder))
    return folder


@pytest.fixture(autouse=True)
def own(folder: Path, application: Application) -> Iterator[Path]:
    """Let the window list the presets of the folder, and remove them from its list afterwards."""
    application.presets.update()
    yield folder
    for path in folder.iterdir():
        path.unlink()
    application.presets.update()


@pytest.fixture
def answer(monkeypatch: pytest.MonkeyPatch) -> Answer:
    """Answer the dialog that asks for a name, and the one that asks whether to replace."""

    def give(name: str, replace: bool = False) -> None:
        yes, no = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No
        for ask in ("getText", "getItem"):
            monkeypatch.setattr(QInputDialog, ask, lambda *_: (name, bool(name)))
        monkeypatch.setattr(QMessageBox, "question", lambda *_: yes if replace else no)

    return give


@pytest.fixture
def matched(
    application: Application, user: User, photo_file: Path, remembered_matches: None
) -> Application:
    """Open a photo and match it, as if with a known LED."""
    user.open_photo(photo_file)
    application.view("photo").form.sent.show_key("lamp")
    application.shell.pane("photo").match()
    user.wait_until_idle()
    assert application.shell.pane("photo").matching.match is not None
    return application


def names(application: Application) -> list[str]:
    combo = application.controls.preset
    return [combo.itemData(place) or combo.itemText(place) for place in range(combo.count())]


@pytest.mark.own_window
def test_the_window_starts_in_spite_of_rubbish_among_presets(application: Application) -> None:
    assert names(application) == [*occ.presets(), "rubbish: cannot be read"]
    place = len(occ.presets())
    entries = application.controls.preset.model()
    assert not entries.flags(entries.index(place, 0)) & Qt.ItemFlag.ItemIsEnabled
    tip = application.controls.preset.itemData(place, Qt.ItemDataRole.ToolTipRole)
    assert "rubbish.toml cannot be read" in tip


def test_an_invalid_preset_does_not_affect_the_others(
    application: Application, user: User, own: Path
) -> None:
    bad = {
        "deep": "format = 1\n[camera]\niso" + ".a" * 1500 + " = 1",
        "long": "title = 0x" + "f" * 5000,
        "no title": "title = 1\n",
    }
    for name, text in bad.items():
        (own / f"{name}.toml").write_text(text)
    save_preset("good", Scene(), title="good")
    for name in bad:
        application.presets.load(name)
        assert f"{name}.toml" in user.message
    listed = [name for name in names(application) if name not in occ.presets()]
    assert listed == [f"{name}: cannot be read" for name in (*bad, "rubbish")]
    assert "good" in names(application)


def test_a_saved_match_is_listed_last_and_can_be_loaded_and_replaces_rubbish_on_request_only(
    matched: Application, user: User, answer: Answer, own: Path
) -> None:
    shown = user.choose_next_preset()
    answer("my phone", False)
    *before, unreadable = names(matched)
    matched.view("photo").result.save.click()
    assert matched.controls.preset.currentData() == shown
    assert names(matched) == [*before, "my phone", unreadable]
    assert user.message == "Saved the preset my phone"
    assert preset_named("my phone").title == "Measured from stripes.png"
    matched.controls.preset_chosen.emit("my phone")
    user.wait_until_idle()
    assert matched.scene_store.scene == matched.shell.pane("photo").matching.match.scene
    assert matched.controls.preset.currentText() == "my phone"
    answer("rubbish", False)
    matched.view("photo").result.save.click()
    assert (own / "rubbish.toml").read_bytes() == b"\xff no preset"
    user.choose("D&elete preset")
    assert not (own / "rubbish.toml").exists()
    assert "rubbish: cannot be read" not in names(matched)


def test_a_preset_is_replaced_and_deleted_on_request_and_a_missing_one_gives_a_sentence(
    matched: Application, user: User, answer: Answer, own: Path
) -> None:
    answer("phone-136us", False)
    matched.view("photo").result.save.click()
    assert user.message == "'phone-136us' is a preset of the program; choose another name."
    assert user_presets() == ()
    save_preset("mine", Scene())
    answer("", False)
    matched.view("photo").result.save.click()
    user.choose("D&elete preset")
    assert user_presets() == ("mine",)
    for replace in (False, True):
        answer("mine", replace)
        matched.view("photo").result.save.click()
        assert (preset_named("mine").scene != Scene()) == replace
    (own / "rubbish.toml").unlink()
    assert "mine" in names(matched)
    user.choose("D&elete preset")
    assert "mine" not in names(matched)
    assert user.message == "Deleted the preset mine"
    user.choose("D&elete preset")
    assert user.message == "There is no preset of your own."
    answer("mine", False)
    matched.view("photo").result.save.click()
    scene = matched.scene_store.scene
    delete_preset("mine")
    matched.controls.preset_chosen.emit("mine")
    assert user.message.startswith("There is no preset 'mine'.")
    assert "mine" not in names(matched)
    assert matched.scene_store.scene == scene


def test_without_a_match_there_is_nothing_to_save(application: Application, user: User) -> None:
    application.presets.ask_to_save_match(application.shell.pane("photo").matching)
    assert user.message == "There is no match to save yet."


def test_a_changed_preset_is_named_until_another_scene_comes(
    application: Application, user: User
) -> None:
    preset = application.controls.preset
    application.presets.load("phone-68us")
    assert preset.currentText() == "Phone, 68 µs"
    application.scene_store.change(iso=200.0)
    application.scene_store.change(distance=1.5)
    assert preset.currentIndex() == -1
    assert preset.placeholderText() == "Phone, 68 µs, changed"
    application.scene_store.undo_stack.undo()
    application.scene_store.undo_stack.undo()
    assert preset.currentText() == "Phone, 68 µs"
    application.scene_store.change(iso=200.0)
    other = occ.load_preset("tablet-61us").replace(iso=300.0)
    application.scene_store.put(other, "another scene")
    assert preset.placeholderText() == "Choose a preset"
    application.scene_store.undo_stack.undo()
    assert preset.placeholderText() == "Phone, 68 µs, changed"
    user.wait_until_idle()


def test_a_scene_that_is_a_preset_is_named_by_it_whatever_a_session_says(
    application: Application, user: User
) -> None:
    application.presets.load("phone-68us")
    show(application.scene_store.store, preset="tablet-61us")
    assert application.presets.shown_names == ("phone-68us", "")
    application.scene_store.change(iso=200.0)
    assert application.presets.shown_names == ("", "tablet-61us")
    user.wait_until_idle()


def test_a_preset_is_named_again_after_a_lesson(application: Application, user: User) -> None:
    preset = application.controls.preset
    application.window.bring_to_front("lessons")
    lessons = application.shell.pane("lessons").controller
    application.presets.load("phone-68us")
    for pattern, named in (
        ("", "Phone, 68 µs"),
        ("10", "Phone, 68 µs, changed"),  # two parameters differ from the scene of a lesson
    ):
        application.scene_store.change(pattern=pattern)
        assert (preset.currentText() or preset.placeholderText()) == named
        lessons.begin_first()
        application.scene_store.change(code=3)
        application.presets.load("phone-136us")
        application.lessons.end()
        assert (preset.currentText() or preset.placeholderText()) == named
    user.wait_until_idle()
