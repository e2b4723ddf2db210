"""What the user has set about photos: which one is open, how it is read and what is matched."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Self

from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.results.decoding import Region

if TYPE_CHECKING:
    from occ_model.results.lamp import Lamp

_openings = count(1)

MODES = ("beside", "blend", "split", "difference")
"""Ways of showing a photo with the simulated picture."""

LEAST_SCALE, LARGEST_SCALE = 0.01, 100.0

KNOWN = ("switching_frequency", "readout_time")
"""Stripes determine only the product of these two: one must be known to estimate the other."""

SENT = ("auto", "scene", "square", "read")
"""Sources of the sent pattern: found out, the scene, a square wave, or read."""


@dataclass(frozen=True, slots=True)
class MatchChoice:
    sent: str = "auto"  # what was sent, one of SENT
    square_frequency: float = 1000.0  # cycles per second of the square wave, in Hz, if one was sent
    # ``"readout_time"`` or ``"switching_frequency"``; the other one is known
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
class PhotoReading:
    scan_axis: str = SCAN_AXES[0]  # the axis of the file that the shutter scanned, one of SCAN_AXES
    channel: str = CHANNELS[0]  # the channel of a coloured photo that is read, one of CHANNELS


@dataclass(frozen=True, slots=True)
class PhotoSource:
    """A file that was opened, and how it is read: opened again, the file is read again."""

    path: Path
    reading: PhotoReading
    opening: int


@dataclass(frozen=True, slots=True)
class PhotoFrame:
    """A photo and how it is read, which the coordinates of a rectangle depend on."""

    path: Path
    shape: tuple[int, ...] = ()  # rows and columns; empty where it was not read yet
    turned: bool = False


@dataclass(frozen=True, slots=True)
class Placed:
    """Where the user has put a photo on the picture."""

    source: PhotoSource
    placement: Placement


@dataclass(frozen=True, slots=True)
class PhotoChoice:
    """What the user has set about photos; what belongs to a photo that is not shown is idle."""

    path: Path | None = None  # the photo that is open, or about to be; None for none
    reading: PhotoReading = field(default_factory=PhotoReading)
    opening: int = 0  # the number of its opening: opened again, a file is read again
    # The lamp or the rectangle that is matched, of all photos since none was open
    parts: "Mapping[PhotoFrame, Lamp | Region]" = field(default_factory=dict)
    # The choices of a match, the known values in SI units that are certain of the photo, and those
    # that were certain of photos before
    form: MatchChoice = field(default_factory=MatchChoice)
    certain: Mapping[str, float] = field(default_factory=dict)
    forgotten: Mapping[str, float] = field(default_factory=dict)
    listed: tuple[Path, ...] = ()
    placed: Placed | None = None  # where a photo was put by hand
    is_match_wanted: bool = False  # whether the photo is matched, and that applied, once it is read

    @property
    def source(self) -> PhotoSource | None:
        return None if self.path is None else PhotoSource(self.path, self.reading, self.opening)

    @property
    def rectangle(self) -> Region | None:
        """The rectangle that is matched, as a session keeps it; None for the whole photo."""
        parts = [part for frame, part in self.parts.items() if frame.path == self.path]
        if not parts:
            return None
        return parts[-1] if isinstance(parts[-1], Region) else parts[-1].region

    def opened(self, path: Path, *, match: bool = False) -> Self:
        """Open a photo; what is certain of one photo of the table is certain of all."""
        opened = replace(self, path=path, opening=next(_openings), is_match_wanted=match)
        is_listed = path in self.listed and self.path in (None, *self.listed)
        return opened if is_listed or path == self.path else opened.uncertain()

    def closed(self) -> Self:
        return replace(self, path=None, parts={}).uncertain()

    def with_known_frequency(self, frequency: float) -> Self:
        """Reset the form, with the switching frequency in Hz being certain."""
        certain = {"switching_frequency": frequency}
        return replace(self, form=MatchChoice(), certain=certain, forgotten={})

    def uncertain(self) -> Self:
        """Take no value as certain any more, and note those that were."""
        return replace(self, certain={}, forgotten={**self.forgotten, **self.certain})

    def with_certain(self, name: str, value: float | None) -> Self:
        others = {known: other for known, other in self.certain.items() if known != name}
        forgotten = {known: other for known, other in self.forgotten.items() if known != name}
        certain = others if value is None else {**others, name: value}
        return replace(self, certain=certain, forgotten=forgotten)

    def with_part(self, frame: PhotoFrame, part: "Lamp | Region | None") -> Self:
        former = (frame, PhotoFrame(frame.path))
        parts = {known: each for known, each in self.parts.items() if known not in former}
        return replace(self, parts=parts if part is None else {**parts, frame: part})
