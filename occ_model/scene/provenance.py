"""What a file says about where its numbers come from, written and read back."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from occ_model.scene.scene import Scene
from occ_model.version import __version__

_SCENE = re.compile(r"^scene (.+):$", re.MULTILINE)


@dataclass(frozen=True)
class Provenance:
    """The scenes, the version and the seed behind a figure or a table.

    Parameters
    ----------
    title
        What the figure or table shows.
    scenes
        The scenes by name.
    seed
        Of all random numbers, None where there are none.
    notes
        Further lines.
    date
        When they were made, empty where the file is to be the same whenever it is.
    """

    title: str
    scenes: Mapping[str, Scene]
    seed: int | None = None
    notes: tuple[str, ...] = field(default=())
    date: str = ""

    def lines(self) -> list[str]:
        """Write it as lines of text."""
        lines = [self.title, f"occ_model {__version__}"]
        if self.date:
            lines.append(f"date {self.date}")
        if self.seed is not None:
            lines.append(f"seed {self.seed}")
        lines += self.notes
        for name, scene in self.scenes.items():
            lines += ["", f"scene {name}:", *scene.to_toml().splitlines()]
        return lines

    def text(self) -> str:
        """Write it as one text."""
        return "\n".join(self.lines())


def scenes_in(text: str) -> dict[str, Scene]:
    """Read the scenes out of what :meth:`Provenance.text` wrote, by their names.

    Raises
    ------
    SceneFileError
        A scene in it cannot be read.
    ParameterError
        A value in one is out of range.
    """
    _before, *parts = _SCENE.split(text)  # names and texts in turn
    return {name: Scene.from_toml(toml) for name, toml in zip(parts[::2], parts[1::2], strict=True)}


def first_scene_in(text: str) -> Scene | None:
    """Read the first scene out of what :meth:`Provenance.text` wrote, None where there is none.

    Raises
    ------
    SceneFileError
        It cannot be read.
    ParameterError
        A value in it is out of range.
    """
    start = _SCENE.search(text)
    if start is None:
        return None
    following = _SCENE.search(text, start.end())
    return Scene.from_toml(text[start.end() : following.start() if following else None])
