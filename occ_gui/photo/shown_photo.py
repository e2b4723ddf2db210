"""The open photo as it is shown and matched, derived from workspace and results."""

from dataclasses import dataclass, field, replace
from typing import TypeAlias

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.results import Results, ResultsStore
from occ_gui.simulation.snapshot import ColumnView, Reading
from occ_gui.values.choices import MatchChoice, PhotoChoice, PhotoFrame, Placement
from occ_gui.values.photo_results import ListedRows, MatchOutcome, PhotoDocument, StripeSearch
from occ_model.errors import ParameterError
from occ_model.photo.reading.load import Photo, region_within
from occ_model.results.bands import Cure
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match, Stripes, known_parameter
from occ_model.results.photo_table import PhotoRow
from occ_model.scene.scene import Scene

Part: TypeAlias = Lamp | Region | None
"""The part of a photo that is matched: a lamp, a rectangle drawn by hand, or None for all of it."""


def part_of(choice: PhotoChoice, results: Results) -> Part:
    """Return the part of the open photo that is matched.

    For a lamp that is no longer among the lamps found, this is its region.
    """
    document = results.document
    if document is None:
        return None
    any_frame = choice.parts.get(PhotoFrame(document.photo.path))
    part = choice.parts.get(document.frame, any_frame)
    if isinstance(part, Lamp):
        return part if part in document.lamps else part.region
    return part if part is not None and lies_within(document.photo, part) else None


def lies_within(photo: Photo, region: Region) -> bool:
    try:
        region_within(photo, region)
    except ParameterError:
        return False
    return True


def known_of(choice: MatchChoice, scene: Scene) -> str:
    """Return the parameter that must be known for a match with these choices."""
    if choice.sent == "lamp" and choice.estimate == "readout_time":
        return "lamp_frequency"
    return known_parameter(choice.estimate, scene.transmitter)


def find_match(results: Results) -> MatchOutcome | None:
    """Return the match of the open photo: its own, or the one in its row of the table."""
    document, listed = results.document, results.listed
    if document is None:
        return None
    outcome = document.outcome
    if listed is not None and (outcome is None or outcome.match is None):
        row = listed.match_of(document)
        if row is not None and outcome is not None:
            row = row.with_refusal(outcome.refusal, outcome.part)
        return row or outcome
    return outcome


def automatic_placement(
    photo: Photo, reading: ColumnView, search: StripeSearch | None = None
) -> Placement:
    """Place a photo of the picture's size on the picture, any other with its lamp on the panel."""
    camera = reading.scene.camera
    if photo.image.shape == (camera.rows, camera.columns):
        return Placement()
    column, row = reading.panel_origin
    if search is not None and search.stripes is not None:
        lamp = search.stripes.region
        column, row = column - lamp.first_column, row - lamp.first_row
    return Placement(column, row)


