"""The state of a window is read as it was written; parts that are invalid get first values."""

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest
from full_workspaces import A_FILE, full_workspace

from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.files.session import LARGEST_FILE, SessionFile
from occ_gui.files.session_record import SavedSession, make_record, read_session
from occ_gui.values.choices import PhotoChoice, RoomChoice
from occ_model.scene.scene import Scene


def test_every_setting_is_restored(tmp_path: Path) -> None:
    first, workspace = Workspace(Scene()), full_workspace()
    same = [each.name for each in fields(first)
            if getattr(first, each.name) == getattr(workspace, each.name)]  # fmt: skip
    assert not same
    file = SessionFile(tmp_path)
    file.write(SavedSession(workspace), in_use=False)
    file.close()
    again = SessionFile(tmp_path)
    assert again.last == SavedSession(workspace)
    kept = again.last.workspace.pins[1]
    assert kept.request.more_decoders == ("sequence",)  # not compared between pins
    again.close()


DAMAGED: list[tuple[tuple[str, ...], object]] = [
    (("room", "camera"), {"x": "far"}),
    (("room", "camera"), [1]),
    (("room", "room"), "lamps = 3"),
    (("room", "room"), None),
    (("room", "focal_length"), -1.0),
    (("room", "photo"), "/nowhere/room.jpg"),
    (("photo", "load_options", "channel"), "infrared"),
    (("photo", "form", "sent"), "?"),
    (("photo", "form", "lamp_frequency"), -1.0),
    (("photo", "form", "fit_gamma"), 2),
    (("photo", "certain", "iso"), 100.0),
    (("photo", "certain", "readout_time"), "8"),
    (("settings", "tolerance"), -1),
    (("settings", "observable"), "sound"),
    (("settings", "observable"), []),
    (("settings", "force"), 3),
    (("settings", "force"), {"vignetting": 1}),
    (("settings", "seed"), -1),
]


@pytest.mark.parametrize(("place", "value"), DAMAGED)
def test_an_invalid_part_alone_gets_its_first_value(place: tuple[str, ...], value: object) -> None:
    workspace = full_workspace()
    first: dict[str, Any] = {
        "room": RoomChoice(),
        "photo": PhotoChoice(A_FILE, parts=workspace.photo.parts),
        "settings": FIRST_SETTINGS,
    }
    if place == ("room", "photo"):  # a file that is gone
        first["room"] = replace(workspace.room, photo=None)
    record: Any = make_record(SavedSession(workspace))
    at = record
    for name in place[:-1]:
        at = at[name]
    at[place[-1]] = value
    kept = read_session(record)
    assert kept.workspace == replace(workspace, **{place[0]: first[place[0]]})


LONG_NUMBER = "9" * 4000
DEEP = 1500

DAMAGED_SCENES = {
    "a number of 4,000 digits": f"format = 1\n[camera]\niso = {LONG_NUMBER}\n",
    "a longer number": f"format = 1\n[camera]\niso = {LONG_NUMBER * 2}\n",
    "a deep key": f"format = 1\n{'a.' * DEEP}a = 1\n",
    "a very deep list": f"format = 1\na = {'[' * 100_000}\n",
    "a deep parameter": f"format = 1\n[camera]\niso = {'{a=' * DEEP}1{'}' * DEEP}\n",
    "much": "format = 1\n#" + LARGEST_FILE * "x",
    "no text": "\ud800",
}


@pytest.mark.parametrize(
    "value", ["-" + LONG_NUMBER, LONG_NUMBER * 2, "[" * 100_000, '{"a": ' * DEEP + "1" + "}" * DEEP]
)
def test_a_session_with_numbers_or_lists_that_no_computer_needs_is_left_out(
    tmp_path: Path, value: str
) -> None:
    record = json.dumps(make_record(SavedSession(Workspace(Scene()))))
    text = record.replace('"seed": 1', f'"seed": {value}')
    assert value in text
    (tmp_path / "session-1.json").write_text(text, "ascii")
    file = SessionFile(tmp_path)
    kept = file.last  # None if the text is no longer valid JSON
    assert kept is None or kept.workspace.settings == FIRST_SETTINGS
    file.close()


@pytest.mark.parametrize("text", DAMAGED_SCENES.values(), ids=DAMAGED_SCENES)
def test_a_damaged_scene_of_a_crash_is_left_out_and_kept_aside(tmp_path: Path, text: str) -> None:
    record = json.dumps({"format": 1, "in_use": True, "scene": text})
    (tmp_path / "session-1.json").write_text(record, "ascii")
    file = SessionFile(tmp_path)
    assert (file.last, file.crashed) == (None, None)
    aside = (tmp_path / "session-1.unreadable").read_text("ascii")
    assert json.loads(aside) == {"format": 1, "in_use": True, "scene": text}
    file.close()
