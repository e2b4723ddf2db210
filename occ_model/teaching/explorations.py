"""Guided explorations: short texts with a scene each, and a question to answer by trying."""

import tomllib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from occ_model.errors import SceneFileError
from occ_model.presets import load_preset
from occ_model.resource_files import resource_path
from occ_model.results.teaching import Exploration, Step
from occ_model.settings import with_settings

_FOLDER = "explorations"


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
