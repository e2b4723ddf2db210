"""The session is always on disk, in a file for each window; a full disk is reported."""

import itertools
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from gui.kinds import collect
from gui.stores import store_of
from PySide6.QtCore import QTimer
from pytestqt.qtbot import QtBot

from occ_gui.core.workspace import Workspace
from occ_gui.files import session as session_module
from occ_gui.files.session import Session, SessionFile
from occ_gui.files.session_record import SavedSession
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.scene import Scene

Begin = Callable[[Path], Session]


@pytest.fixture
def scenes(qapp: object, small_scene: Scene) -> SceneStore:
    return store_of(small_scene)


@pytest.fixture
def begin(scenes: SceneStore) -> Begin:
    """Begin to write the session of a window into a folder."""

    def begin_in(folder: Path) -> Session:
        store = scenes.store
        session = Session(store, lambda: store.workspace)
        session.begin(SessionFile(folder), names_scene=True)
        return session

    return begin_in


def scenes_in(folder: Path) -> list[Scene]:
    paths = sorted(folder.glob("*.json"))
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    return [Scene.from_toml(record["scene"]) for record in records]


def test_two_open_windows_do_not_report_each_other_as_crashed(tmp_path: Path) -> None:
    first, second = SessionFile(tmp_path), SessionFile(tmp_path)
    for file in (first, second):
        file.write(SavedSession(Workspace(Scene())), in_use=True)
    third = SessionFile(tmp_path)
    assert {path.name for path in tmp_path.glob("*.json")} == {"session-1.json", "session-2.json"}
    assert [file.crashed for file in (first, second, third)] == [None] * 3
    for file in (first, second):
        file.write(SavedSession(Workspace(Scene())), in_use=False)
        file.close()
    third.close()
    assert SessionFile(tmp_path).crashed is None
    assert not list(tmp_path.glob("*.toml"))


def test_a_window_does_not_take_over_the_scene_of_another_that_is_open(tmp_path: Path) -> None:
    scenes = [Scene().replace(iso=iso) for iso in (99.0, 101.0)]
    former, first = SessionFile(tmp_path), SessionFile(tmp_path)
    for file, scene in zip((former, first), scenes, strict=True):
        file.write(SavedSession(Workspace(scene)), in_use=True)
    assert SessionFile(tmp_path).last is None
    former.write(SavedSession(Workspace(scenes[0])), in_use=False)
    former.close()
    second = SessionFile(tmp_path)
    assert second.last.workspace.scene == scenes[0]
    first.close()
    assert SessionFile(tmp_path).last == SavedSession(Workspace(scenes[1]))


def test_a_full_disk_and_a_folder_that_cannot_be_made_are_each_reported_once(
    begin: Begin, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = begin(tmp_path)
    messages = collect(session.status_message)
    write = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        write(path, content[:7])
        raise OSError(28, "No space left on device")

    for _ in range(2):
        with monkeypatch.context() as patched:
            patched.setattr(Path, "write_bytes", full)
            session.write()
            session.write()
        session.write()
    assert len(messages) == 2
    assert "No space left on device" in messages[0]
    session.end()
    (tmp_path / "file").write_text("")
    session = begin(tmp_path / "file" / "folder")
    session.status_message.connect(messages.append)
    session.write()
    assert len(messages) == 3
    session.end()


def test_a_changed_scene_is_written_after_a_moment_with_the_settings_in_one_file(
    begin: Begin, scenes: SceneStore, tmp_path: Path, qtbot: QtBot
) -> None:
    session, store = begin(tmp_path), scenes
    store.change(iso=321.0)
    store.change(iso=322.0)
    assert scenes_in(tmp_path) == []
    qtbot.waitUntil(lambda: scenes_in(tmp_path) == [store.scene])
    scenes.settings.set_tolerance(3.5)
    session.end()
    last = SessionFile(tmp_path).last
    assert last.workspace == scenes.store.workspace
    assert [path.name for path in tmp_path.glob("*.json")] == ["session-1.json"]


@contextmanager
def scene_in_motion(store: SceneStore) -> Iterator[None]:
    """Change a scene again and again, faster than the session is written."""
    values = itertools.count(100.0)
    moves = QTimer()
    moves.timeout.connect(lambda: store.change(iso=next(values)))
    moves.start(5)
    yield
    assert moves.isActive()
    moves.stop()


def test_a_scene_that_keeps_changing_is_written_nevertheless(
    begin: Begin,
    scenes: SceneStore,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    monkeypatch.setattr(session_module, "LONGEST_WAIT_MS", 100)
    session = begin(tmp_path)
    written: set[float] = set()

    def is_written_twice() -> bool:
        written.update(scene.camera.iso for scene in scenes_in(tmp_path))
        return len(written) == 2

    with scene_in_motion(scenes):
        qtbot.waitUntil(is_written_twice)
    session.end()
