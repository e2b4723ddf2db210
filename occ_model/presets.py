"""Scenes to begin with: those that come with the package, and the user's own.

Each value has its source, or the reason why it is assumed, in the preset's file.
"""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import tomli_w

from occ_model import scene_file
from occ_model.errors import OccError, OutputError, ParameterError, PresetError, SceneFileError
from occ_model.output import make_folder, write_whole
from occ_model.parameters import parameter_named
from occ_model.resource_files import resource_path
from occ_model.scene import Scene, check_scene

_FOLDER = "presets"

USER_FOLDER = "OCC_PRESETS"
"""The environment variable that names another folder for the user's own presets."""

_NAME = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9 _-]{0,58}[A-Za-z0-9_-])?")
_NAMES = "1 to 60 letters, digits, spaces, - and _, the first a letter or digit, the last no space"
_DEVICE = re.compile(r"con|prn|aux|nul|(?:com|lpt)[0-9]", re.IGNORECASE)
"""Names that Windows keeps for devices."""


@dataclass(frozen=True, slots=True)
class Preset:
    """A scene to begin with.

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
    """List the names of the presets: those of the package, then the user's own.

    A file among the user's own that is no preset is left out; :func:`preset_named` tells why.
    """
    return (*_built_in(), *user_presets())


def user_presets() -> tuple[str, ...]:
    """List the names of the user's own presets."""
    return tuple(sorted(name for name in _names_in(user_folder()) if _is_own(name)))


def load_preset(name: str) -> Scene:
    """Load the scene of a preset.

    Raises
    ------
    PresetError
        No preset has that name; the names there are stand in the message.
    SceneFileError, ParameterError
        The user's own file of that name is no preset.
    """
    return preset_named(name).scene


def preset_named(name: str) -> Preset:
    """Load a preset with the notes on its values.

    Raises
    ------
    PresetError
        No preset has that name.
    SceneFileError, ParameterError
        The user's own file of that name is no preset.
    """
    if isinstance(name, str):
        if name in _built_in():
            return _load(name)
        if name in _names_in(user_folder()):
            return _load_own(name)
    raise _unknown(name, presets())


def save_preset(
    name: str, scene: Scene, *, title: str = "", sources: Mapping[str, str] | None = None
) -> Path:
    """Save a scene as one of the user's own presets, in place of one of that name.

    Parameters
    ----------
    name
        The name to load it by: letters, digits, spaces, ``-`` and ``_``.
    scene
        The scene.
    title
        What it is, in a few words; by default the name.
    sources
        Where values come from, by the parameter's name.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    PresetError
        The name cannot be one, or a preset of the package has it.
    ParameterError
        ``scene`` is none, or a source is of what is no parameter.
    OutputError
        The file cannot be written.
    """
    _check_name(name)
    check_scene(scene)
    notes = _notes(dict(sources or {}))
    head = tomli_w.dumps({"title": str(title) or name})
    tables: dict[str, Mapping[str, object]] = {**scene.tables()}
    if notes:
        tables["sources"] = notes
    path = _own_file(name)
    make_folder(path.parent)
    write_whole(path, (head + scene_file.to_toml(tables)).encode("utf-8", "replace"))
    return path


def delete_preset(name: str) -> None:
    """Delete one of the user's own presets.

    Raises
    ------
    PresetError
        None of the user's own has that name.
    OutputError
        It cannot be deleted.
    """
    if isinstance(name, str) and name in _built_in():
        raise PresetError(f"The preset {name!r} comes with the program and cannot be deleted.")
    own = _names_in(user_folder())
    if not isinstance(name, str) or name not in own:
        raise _unknown(name, own)
    path = _own_file(name)
    try:
        path.unlink()
    except OSError as error:
        raise OutputError(f"{path} cannot be deleted: {error.strerror or error}.") from None


def user_folder() -> Path:
    """Give the folder of the user's own presets, which need not be there yet."""
    folder = os.environ.get(USER_FOLDER)
    if folder:
        return Path(folder)
    # Not needed where the user's folder is named.
    from platformdirs import user_config_path

    return user_config_path("occ-explorer", appauthor=False) / _FOLDER


