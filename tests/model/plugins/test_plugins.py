"""The manual's plug-in works, names are words, and whatever a result holds is checked."""

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
from model.plugins.installed_package import install

import occ_model as occ
from occ_model import plugins
from occ_model.cli import main
from occ_model.receiver.decoders import checked_result

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
def test_its_decoder_reads_what_is_sent_by_any_scheme(packages: Path, changes: str) -> None:
    assert run(packages, "-c", USE.format(changes=changes)) == SEEN


def test_its_decoder_is_imported_once_it_is_named_also_on_the_command_line(
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
def _installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    names = dict.fromkeys((*OTHERWISE, "good-1_a"), "named:it")
    install(tmp_path, "named", dict.fromkeys(GROUPS, names), "it = 1")
    monkeypatch.syspath_prepend(tmp_path)
    plugins._found.cache_clear()
    yield
    plugins._found.cache_clear()


@pytest.mark.usefixtures("_installed")
@pytest.mark.parametrize("group", GROUPS)
def test_only_a_word_is_the_name_of_a_plug_in(group: str) -> None:
    assert plugins.plugin_names(group) == ("good-1_a",)


READ = occ.DecodeResult("own", code=1, bits=np.array([1]), chips=np.array([1, 0]))

RUBBISH: tuple[Any, ...] = (
    None, True, -1, 2**70, 1.5, float("nan"), "", "a\x1b[31m", b"\0", object(), [], [1], {}, (),
    (1, "2"), np.array(1), np.array([]), np.array([0.5, 1.0]), np.array([1, 0, 1]),
    np.zeros((2, 2)), np.array(["1", "0"]), np.array([1, None]), np.array([1j, 0]),
    np.array([np.nan, 1.0]), np.zeros(2, dtype=[("a", "u1")]), np.broadcast_to(np.uint8(0), 10**12),
    occ.Scene(), len,
)  # fmt: skip


@each_case([field.name for field in fields(occ.DecodeResult)])
def test_a_part_of_a_result_is_of_its_kind_or_refused(name: str) -> None:
    reasons = []
    for value in RUBBISH:
        try:
            found = checked_result("Own", replace(READ, **{name: value}), 20)
        except occ.PluginError as error:
            reasons.append(str(error))
            continue
        assert found.failure or (isinstance(found.code, int) and found.code >= 0)
        assert set(np.unique(found.bits)) <= {0, 1}
        assert set(np.unique(found.chips)) <= {0, 1}
    assert all(reason.startswith("Own gives ") for reason in reasons)
    assert len(reasons) > len(RUBBISH) / 2 or name in ("decoder", "location")
