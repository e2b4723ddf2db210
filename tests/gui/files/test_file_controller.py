"""Scenes and pictures are saved and opened; a refused file changes nothing."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from gui.kinds import SnapshotOf, collect
from gui.stores import store_of
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene


class FilesBench:
    """A controller without a window, and its messages."""

    def __init__(self, scene: Scene) -> None:
        self.store = store_of(scene)
        self.photos = PhotoController(store_of().store, ResultsStore())
        self.preferences = Preferences()
        self.shown: Snapshot | None = None
        self.waiting: list[Callable[[Snapshot], None]] = []
        self.files = FileController(
            None,
            self.store,
            self.photos,
            self.preferences,
            self._when_present,
        )
        self.status_message: list[str] = []
        for said in (self.files.status_message, self.files.failed):
            said.connect(self.status_message.append)

    def _when_present(self, use: Callable[[Snapshot], None]) -> None:
        if self.shown is None:
            self.waiting.append(use)
        else:
            use(self.shown)


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Iterator[FilesBench]:
    bench = FilesBench(small_scene)
    yield bench
    bench.photos.loading.task.stop()


def test_a_saved_scene_is_opened_exactly_as_it_was_in_one_step_that_can_be_undone(
    bench: FilesBench, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    bench.store.change(exposure_time=1e-4 / 3, pattern="0110", yaw=0.1)
    saved = bench.store.scene
    bench.files.save_scene(path)
    bench.store.put(Scene(), "something else")
    bench.files.open_scene(path)
    assert bench.store.scene == saved
    assert bench.status_message == ["Saved mine.toml", "Opened mine.toml"]
    assert bench.store.undo_stack.undoText() == "opening of mine.toml"
    bench.store.undo_stack.undo()
    assert bench.store.scene == Scene()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"this is no scene", ""),
        (b"format = 1\n[camera]\niso = -5.0\n", ""),
        (None, ""),
        (b"format = 99\n", "this version reads format 1"),
    ],
)
def test_a_file_that_is_not_a_scene_is_refused_and_the_scene_stays(
    bench: FilesBench, tmp_path: Path, small_scene: Scene, content: bytes | None, said: str
) -> None:
    path = tmp_path / "wrong.toml"
    if content is not None:
        path.write_bytes(content)
    bench.files.open_scene(path)
    (sentence,) = bench.status_message
    assert sentence.endswith((".", "?"))
    assert "Opened" not in sentence
    assert said in sentence
    assert bench.store.scene == small_scene
    assert bench.store.undo_stack.count() == 0


@pytest.mark.parametrize("what", ["scene", "picture"])
def test_what_cannot_be_written_gives_a_sentence_and_no_file(
    bench: FilesBench, tmp_path: Path, snapshot_of: SnapshotOf, what: str
) -> None:
    bench.shown = snapshot_of()
    nowhere = tmp_path / "nowhere"
    places = {
        "scene": (tmp_path, nowhere / "scene.toml"),
        "picture": (tmp_path / "p", tmp_path / "p.toml", nowhere / "p.png"),
    }
    for path in places[what]:
        getattr(bench.files, f"save_{what}")(path)
        assert path.name in bench.status_message[-1]
        assert "Saved" not in bench.status_message[-1]
    assert list(tmp_path.iterdir()) == []


def test_a_scene_inside_another_file_does_not_become_the_file_of_the_scene(
    bench: FilesBench, tmp_path: Path, qtbot: QtBot
) -> None:
    path = tmp_path / "scene.txt"
    path.write_text(Scene().to_toml(), encoding="utf-8")
    with qtbot.assertNotEmitted(bench.files.scene_opened):
        bench.files.open_scene(path)
    assert bench.store.scene == Scene()
    assert bench.status_message == ["Opened the scene inside scene.txt"]


@pytest.mark.parametrize("ending", ["png", "tif"])
def test_a_saved_picture_is_exactly_the_one_shown(
    bench: FilesBench, tmp_path: Path, snapshot_of: SnapshotOf, ending: str
) -> None:
    shown = bench.shown = snapshot_of(iso=400.0)
    path = tmp_path / f"picture.{ending}"
    bench.files.save_picture(path)
    assert bench.status_message == [f"Saved picture.{ending}: the camera's picture"]
    written = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    assert np.array_equal(written, shown.frame.camera_image)


def test_a_picture_saved_after_a_wait_is_of_the_kind_chosen_before_it(
    bench: FilesBench, tmp_path: Path, snapshot_of: SnapshotOf
) -> None:
    path = tmp_path / "picture.png"
    store = bench.store.store
    store.put(replace(store.workspace, picture_kind="receiver"))
    bench.files.save_picture(path)
    store.put(replace(store.workspace, picture_kind="camera"))
    assert bench.status_message == []
    assert list(tmp_path.iterdir()) == []
    shown = snapshot_of()
    (write,) = bench.waiting
    write(shown)
    assert "the receiver's picture" in bench.status_message[-1]
    written = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    assert np.array_equal(written, shown.frame.image)


def test_the_dialogs_answer_is_what_is_read_and_written(
    bench: FilesBench,
    tmp_path: Path,
    photo_file: Path,
    snapshot_of: SnapshotOf,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    answers = [tmp_path / "a.toml", tmp_path / "b.png", tmp_path / "a.toml", photo_file]
    dialogs = iter([(str(path), "") for path in answers])
    for ask in ("getOpenFileName", "getSaveFileName"):
        monkeypatch.setattr(QFileDialog, ask, lambda *_: next(dialogs))
    bench.shown = snapshot_of()
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([next(dialogs)[0]], ""))
    bench.files.ask_to_save_scene()
    bench.files.ask_to_save_picture()
    bench.files.ask_for_scene()
    assert bench.status_message == [
        "Saved a.toml",
        "Saved b.png: the camera's picture",
        "Opened a.toml",
    ]
    with qtbot.waitSignal(bench.photos.opened) as opened:
        bench.files.ask_for_photo()
    assert opened.args[0].path == photo_file


@pytest.mark.parametrize(("name", "written"), [("scene", ["scene.toml"]), ("scene.txt", [])])
def test_a_name_without_an_ending_gets_that_of_scenes_and_another_ending_is_refused(
    bench: FilesBench,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    written: list[str],
) -> None:
    answer = (str(tmp_path / name), "")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: answer)
    bench.files.ask_to_save_scene()
    assert [path.name for path in tmp_path.iterdir()] == written


def test_a_cancelled_dialog_does_nothing(
    bench: FilesBench, monkeypatch: pytest.MonkeyPatch, small_scene: Scene
) -> None:
    for ask in ("getOpenFileName", "getSaveFileName"):
        monkeypatch.setattr(QFileDialog, ask, lambda *_: ("", ""))
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([], ""))
    for ask_user in (
        bench.files.ask_for_photo,
        bench.files.ask_for_scene,
        bench.files.ask_to_save_scene,
        bench.files.ask_to_save_picture,
    ):
        ask_user()
    assert bench.status_message == []
    assert bench.photos.loading.task.is_idle
    assert bench.store.scene == small_scene


def test_several_photos_of_the_dialog_become_a_table_which_a_dialog_saves(
    bench: FilesBench,
    photo_file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    copy = tmp_path / "copy.png"
    copy.write_bytes(photo_file.read_bytes())
    names = [str(photo_file), str(copy)]
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (names, ""))
    wanted = collect(bench.files.pane_requested)
    with qtbot.waitSignal(bench.photos.opened) as opened:
        bench.files.ask_for_photo()
    assert bench.photos.choice.listed == (photo_file, copy)
    assert wanted == ["photo", "photos"]
    assert opened.args[0].path == photo_file
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "own"), ""))
    bench.files.ask_to_save_table("readout, µs\n")
    assert (tmp_path / "own.csv").read_bytes() == "readout, µs\n".encode()
    assert bench.status_message == ["Saved own.csv"]


def test_a_name_without_an_ending_writes_over_no_file(
    bench: FilesBench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The dialog asked only about the name as it was typed."""
    own = tmp_path / "own.csv"
    own.write_text("mine", encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "own"), ""))
    bench.files.ask_to_save_table("readout\n")
    assert own.read_text(encoding="utf-8") == "mine"
    assert bench.status_message[0].startswith("own.csv exists already")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(own), ""))
    bench.files.ask_to_save_table("readout\n")
    assert own.read_text(encoding="utf-8") == "readout\n"


