"""Starts of the window: in every locale, interrupted at any moment, and with plug-ins that hang."""

import itertools
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet
from gui.starts import Starts
from interruption import MOMENTS, interrupted
from model.plugins.installed_package import install

from occ_model import plugins

KINDS = ("window", "screenshot")

_LATEST = 2.0
"""Seconds after which the last moment is: the window is shown then, and its processes work."""


def every_kind_and_moment() -> Iterator[ParameterSet]:
    """Pair both kinds of start with each moment; every day each moment has one kind."""
    for place, kind in itertools.product(range(MOMENTS), KINDS):
        everyday = KINDS[place % len(KINDS)] == kind
        yield pytest.param(kind, place, marks=() if everyday else pytest.mark.whole)


@pytest.mark.parametrize(("kind", "place"), list(every_kind_and_moment()))
def test_an_interrupted_start_is_one_line_and_leaves_no_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, place: int
) -> None:
    monkeypatch.setenv("OCC_STATE", str(tmp_path / "state"))
    picture = tmp_path / "w.png"
    words = ["--screenshot", str(picture)] if kind == "screenshot" else []
    delay = _LATEST * (place / MOMENTS) ** 2
    code, error = interrupted("occ_gui.__main__", words, delay)
    if code == 0:  # shown by then, and closed; or drawn
        assert (error, kind == "window" or picture.is_file()) == ("", True)
    else:
        assert (code, error) == (130, "occ-gui: interrupted.\n")
        assert not picture.exists()


