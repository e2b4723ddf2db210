"""Load the guided lessons: steps with a text, a scene, a question and its answer."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from occ_model.errors import OccError, SceneFileError, one_line, shown
from occ_model.files.reading import read_text
from occ_model.files.resources import resource_names, resource_text
from occ_model.results.teaching import Lesson, Step
from occ_model.scene.from_text import with_settings
from occ_model.scene.presets import load_preset
from occ_model.scene.toml_format import parse_toml

_FOLDER, _ENDING = "lessons", ".toml"


@lru_cache(maxsize=1)
def lessons() -> tuple[Lesson, ...]:
    """Load the lessons that come with the package, in their order.

    Raises
    ------
    SceneFileError
        A file cannot be read.
    """
    return tuple(
        _lesson(name, resource_text(_FOLDER, f"{name}{_ENDING}"))
        for name in resource_names(_FOLDER, _ENDING)
    )


def read_lesson(path: Path) -> Lesson:
    """Read a lesson's file.

    Raises
    ------
    SceneFileError
        The file cannot be read, holds no lesson, names a preset that does not exist, or has a
        value that is out of range.
    """
    return _lesson(path.stem, read_text(path))


def _lesson(name: str, text: str) -> Lesson:
    try:
        content = parse_toml(text)
        steps = tuple(_step(step) for step in content["step"])
        return Lesson(name, _text(content["title"]), steps)
    except OccError as error:
        raise SceneFileError(f"{one_line(name)} is no lesson: {error}") from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise SceneFileError(f"{one_line(name)} is no lesson: {shown(error)}.") from None


def _step(content: Mapping[str, Any]) -> Step:
    settings = [f"{name}={_written(value)}" for name, value in content.get("set", {}).items()]
    return Step(
        text=" ".join(_text(content["text"]).split()),
        question=" ".join(_text(content["question"]).split()),
        answer=" ".join(_text(content["answer"]).split()),
        scene=with_settings(load_preset(content["preset"]), settings),
        pane=_text(content.get("pane", "")),
        photo=_text(content.get("photo", "")),
    )


def _written(value: object) -> str:
    """Write a value as in an option of the command line."""
    return value if isinstance(value, str) else shown(value)


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise SceneFileError(f"there is {shown(value)} in place of a text.")
    return value
