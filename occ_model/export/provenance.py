"""What a file says about where its numbers come from."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from occ_model.scene import Scene
from occ_model.version import __version__


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
    """

    title: str
    scenes: Mapping[str, Scene]
    seed: int | None = None
    notes: tuple[str, ...] = field(default=())

    def lines(self) -> list[str]:
        """Write it as lines of text."""
        lines = [self.title, f"occ_model {__version__}"]
        if self.seed is not None:
            lines.append(f"seed {self.seed}")
        lines += self.notes
        for name, scene in self.scenes.items():
            lines += ["", f"scene {name}:", *scene.to_toml().splitlines()]
        return lines

    def text(self) -> str:
        """Write it as one text."""
        return "\n".join(self.lines())
