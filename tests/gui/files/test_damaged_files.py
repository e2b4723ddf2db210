"""The window starts whatever the files contain that it reads at its start."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from gui.kinds import add_widget
from gui.starts import PROJECT, Starts
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.files.kept_file import LARGEST
from occ_gui.files.preferences import Preferences
from occ_gui.files.session_file import SessionFile
from occ_gui.files.session_record import Kept
from occ_gui.lessons.answers import LessonAnswers
from occ_gui.lessons.lesson_controller import LessonController
from occ_gui.lessons.lesson_view import LessonView
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

LONG_NUMBER = "9" * 4000
DEEP = 1500

DAMAGED_SCENES = {
    "a number of 4,000 digits": f"format = 1\n[camera]\niso = {LONG_NUMBER}\n",
    "a format of 4,000 digits": f"format = {LONG_NUMBER}\n",
    "a longer number": f"format = 1\n[camera]\niso = {LONG_NUMBER * 2}\n",
    "a deep key": f"format = 1\n{'a.' * DEEP}a = 1\n",
    "a deep list": f"format = 1\na = {'[' * DEEP}{']' * DEEP}\n",
    "a very deep list": f"format = 1\na = {'[' * 100_000}\n",
    "a deep parameter": f"format = 1\n[camera]\niso = {'{a=' * DEEP}1{'}' * DEEP}\n",
    "much": "format = 1\n#" + LARGEST * "x",
    "no text": "\ud800",
}

DAMAGED_SETTINGS = {
    "a seed below zero of 4,000 digits": '"seed": -' + LONG_NUMBER,
    "a tolerance below zero of 4,000 digits": '"tolerance": -' + LONG_NUMBER,
    "a longer number": '"seed": ' + LONG_NUMBER * 2,
    "a deep list": '"observable": ' + "[" * DEEP + "]" * DEEP,
    "a very deep list": '"observable": ' + "[" * 100_000,
    "a switch that is no switch": '"force": {"vignetting": 1}',
    "a deep switch": '"force": ' + '{"vignetting": ' * DEEP + "1" + "}" * DEEP,
}


def make_large(path: Path) -> None:
    """Make a file that has no end, as far as anybody would wait."""
    with path.open("wb") as file:
        file.truncate(2**40)


Damage = Callable[[Path], object]
NO_FILES: dict[str, Damage] = {
    "a pipe": os.mkfifo,
    "an endless device": lambda path: path.symlink_to("/dev/zero"),
    "a folder": Path.mkdir,
    "a link to nothing": lambda path: path.symlink_to("nowhere"),
    "a link to itself": lambda path: path.symlink_to(path.name),
    "a large file": make_large,
}


def left_behind(folder: Path, **record: object) -> None:
    (folder / "session-1.json").write_text(json.dumps({"format": 1, **record}), "ascii")


@pytest.mark.parametrize("text", DAMAGED_SCENES.values(), ids=DAMAGED_SCENES)
def test_a_damaged_scene_in_the_session_is_left_out(tmp_path: Path, text: str) -> None:
    left_behind(tmp_path, in_use=False, scene=text)
    file = SessionFile(tmp_path)
    assert (file.last, file.crashed) == (None, None)
    file.close()


@pytest.mark.parametrize("text", DAMAGED_SETTINGS.values(), ids=DAMAGED_SETTINGS)
def test_damaged_settings_in_the_session_are_left_out(tmp_path: Path, text: str) -> None:
    file = SessionFile(tmp_path)
    file.write(Kept(Workspace(Scene(), SimulationSettings())), in_use=False)
    file.close()
    path = tmp_path / "session-1.json"
    whole = path.read_text("ascii")
    damaged = re.sub(
        r'("settings": \{[^}]*\}[^}]*)\}', lambda found: f"{found[1]}, {text}}}", whole
    )
    assert damaged != whole
    file = SessionFile(tmp_path)
    assert file.last is not None
    assert file.last.workspace.settings == SimulationSettings()
    file.close()
    path.write_text(damaged, "ascii")
    file = SessionFile(tmp_path)
    kept = file.last  # none where it is no JSON any more
    assert kept is None or kept.workspace.settings == FIRST_SETTINGS
    file.close()


@pytest.mark.parametrize("text", DAMAGED_SCENES.values(), ids=DAMAGED_SCENES)
def test_a_damaged_scene_of_a_crash_is_kept_aside(tmp_path: Path, qtbot: QtBot, text: str) -> None:
    left_behind(tmp_path, in_use=True, scene=text)
    file = SessionFile(tmp_path)
    assert file.crashed is None
    aside = (tmp_path / "session-1.unreadable").read_text("ascii")
    assert json.loads(aside) == {"format": 1, "in_use": True, "scene": text}
    file.close()


LOOK = """
import sys
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start
def start(*arguments):
    qt, application = begin(*arguments)
    application.store.change(iso=321.0)
    QTimer.singleShot(0, application.window.close)
    return qt, application
