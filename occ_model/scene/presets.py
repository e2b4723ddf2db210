"""List, load, save and delete presets: the package's, and the user's own.

A preset's file gives the source of each value, or the reason why it is assumed.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import tomli_w

from occ_model.errors import (
    OccError,
    OutputError,
    ParameterError,
    PresetError,
    SceneFileError,
    one_line,
    quote,
)
from occ_model.files import resources
from occ_model.files.reading import read_text
from occ_model.files.resources import resource_text
from occ_model.files.writing import make_folder, write_whole
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


@dataclass(frozen=True, slots=True)
class LoadedPresets:
    package: tuple[Preset, ...]
    own: tuple[Preset, ...]  # The user's
    problems: Mapping[str, str]  # Why other files of the user cannot be used, by printable name

    @property
    def every(self) -> tuple[Preset, ...]:
        return (*self.package, *self.own)


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
            f"based_on is {quote(named)}; allowed: names of the program's presets."
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
        raise SceneFileError(f"title is {quote(title)}; allowed: a text.")
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
            f"The notes on a preset are {quote(table)}; allowed: a text a parameter."
        )
    for name in table:
        parameter_named(name)
    return table


USER_FOLDER = "OCC_PRESETS"  # environment variable that names another folder for the user's presets
_NAME = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9 _-]{0,58}[A-Za-z0-9_-])?")
_NAME_RULE = (
    "1 to 60 letters, digits, spaces, - and _; the first a letter or digit, the last not a space"
)
_WINDOWS_DEVICE = re.compile(r"con|prn|aux|nul|(?:com|lpt)[0-9]", re.IGNORECASE)
"""Names that Windows reserves for devices."""


def presets() -> tuple[str, ...]:
    """List the names of the presets: those of the package, then the user's own.

    A file of the user that cannot be read as a preset is left out; :func:`read_presets` says why.
    """
    return (*_package_names(), *user_presets())


def user_presets() -> tuple[str, ...]:
    return tuple(preset.name for preset in read_presets().own)


def read_presets() -> LoadedPresets:
    """Load all presets that can be read."""
    own: list[Preset] = []
    problems: dict[str, str] = {}
    for path in resources.files_in(user_folder(), ENDING):
        name = path.stem
        try:
            problem = _name_problem(name)
            if problem is not None:
                raise SceneFileError(f"The preset file {one_line(str(path))}: {problem}")
            own.append(_load_own(name))
        except OccError as error:
            problems[one_line(name)] = str(error)
    return LoadedPresets(tuple(map(package_preset, _package_names())), tuple(own), problems)


def load_preset(name: str) -> Scene:
    """Load the scene of a preset.

    Raises
    ------
    PresetError
        No preset has that name; the message lists the known names.
    SceneFileError, ParameterError
        The user's own file of that name is not a preset.
    """
    return preset_named(name).scene


def preset_named(name: str) -> Preset:
    if isinstance(name, str):
        if name in _package_names():
            return package_preset(name)
        if name in _own_names():
            return _load_own(name)
    raise _unknown_preset(name, presets())


def save_preset(
    name: str, scene: Scene, *, title: str = "", sources: Mapping[str, str] | None = None
) -> Path:
    """Save a scene as one of the user's own presets; one of that name is replaced.

    Parameters
    ----------
    name
        The name to load it by: letters, digits, spaces, ``-`` and ``_``.
    title
        A short description; by default the name.
    sources
        Where values come from, by the parameter's name.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    PresetError
        The name is not allowed, or is that of a preset of the package.
    ParameterError
        ``scene`` is not a scene, ``title`` is not a text, or a source is for an unknown parameter.
    OutputError
        The file cannot be written.
    """
    _check_name(name)
    if not isinstance(title, str):
        raise ParameterError.of("title", quote(title), "a text")
    notes = check_notes(dict(sources or {}))
    head = tomli_w.dumps({"title": title or name})
    tables: dict[str, Mapping[str, object]] = {**scene.tables()}
    if notes:
        tables["sources"] = notes
    path = _own_file(name)
    make_folder(path.parent)
    write_whole(path, (head + toml_format.to_toml(tables)).encode("utf-8", "replace"))
    return path


def delete_preset(name: str) -> None:
    """Delete one of the user's own presets.

    Raises
    ------
    PresetError
        None of the user's own presets has that name.
    OutputError
        It cannot be deleted.
    """
    if isinstance(name, str) and name in _package_names():
        raise PresetError(f"The preset {quote(name)} comes with the program and cannot be deleted.")
    own = _own_names()
    if not isinstance(name, str) or name not in own:
        raise _unknown_preset(name, own)
    path = _own_file(name)
    try:
        path.unlink()
    except OSError as error:
        where = one_line(str(path))
        raise OutputError(f"{where} cannot be deleted: {error.strerror or error}.") from None


def user_folder() -> Path:
    """Return the folder of the user's own presets, which need not exist yet."""
    return resources.user_folder(USER_FOLDER, FOLDER)


def _package_names() -> tuple[str, ...]:
    return resources.resource_names(FOLDER, ENDING)


def _own_names() -> tuple[str, ...]:
    """List the names of the user's own preset files, readable or not."""
    return tuple(
        p.stem for p in resources.files_in(user_folder(), ENDING) if _name_problem(p.stem) is None
    )


def _own_file(name: str) -> Path:
    return user_folder() / f"{name}{ENDING}"


def _name_problem(name: object) -> str | None:
    """Return why a preset cannot have a name, None if it can."""
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        return f"A preset cannot be named {quote(name)}; allowed: {_NAME_RULE}."
    if name.lower() in {other.lower() for other in _package_names()}:
        return f"{quote(name)} is a preset of the program; choose another name."
    return None


def _check_name(name: str) -> None:
    problem = _name_problem(name)
    if problem is None and _WINDOWS_DEVICE.fullmatch(name):
        problem = f"A preset cannot be named {quote(name)}; allowed: {_NAME_RULE}."
    if problem is not None:
        raise PresetError(problem)


def _unknown_preset(name: object, known: tuple[str, ...]) -> PresetError:
    from difflib import get_close_matches  # takes a moment, and only a mistake needs it

    near = get_close_matches(name, known, n=1) if isinstance(name, str) else ()
    hint = f" Did you mean {near[0]}?" if near else ""
    names = ", ".join(known) or "none"
    return PresetError(f"There is no preset {quote(name)}.{hint} Known are {names}.")


def _load_own(name: str) -> Preset:
    """Load one of the user's own presets; its file may change at any time and contain anything."""
    path = _own_file(name)
    text = read_text(path)
    try:
        return preset_from(name, text)
    except OccError as error:
        kind = type(error) if isinstance(error, SceneFileError | ParameterError) else SceneFileError
        raise kind(f"The preset file {one_line(str(path))} cannot be used: {error}") from None
