"""The bundle: its descriptions agree with the program, and it runs where there is no Python."""

import configparser
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from importlib.metadata import distribution, packages_distributions
from pathlib import Path

import pytest
from PIL import Image

import occ_model as occ
from occ_gui.app.command_line import make_parser

ROOT = Path(__file__).parents[2]
PACKAGING = ROOT / "resources" / "packaging"
LINUX = PACKAGING / "linux"
TYPE = "application/x-occ-scene+toml"


def test_every_description_names_this_version() -> None:
    described = ElementTree.parse(LINUX / "occ-explorer.metainfo.xml")
    assert described.findall("releases/release")[0].get("version") == occ.__version__
    start = (ROOT / "resources" / "docs" / "index.md").read_text(encoding="utf-8")
    assert f"version = {{{occ.__version__}}}" in start
    assert re.findall(r"^### ([\d.]+)", start, re.MULTILINE)[0] == occ.__version__
    install = (ROOT / "README.md").read_text(encoding="utf-8")
    named = re.findall(r"occ_explorer-([\d.]+)-", install)
    assert named == [occ.__version__] * len(named)
    assert named


def test_the_desktop_starts_the_program_with_a_file_or_none() -> None:
    entry = configparser.ConfigParser(interpolation=None)
    entry.optionxform = str  # type: ignore[assignment,method-assign]  # keys keep their case
    entry.read(LINUX / "occ-explorer.desktop", encoding="utf-8")
    program, *words = entry["Desktop Entry"]["Exec"].split()
    assert program == "occ-gui"
    for files in ([], ["scene.occ.toml"]):
        given = [file for word in words for file in (files if word == "%f" else [word])]
        assert make_parser().parse_args(given).files == [Path(file) for file in files]
    assert entry["Desktop Entry"]["MimeType"] == f"{TYPE};"
    name = entry["Desktop Entry"]["Icon"]
    assert (ROOT / "resources" / "icons" / f"{name}.svg").is_file()


def test_the_type_of_scene_files_is_that_of_saved_ones() -> None:
    space = {"mime": "http://www.freedesktop.org/standards/shared-mime-info"}
    (described,) = ElementTree.parse(LINUX / "occ-explorer.xml").findall("mime:mime-type", space)
    assert described.get("type") == TYPE
    (glob,) = described.findall("mime:glob", space)
    assert Path("scene.occ.toml").match(glob.get("pattern", ""))
    assert TYPE in (LINUX / "occ-explorer.metainfo.xml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bundle")
    command = [sys.executable, str(PACKAGING / "build.py"), "--to", str(folder)]
    subprocess.run(command, check=True, capture_output=True)
    return folder / "occ-explorer"


def run_alone(bundle: Path, program: str, *words: str, home: Path) -> str:
    """Run a program of the bundle where neither Python nor any other program is found."""
    nothing = {"HOME": str(home), "PATH": str(home / "nothing"), "LC_ALL": "C.UTF-8"}
    done = subprocess.run(
        [bundle / program, *words], env=nothing, check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr  # a progress bar may stand there
    return done.stdout


@pytest.mark.whole
@pytest.mark.skipif(sys.platform != "linux", reason="starts the bundle without a display")
def test_the_bundle_runs_without_python(bundle: Path, tmp_path: Path) -> None:
    picture = tmp_path / "window.png"
    run_alone(bundle, "occ-gui", "--screenshot", str(picture), home=tmp_path)
    with Image.open(picture) as drawn:
        assert len(drawn.convert("L").getcolors() or ()) > 50

    photo = ROOT / "resources" / "photos" / "led-1khz.jpg"
    words = ["match", str(photo), "--set", "pattern=01", "--set", "switching_frequency=2kHz"]
    usual = subprocess.run(
        [sys.executable, "-m", "occ_model", *words],
        check=True,
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
    )
    assert run_alone(bundle, "occ-model", *words, home=tmp_path) == usual.stdout

    film = tmp_path / "film.mp4"
    size = ["--set", "rows=240", "--set", "columns=320", "--frames", "3"]
    written = run_alone(bundle, "occ-model", "film", *size, "-o", str(film), home=tmp_path)
    assert "The file is lossy: in the first frame" in written  # it has been opened again

    table = tmp_path / "rates.csv"
    # The equalizer imports of scikit-image what the bundle has of it.
    sweep = ["sweep", "--vary", "switching_frequency=4kHz,8kHz", "--jobs", "2", "--images", "2",
             "--decoder", "equalizer"]  # fmt: skip
    run_alone(bundle, "occ-model", *sweep, "--out", str(table), home=tmp_path)
    assert table.read_text(encoding="utf-8").count(",equalizer,") == 2
    notice = (bundle / "NOTICE.txt").read_text(encoding="utf-8")
    owners = packages_distributions()
    held = {each for path in (bundle / "_internal").iterdir() for each in owners.get(path.name, ())}
    assert {"pillow", "pyqtgraph", "scipy"} < held
    assert [each for each in held if f"\n{each} {distribution(each).version}: " not in notice] == []
    texts = {path.name for path in (bundle / "licences").iterdir()}
    assert set(re.findall(r"licences/([^)\s]+)", notice)) == texts