def _built_in() -> tuple[str, ...]:
    return tuple(sorted(path.stem for path in resource_path(_FOLDER).glob("*.toml")))


def _names_in(folder: Path) -> tuple[str, ...]:
    """List the files that could be the user's own presets."""
    try:
        names = [path.stem for path in folder.glob("*.toml") if path.is_file()]
    except (OSError, ValueError):  # no folder, none that may be read, or none that can be one
        return ()
    built_in = {name.lower() for name in _built_in()}
    return tuple(name for name in names if _NAME.fullmatch(name) and name.lower() not in built_in)


def _is_own(name: str) -> bool:
    try:
        _load_own(name)
    except OccError:
        return False
    return True


def _own_file(name: str) -> Path:
    return user_folder() / f"{name}.toml"


def _check_name(name: str) -> None:
    if not isinstance(name, str) or not _NAME.fullmatch(name) or _DEVICE.fullmatch(name):
        raise PresetError(f"A preset cannot be named {name!r}; allowed: {_NAMES}.")
    if name.lower() in {other.lower() for other in _built_in()}:
        raise PresetError(f"{name!r} is a preset of the program; choose another name.")


def _unknown(name: object, known: tuple[str, ...]) -> PresetError:
    near = get_close_matches(str(name), known, n=1)
    hint = f" Did you mean {near[0]}?" if near else ""
    names = ", ".join(known) or "none"
    return PresetError(f"There is no preset {name!r}.{hint} Known are {names}.")


@lru_cache(maxsize=64)
def _load(name: str) -> Preset:
    """Lay a preset file of the package over those that it is based on."""
    return _put_together(name, _package_layers(name))


def _load_own(name: str) -> Preset:
    """Load one of the user's own, which may change at any time and is not trusted."""
    path = _own_file(name)
    try:
        preset = _put_together(name, _layers(path))
    except (SceneFileError, ParameterError) as error:
        raise type(error)(f"The preset file {path} cannot be used: {error}") from None
    return preset if preset.title else Preset(name, name, preset.scene, preset.sources, {})


@lru_cache(maxsize=64)
def _package_layers(name: str) -> tuple[dict[str, Any], ...]:
    """Read a preset file of the package, which does not change while the program runs."""
    return _layers(resource_path(_FOLDER, f"{name}.toml"))


def _put_together(name: str, layers: tuple[dict[str, Any], ...]) -> Preset:
    preset = Preset(name, "", Scene(), MappingProxyType({}), MappingProxyType({}))
    for content in layers:
        preset = _laid_over(preset, content)
    return preset


def _layers(path: Path) -> tuple[dict[str, Any], ...]:
    """Read a preset file and, before it, those of the package that it is based on."""
    try:
        content = scene_file.from_toml(path.read_text(encoding="utf-8-sig"))
    except (OSError, UnicodeDecodeError) as error:
        raise SceneFileError(f"The preset file {path.name} cannot be read: {error}.") from None
    named = content.pop("based_on", [])
    bases = [named] if isinstance(named, str) else named
    if not isinstance(bases, list) or not all(_is_base(base) for base in bases):
        raise SceneFileError(f"based_on is {named!r}; allowed: names of the program's presets.")
    return (*(layer for base in bases for layer in _package_layers(base)), content)


def _is_base(name: object) -> bool:
    return isinstance(name, str) and re.fullmatch(r"[\w-]+(/[\w-]+)?", name) is not None


def _laid_over(base: Preset, content: dict[str, Any]) -> Preset:
    """Return the preset with a file's values and notes in place of its own."""
    tables = dict(content)
    title = tables.pop("title", base.title)
    if not isinstance(title, str):
        raise SceneFileError(f"title is {title!r}; allowed: a text.")
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


def _notes(table: object) -> dict[str, str]:
    if not isinstance(table, dict) or not all(isinstance(note, str) for note in table.values()):
        raise SceneFileError(f"The notes on a preset are {table!r}; allowed: a text a parameter.")
    for name in table:
        parameter_named(name)
    return table
