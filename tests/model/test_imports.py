"""The model stands alone: no window, nothing slow at start-up, and no need of Qt to be there."""

import inspect
import os
import subprocess
import sys
import sysconfig
import venv
from functools import cached_property
from importlib.metadata import files
from pathlib import Path
from types import FunctionType

import pytest

HEAVY = ("PySide6", "pyqtgraph", "superqt", "matplotlib", "scipy", "skimage", "PIL", "pandas")

PROCESSES = {"concurrent.futures.process", "multiprocessing", "tqdm"}
"""What only several processes need."""

USE = f"""
import sys

class Blocked:
    tried = []

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {HEAVY!r}:
            self.tried.append(name)
            raise ImportError(f"{{name}} is blocked here")

sys.meta_path.insert(0, Blocked())

import numpy as np
import occ_model as occ

preset = occ.load_preset("phone-136us").replace(rows=300, code=718)
for scene in preset, preset.replace(line_code="4b6b", framing="raw"):
    scene = occ.Scene.from_toml(scene.to_toml())
    frame = occ.render(scene)
    result = occ.decode(frame.image, scene)
    print(result.code, *frame.image.shape)
occ.sweep
print(*Blocked.tried)
print(*sys.modules)
"""


def run(program: str) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout


@pytest.mark.parametrize("module", ["occ_model", "occ_model.cli"])
def test_importing_the_model_imports_nothing_unneeded(module: str) -> None:
    loaded = run(f"import sys, {module}; print(*sys.modules)").split()
    assert module in loaded
    assert {name.partition(".")[0] for name in loaded} & {*HEAVY, "occ_gui"} == set()


def test_a_scene_is_decoded_without_heavy_packages_processes_or_plugins() -> None:
    paper, other, tried, modules = run(USE).splitlines()
    assert (paper, other.split()[1:]) == ("718 300 3456", ["300", "3456"])
    assert tried == ""
    loaded = {*modules.split()}
    assert {"occ_model.simulation.render", "occ_model.study.sweep.sweep"} <= loaded
    assert {name.partition(".")[0] for name in loaded} & {*HEAVY, "occ_gui"} == set()
    assert loaded & PROCESSES == set()
    assert "occ_model.transmitter.line_codes._4b6b" in loaded
    assert "occ_model.transmitter.line_codes._8b10b" not in loaded
    assert "importlib.metadata" not in loaded


def test_every_public_name_is_there_and_listed() -> None:
    import occ_model

    names = vars(occ_model)["__all__"]
    assert sorted(names) == names
    assert [name for name in names if not hasattr(occ_model, name)] == []
    assert {*names} <= {*dir(occ_model)}
    starred: dict[str, object] = {}
    exec("from occ_model import *", starred)
    assert starred.keys() - {"__builtins__"} == {*names}
    with pytest.raises(AttributeError, match="'occ_model' has no attribute 'nothing'"):
        occ_model.nothing  # type: ignore[attr-defined]  # noqa: B018


def test_all_that_the_package_offers_says_what_it_is() -> None:
    import occ_model

    silent = []
    for name in vars(occ_model)["__all__"]:
        offered = getattr(occ_model, name)
        if not (inspect.isfunction(offered) or inspect.isclass(offered)):
            continue
        parts: dict[str, object] = {name: offered}
        if inspect.isclass(offered):
            own = [kind for kind in offered.__mro__ if kind.__module__.startswith("occ_model")]
            parts |= {
                f"{name}.{key}": part
                for kind in own
                for key, part in vars(kind).items()
                if not key.startswith("_")
                and isinstance(part, FunctionType | property | cached_property | classmethod)
            }
        silent += [key for key, part in parts.items() if not inspect.getdoc(part)]
    assert silent == []


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


def run_module(
    python: Path | str, folder: Path, *arguments: str, module: str = "occ_model"
) -> subprocess.CompletedProcess[str]:
    """Run a program of the project in a folder, with another Python."""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT)}
    command = [str(python), "-W", "error", "-m", module, *arguments]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


@pytest.mark.whole
def test_the_commands_do_the_same_with_and_without_qt(python: Path, tmp_path: Path) -> None:
    outcomes = []
    for where, folder in ((python, tmp_path / "without"), (sys.executable, tmp_path / "with")):
        folder.mkdir()
        done = {name: run_module(where, folder, *words) for name, words in COMMANDS.items()}
        assert {name: each.stderr for name, each in done.items() if each.returncode} == {}
        assert (folder / "sweep.pdf").read_bytes().startswith(b"%PDF")
        written = [(folder / name).read_bytes() for name in ("picture.png", "sweep.csv")]
        outcomes.append((done["decode"].stdout, done["match"].stdout, written))
    assert outcomes[0] == outcomes[1]


def test_the_window_says_what_to_install(python: Path, tmp_path: Path) -> None:
    ended = run_module(python, tmp_path, "--screenshot", "window.png", module="occ_gui")
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert "PySide6 and pyqtgraph" in ended.stderr
    assert "pip install 'occ-explorer[gui]'" in ended.stderr
    assert run_module(python, tmp_path, "--version", module="occ_gui").returncode == 0
