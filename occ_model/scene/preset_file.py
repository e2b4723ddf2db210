"""Preset files: scene files with notes on their values, based on other presets."""

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

_MAX_BASES = 8  # presets that one may be based on; all of them are read whenever it is loaded


@dataclass(frozen=True, slots=True)
class Preset:
    """A scene with a name, a title and notes on its values."""

    name: str
    title: str
    scene: Scene
    sources: Mapping[str, str]  # Where a parameter's value comes from, by the parameter's name
    assumed: Mapping[str, str]  # The reason for a parameter's value without a source


def preset_from(name: str, text: str) -> Preset:
    """Parse a preset; its name is the title where the text has none."""
    preset = _put_together(name, _layers(text))
    return preset if preset.title else replace(preset, title=name)


@lru_cache(maxsize=64)
def package_preset(name: str) -> Preset:
    return _put_together(name, _package_layers(name))


@lru_cache(maxsize=64)
def _package_layers(name: str) -> tuple[dict[str, Any], ...]:
    """Read a preset file of the package; it does not change while the program runs."""
    try:
        return _layers(resource_text(FOLDER, *f"{name}{ENDING}".split("/")))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or one_line(str(error))
        file = one_line(f"{name}{ENDING}")
        raise SceneFileError(f"The preset file {file} cannot be read: {reason}.") from None


def _put_together(name: str, layers: tuple[dict[str, Any], ...]) -> Preset:
    preset = Preset(name, "", Scene(), MappingProxyType({}), MappingProxyType({}))
    for content in layers:
        preset = _laid_over(preset, content)
    return preset


def _layers(text: str) -> tuple[dict[str, Any], ...]:
    """Parse a preset file's text, after the layers of the presets that it is based on."""
    content = toml_format.from_toml(text)
    named = content.pop("based_on", [])
    bases = [named] if isinstance(named, str) else named
    if not isinstance(bases, list) or not all(_is_base(base) for base in bases):
        raise SceneFileError(
            f"based_on is {shown(named)}; allowed: names of the program's presets."
        )
    if len(bases) > _MAX_BASES:
        raise SceneFileError(f"based_on has {len(bases)} names; allowed: up to {_MAX_BASES}.")
    return (*(layer for base in bases for layer in _package_layers(base)), content)


def _is_base(name: object) -> bool:
    return isinstance(name, str) and re.fullmatch(r"[\w-]+(/[\w-]+)?", name) is not None


def _laid_over(base: Preset, content: dict[str, Any]) -> Preset:
    """Return the preset with a file's values and notes in place of its own."""
    tables = dict(content)
    title = tables.pop("title", base.title)
    if not isinstance(title, str):
        raise SceneFileError(f"title is {shown(title)}; allowed: a text.")
    sources = checked_notes(tables.pop("sources", {}))
    assumed = checked_notes(tables.pop("assumed", {}))
    # A value with a source here is no longer assumed, as it may be in the base, and vice versa.
    return Preset(
        name=base.name,
        title=title,
        scene=base.scene.with_tables(tables),
        sources=_over(base.sources, sources, without=assumed),
        assumed=_over(base.assumed, assumed, without=sources),
    )


def _over(
    base: Mapping[str, str], own: Mapping[str, str], without: Mapping[str, str]
) -> Mapping[str, str]:
    """Combine a preset's own notes with those of its base, ``without`` some names; read-only."""
    kept = {name: note for name, note in base.items() if name not in without}
    return MappingProxyType({**kept, **own})


def checked_notes(table: object) -> dict[str, str]:
    if not isinstance(table, dict) or not all(isinstance(note, str) for note in table.values()):
        raise SceneFileError(
            f"The notes on a preset are {shown(table)}; allowed: a text a parameter."
        )
    for name in table:
        parameter_named(name)
    return table
