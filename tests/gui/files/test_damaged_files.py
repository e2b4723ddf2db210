"""The window starts whatever the files contain that it reads at its start."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from gui.starts import Starts
from PySide6.QtCore import QSettings

from occ_gui.core.workspace import Workspace
from occ_gui.files.preferences import Preferences
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Kept
from occ_model.scene.scene import Scene


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


@pytest.mark.parametrize("kind", NO_FILES)
def test_what_is_no_file_is_neither_read_nor_keeps_a_session_from_being_written(
    tmp_path: Path, kind: str
) -> None:
    NO_FILES[kind](tmp_path / "session-1.json")
    file = SessionFile(tmp_path)
    assert (file.last, file.crashed) == (None, None)
    kept = Kept(Workspace(Scene()))
    file.write(kept, in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    assert again.last == kept
    again.close()


READ_SETTINGS = """
from occ_gui.app.start import kept_settings
print(kept_settings().value("view/margins"))
"""


def test_the_default_settings_are_those_of_the_users_folder(
    starts: Starts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "occ-explorer"
    folder.mkdir()
    (folder / "occ-gui.conf").write_text("[view]\nmargins=no\n", "ascii")
    monkeypatch.delenv("OCC_STATE")
    read = starts.run(program=READ_SETTINGS, XDG_CONFIG_HOME=str(tmp_path))
    assert (read.stdout, read.stderr) == ("no\n", "")


def test_a_value_of_a_kind_that_python_does_not_know_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "settings.ini"
    value = r"@Variant(\0\0\0\x39\0\0\0\0\x61)"
    keys = ("files/folder", "files/recent", "view/margins")
    sections = (f"[{key.split('/')[0]}]\n{key.split('/')[1]}={value}\n" for key in keys)
    path.write_text("".join(sections), "ascii")
    preferences = Preferences(QSettings(str(path), QSettings.Format.IniFormat))
    assert (preferences.folder, preferences.files, preferences.slider_strips) == ("", (), True)
