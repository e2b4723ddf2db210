"""What is computed of a photo, each with what it was computed from."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

from occ_gui.values.photo_choice import MatchChoice, PhotoFrame, PhotoReading, PhotoSource
from occ_model.arrays import FloatArray
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene

if TYPE_CHECKING:  # a window without a photo starts without them
    from occ_model.photo.reading.load import Photo
    from occ_model.results.lamp import Lamp
    from occ_model.results.match import Comparison, Match, Stripes
    from occ_model.results.photo_table import PhotoRow


@dataclass(frozen=True, eq=False, slots=True)
class StripeSearch:
    """The stripes of a photo or of a part of it, or why there are none."""

    stripes: "Stripes | None"
    sentence: str


@dataclass(frozen=True, eq=False, slots=True)
class MatchRequest:
    """What a match was asked for: the scene and the choices at that time, and the part."""

    photo: "Photo"
    scene: Scene
    choice: MatchChoice
    part: "Lamp | Region | None"  # None for all of the photo
    is_applied_then: bool = False  # whether what is found is applied to the scene at once


@dataclass(frozen=True, slots=True)
class FoundMatch:
    part: "Lamp | Region | None"  # what was matched; None for all of the photo
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

    def refused(self, reasons: tuple[str, ...], part: "Lamp | Region | None") -> Self:
        """Keep the match where the next one, of this part, is refused."""
        return replace(self, refusal=reasons, refused_part=part)


@dataclass(frozen=True, eq=False, slots=True)
class PhotoDocument:
    """A photo that was read, what is asked of it, and what was found in it."""

    photo: "Photo"
    source: PhotoSource
    is_searched: bool = False  # whether its lamps are being searched
    lamps: "tuple[Lamp, ...]" = ()
    why_no_lamps: str = ""  # a sentence where the search has failed
    requested: MatchRequest | None = None  # the match that is at work
    found: FoundMatch | None = None  # the outcome of the last one

    @property
    def frame(self) -> PhotoFrame:
        return PhotoFrame(self.photo.path, self.photo.image.shape, self.photo.turned)

    def at_rest(self) -> Self:
        """Return the document without the work that ends when another photo is opened."""
        return replace(self, is_searched=False, requested=None)


@dataclass(frozen=True, eq=False, slots=True)
class ListedRows:
    """What was found so far in the photos of the table, and how they were read."""

    rows: "tuple[PhotoRow, ...]"
    reading: PhotoReading
    given: float  # the known value of the scene when they were matched, in SI units

    def match_of(self, document: PhotoDocument) -> FoundMatch | None:
        rows = (row for row in self.rows if row.path == document.photo.path)
        row = next(rows, None)
        if row is None or row.match is None or document.source.reading != self.reading:
            return None
        return FoundMatch(None, row.match, self.given, is_listed=True)


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
