"""What a user has set for figures of their own does not reach the figures of this package."""

import os
import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.figure import Figure

from occ_model.figures.drawing import figure_bytes, house_style
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene

DRAW = """
import sys
from hashlib import sha256
from occ_model.figures.drawing import figure_bytes, house_style
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

with house_style():
    figure = Figure()  # without axes, which take as long to place as all else does
    figure.text(0.5, 0.5, "Grey level")
    figure.add_artist(Line2D([0.0, 1.0], [0.0, 1.0]))
    provenance = Provenance("A line", {"at hand": Scene()}, 1, (), "2026-01-01")
    print(sha256(figure_bytes(figure, "svg", provenance)).hexdigest())
"""

TASTE = "text.usetex: true\nlines.linewidth: 9\nfigure.facecolor: red\nfont.family: nowhere\n"


def drawn(folder: Path, **environment: str) -> str:
    """Draw a figure in a process of its own; give the hash of its file."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", DRAW],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The figure where nothing is set."""
    return drawn(tmp_path_factory.mktemp("plain"))


def taste(path: Path) -> None:
    path.write_text(TASTE, encoding="utf-8")


def undecodable(path: Path) -> None:
    path.write_bytes(b"lines.linewidth: 2 # \xff\xfe\n")


def test_no_settings_file_in_the_working_folder_reaches_a_figure(
    tmp_path: Path, plain: str
) -> None:
    taste(tmp_path / "matplotlibrc")
    assert drawn(tmp_path) == plain


@pytest.mark.parametrize(
    "variable", [pytest.param("MATPLOTLIBRC", marks=pytest.mark.whole), "MPLCONFIGDIR"]
)
def test_no_settings_file_named_elsewhere_reaches_a_figure(
    tmp_path: Path, plain: str, variable: str
) -> None:
    undecodable(tmp_path / "settings")
    taste(tmp_path / "matplotlibrc")
    work = tmp_path / "work"
    work.mkdir()
    place = tmp_path / "settings" if variable == "MATPLOTLIBRC" else tmp_path
    assert drawn(work, **{variable: str(place)}) == plain


def test_no_unknown_backend_or_unwritable_folder_stops_a_figure(tmp_path: Path, plain: str) -> None:
    # No user can create a folder under a file.
    taste(tmp_path / "file")
    nowhere = str(tmp_path / "file" / "folder")
    assert drawn(tmp_path, MPLBACKEND="nonsense", MPLCONFIGDIR=nowhere) == plain


def test_where_matplotlib_can_write_nowhere_a_sentence_says_so(tmp_path: Path) -> None:
    taste(tmp_path / "file")
    nowhere = str(tmp_path / "file" / "folder")
    program = (
        "import tempfile\n"
        f"tempfile.tempdir = {nowhere!r}\n"
        "from occ_model.errors import OutputError\n"
        "try:\n    import occ_model.figures\nexcept OutputError as error:\n    print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        env={**os.environ, "MPLCONFIGDIR": nowhere},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.startswith("Figures cannot be drawn: matplotlib does not start: ")
    assert done.stdout.count("\n") == 1


def test_figures_ignore_and_keep_settings_of_the_same_process() -> None:
    def draw() -> bytes:
        with house_style():
            figure = Figure()
            figure.subplots().plot([1, 2, 3])
            provenance = Provenance("A line", {"at hand": Scene()}, 1, (), "2026-01-01")
            return figure_bytes(figure, "svg", provenance)

    before = draw()
    with mpl.rc_context({"lines.linewidth": 9, "axes.facecolor": "red"}):
        assert draw() == before
        assert mpl.rcParams["lines.linewidth"] == 9


def test_the_environments_backend_serves_the_users_own_figures() -> None:
    program = (
        "import os, occ_model.figures, matplotlib\n"
        "print(matplotlib.rcParams['backend'], os.environ['MPLBACKEND'])\n"
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        env={**os.environ, "MPLBACKEND": "svg"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["svg", "svg"]