@dataclass(frozen=True, slots=True)
class ShownPhoto:
    scene: Scene
    choice: PhotoChoice = field(default_factory=PhotoChoice)
    reading: Reading | None = None  # the reading of the simulated scene
    document: PhotoDocument | None = None
    part: Part = None
    outcome: MatchOutcome | None = None
    listed: ListedRows | None = None  # the results for the photos of the table
    cure: Cure | None = None  # the remedy for the bars of the match, once it is known
    row: PhotoRow | None = None  # the photo's row of the table
    stripe_search: StripeSearch | None = None
    placement: Placement = field(default_factory=Placement)
    is_placed_by_hand: bool = False  # whether the user has placed the photo
    is_loading: bool = False  # whether another photo is being loaded
    is_enhanced: bool = False

    @classmethod
    def of(cls, workspace: Workspace, results: Results) -> "ShownPhoto":
        choice, document, reading = workspace.photo, results.document, results.reading
        listed = results.listed
        if listed is not None and listed.paths != choice.listed:
            listed = None
        shown = cls(workspace.scene, choice, reading, listed=listed)
        if document is None:
            return shown
        placed, placement = choice.placed_photo, Placement()
        is_placed_by_hand = placed is not None and placed.source == document.source
        if placed is not None and is_placed_by_hand:
            placement = placed.placement.within_limits()
        elif reading is not None:
            placement = automatic_placement(document.photo, reading, results.stripes)
        return replace(
            shown,
            document=document,
            part=part_of(choice, results),
            outcome=find_match(results),
            row=None if listed is None else listed.row_of(document),
            stripe_search=results.stripes,
            placement=placement,
            is_placed_by_hand=is_placed_by_hand,
            is_loading=choice.source != document.source,
            is_enhanced=workspace.is_enhanced,
        )

    @property
    def photo(self) -> Photo | None:
        return None if self.document is None else self.document.photo

    @property
    def lamps(self) -> tuple[Lamp, ...]:
        return () if self.document is None else self.document.lamps

    @property
    def chosen_lamp(self) -> int | None:
        """The index of the lamp that is matched; None if it is not one of the lamps found."""
        return next((index for index, lamp in enumerate(self.lamps) if lamp is self.part), None)

    @property
    def rectangle(self) -> Region | None:
        """The rectangle drawn by hand that is matched."""
        return self.part if isinstance(self.part, Region) else None

    @property
    def is_matching(self) -> bool:
        """Whether a match is running."""
        return self.document is not None and self.document.match_request is not None

    @property
    def search(self) -> tuple[tuple[Lamp, ...], bool, str]:
        """The lamps found, whether the search is running, and why it found none."""
        document = self.document
        if document is None:
            return (), False, ""
        return document.lamps, document.is_searched, document.why_no_lamps

    @property
    def stripes(self) -> Stripes | None:
        """The stripes of the match, with the fitted levels, or those found before."""
        if self.match is not None:
            return self.match.stripes
        return None if self.stripe_search is None else self.stripe_search.stripes

    @property
    def compared_stripes(self) -> Stripes | None:
        """The stripes to compare: the match of a code does not change their levels."""
        search = self.stripe_search
        is_lamp = self.match is not None and self.match.lamp is not None
        if is_lamp or search is None or search.stripes is None:
            return self.stripes
        return search.stripes

    @property
    def why_no_stripes(self) -> str:
        """Why no stripes are known; also empty while the search is running."""
        search = self.stripe_search
        return "" if self.match is not None or search is None else search.sentence

    @property
    def match(self) -> Match | None:
        return None if self.outcome is None else self.outcome.match

    @property
    def present_match(self) -> Match | None:
        """The match, unless it is outdated."""
        return None if self.validity[0] else self.match

    @property
    def is_applied(self) -> bool:
        """Whether the scene is that of the match."""
        return self.match is not None and self.match.is_applied_to(self.scene)

    @property
    def refusal(self) -> tuple[str, ...]:
        """The reasons why the match was refused; empty if it was not."""
        return () if self.outcome is None else self.outcome.refusal_of(self.part)

    @property
    def why_unusable(self) -> str:
        """Why the match belongs to another photo or part and cannot be used; empty if it can."""
        if self.is_loading:
            return "of the previous photo: the next one is being loaded"
        if self.outcome is not None and self.outcome.part != self.part:
            return "of another part of the photo: match again"
        return ""

    @property
    def validity(self) -> tuple[str, bool]:
        """Why the match is outdated, empty if it is not, and whether it can be used."""
        reason = "an earlier match: the latest one was refused" * bool(self.refusal)
        return self.why_unusable or reason, not self.why_unusable


_INSET = 4  # the first rectangle leaves out a fraction 1 / _INSET of the photo at each side


class PartEdits(QObject):
    def __init__(self, store: Store, results_store: ResultsStore) -> None:
        super().__init__()
        self._store, self._results_store = store, results_store

    @property
    def part(self) -> Part:
        return part_of(self._store.workspace.photo, self._results_store.results)

    def choose(self, index: int) -> None:
        document = self._results_store.results.document
        if document is not None and 0 <= index < len(document.lamps):
            self._match(document.lamps[index])

    def draw(self, region: Region) -> None:
        """Match this rectangle, clipped to the photo."""
        photo = self._results_store.results.photo
        if photo is None:
            return
        rows, columns = photo.image.shape
        clipped = Region(
            min(max(region.first_row, 0), rows - 1), max(min(region.last_row, rows), 1),
            min(max(region.first_column, 0), columns - 1), max(min(region.last_column, columns), 1),
        )  # fmt: skip
        self._match(clipped if lies_within(photo, clipped) else self.part)

    def set_by_hand(self, by_hand: bool) -> None:
        """Match a rectangle drawn by hand, or the whole photo again.

        The first rectangle is that of the chosen lamp, or the middle of the photo.
        """
        photo = self._results_store.results.photo
        if not by_hand or photo is None:
            self.match_whole()
            return
        rows, columns = photo.image.shape
        middle = Region(
            rows // _INSET, rows - rows // _INSET, columns // _INSET, columns - columns // _INSET
        )
        self.draw(self.part.region if isinstance(self.part, Lamp) else middle)

    def match_whole(self) -> None:
        self._match(None)

    def _match(self, part: Part) -> None:
        workspace, document = self._store.workspace, self._results_store.results.document
        if document is not None:
            photo = workspace.photo.with_part(document.frame, part)
            self._store.put(replace(workspace, photo=photo))
