"""The window starts whatever is in the files that it reads at the start."""

import os
import stat
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from gui.kinds import collect
from gui.starts import Starts
from PySide6.QtCore import QSettings

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.files.preferences import Preferences
from occ_gui.files.session import Session, SessionFile
from occ_gui.files.session_record import SavedSession
from occ_model.scene.scene import Scene


def make_large(path: Path) -> None:
    """Make a file that never ends when it is read."""
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
def test_what_is_not_a_file_is_not_read_and_does_not_prevent_the_writing_of_a_session(
    tmp_path: Path, kind: str
) -> None:
    NO_FILES[kind](tmp_path / "session-1.json")
    file = SessionFile(tmp_path)
    assert (file.last, file.crashed) == (None, None)
    kept = SavedSession(Workspace(Scene()))
    file.write(kept, in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    assert again.last == kept
    again.close()


COUNTS = ("9" * 4300, "9" * 5000, "-9", "1e999", "NaN", str(2**53), "true", '"7"', "[7]")


@pytest.mark.parametrize("count", COUNTS, ids=[text[:9] for text in COUNTS])
def test_an_invalid_count_does_not_prevent_the_writing_of_a_session(
    tmp_path: Path, count: str
) -> None:
    first, second = (SavedSession(Workspace(Scene().replace(iso=iso))) for iso in (111.0, 222.0))
    file = SessionFile(tmp_path)
    file.write(first, in_use=False)
    file.close()
    path = tmp_path / "session-1.json"
    text = path.read_text("ascii")
    path.write_text(text.replace('"count": 1', f'"count": {count}'), "ascii")
    assert path.read_text("ascii") != text
    for _ in range(2):
        file = SessionFile(tmp_path)
        file.write(second, in_use=False)
        file.close()
    again = SessionFile(tmp_path)
    assert again.last == second
    again.close()


OTHERS = {
    '{"format": 2, "scene": "of tomorrow"}': "its format is 2; allowed: 1.",
    '{"format": true}': "its format is True; allowed: 1.",
    "[1]": "its format is None; allowed: 1.",
    "{": "it is not a session.",
    "[" * 100_000: "it is not a session.",
    "\xff": "it is not text in UTF-8.",
    '{"format": 1, "scene": ""}': "contains no valid scene.",
}


def test_a_file_that_is_not_a_session_is_renamed_with_a_sentence(
    qapp: object, tmp_path: Path
) -> None:
    path = tmp_path / "session-1.json"
    for place, (text, reason) in enumerate(OTHERS.items(), 1):
        path.write_bytes(text.encode("latin-1"))
        file = SessionFile(tmp_path)
        name = f"session-1.unreadable{f'-{place}' * (place > 1)}"
        assert (tmp_path / name).read_bytes() == text.encode("latin-1")
        session = Session(Store(Workspace(Scene())), partial(Workspace, Scene()))
        said = collect(session.status_message)
        session.begin(file, names_scene=False)
        sentence = file.invalid_file_message
        assert said == [sentence]
        assert sentence.startswith(str(path))
        assert sentence.endswith(f"{reason} It is kept as {name}.")
        session.end()
        path.unlink()
    assert len([*tmp_path.glob("*.unreadable*")]) == len(OTHERS)


def test_a_file_that_cannot_be_renamed_is_not_overwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "session-1.json"
    path.write_text('{"format": 2}', "ascii")

    def refuse(*_arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "rename", refuse)
    file = SessionFile(tmp_path)
    file.write(kept := SavedSession(Workspace(Scene())), in_use=False)
    file.close()
    assert path.read_text("ascii") == '{"format": 2}'
    again = SessionFile(tmp_path)
    assert again.last == kept
    again.close()


KEEP = """
import os
from pathlib import Path
from PySide6.QtWidgets import QApplication
from occ_gui.app.start import open_preferences
from occ_gui.core.store import Workspace
from occ_gui.files.preferences import Preferences
from occ_gui.files.session import SessionFile, state_folder
from occ_gui.files.session_record import SavedSession
from occ_model.scene.scene import Scene

os.umask(0o022)
app = QApplication([])
file, settings = SessionFile(state_folder()), open_preferences()
preferences = Preferences(settings)
for name in ("a.png", "b.png"):
    preferences.add(Path(name))
    settings.sync()
    file.write(SavedSession(Workspace(Scene())), in_use=False)
print(settings.fileName(), flush=True)
os._exit(0)
"""


@pytest.mark.parametrize("folder", ["named", "usual"])
def test_what_the_program_keeps_about_the_user_is_readable_by_nobody_else(
    starts: Starts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, folder: str
) -> None:
    names = {"OCC_STATE": str(tmp_path / "state")}
    if folder == "usual":
        monkeypatch.delenv("OCC_STATE")
        names = {f"XDG_{kind}_HOME": str(tmp_path / kind.lower()) for kind in ("CONFIG", "STATE")}
    read = starts.run(program=KEEP, **names)
    assert read.stderr == ""
    found = {path.name: path for path in tmp_path.rglob("*") if path.is_file()}
    settings = Path(read.stdout.strip()).name
    assert found.keys() == {"session-1.json", "session-1.lock", settings}
    for path in found.values():
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
        assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
        path.chmod(0o644)  # as earlier versions left them
    found["session-1.json"].rename(found["session-1.json"].with_name("session-3.json"))
    found["session-1.lock"].rename(
        left := found["session-1.lock"].with_name("session-3.unreadable")
    )
    assert starts.run(program=KEEP, **names).stderr == ""
    again = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert left in again
    assert len(again) == 5
    assert {stat.S_IMODE(path.stat().st_mode) for path in again} == {0o600}


READ_SETTINGS = """
from occ_gui.app.start import open_preferences
print(open_preferences().value("view/strips"))
"""


def test_the_default_settings_are_those_of_the_users_folder(
    starts: Starts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "occ-explorer"
    folder.mkdir()
    (folder / "occ-gui.conf").write_text("[view]\nstrips=no\n", "ascii")
    monkeypatch.delenv("OCC_STATE")
    read = starts.run(program=READ_SETTINGS, XDG_CONFIG_HOME=str(tmp_path))
    assert (read.stdout, read.stderr) == ("no\n", "")


def test_a_value_of_a_kind_that_python_does_not_know_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "settings.ini"
    value = r"@Variant(\0\0\0\x39\0\0\0\0\x61)"
    keys = ("files/folder", "files/recent", "view/strips")
    sections = (f"[{key.split('/')[0]}]\n{key.split('/')[1]}={value}\n" for key in keys)
    path.write_text("".join(sections), "ascii")
    preferences = Preferences(QSettings(str(path), QSettings.Format.IniFormat))
    assert (preferences.folder, preferences.files, preferences.slider_strips) == ("", (), True)
