"""The manual's plug-in works, names are words, and contradictory results are refused."""

import os
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from documents import FOLDER, blocks, text_of
from each_case import each_case
from model.plugins.installed_package import importable, install

import occ_model as occ
from occ_model import plugins
from occ_model.cli import main
from occ_model.receiver.decode import DECODERS
from occ_model.receiver.result_check import check_result

PAGE = text_of(FOLDER / "developers.md")

USE = """
import sys
import occ_model as occ
from occ_model.cli import main

print(occ.decoders()[-1], "occ_sampler" in sys.modules)
scene = occ.load_preset("phone-68us").replace(
    rows=100, distance=0.6, switching_frequency=4e3, enhancement="none", {changes}
)
result = occ.decode(occ.column_profile(scene), scene, decoder="sampler")
print(result.code == scene.transmitter.code, result.failure)
sys.exit(main(sys.argv[1:]) if sys.argv[1:] else 0)
"""


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of packages with that of the manual."""
    folder = tmp_path_factory.mktemp("packages")
    _, description = blocks(PAGE, "toml")
    project = tomllib.loads(description)["project"]
    module, _ = blocks(PAGE, "python")
    install(folder, project["name"], project["entry-points"], module)
    return folder


def run(packages: Path, *words: str) -> str:
    done = subprocess.run(
        [sys.executable, *words],
        env={**os.environ, "PYTHONPATH": str(packages)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout


SEEN = "sampler False\nTrue None\n"


@pytest.mark.whole
@pytest.mark.parametrize(
    "changes", ["line_code='manchester', framing='c-ook'", "line_code='4b6b', framing='raw'"]
)
def test_the_plugins_decoder_reads_what_is_sent_by_any_scheme(packages: Path, changes: str) -> None:
    assert run(packages, "-c", USE.format(changes=changes)) == SEEN


def test_the_plugins_decoder_is_imported_once_it_is_named_also_on_the_command_line(
    packages: Path, tmp_path: Path
) -> None:
    settings = ["--set", "rows=300", "--set", "distance=60cm", "--set", "switching_frequency=4kHz"]
    settings += ["--set", "enhancement=none", "--set", "payload=text:HI"]
    picture = tmp_path / "picture.png"
    assert main(["render", *settings, "-o", str(picture)]) == 0
    words = ("decode", str(picture), *settings, "--decoder", "sampler")
    said = run(packages, "-c", USE.format(changes=""), *words)
    assert said.startswith(SEEN)
    assert "payload      HI\n" in said


OTHERWISE = [
    "../x", "..", "/etc/x", "a/b", "a\\b", ".hidden", "a.b", "a b", "a,b", "<b>", "C:x", "x" * 61,
    "\u202egnp", "-x", "a\x1b[31m",
]  # fmt: skip
GROUPS = (plugins.DECODERS, plugins.LINE_CODES, plugins.FRAMINGS)


@pytest.fixture
def _installed(tmp_path: Path) -> Iterator[None]:
    names = dict.fromkeys((*OTHERWISE, "good-1_a"), "named:it")
    with importable(tmp_path, "named", dict.fromkeys(GROUPS, names), "it = 1"):
        yield


@pytest.mark.usefixtures("_installed")
@pytest.mark.parametrize("group", GROUPS)
def test_only_a_word_is_the_name_of_a_plug_in(group: str) -> None:
    assert plugins.plugin_names(group) == ("good-1_a",)


SCENE = occ.Scene().replace(bits=4, code=5)
READ = occ.DecodeResult(
    "own", code=5, bits=np.array([0, 1, 0, 1]), chips=np.array([1, 0]), headers=(0,)
)


IMPOSSIBLE: tuple[tuple[dict[str, Any], str], ...] = (
    ({"code": 2**70}, f"code = {2**70} with bits that are 5."),
    ({"code": None}, "code = None with bits that are 5."),
    ({"payload": "HI"}, "payload = 'HI' with bits that are ''."),
    ({"bits": np.array([1, 0]), "code": 2}, "2 bits in place of 4, and no failure."),
    ({"bits": np.array([0, 1, 0, 2])}, "bits that are not an array of zeros and ones."),
    ({"chips": np.zeros((2, 2))}, "chips that are not an array of zeros and ones."),
    ({"chip_starts": np.zeros(3)}, "chip_starts of the shape (3,); allowed: (2,)."),
    ({"light": np.zeros(19)}, "light of the shape (19,); allowed: (20,)."),
    ({"bit_likelihoods": np.ones(2)}, "bit_likelihoods of the shape (2,); allowed: (4,)."),
)  # fmt: skip


@each_case(IMPOSSIBLE)
def test_what_cannot_be_is_refused_with_what_is_allowed(parts: dict[str, Any], said: str) -> None:
    with pytest.raises(occ.PluginError) as caught:
        check_result("Own", replace(READ, **parts), 20, SCENE)
    assert str(caught.value) == f"Own gives {said}"


def test_a_result_of_the_program_passes_the_check_as_it_is() -> None:
    scene = occ.load_preset("phone-68us").replace(rows=40, payload="text:HI", distance=0.5)
    signal = occ.column_profile(scene)
    for name in DECODERS:
        read = DECODERS[name].read(signal, scene)
        found = check_result("Own", read, len(signal), scene)
        for field in fields(occ.DecodeResult):
            value, before = getattr(found, field.name), getattr(read, field.name)
            if field.name in ("runs", "histograms"):
                assert (value is None) == (before is None)
            elif isinstance(before, np.ndarray | float):
                np.testing.assert_allclose(value, before, rtol=1e-14)
            elif field.name != "decoder":
                assert value == before
        assert name == "sequence" or found.failure is None
