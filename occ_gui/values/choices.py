"""The user's choices of room, film and photos, and how each is used."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Self

from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.results.decoding import Region
from occ_model.scene.recording import Recording

if TYPE_CHECKING:  # a window that shows none starts without them
    from occ_model.results.lamp import Lamp
    from occ_model.room.room import Room

_openings = count(1)

FIRST_FRAMES, FRAMES = 60, range(2, 100_001)
"""Number of frames of the simulated film at first, and the numbers that are allowed."""


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


FIRST_ROOM = "office"


@dataclass(frozen=True, slots=True)
class RoomChoice:
    name: str = FIRST_ROOM  # of the built-in room, or of the file, that the room comes from
    # The room with the camera where the user has put it; None for the first room unchanged
    room: "Room | None" = None
    # The photo of the room that is shown in place of the simulated picture
    photo: Path | None = None
    # Equivalent focal length of the photo in metres; None for that in its file, or the room's
    focal_length: float | None = None


THEMES = ("system", "light", "dark")
"""Colours of the window; those of the system are light or dark."""

OVERLAYS = ("beside", "blend", "split", "difference")
"""Ways of showing a photo with the simulated picture."""

LEAST_SCALE, LARGEST_SCALE = 0.01, 100.0

KNOWN_PARAMETERS = ("switching_frequency", "lamp_frequency", "pulse_frequency", "readout_time")
"""Stripes determine only the product of a frequency and the readout time: one must be known to
estimate the other."""

SENT_SOURCES = ("auto", "scene", "lamp", "read")
"""Sources of what was sent: found automatically, the scene, a lamp of any duty, or the stripes."""


@dataclass(frozen=True, slots=True)
class MatchChoice:
    sent: str = "auto"  # what was sent, one of SENT_SOURCES
    lamp_frequency: float = 1000.0  # cycles per second of the lamp, in Hz, if one was sent
    # What is estimated, one of ESTIMATES; the other one is known
    estimate: str = "readout_time"
    fit_gamma: bool = False  # whether gamma is estimated too


@dataclass(frozen=True, slots=True)
class Placement:
    column: float = 0.0  # the pixel of the simulated picture under the photo's first pixel
    row: float = 0.0
    scale: float = 1.0  # pixels of the simulated picture per pixel of the photo

    def within_limits(self) -> Self:
        return replace(self, scale=min(max(self.scale, LEAST_SCALE), LARGEST_SCALE))


@dataclass(frozen=True, slots=True)
class LoadOptions:
    scan_axis: str = SCAN_AXES[0]  # the axis of the file that the shutter scanned, one of SCAN_AXES
    channel: str = CHANNELS[0]  # the channel of a coloured photo that is read, one of CHANNELS


@dataclass(frozen=True, slots=True)
class PhotoSource:
    """A file that was opened, and how it is loaded; opening it again loads it again."""

    path: Path
    load_options: LoadOptions
    opening: int


@dataclass(frozen=True, slots=True)
class PhotoFrame:
    """A photo with its shape and orientation, which the coordinates of a rectangle refer to."""

    path: Path
    shape: tuple[int, ...] = ()  # rows and columns; empty before the photo is loaded
    turned: bool = False


@dataclass(frozen=True, slots=True)
class PlacedPhoto:
    """Where the user has put a photo on the picture."""

    source: PhotoSource
    placement: Placement


@dataclass(frozen=True, slots=True)
class PhotoChoice:
    """The user's choices for photos; a setting for a photo that is not shown has no effect."""

    path: Path | None = None  # the photo that is open, or is being loaded; None for none
    load_options: LoadOptions = field(default_factory=LoadOptions)
    opening: int = 0  # counts the openings, so that opening a file again loads it again
    # The lamp or rectangle that is matched, for every photo opened since the last one was closed
    parts: "Mapping[PhotoFrame, Lamp | Region]" = field(default_factory=dict)
    # The choices of a match, the known values in SI units that are certain for this photo, and
    # those that were certain for earlier photos
    form: MatchChoice = field(default_factory=MatchChoice)
    certain: Mapping[str, float] = field(default_factory=dict)
    forgotten: Mapping[str, float] = field(default_factory=dict)
    listed: tuple[Path, ...] = ()
    placed_photo: PlacedPhoto | None = None
    is_match_wanted: bool = (
        False  # whether to match the photo and apply the match once it is loaded
    )

    @property
    def source(self) -> PhotoSource | None:
        return (
            None if self.path is None else PhotoSource(self.path, self.load_options, self.opening)
        )

    @property
    def rectangle(self) -> Region | None:
        """The rectangle that is matched, as stored in a session; None for the whole photo."""
        parts = [part for frame, part in self.parts.items() if frame.path == self.path]
        if not parts:
            return None
        return parts[-1] if isinstance(parts[-1], Region) else parts[-1].region

    def open(self, path: Path, *, match: bool = False) -> Self:
        """Open a photo; what is assumed of one photo of the table is assumed of all."""
        opened = replace(self, path=path, opening=next(_openings), is_match_wanted=match)
        is_listed = path in self.listed and self.path in (None, *self.listed)
        return opened if is_listed or path == self.path else opened.drop_assumptions()

    def close(self) -> Self:
        return replace(self, path=None, parts={}).drop_assumptions()

    def with_known(self, name: str, value: float) -> Self:
        """Reset the form, with one known value, in SI units, that is certain."""
        return replace(self, form=MatchChoice(), certain={name: value}, forgotten={})

    def drop_assumptions(self) -> Self:
        """Assume neither what was sent nor that a value is certain; remember those that were."""
        form, forgotten = replace(self.form, sent="auto"), {**self.forgotten, **self.certain}
        return replace(self, form=form, certain={}, forgotten=forgotten)

    def with_certain(self, name: str, value: float | None) -> Self:
        others = {key: known for key, known in self.certain.items() if key != name}
        forgotten = {key: known for key, known in self.forgotten.items() if key != name}
        certain = others if value is None else {**others, name: value}
        return replace(self, certain=certain, forgotten=forgotten)

    def with_part(self, frame: PhotoFrame, part: "Lamp | Region | None") -> Self:
        replaced_frames = (frame, PhotoFrame(frame.path))
        parts = {key: other for key, other in self.parts.items() if key not in replaced_frames}
        return replace(self, parts=parts if part is None else {**parts, frame: part})
