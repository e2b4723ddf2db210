"""The scene on the disk at all times: each window its own, and a full disk told of once."""

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from PySide6.QtCore import QSettings, QTimer
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.files import autosave as autosave_room
from occ_gui.files.autosave import Autosave
from occ_gui.files.preferences import Memory
from occ_gui.files.session import Session
from occ_gui.files.session_keeper import SessionKeeper
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.scene import Scene


def test_two_windows_do_not_take_each_other_for_a_crash(tmp_path: Path, qtbot: QtBot) -> None:
    first, second = Autosave(tmp_path), Autosave(tmp_path)
    stores = [SceneStore(Scene()), SceneStore(Scene())]
    for autosave, store in zip((first, second), stores, strict=True):
        autosave.follow(store)
        autosave.write()
    assert {path.name for path in tmp_path.glob("*.toml")} == {"scene-1.toml", "scene-2.toml"}
    assert second.recovered is None
    first.end()
    second.end()
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_told_of_once_and_again_after_it_had_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    autosave, store = Autosave(tmp_path), SceneStore(Scene())
    messages: list[str] = []
    autosave.failed.connect(messages.append)
    autosave.follow(store)
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        write(path, content[:7])
        raise OSError(28, "No space left on device")

    for _ in range(2):
        with monkeypatch.context() as patched:
            patched.setattr(Path, "write_bytes", full)
            autosave.write()
            autosave.write()
        autosave.write()
    assert len(messages) == 2
    assert "No space left on device" in messages[0]
    autosave.end()


def test_a_folder_that_cannot_be_made_is_told_of_and_the_window_works(
    tmp_path: Path, qtbot: QtBot
) -> None:
    (tmp_path / "file").write_text("")
    autosave = Autosave(tmp_path / "file" / "folder")
    messages: list[str] = []
    autosave.failed.connect(messages.append)
    autosave.follow(SceneStore(Scene()))
    autosave.write()
    assert len(messages) == 1
    autosave.end()


def test_the_scene_is_written_a_moment_after_it_was_changed(tmp_path: Path, qtbot: QtBot) -> None:
    autosave, store = Autosave(tmp_path), SceneStore(Scene())
    autosave.follow(store)
    store.change(iso=321.0)
    store.change(iso=322.0)
    assert not list(tmp_path.glob("*.toml"))
    qtbot.waitUntil(lambda: bool(list(tmp_path.glob("*.toml"))))
    (path,) = tmp_path.glob("*.toml")
    assert Scene.from_toml(path.read_text(encoding="utf-8")) == store.scene
    autosave.end()


@contextmanager
def scene_in_motion(store: SceneStore) -> Iterator[None]:
    """Change a scene again and again, sooner than any writing waits."""
    values = itertools.count(100.0)
    moves = QTimer()
    moves.timeout.connect(lambda: store.change(iso=next(values)))
    moves.start(5)
    yield
    assert moves.isActive()
    moves.stop()


def test_a_scene_that_never_rests_is_written_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr(autosave_room, "LONGEST_WAIT_MS", 100)
    autosave, store = Autosave(tmp_path), SceneStore(Scene())
    autosave.follow(store)
    written: set[str] = set()

    def is_written_twice() -> bool:
        written.update(path.read_text(encoding="utf-8") for path in tmp_path.glob("*.toml"))
        return len(written) == 2

    with scene_in_motion(store):
        qtbot.waitUntil(is_written_twice)
    autosave.end()


def test_the_session_of_a_scene_that_never_rests_is_kept_all_the_same(
    application: Application, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr(autosave_room, "LONGEST_WAIT_MS", 100)
    memory = Memory(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat))
    store = application.store
    keeper = SessionKeeper(
        store, application.settings, application.desktop.document, memory, lambda: None
    )
    keeper.resume(Autosave(tmp_path), Session(), scene_wins=True)
    kept: set[str] = set()

    def is_kept_twice() -> bool:
        kept.update({memory.recall("session/scene")} - {""})
        return len(kept) == 2

    with scene_in_motion(store):
        qtbot.waitUntil(is_kept_twice)
    keeper.end()