def test_dialogs_begin_in_the_folder_of_the_last_file(
    bench: FilesBench,
    tmp_path: Path,
    photo_file: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    asked: list[str] = []
    for ask in ("getOpenFileName", "getOpenFileNames", "getSaveFileName"):
        monkeypatch.setattr(QFileDialog, ask, lambda *words: (asked.append(words[2]) or "", ""))
    dialogs = (
        bench.files.ask_for_photo,
        bench.files.ask_for_scene,
        bench.files.ask_to_save_scene,
        bench.files.ask_to_save_picture,
    )
    for ask_user in dialogs:
        ask_user()
    assert asked == ["", "", "scene.occ.toml", "simulation-camera.png"]
    with qtbot.waitSignal(bench.photos.opened):
        bench.photos.open(photo_file)
    asked.clear()
    for ask_user in dialogs:
        ask_user()
    folder = photo_file.parent
    saved = [str(folder / "scene.occ.toml"), str(folder / "simulation-camera.png")]
    assert asked == [str(folder), str(folder), *saved]
    (tmp_path / "deeper").mkdir()
    bench.files.save_scene(tmp_path / "deeper" / "scene.toml")
    bench.files.ask_for_scene()
    assert asked[-1] == str(tmp_path / "deeper")


def test_only_what_was_opened_or_saved_is_a_recent_file(
    bench: FilesBench, tmp_path: Path, small_scene: Scene
) -> None:
    bench.files.open_scene(tmp_path / "missing.toml")
    bench.files.save_scene(tmp_path / "missing" / "a.toml")
    assert bench.preferences.files == ()
    bench.files.save_scene(tmp_path / "a.toml")
    assert bench.preferences.files == (tmp_path / "a.toml",)
    bench.preferences.clear()
    bench.files.open_scene(tmp_path / "a.toml")
    assert bench.preferences.files == (tmp_path / "a.toml",)


@pytest.mark.parametrize("folder", ["/" + "a" * 300, "/a" * 4000, "/\x00", "/dev/null/a", "a" * 9])
def test_a_dialog_does_not_begin_in_an_impossible_folder(
    bench: FilesBench, tmp_path: Path, folder: str
) -> None:
    kept = QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)
    kept.setValue("files/folder", folder)
    kept.setValue("files/recent", [folder, folder])
    preferences = Preferences(kept)
    assert preferences.folder == ""
    for path in (*preferences.files, Path(folder)):
        bench.files.open_recent(path)
        assert "no longer there" in bench.status_message[-1]
        bench.files.open_dropped([path])
        assert "is not a file" in bench.status_message[-1]


def test_an_unusable_drop_is_answered_with_a_sentence(bench: FilesBench, tmp_path: Path) -> None:
    for dropped in ([], [tmp_path]):
        bench.files.open_dropped(dropped)
        assert bench.status_message[-1].endswith("; drop a photo, a film or a scene (.toml).")
        assert ("computer" in bench.status_message[-1]) == (not dropped)


def test_a_film_is_recognized_by_its_content(bench: FilesBench, tmp_path: Path) -> None:
    path = tmp_path / "without an ending"
    path.write_bytes(b"\x00\x00\x00\x18ftypisom")
    asked: list[Path] = []
    bench.files.film_requested.connect(asked.append)
    bench.files.open_dropped([path])
    bench.files.open_recent(path)
    assert asked == [path, path]
