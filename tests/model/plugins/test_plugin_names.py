"""A plug-in's name is a word: it leads out of no folder, and adds nothing to a table."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from model.plugins.installed_package import install

import occ_model as occ
from occ_model import plugins
from occ_model.errors import ParameterError

OTHERWISE = [
    "../x", "..", "/etc/x", "a/b", "a\\b", ".hidden", "a.b", "a b", "a,b", "<b>", "C:x", "x" * 61,
    "\u202egnp", "-x", "a\x1b[31m",
]  # fmt: skip
GROUPS = (plugins.DECODERS, plugins.LINE_CODES, plugins.FRAMINGS)


@pytest.fixture(autouse=True)
def _installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    names = dict.fromkeys((*OTHERWISE, "good-1_a"), "named:it")
    install(tmp_path, "named", dict.fromkeys(GROUPS, names), "it = 1")
    monkeypatch.syspath_prepend(tmp_path)
    plugins._found.cache_clear()
    yield
    plugins._found.cache_clear()


@pytest.mark.parametrize("group", GROUPS)
def test_only_a_word_is_the_name_of_a_plug_in(group: str) -> None:
    assert plugins.plugin_names(group) == ("good-1_a",)


@pytest.mark.parametrize("name", OTHERWISE)
def test_a_plug_in_of_another_name_is_none(name: str) -> None:
    scene = occ.Scene()
    with pytest.raises(ParameterError, match=r"^decoder is "):
        occ.decode(occ.column_profile(scene), scene, decoder=name)
