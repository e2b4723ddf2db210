"""A window whose plug-in never comes back can be closed, and names it."""

import json
from pathlib import Path

import pytest
from gui.starts import Starts
from model.plugins.installed_package import install

from occ_model import plugins

MODULE = """
import time
from dataclasses import replace
from pathlib import Path

import occ_model as occ
from occ_model.transmitter.line_codes.manchester import LINE_CODE


def sleep(*_):
    Path(__file__).with_name("begun").touch()
    while True:
        time.sleep(1)


def loop(*_):
    Path(__file__).with_name("begun").touch()
    while True:
        pass


sleeper = occ.Decoder("sleeper", "Sleeper", sleep)
looper = occ.Decoder("looper", "Looper", loop)
dreamer = replace(LINE_CODE, name="dreamer", encode=sleep)
"""

CLOSE = """
import sys
from pathlib import Path

sys.path.insert(0, {folder!r})
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start
def start(*arguments):
    qt, application = begin(*arguments)
    looks = QTimer(application)
    def look():
        # Decoders are looked for after the first picture, which a code that hangs never makes.
        if {decoder!r}:
            if not application.view("decode").decoders.count() > 4:
                return
            application.view("decode").choose_decoder({decoder!r})
        if Path({folder!r}, "begun").exists():
            looks.stop()
            application.store.change(iso=321.0)
            application.window.close()
    looks.timeout.connect(look)
    looks.start(20)
    shown = application.simulation.snapshot_shown
    shown.connect(lambda _: application.store.change(line_code={code!r}))
    return qt, application
app.start = start
sys.exit(app.main(["--set", "rows=100"]))
"""


@pytest.mark.whole
@pytest.mark.parametrize(
    ("hangs", "changes"),
    [
        ("sleeper", {"decoder": "sleeper", "code": "manchester"}),
        ("looper", {"decoder": "looper", "code": "manchester"}),
        ("dreamer", {"decoder": "", "code": "dreamer"}),
    ],
)
def test_a_window_whose_plug_in_hangs_closes_with_its_session_kept(
    starts: Starts, tmp_path: Path, hangs: str, changes: dict[str, str]
) -> None:
    named = {name: f"hanging:{name}" for name in ("sleeper", "looper", "dreamer")}
    groups = {plugins.DECODERS: named, plugins.LINE_CODES: named}
    install(tmp_path, "hanging", groups, MODULE)
    state = tmp_path / "state"
    program = CLOSE.format(folder=str(tmp_path), **changes)
    ended = starts.run(program=program, OCC_STATE=str(state))
    assert ended.returncode == 0
    assert ended.stderr == (
        f"occ-gui: The plug-in '{hangs}' of the package 'hanging' does not come back: the window "
        "has ended without it.\n"
    )
    record = json.loads((state / "session-1.json").read_text("ascii"))
    assert "iso = 321.0" in record["scene"]
    assert record["in_use"] is False
