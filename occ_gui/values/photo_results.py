"""Results computed from a photo, each with what it was computed from."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Self

import numpy as np

from occ_gui.values.choices import LoadOptions, MatchChoice, PhotoFrame, PhotoSource
from occ_model.arrays import FloatArray
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene

if TYPE_CHECKING:  # a window without a photo starts without them
    from occ_model.photo.many.row import MatchSettings
    from occ_model.photo.reading.load import Photo
    from occ_model.results.comparison import Comparison
    from occ_model.results.lamp import Lamp
    from occ_model.results.match import Match, Stripes
    from occ_model.results.photo_table import PhotoRow, PhotoTable


@dataclass(frozen=True, eq=False, slots=True)
class StripeSearch:
    """The stripes of a photo or a part of it, or the reason why there are none."""

    stripes: "Stripes | None"
    sentence: str


@dataclass(frozen=True, eq=False, slots=True)
class MatchRequest:
    """A request for a match: the photo, the scene and the choices at that time, and the part."""

    photo: "Photo"
    scene: Scene
    choice: MatchChoice
    part: "Lamp | Region | None"  # None for all of the photo
    applies_result: bool = False  # whether the match is applied to the scene as soon as it is ready


@dataclass(frozen=True, slots=True)
class MatchOutcome:
    part: "Lamp | Region | None"  # what was matched; None for all of the photo
    # The match; after a refusal, the previous match, or None if there was none
    match: "Match | None"
    # Name and value in SI units of the scene's known parameter when the match was requested
    given: tuple[str, float]
    # Why the latest match was refused, a sentence for each reason, and the part to be matched
    refusal: tuple[str, ...] = ()
    refused_part: "Lamp | Region | None" = None
    is_listed: bool = False

    def refusal_of(self, part: "Lamp | Region | None") -> tuple[str, ...]:
        """Return why the match of this part was refused; empty if it was not."""
        return self.refusal if part == self.refused_part else ()

    def with_refusal(self, reasons: tuple[str, ...], part: "Lamp | Region | None") -> Self:
        """Return this match with the reasons why the next one, of this part, was refused."""
        return replace(self, refusal=reasons, refused_part=part)


@dataclass(frozen=True, eq=False, slots=True)
class PhotoDocument:
    """A photo that was loaded, the requests for it, and their results."""

    photo: "Photo"
    source: PhotoSource
    is_searched: bool = False  # whether it is being searched for lamps
    lamps: "tuple[Lamp, ...]" = ()
    why_no_lamps: str = ""  # why the search failed; empty if it did not
    match_request: MatchRequest | None = None  # the match that is running
    outcome: MatchOutcome | None = None  # of the last match

    @property
    def frame(self) -> PhotoFrame:
        return PhotoFrame(self.photo.path, self.photo.image.shape, self.photo.turned)

    def without_work(self) -> Self:
        """Return the document without running work, which ends when another photo is opened."""
        return replace(self, is_searched=False, match_request=None)


@dataclass(frozen=True, eq=False, slots=True)
class ListedRows:
    """The results so far for the photos of the table, and how they were loaded and matched."""

    paths: tuple[Path, ...]
    rows: "Mapping[int, PhotoRow]"  # by the index of the photo
    load_options: LoadOptions
    given: tuple[str, float]  # as in a MatchOutcome
    settings: "MatchSettings"
    table: "PhotoTable | None" = None  # the rows with their mean, once all photos are matched
    is_running: bool = False

    def row_of(self, document: PhotoDocument) -> "PhotoRow | None":
        """Return the row of a photo; None before it is matched, or if it was loaded otherwise."""
        if document.source.load_options != self.load_options:
            return None
        rows = self.rows.values()
        return next((row for row in rows if row.path == document.photo.path), None)

    def match_of(self, document: PhotoDocument) -> MatchOutcome | None:
        row = self.row_of(document)
        if row is None or row.match is None:
            return None
        return MatchOutcome(None, row.match, self.given, is_listed=True)


@dataclass(frozen=True, eq=False, slots=True)
class PhotoProfile:
    # The comparison of both profiles; None if ``sentence`` says why that is impossible
    comparison: "Comparison | None"
    # Shape (columns of the photo,): mean of each column of the whole photo, in grey levels
    raw: FloatArray
    # The simulated column at the photo's first column, and simulated columns per photo column
    first_column: float = 0.0
    scale: float = 1.0
    # Why there is no comparison; empty while the photo is being searched for stripes
    sentence: str = ""
    photo: "Photo | None" = None
    is_outdated: bool = False  # whether the simulation shows an earlier scene

    @property
    def curve(self) -> tuple[FloatArray, FloatArray]:
        """Columns of the simulated picture, and the photo's levels there.

        A compared photo has the simulation's mean and contrast; any other has its own levels.
        """
        if self.comparison is None:
            columns = np.arange(len(self.raw), dtype=np.float64)
            return np.asarray(self.first_column + self.scale * columns), self.raw
        levels = self.comparison.photo
        return self.comparison.first_column + np.arange(len(levels), dtype=np.float64), levels