@pytest.mark.whole
@pytest.mark.parametrize("redirect", [">&-", ">&- 2>&-", "<&- >&- 2>&-"])
def test_a_window_needs_no_standard_streams(tmp_path: Path, redirect: str) -> None:
    picture = tmp_path / "w.png"
    shell = ("sh", "-c", f'exec "$@" {redirect}', "sh")
    done = subprocess.run(
        [*shell, sys.executable, "-m", "occ_gui", "--screenshot", picture, "--set", "rows=60"],
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp932"])
def test_the_help_is_shown_in_any_encoding(encoding: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "occ_gui", "--help"],
        capture_output=True,
        env={**os.environ, "PYTHONIOENCODING": encoding},
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.startswith(b"usage: occ-gui")
    scene = (b"--preset", b"--scene", b"--set", b"--photo", b"--tolerance", b"--on", b"--off")
    for option in (*scene, b"--screenshot", b"--size", b"--dock", b"--match", b"--overlay"):
        assert option in done.stdout


BEGIN = """
import sys
import occ_model as occ
from occ_gui.app.command_line import start
from occ_gui.core.workspace import Workspace

qt, application = start(Workspace(occ.load_preset("phone-68us").replace(rows=200)), ["occ-gui"])
pictures = []
application.simulation.picture_ready.connect(pictures.append)
application.window.show()
while not pictures:
    qt.processEvents()
qt.processEvents()
late = ("pyqtgraph", "matplotlib", "scipy", "occ_gui.photo.photo_view", "occ_gui.lessons.pane")
print([name for name in late if name in sys.modules])
print([name for name in application.shell.help_pages if application.shell.made_pane(name)])
while not application.is_idle:
    qt.processEvents()
slow = ("contourpy", "matplotlib", "scipy", "skimage", "occ_gui.video.wiring",
        "occ_gui.bench.pane", "occ_gui.explanation.pane", "occ_gui.help.help_browser",
        "occ_gui.help.help_window", "occ_gui.lessons.pane",
        "occ_gui.spectrum.pane", "occ_model.photo.chips", "occ_model.photo.evidence",
        "occ_model.photo.fit", "occ_model.photo.lamps")
print([name for name in slow if name in sys.modules])
application.window.close()
"""


def test_the_first_picture_is_there_before_any_pane_is_made_and_what_is_slow_to_import_later() -> (
    None
):
    done = subprocess.run(
        [sys.executable, "-c", BEGIN],
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    assert done.stdout.split() == ["[]", "[]", "[]"]


PROJECT = Path(__file__).resolve().parents[3]

CHARACTERS = """\
<code_set_name> UTF-8
<comment_char> %
<escape_char> /
<mb_cur_min> 1
<mb_cur_max> 6
CHARMAP
<U0000>..<U007F> /x00 ASCII
<U0130> /xc4/xb0 LATIN CAPITAL LETTER I WITH DOT ABOVE
<U0131> /xc4/xb1 LATIN SMALL LETTER DOTLESS I
END CHARMAP
"""

# What sets Turkish, Azerbaijani, Kurdish and Crimean Tatar apart, and a comma in numbers. Written
# out, because the sources of the real locales are in a package that few machines have.
RULES = """\
comment_char %
escape_char /
LC_CTYPE
upper <U0041>..<U005A>;<U0130>
lower <U0061>..<U007A>;<U0131>
digit <U0030>..<U0039>
space <U0009>..<U000D>;<U0020>
cntrl <U0000>..<U001F>;<U007F>
toupper {upper};(<U0131>,<U0049>)
END LC_CTYPE
LC_NUMERIC
decimal_point "<U002C>"
thousands_sep "<U002E>"
grouping 3;3
END LC_NUMERIC
"""

START = """
import ctypes
import locale
from PySide6.QtCore import QTimer
import occ_gui.app.command_line as app

begin = app.start

def start(*arguments):
    qt, application = begin(*arguments)
    def look():
        place = application.view("photo").placement.column
        print("i:", hex(ctypes.CDLL(None).towupper(ord("i"))))
        print("point:", locale.localeconv()["decimal_point"])
        print("code:", application.controls.code.number.text())
        print("place:", place.textFromValue(1234.5), place.valueFromText("2.5"))
        application.window.close()
    QTimer.singleShot(0, look)
    return qt, application

app.start = start
raise SystemExit(app.main(["--fresh", "--set", "rows=100", "--set", "code=718"]))
"""


@pytest.fixture(scope="module")
def locales(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a locale of the dotted capital I and the decimal comma."""
    folder = tmp_path_factory.mktemp("locales")
    letters = (chr(code) for code in range(ord("a"), ord("z") + 1))
    upper = {letter: 0x130 if letter == "i" else ord(letter.upper()) for letter in letters}
    pairs = ";".join(f"(<U{ord(low):04X}>,<U{high:04X}>)" for low, high in upper.items())
    (folder / "characters").write_text(CHARACTERS, encoding="ascii")
    (folder / "rules").write_text(RULES.format(upper=pairs), encoding="ascii")
    # What is left out warns, and without -c that is the end.
    subprocess.run(
        ["localedef", "-c", "-i", "rules", "-f", "characters", "./tr_TR.UTF-8"],
        cwd=folder, capture_output=True, check=False,
    )  # fmt: skip
    assert (folder / "tr_TR.UTF-8" / "LC_NUMERIC").is_file()
    return folder


# Qt takes the way of writing numbers from the name alone, whether there is such a locale or not.
@pytest.mark.parametrize(
    ("numbers", "point"),
    [
        ("tr_TR.UTF-8", ","),
        pytest.param("ar_EG.UTF-8", ".", marks=pytest.mark.whole),
        pytest.param("C", ".", marks=pytest.mark.whole),
        pytest.param("fa_IR.UTF-8", ".", marks=pytest.mark.whole),
    ],
)
def test_the_window_writes_numbers_alike_in_any_locale(
    locales: Path, tmp_path: Path, numbers: str, point: str
) -> None:
    own = {name: value for name, value in os.environ.items() if not name.startswith(("LC_", "LAN"))}
    environment = {
        **own, "QT_QPA_PLATFORM": "offscreen", "OCC_STATE": str(tmp_path / "state"),
        "LOCPATH": str(locales), "LC_CTYPE": "tr_TR.UTF-8", "LC_NUMERIC": numbers,
    }  # fmt: skip
    window = subprocess.run(
        [sys.executable, "-c", START],
        cwd=PROJECT, env=environment, capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (window.returncode, window.stderr) == (0, "")
    assert window.stdout.splitlines() == [
        "i: 0x130", f"point: {point}", "code: 718", "place: 1234.50 2.5",
    ]  # fmt: skip


def test_no_property_of_qt_is_set_by_a_keyword_starting_with_i() -> None:
    # PySide finds the setter by the capital of its first letter, which depends on the locale.
    given = [
        f"{path.name}: {call}"
        for path in (PROJECT / "occ_gui").rglob("*.py")
        for call in re.findall(r"\bQ[A-Z]\w+\([^()]*\bi\w*=[^()]*\)", path.read_text("utf-8"))
    ]
    assert given == []


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
