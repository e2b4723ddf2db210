"""Guided explorations: short texts with a scene each, and a question to answer by trying."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from occ_model.errors import SceneFileError
from occ_model.presets import load_preset
from occ_model.resource_files import resource_path
from occ_model.scene import Scene
from occ_model.settings import with_settings

_FOLDER = "explorations"


@dataclass(frozen=True, slots=True)
class Step:
    """One step of an exploration.

    Parameters
    ----------
    text
        What there is to see.
    question
        What to find out.
    answer
        What one finds, for whoever wants to compare.
    scene
        What the window shows.
    pane
        The pane that it is best seen in, empty for whichever is at the front.
    photo
        The sample photo to open, by its name, empty for none.
    """

    text: str
    question: str
    answer: str
    scene: Scene
    pane: str = ""
    photo: str = ""


@dataclass(frozen=True, slots=True)
class Exploration:
    """A guided exploration.

    Parameters
    ----------
    name
        The file's name.
    title
        What it is about.
    steps
        One after the other.
    """

    name: str
    title: str
    steps: tuple[Step, ...]


@lru_cache(maxsize=1)
def explorations() -> tuple[Exploration, ...]:
    """Load the explorations that come with the package, in their order.

    Raises
    ------
    SceneFileError
        A file cannot be read.
    """
    return tuple(read_exploration(path) for path in sorted(resource_path(_FOLDER).glob("*.toml")))


def read_exploration(path: Path) -> Exploration:
    """Read an exploration's file.

    Raises
    ------
    SceneFileError
        It is not an exploration's file.
    ParameterError
        A value in it is out of range.
    PresetError
        It names a preset that does not exist.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
        steps = tuple(_step(step) for step in content["step"])
        return Exploration(path.stem, content["title"], steps)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise SceneFileError(f"{path.name} is no exploration: {error!r}.") from None


def _step(content: Mapping[str, Any]) -> Step:
    settings = [f"{name}={value}" for name, value in content.get("set", {}).items()]
    return Step(
        text=" ".join(content["text"].split()),
        question=" ".join(content["question"].split()),
        answer=" ".join(content["answer"].split()),
        scene=with_settings(load_preset(content["preset"]), settings),
        pane=content.get("pane", ""),
        photo=content.get("photo", ""),
    )
