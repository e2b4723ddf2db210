"""The package of the manual, installed and used in an environment of its own."""

import os
import subprocess
import sys
import tomllib
import venv
from pathlib import Path

import pytest
from documents import FOLDER, blocks, text_of
from model.plugins.installed_package import install

from occ_model.cli import main

PAGE = text_of(FOLDER / "extending.md")

USE = """
import occ_model as occ

scene = occ.load_preset("phone-68us").replace(
    rows=100, distance=0.6, switching_frequency=4e3, enhancement="none", {changes}
)
result = occ.decode(occ.column_profile(scene), scene, decoder="sampler")
print(occ.decoders()[-1], result.code == scene.transmitter.code, result.failure)
"""


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The interpreter of an environment with this project and the package of the manual."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, symlinks=os.name != "nt", with_pip=False)
    (packages,) = folder.glob("**/site-packages")
    here = [path for path in sys.path if path and Path(path).is_dir()]
    (packages / "project.pth").write_text("\n".join(here), encoding="utf-8")
    _, description = blocks(PAGE, "toml")
    project = tomllib.loads(description)["project"]
    (module,) = blocks(PAGE, "python")
    install(packages, project["name"], project["entry-points"], module)
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def run(python: Path, *words: str) -> str:
    done = subprocess.run([python, *words], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout


def test_the_package_has_about_40_lines() -> None:
    lines = "".join(blocks(PAGE, "toml")[1:] + blocks(PAGE, "python")).splitlines()
    assert len([line for line in lines if line]) <= 45


@pytest.mark.parametrize(
    "changes",
    [
        "",
        pytest.param("line_code='manchester', framing='c-ook'", marks=pytest.mark.whole),
        pytest.param("line_code='4b6b', framing='raw'", marks=pytest.mark.whole),
    ],
)
def test_its_decoder_reads_what_is_sent(python: Path, changes: str) -> None:
    assert run(python, "-c", USE.format(changes=changes)) == "sampler True None\n"


def test_the_command_line_takes_its_name(python: Path, tmp_path: Path) -> None:
    settings = ["--set", "rows=300", "--set", "distance=60cm", "--set", "switching_frequency=4kHz"]
    settings += ["--set", "enhancement=none", "--set", "payload=text:HI"]
    picture = tmp_path / "picture.png"
    assert main(["render", *settings, "-o", str(picture)]) == 0
    said = run(python, "-m", "occ_model", "decode", str(picture), *settings, "--decoder", "sampler")
    assert "payload      HI\n" in said


def test_it_is_not_imported_before_it_is_named(python: Path) -> None:
    program = "import sys, occ_model as occ; occ.decoders(); print('occ_sampler' in sys.modules)"
    assert run(python, "-c", program) == "False\n"
