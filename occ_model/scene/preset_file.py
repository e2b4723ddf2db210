"""Preset files: scene files with notes on their values, which may be based on other presets."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from occ_model.errors import SceneFileError, one_line, shown
from occ_model.files.resources import resource_text
from occ_model.scene import toml_format
from occ_model.scene.parameters import parameter_named
from occ_model.scene.scene import Scene

FOLDER, ENDING = "presets", ".toml"

_MAX_BASES = 8  # presets on which one may be based; loading it reads all of them


@dataclass(frozen=True, slots=True)
class Preset:
    """A scene with a name, a title and notes on its values."""

    name: str
    title: str
    scene: Scene
    sources: Mapping[str, str]  # Where a value comes from, by the parameter's name
    assumed: Mapping[str, str]  # The reason for a value without a source, by the parameter's name


def preset_from(name: str, text: str) -> Preset:
    """Parse a preset; a text without a title gets the name as its title."""
    preset = _combine_layers(name, _parse_layers(text))
    return preset if preset.title else replace(preset, title=name)


@lru_cache(maxsize=64)
def package_preset(name: str) -> Preset:
    return _combine_layers(name, _read_package_layers(name))


@lru_cache(maxsize=64)
def _read_package_layers(name: str) -> tuple[dict[str, Any], ...]:
    """Read a preset file of the package, which does not change while the program runs."""
    try:
        return _parse_layers(resource_text(FOLDER, *f"{name}{ENDING}".split("/")))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or one_line(str(error))
        file = one_line(f"{name}{ENDING}")
        raise SceneFileError(f"The preset file {file} cannot be read: {reason}.") from None


def _combine_layers(name: str, layers: tuple[dict[str, Any], ...]) -> Preset:
    preset = Preset(name, "", Scene(), MappingProxyType({}), MappingProxyType({}))
    for content in layers:
        preset = _add_layer(preset, content)
    return preset


def _parse_layers(text: str) -> tuple[dict[str, Any], ...]:
    """Parse a preset file's text; the layers of the presets on which it is based come first."""
    content = toml_format.from_toml(text)
    named = content.pop("based_on", [])
    bases = [named] if isinstance(named, str) else named
    if not isinstance(bases, list) or not all(_is_base(base) for base in bases):
        raise SceneFileError(
            f"based_on is {shown(named)}; allowed: names of the program's presets."
        )
    if len(bases) > _MAX_BASES:
        raise SceneFileError(f"based_on has {len(bases)} names; allowed: up to {_MAX_BASES}.")
    return (*(layer for base in bases for layer in _read_package_layers(base)), content)


def _is_base(name: object) -> bool:
    return isinstance(name, str) and re.fullmatch(r"[\w-]+(/[\w-]+)?", name) is not None


def _add_layer(base: Preset, content: dict[str, Any]) -> Preset:
    """Replace values and notes of a preset by those of a file."""
    tables = dict(content)
    title = tables.pop("title", base.title)
    if not isinstance(title, str):
        raise SceneFileError(f"title is {shown(title)}; allowed: a text.")
    sources = check_notes(tables.pop("sources", {}))
    assumed = check_notes(tables.pop("assumed", {}))
    # A value that has a source here is no longer assumed as in the base, and vice versa.
    return Preset(
        name=base.name,
        title=title,
        scene=base.scene.with_tables(tables),
        sources=_combine_notes(base.sources, sources, without=assumed),
        assumed=_combine_notes(base.assumed, assumed, without=sources),
    )


def _combine_notes(
    base: Mapping[str, str], own: Mapping[str, str], without: Mapping[str, str]
) -> Mapping[str, str]:
    """Add a preset's own notes to those of its base ``without`` some names; read-only."""
    kept = {name: note for name, note in base.items() if name not in without}
    return MappingProxyType({**kept, **own})


def check_notes(table: object) -> dict[str, str]:
    if not isinstance(table, dict) or not all(isinstance(note, str) for note in table.values()):
        raise SceneFileError(
            f"The notes on a preset are {shown(table)}; allowed: a text a parameter."
        )
    for name in table:
        parameter_named(name)
    return table
