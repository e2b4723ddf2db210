"""What is computed of a photo, each with what it was computed from."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from occ_gui.values.photo_choice import PhotoFrame, PhotoReading, PhotoSource
from occ_model.arrays import FloatArray
from occ_model.results.decoding import Region

if TYPE_CHECKING:  # a window without a photo starts without them
    from occ_model.photo.reading.load import Photo
    from occ_model.results.lamp import Lamp
    from occ_model.results.match import Comparison, Match, Stripes
    from occ_model.results.photo_table import PhotoRow


@dataclass(frozen=True, eq=False, slots=True)
class OpenPhoto:
    photo: "Photo"
    source: PhotoSource

    @property
    def frame(self) -> PhotoFrame:
        return PhotoFrame(self.photo.path, self.photo.image.shape, self.photo.turned)


@dataclass(frozen=True, eq=False, slots=True)
class StripeSearch:
    """The stripes of a photo or of a part of it, or why there are none."""

    stripes: "Stripes | None"
    sentence: str


@dataclass(frozen=True, slots=True)
class FoundMatch:
    photo: "Photo"  # what was matched; None for all of the photo
    part: "Lamp | Region | None"
    # The match; that of before where there is a refusal, None where there was none
    match: "Match | None"
    given: float  # the known value of the scene at the request, in SI units
    # The reasons why there is no match, each a sentence, and the part that they are about
    refusal: tuple[str, ...] = ()
    refused_part: "Lamp | Region | None" = None
    is_listed: bool = False

    def refusal_of(self, part: "Lamp | Region | None") -> tuple[str, ...]:
        """Return why there is no match of this part; empty where it was not refused."""
        return self.refusal if part == self.refused_part else ()


@dataclass(frozen=True, eq=False, slots=True)
class ListedRows:
    """What was found so far in the photos of the table, and how they were read."""

    rows: "tuple[PhotoRow, ...]"
    reading: PhotoReading
    given: float  # the known value of the scene when they were matched, in SI units

    def match_of(self, opened: OpenPhoto) -> FoundMatch | None:
        rows = (row for row in self.rows if row.path == opened.photo.path)
        row = next(rows, None)
        if row is None or row.match is None or opened.source.reading != self.reading:
            return None
        return FoundMatch(opened.photo, None, row.match, self.given, is_listed=True)


@dataclass(frozen=True, eq=False, slots=True)
class PhotoProfile:
    # Both profiles compared, None if ``sentence`` says why that is impossible
    comparison: "Comparison | None"
    # Shape (columns of the photo,): mean of each column of the whole photo, in grey levels
    raw: FloatArray
    # The simulated column under the photo's first one, and simulated columns per photo column
    first_column: float = 0.0
    scale: float = 1.0
    # Why there is no comparison; also empty while the photo is searched for stripes
    sentence: str = ""
    photo: "Photo | None" = None
    is_outdated: bool = False  # whether the simulation is of another scene than the present one
