"""Starts of the window: in every locale, and interrupted at any moment."""

import itertools
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet
from gui.starts import Starts
from interruption import MOMENTS, run_and_interrupt

KINDS = ("window", "screenshot")

_LATEST = 2.0
"""Seconds to the last moment, when the window is shown and its processes work."""


def every_kind_and_moment() -> Iterator[ParameterSet]:
    """Pair both kinds of start with each moment; the quick tests run one kind for each."""
    for place, kind in itertools.product(range(MOMENTS), KINDS):
        is_quick = KINDS[place % len(KINDS)] == kind
        yield pytest.param(kind, place, marks=() if is_quick else pytest.mark.whole)


@pytest.mark.parametrize(("kind", "place"), list(every_kind_and_moment()))
def test_an_interrupted_start_is_one_line_and_leaves_no_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, place: int
) -> None:
    monkeypatch.setenv("OCC_STATE", str(tmp_path / "state"))
    picture = tmp_path / "w.png"
    words = ["--screenshot", str(picture)] if kind == "screenshot" else []
    delay = _LATEST * (place / MOMENTS) ** 2
    code, error = run_and_interrupt("occ_gui.__main__", words, delay)
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


def test_the_help_is_shown_in_any_encoding(starts: Starts) -> None:
    done = starts.run("--help", PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("usage: occ-gui")
    scene = ("--preset", "--scene", "--set", "--photo", "--tolerance", "--on", "--off")
    for option in (*scene, "--screenshot", "--size", "--dock", "--match", "--overlay"):
        assert option in done.stdout


BEGIN = """
import sys
import occ_model as occ
from occ_gui.app.command_line import start
from occ_gui.core.store import Workspace

qt, application = start(Workspace(occ.load_preset("phone-68us").replace(rows=200)), ["occ-gui"])
pictures = []
application.simulation.picture_ready.connect(pictures.append)
application.window.show()
while not pictures:
    qt.processEvents()
qt.processEvents()
late = ("pyqtgraph", "matplotlib", "scipy", "occ_gui.photo.photo_view", "occ_gui.lessons.pane")
print([name for name in late if name in sys.modules])
print([name for name in application.shell.help_pages if application.shell.find_pane(name)])
while not application.is_idle:
    qt.processEvents()
slow = ("contourpy", "matplotlib", "scipy", "skimage", "occ_gui.video.wiring",
        "occ_gui.bench.pane", "occ_gui.explanation.pane", "occ_gui.help.help_browser",
        "occ_gui.help.help_window", "occ_gui.lessons.pane",
        "occ_gui.spectrum.pane", "occ_model.photo.chips", "occ_model.photo.evidence",
        "occ_model.photo.fit", "occ_model.photo.lamps")
print([name for name in slow if name in sys.modules])
place = application.view("photo").placement.column
print(place.textFromValue(1234.5), place.valueFromText("2.5"))
application.window.close()
"""


def test_slow_imports_follow_the_first_picture_and_no_locale_changes_numbers() -> None:
    # Qt takes the format of numbers from the locale's name, even if it is not installed.
    variables = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "LC_ALL": "de_DE.UTF-8"}
    done = subprocess.run(
        [sys.executable, "-c", BEGIN], env=variables, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == ["[]", "[]", "[]", "1234.50 2.5"]


PROJECT = Path(__file__).resolve().parents[3]


def test_no_property_of_qt_is_set_by_a_keyword_starting_with_i() -> None:
    # PySide derives the setter from the first letter in upper case, which depends on the locale.
    calls = [
        f"{path.name}: {call}"
        for path in (PROJECT / "occ_gui").rglob("*.py")
        for call in re.findall(r"\bQ[A-Z]\w+\([^()]*\bi\w*=[^()]*\)", path.read_text("utf-8"))
    ]
    assert calls == []
