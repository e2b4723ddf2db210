"""What the user has set about films: which one is open, and how the simulated one is recorded."""

from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import Self

from occ_model.photo.reading.choices import SCAN_AXES
from occ_model.scene.recording import Recording

FIRST_FRAMES, FRAMES = 60, range(2, 100_001)
"""Number of frames of the simulated film at first, and the numbers that are allowed."""

_openings = count(1)


@dataclass(frozen=True, slots=True)
class FilmSource:
    """An opened file, and the axis of its pictures that the shutter scanned."""

    path: Path
    axis: str
    opening: int


@dataclass(frozen=True, slots=True)
class FilmChoice:
    # The film that is open, or is being loaded; None if there is only the simulated one
    path: Path | None = None
    axis: str = SCAN_AXES[0]  # the axis of its pictures that the shutter scanned, one of SCAN_AXES
    opening: int = 0  # counts the openings, so that opening a file again loads it again
    # How the simulated film is recorded, and how many frames it has
    recording: Recording = field(default_factory=Recording)
    frames: int = FIRST_FRAMES

    @property
    def source(self) -> FilmSource | None:
        return None if self.path is None else FilmSource(self.path, self.axis, self.opening)

    def open(self, path: Path | None, axis: str = SCAN_AXES[0]) -> Self:
        return replace(self, path=path, axis=axis, opening=next(_openings))