app.start = start
sys.exit(app.main([]))
"""


@pytest.mark.parametrize("kind", NO_FILES)
def test_what_is_no_file_does_not_keep_the_window_from_starting(
    tmp_path: Path, starts: Starts, kind: str
) -> None:
    NO_FILES[kind](tmp_path / "session-1.json")
    window = starts.run(program=LOOK, OCC_STATE=str(tmp_path))
    assert (window.returncode, window.stderr) == (0, "")


READ_SETTINGS = """
from occ_gui.app.start import kept_settings
print(kept_settings().value("view/margins"))
"""


def test_the_default_settings_are_those_of_the_users_folder(tmp_path: Path) -> None:
    folder = tmp_path / "occ-explorer"
    folder.mkdir()
    (folder / "occ-gui.conf").write_text("[view]\nmargins=no\n", "ascii")
    environment = {**os.environ, "XDG_CONFIG_HOME": str(tmp_path)}
    del environment["OCC_STATE"]
    read = subprocess.run(
        [sys.executable, "-c", READ_SETTINGS],
        cwd=PROJECT, env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (read.stdout, read.stderr) == ("no\n", "")


@pytest.mark.parametrize("folder", ["/" + "a" * 300, "/a" * 4000, "/\x00", "/dev/null/a", "a" * 9])
def test_a_folder_that_cannot_be_is_not_where_a_dialog_begins(
    application: Application, tmp_path: Path, folder: str
) -> None:
    kept = QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)
    kept.setValue("files/folder", folder)
    kept.setValue("files/recent", [folder, folder])
    preferences = Preferences(kept)
    assert preferences.folder == ""
    for path in (*preferences.files, Path(folder)):
        application.files.open_recent(path)
        assert "no longer there" in application.window.statusBar().currentMessage()
        application.files.open_dropped([path])
        assert "is not a file" in application.window.statusBar().currentMessage()


@pytest.mark.parametrize("kind", ["38", "39", "3f"])
def test_a_value_of_a_kind_that_python_does_not_know_is_left_out(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "settings.ini"
    value = rf"@Variant(\0\0\0\x{kind}\0\0\0\0\x61)"
    keys = ("files/folder", "files/recent", "view/margins")
    sections = (f"[{key.split('/')[0]}]\n{key.split('/')[1]}={value}\n" for key in keys)
    path.write_text("".join(sections), "ascii")
    preferences = Preferences(QSettings(str(path), QSettings.Format.IniFormat))
    assert (preferences.folder, preferences.files, preferences.slider_strips) == ("", (), True)


@pytest.mark.parametrize(
    "error",
    [RecursionError("too deep"), ValueError("9" * 5000), AttributeError("get"), KeyError(1)],
)
def test_unreadable_lessons_are_reported(
    application: Application, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def fail() -> None:
        raise error

    monkeypatch.setattr("occ_gui.lessons.lesson_controller.lessons", fail)
    view = add_widget(qtbot, LessonView())
    answers = LessonAnswers()
    LessonController(application.store.store, application.board, view, answers).set_seen(True)
    answers.runner.stop()
    told = [label.text() for label in view.findChildren(QLabel)]
    assert any(type(error).__name__ in text for text in told)
    assert not view.list.choices
