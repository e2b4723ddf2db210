"""The files of the package are found and packed."""

import tomllib
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.files.resources import resource_names, resource_text

ROOT = Path(occ.__file__).parent.parent


TOOLS = {"packaging", "site"}
"""Folders used to build the project, which the running program does not read."""


def test_a_wheel_has_every_folder_of_resources_inside() -> None:
    with (ROOT / "pyproject.toml").open("rb") as file:
        included = tomllib.load(file)["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    folders = [path.name for path in (ROOT / "resources").iterdir() if path.is_dir()]
    names = {name for name in folders if not name.startswith("__")} - TOOLS
    assert included == {f"resources/{name}": f"occ_model/resources/{name}" for name in names}


def test_resources_are_listed_and_read_here() -> None:
    assert "phone-136us" in resource_names("presets", ".toml")
    assert "devices" not in resource_names("presets", ".toml")
    assert resource_text("presets", "devices", "phone.toml").startswith(("format", "#", "title"))
    with pytest.raises(FileNotFoundError):
        resource_text("presets", "missing.toml")
