"""The model and its commands work where neither PySide6 nor pyqtgraph is installed."""

import os
import subprocess
import sys
import sysconfig
import venv
from importlib.metadata import files
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
WINDOW_PACKAGES = ("PySide6_Essentials", "shiboken6", "pyqtgraph")

SCENE = ("--preset", "phone-136us", "--set", "switching_frequency=8kHz", "--set", "rows=120")
SWEEP = ("--vary", "switching_frequency=8kHz,20kHz", "--images", "2")
PHOTO = PROJECT / "resources" / "photos" / "led-1khz.jpg"
COMMANDS = {
    "render": ("render", *SCENE, "--seed", "1", "-o", "picture.png"),
    "decode": ("decode", "picture.png", *SCENE),
    "match": ("match", str(PHOTO), "--led-frequency", "1kHz"),
    "sweep": ("sweep", *SCENE, *SWEEP, "--out", "sweep.csv", "--plot", "sweep.pdf"),
}


def installed_names(package: str) -> set[str]:
    """Return the top-level names that a package has put beside the others."""
    return {path.parts[0] for path in files(package) or () if path.parts[0] != ".."}


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment that shares all packages but the window's."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, with_pip=False)
    window = set.union(*map(installed_names, WINDOW_PACKAGES))
    base = {"base": str(folder)}
    packages = Path(sysconfig.get_path("purelib", "venv", base))
    for path in Path(sysconfig.get_path("purelib")).iterdir():
        if path.name not in window:
            (packages / path.name).symlink_to(path)
    return Path(sysconfig.get_path("scripts", "venv", base)) / Path(sys.executable).name


def run(
    python: Path | str, folder: Path, *arguments: str, module: str = "occ_model"
) -> subprocess.CompletedProcess[str]:
    """Run a program of the project in a folder, with another Python."""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT)}
    command = [str(python), "-W", "error", "-m", module, *arguments]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


def test_no_package_of_the_window_is_there(python: Path, tmp_path: Path) -> None:
    ask = "from importlib.metadata import distributions as d; print(*{p.name for p in d()})"
    listed = subprocess.run(
        [python, "-c", ask], cwd=tmp_path, check=True, capture_output=True, text=True
    ).stdout.split()
    assert "numpy" in listed
    assert not {"PySide6_Essentials", "shiboken6", "pyqtgraph"} & set(listed)


@pytest.mark.whole
def test_the_commands_do_the_same_with_and_without_qt(python: Path, tmp_path: Path) -> None:
    outcomes = []
    for where, folder in ((python, tmp_path / "without"), (sys.executable, tmp_path / "with")):
        folder.mkdir()
        done = {name: run(where, folder, *words) for name, words in COMMANDS.items()}
        assert {name: each.stderr for name, each in done.items() if each.returncode} == {}
        assert (folder / "sweep.pdf").read_bytes().startswith(b"%PDF")
        written = [(folder / name).read_bytes() for name in ("picture.png", "sweep.csv")]
        outcomes.append((done["decode"].stdout, done["match"].stdout, written))
    assert outcomes[0] == outcomes[1]


def test_the_window_says_what_to_install(python: Path, tmp_path: Path) -> None:
    ended = run(python, tmp_path, "--screenshot", "window.png", module="occ_gui")
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert "PySide6 and pyqtgraph" in ended.stderr
    assert "pip install 'occ-explorer[gui]'" in ended.stderr
    assert run(python, tmp_path, "--version", module="occ_gui").returncode == 0
