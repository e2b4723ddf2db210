"""The session is on the disk at all times, a file for each window; a full disk is reported."""

import itertools
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.files import autosave as autosave_module
from occ_gui.files.autosave import Autosave
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Session
from occ_gui.scene.scene_store import SceneStore
from occ_model.effects.registry import NAMES
from occ_model.scene.scene import Scene

Begin = Callable[[Path], Autosave]


@pytest.fixture
def begin(application: Application) -> Begin:
    """Write the session of a window into a folder from now on."""

    def resume(folder: Path) -> Autosave:
        autosave = Autosave(
            application.store,
            application.document,
            application.kept.session,
        )
        autosave.resume(SessionFile(folder, NAMES), Session(), scene_wins=True)
        return autosave

    return resume


def scenes_in(folder: Path) -> list[Scene]:
    """Read the scenes of all session files."""
    paths = sorted(folder.glob("*.json"))
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    return [Scene.from_toml(record["scene"]) for record in records]


def test_two_windows_do_not_take_each_other_for_a_crash(tmp_path: Path) -> None:
    first, second = SessionFile(tmp_path, NAMES), SessionFile(tmp_path, NAMES)
    for file in (first, second):
        file.write(Session(Scene()), in_use=True)
    third = SessionFile(tmp_path, NAMES)
    assert {path.name for path in tmp_path.glob("*.json")} == {"session-1.json", "session-2.json"}
    assert [file.crashed for file in (first, second, third)] == [None] * 3
    for file in (first, second):
        file.write(Session(Scene()), in_use=False)
        file.close()
    third.close()
    assert SessionFile(tmp_path, NAMES).crashed is None
    assert not list(tmp_path.glob("*.toml"))


def test_a_full_disk_is_reported_once_each_time_it_fills(
    begin: Begin, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    autosave = begin(tmp_path)
    messages: list[str] = []
    autosave.status_message.connect(messages.append)
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


def test_a_folder_that_cannot_be_made_is_reported(begin: Begin, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    autosave = begin(tmp_path / "file" / "folder")
    messages: list[str] = []
    autosave.status_message.connect(messages.append)
    autosave.write()
    assert len(messages) == 1
    autosave.end()


def test_the_scene_is_written_a_moment_after_it_was_changed(
    begin: Begin, application: Application, tmp_path: Path, qtbot: QtBot
) -> None:
    autosave, store = begin(tmp_path), application.store
    store.change(iso=321.0)
    store.change(iso=322.0)
    assert scenes_in(tmp_path) == []
    qtbot.waitUntil(lambda: scenes_in(tmp_path) == [store.scene])
    autosave.end()


def test_the_settings_are_written_in_the_same_file_as_the_scene(
    begin: Begin, application: Application, tmp_path: Path
) -> None:
    autosave = begin(tmp_path)
    application.settings.set_tolerance(3.5)
    autosave.end()
    last = SessionFile(tmp_path, NAMES).last
    assert (last.scene, last.settings) == (application.store.scene, application.settings.settings)
    assert [path.name for path in tmp_path.glob("*.json")] == ["session-1.json"]


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
    begin: Begin,
    application: Application,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    monkeypatch.setattr(autosave_module, "LONGEST_WAIT_MS", 100)
    autosave = begin(tmp_path)
    written: set[float] = set()

    def is_written_twice() -> bool:
        written.update(scene.camera.iso for scene in scenes_in(tmp_path))
        return len(written) == 2

    with scene_in_motion(application.store):
        qtbot.waitUntil(is_written_twice)
    autosave.end()
