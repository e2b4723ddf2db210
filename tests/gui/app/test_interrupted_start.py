"""The window's start: Ctrl-C at any moment, and standard streams of any kind."""

import itertools
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet
from interruption import MOMENTS, interrupted

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


START = """
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
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    done = subprocess.run(
        [sys.executable, "-c", START], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["[]", "[]", "[]"]
