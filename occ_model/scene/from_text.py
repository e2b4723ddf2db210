"""Scenes from files, and changes by texts such as ``switching_frequency=10kHz``."""

from collections.abc import Iterable
from pathlib import Path

from occ_model.errors import ParameterError, SceneFileError, one_line, quote
from occ_model.files.reading import read_text
from occ_model.files.writing import check_ending, write_whole
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import parameter_named
from occ_model.scene.provenance import ENDINGS, scene_inside
from occ_model.scene.scene import Scene

SCENE_ENDING = ".toml"  # ending of scene files

DEFAULT_PRESET = "phone-68us"  # when none is named; all models and decoders give a result for it


def read_scene_file(path: Path) -> Scene:
    """Read a scene file, or the scene inside an exported figure or table."""
    if path.suffix.lower() in ENDINGS:
        return scene_inside(path)
    text = read_text(path)
    try:
        return Scene.from_toml(text)
    except SceneFileError as error:
        raise SceneFileError(f"{one_line(str(path))} cannot be read. {error}") from None


def check_scene_path(path: Path) -> None:
    """Refuse to save a scene in a file that does not have the ending of scene files."""
    check_ending(path, "a scene file", (SCENE_ENDING,))


def write_scene_file(path: Path, scene: Scene) -> None:
    check_scene_path(path)
    write_whole(path, scene.to_toml().encode("utf-8"))


def change_scene(scene: Scene, settings: Iterable[str]) -> Scene:
    """Change a scene by texts such as ``"switching_frequency=10kHz"``."""
    changes: dict[str, ParameterValue] = {}
    for setting in settings:
        name, equals, text = setting.partition("=")
        if not equals:
            raise ParameterError(f"{quote(setting)} is not a setting; write NAME=VALUE.")
        changes[name.strip()] = parameter_named(name.strip()).parse(text)
    return scene.replace(**changes)
