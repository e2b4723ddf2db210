"""A user's settings for their own figures do not affect the figures of this package."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

DRAW = """
import os, sys
from hashlib import sha256
from occ_model.figures.drawing import figure_bytes, house_style
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from matplotlib import rcParams
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

def draw():
    with house_style():
        figure = Figure()  # without axes, which take as long to place as all else does
        figure.text(0.5, 0.5, "Grey level")
        figure.add_artist(Line2D([0.0, 1.0], [0.0, 1.0]))
        provenance = Provenance("A line", {"of this file": Scene()}, 1, (), "2026-01-01")
        return sha256(figure_bytes(figure, "svg", provenance)).hexdigest()

if __name__ == "__main__":
    print(draw(), rcParams["backend"].lower(), os.environ.get("MPLBACKEND"))
"""

TASTE = "text.usetex: true\nlines.linewidth: 9\nfigure.facecolor: red\nfont.family: nowhere\n"


def run_drawing(folder: Path, program: str = DRAW, **environment: str) -> list[str]:
    """Draw a figure in a new process; return the hash of its file, and the backend."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split(maxsplit=2)


@pytest.fixture(scope="module")
def draw() -> Callable[[], str]:
    program: dict[str, Any] = {"__name__": "program"}
    exec(DRAW, program)
    return program["draw"]


def user_settings(path: Path) -> Path:
    path.write_text(TASTE, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "variable", [pytest.param("MATPLOTLIBRC", marks=pytest.mark.whole), "MPLCONFIGDIR"]
)
def test_no_settings_file_reaches_a_figure_and_the_backend_stays_that_of_the_environment(
    tmp_path: Path, draw: Callable[[], str], variable: str
) -> None:
    """One file is in the working folder, one is named; the backend is for the user's figures."""
    work, settings = tmp_path / "work", tmp_path / "settings"
    work.mkdir()
    user_settings(work / "matplotlibrc")
    settings.write_bytes(b"lines.linewidth: 2 # \xff\xfe\n")
    place = (
        settings if variable == "MATPLOTLIBRC" else user_settings(tmp_path / "matplotlibrc").parent
    )
    for fonts in Path(mpl.get_cachedir()).glob("fontlist*.json"):
        shutil.copy(fonts, tmp_path)  # searching for all fonts again takes seconds
    found = run_drawing(work, MPLBACKEND="svg", **{variable: str(place)})
    assert found == [draw(), "svg", "svg\n"]


def test_a_sentence_says_that_matplotlib_can_write_nowhere(tmp_path: Path) -> None:
    nowhere = str(user_settings(tmp_path / "file") / "folder")
    program = (
        "import tempfile\n"
        f"tempfile.tempdir = {nowhere!r}\n"
        "from occ_model.errors import OutputError\n"
        "try:\n    import occ_model.figures\nexcept OutputError as error:\n    print(error)\n"
    )
    said = " ".join(run_drawing(tmp_path, program, MPLCONFIGDIR=nowhere))
    assert said.startswith("Figures cannot be drawn, as matplotlib does not start: ")
    assert said.count("\n") == 1


def test_figures_ignore_and_keep_settings_of_the_same_process(draw: Callable[[], str]) -> None:
    before = draw()
    with mpl.rc_context({"lines.linewidth": 9, "figure.facecolor": "red"}):
        assert draw() == before
        assert mpl.rcParams["lines.linewidth"] == 9
