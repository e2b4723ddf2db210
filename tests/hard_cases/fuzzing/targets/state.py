"""Files that the window stores: sessions, and preferences with the layout of the panes."""

import base64
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import damage
import numpy as np

from hard_cases.fuzzing.mutations import encode_text, mutate_text, random_number
from hard_cases.fuzzing.target import FuzzTarget
from hard_cases.fuzzing.targets.typed import check_scene
from occ_model.scene.scene import Scene

if TYPE_CHECKING:  # Qt is slow to import, and only the targets of the window need it
    from occ_gui.files.session_record import SavedSession

SESSION, SETTINGS = "session-1.json", "settings.ini"
_LAYOUT = re.compile(r"(?<==)[A-Za-z0-9+/]{80,}=*")


@cache
def session_text() -> str:
    """Return the text of a complete session file."""
    from full_workspaces import full_workspace

    from occ_gui.core.store import History, StepChange
    from occ_gui.core.workspace import UndoState
    from occ_gui.files.session import SessionFile
    from occ_gui.files.session_record import SavedSession

    workspace = full_workspace()
    room = workspace.room
    assert room.room is not None
    steps = (
        StepChange("change", {"iso": 200.0}, {}),
        StepChange("room", {}, {"jpeg": True}, room, "phone-68us"),
        StepChange("move", {}, {"jpeg": True}, replace(room, room=room.room.replace(y=1.0))),
    )
    with TemporaryDirectory() as folder:
        file = SessionFile(Path(folder))
        session = SavedSession(workspace, History(UndoState(Scene(), {}), steps, done=1))
        file.write(session, in_use=True)
        file.close()
        return Path(folder, SESSION).read_text("ascii")


def _check_session(session: "SavedSession | None") -> None:
    """Check that a session is unchanged when it is written and read again."""
    from occ_gui.files.session import SessionFile

    if session is None:
        return
    check_scene(session.workspace.scene)
    with TemporaryDirectory() as folder:
        file = SessionFile(Path(folder))
        file.write(session, in_use=False)
        file.close()
        again = SessionFile(Path(folder))
        assert again.last == session, (again.last, session)
        again.close()


def _read_session(random: Random, folder: Path) -> list[str]:
    from occ_gui.core.workspace import Workspace
    from occ_gui.files.session import SessionFile
    from occ_gui.files.session_record import SavedSession

    text = session_text()
    if random.random() < 0.2:
        text = re.sub(r'(?<="count": )1', random_number(random), text)
    elif random.random() < 0.1:
        text = re.sub(r'(?<="format": )1', random_number(random), text)
    else:
        text = mutate_text(random, text)
    content = encode_text(random, text)
    (folder / SESSION).write_bytes(content)
    file = SessionFile(folder)
    _check_session(file.last)
    _check_session(file.crashed)
    kept = file.last or SavedSession(Workspace(Scene()))
    file.write(kept, in_use=False)
    file.close()
    again = SessionFile(folder)
    assert again.last == kept
    again.close()
    if file.invalid_file_message is None:
        assert file.last is not None
        return []
    (aside,) = folder.glob("*.unreadable")
    assert aside.read_bytes() == content
    return [file.invalid_file_message]


_INI = """[General]
[files]
recent={here}, /nowhere/photo.jpg
folder={folder}
[view]
margins=no
theme=dark
overlay=split
picture=camera
[window]
mode=effects
geometry=AdnQywADAAAAAAAAAAAAAAAAA+cAAAJXAAAAAAAAAAAAAAPnAAACVwAAAAACAAAAAyA=
[welcome]
seen=yes
"""

_QT_VALUES = (
    "@Invalid()", "@Variant(\\0\\0\\0\\x39\\0\\0\\0\\0\\x61)", "@ByteArray(\\x80\\0)",
    "@Size(1 2)",
    "@Rect(-1 -1 0 0)", "@Point(x y)", "@DateTime(\\0)", "@String(a)", "@@x", "\\x", '"',
    '"a, b",c',
    "@Variant(" + "\\0" * 400 + ")", ", , ,", "\\xd800", "\\x0",
)  # fmt: skip


def mutate_ini(random: Random, text: str) -> str:
    """Replace some values by texts that only Qt writes, and damage bytes of layouts."""
    lines = text.splitlines()
    rng = np.random.default_rng(random.getrandbits(32))
    for _ in range(random.choice((1, 2, 4))):
        place = random.randrange(len(lines))
        key, equals, _value = lines[place].partition("=")
        layout = _LAYOUT.search(lines[place])
        if layout is not None and random.random() < 0.7:
            content = damage.damage_bytes(rng, base64.b64decode(layout[0]))
            lines[place] = f"{key}={base64.b64encode(content).decode()}"
        elif equals:
            lines[place] = f"{key}={random.choice(_QT_VALUES)}"
    text = "\n".join(lines)
    return mutate_text(random, text) if random.random() < 0.5 else text


def _read_preferences(random: Random, folder: Path) -> list[str]:
    from PySide6.QtCore import QSettings

    from occ_gui.files.preferences import Preferences

    text = _INI.format(here=__file__, folder=folder)
    path = folder / SETTINGS
    path.write_bytes(encode_text(random, mutate_ini(random, text)))
    kept = Preferences(QSettings(str(path), QSettings.Format.IniFormat))
    for stored in kept.files:
        assert stored.is_absolute()
    assert kept.folder == "" or Path(kept.folder).is_dir()
    assert isinstance(kept.slider_strips, bool)
    for key in ("view/theme", "window/geometry", "window/mode", "welcome/seen", "a"):
        assert isinstance(kept.recall(key), str)
    kept.add(path)
    assert kept.files[0] == path
    return []


def _try_any(random: Random, folder: Path) -> list[str]:
    return random.choice((_read_session, _read_preferences))(random, folder)


STATE = FuzzTarget("settings", "sessions, preferences", _try_any, (), fraction=60)
