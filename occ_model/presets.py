"""Scenes that come with the package, each value with its source or the reason it is assumed."""

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from occ_model import scene_file
from occ_model.errors import PresetError, SceneFileError
from occ_model.parameters import parameter_named
from occ_model.resource_files import resource_path
from occ_model.scene import Scene

_FOLDER = "presets"


@dataclass(frozen=True, slots=True)
class Preset:
    """A scene that comes with the package.

    Parameters
    ----------
    name
        The name that it is loaded by.
    title
        What it is, in a few words.
    scene
        The scene.
    sources
        Where a parameter's value comes from, by the parameter's name.
    assumed
        Why a parameter has the value it has where no source gives one.
    """

    name: str
    title: str
    scene: Scene
    sources: Mapping[str, str]
    assumed: Mapping[str, str]


def presets() -> tuple[str, ...]:
    """List the names of the presets."""
    return tuple(sorted(path.stem for path in resource_path(_FOLDER).glob("*.toml")))


def load_preset(name: str) -> Scene:
    """Load the scene of a preset.

    Raises
    ------
    PresetError
        No preset has that name; the names there are stand in the message.
    """
    return preset_named(name).scene


def preset_named(name: str) -> Preset:
    """Load a preset with the notes on its values.

    Raises
    ------
    PresetError
        No preset has that name.
    """
    known = presets()
    if not isinstance(name, str) or name not in known:
        near = get_close_matches(str(name), known, n=1)
        hint = f" Did you mean {near[0]}?" if near else ""
        raise PresetError(f"There is no preset {name!r}.{hint} Known are {', '.join(known)}.")
    return _load(name)


@lru_cache(maxsize=64)
def _load(name: str) -> Preset:
    """Lay a preset file over those that it is based on."""
    preset = Preset(name, "", Scene(), MappingProxyType({}), MappingProxyType({}))
    for content in _layers(name):
        preset = _laid_over(preset, content)
    return preset


def _layers(name: str) -> list[dict[str, Any]]:
    """Read a preset file and, before it, those that it is based on."""
    path = resource_path(_FOLDER, f"{name}.toml")
    try:
        content = scene_file.from_toml(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise SceneFileError(f"The preset file {path.name} cannot be read: {error}.") from None
    named = content.pop("based_on", [])
    bases: list[str] = [named] if isinstance(named, str) else named
    return [*(layer for base in bases for layer in _layers(base)), content]


def _laid_over(base: Preset, content: dict[str, Any]) -> Preset:
    """Return the preset with a file's values and notes in place of its own."""
    tables = dict(content)
    title = tables.pop("title", base.title)
    sources = _notes(tables.pop("sources", {}))
    assumed = _notes(tables.pop("assumed", {}))
    # A value with a source here is no longer assumed, whatever the base said of it, and vice versa.
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
    """Lay a preset's own notes over its base's, less what it says otherwise; read-only."""
    kept = {name: note for name, note in base.items() if name not in without}
    return MappingProxyType({**kept, **own})


def _notes(table: dict[str, str]) -> dict[str, str]:
    for name in table:
        parameter_named(name)
    return table
