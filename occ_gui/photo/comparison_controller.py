"""Controller of the comparison: the photo's profile beside the simulated one."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from PySide6.QtCore import QObject

from occ_gui.background.task import Task
from occ_gui.picture.placement import Placement, PlacementStore
from occ_gui.shell.photo_profile import PhotoProfile
from occ_gui.simulation.snapshot import Reading
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare, enhance_comparison
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Comparison, Match, Stripes

_LEAST_SWING = 0.5
"""Swing in grey levels below which the simulated columns show no stripes."""


class ProfilePane(Protocol):
    """A pane that shows a photo's profile beside the simulated one."""

    def show_photo_profile(self, profile: PhotoProfile | None) -> None:
        """Show this profile in place of the previous one, or none."""


@dataclass(frozen=True, eq=False, slots=True)
class StripeSearch:
    """Result of searching a photo for stripes: the stripes, or a sentence why there are none."""

    photo: Photo
    region: Lamp | Region | None
    stripes: Stripes | None
    sentence: str


def search_stripes(request: tuple[Photo, Lamp | Region | None]) -> StripeSearch:
    """Search a photo, or a part of it, for stripes; the result says why if there are none."""
    photo, region = request
    try:
        return StripeSearch(photo, region, find_stripes(photo, region), "")
    except MatchError as error:
        return StripeSearch(photo, region, None, str(error))


class ComparisonController(QObject):
    """Compares photo and simulation whenever either changes or the photo is moved.

    A photo's stripes are searched once, in the background; those of a match replace them.

    Parameters
    ----------
    placements
        Where the photo lies on the simulated picture.
    pane
        The pane that shows both profiles.
    """

    def __init__(self, placements: PlacementStore, pane: ProfilePane) -> None:
        super().__init__()
        self._placements = placements
        self._pane = pane
        self._photo: Photo | None = None
        self._region: Lamp | Region | None = None
        self._reading: Reading | None = None
        self._stripes: Stripes | None = None
        self._sentence = ""
        self._enhanced, self._is_shown = False, True
        self.runner: Task[tuple[Photo, Lamp | Region | None], StripeSearch] = Task(
            lambda request, _: search_stripes(request), "search for stripes"
        )
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._show_failure)
        placements.changed.connect(self._compare)

    def show_reading(self, reading: Reading) -> None:
        """Compare with this reading in place of the previous one."""
        self._reading = reading
        self._suggest_placement()
        self._compare()

    def show_photo(self, photo: Photo | None) -> None:
        """Compare this photo in place of the previous one, or none."""
        self._photo, self._region = photo, None
        self._search()
        self._placements.reset()
        self._suggest_placement()
        self._compare()

    def set_region(self, region: Lamp | Region | None) -> None:
        """Compare the stripes of this lamp or rectangle from now on, or of the whole photo."""
        if region is not self._region and region != self._region:
            self._region = region
            self._search()
            self._compare()

    def _search(self) -> None:
        self._stripes, self._sentence = None, ""
        if self._photo is not None:
            self.runner.ask((self._photo, self._region))

    def show_match(self, match: Match) -> None:
        """Use the stripes of a match, whose levels are those of the fit."""
        self._stripes, self._sentence = match.stripes, ""
        self._compare()

    def set_enhanced(self, enhanced: bool) -> None:
        """Compare with the enhanced simulated columns, or with those before enhancement."""
        self._enhanced = enhanced
        self._compare()

    def _take(self, found: StripeSearch) -> None:
        # Ignore the stripes of a photo that was closed; those of a match take precedence.
        wanted = found.photo is self._photo and found.region is self._region
        if wanted and self._stripes is None:
            self._stripes, self._sentence = found.stripes, found.sentence
            self._compare()

    def _show_failure(self, sentence: str) -> None:
        self._sentence = sentence
        self._compare()

    def _suggest_placement(self) -> None:
        """Suggest the picture's corner for a photo of the same size, else the panel's corner."""
        if self._photo is None or self._reading is None:
            return
        camera = self._reading.scene.camera
        same = self._photo.image.shape == (camera.rows, camera.columns)
        column, row = (0.0, 0.0) if same else self._reading.panel_origin
        self._placements.suggest(Placement(column, row))

    def _compare(self) -> None:
        photo, reading = self._photo, self._reading
        if photo is None or reading is None:
            if self._is_shown:
                self._is_shown = False
                self._pane.show_photo_profile(None)
            return
        self._is_shown = True
        placement = self._placements.placement
        comparison, sentence = None, self._sentence
        method = reading.scene.model.enhancement
        try:
            comparison = self._compare_with(reading)
        except MatchError as error:
            sentence = str(error)
        if comparison is not None and float(np.ptp(comparison.simulated)) < _LEAST_SWING:
            # A photo scaled to no swing at all would agree with any simulation.
            comparison, sentence = None, "The simulation has no stripes there to compare."
        raw = photo.profile
        if self._enhanced:
            raw = enhance(raw, method).astype(np.float64)
        self._pane.show_photo_profile(
            PhotoProfile(comparison, raw, placement.column, placement.scale, sentence)
        )

    def _compare_with(self, reading: Reading) -> Comparison | None:
        """Compare with a simulated profile, as it is shown; None if no stripes are known."""
        placement, stripes = self._placements.placement, self._stripes
        if stripes is None:
            return None
        first = placement.column + stripes.region.first_column * placement.scale
        comparison = compare(stripes.flattened, reading.profile, first, placement.scale)
        if not self._enhanced:
            return comparison
        return enhance_comparison(comparison, reading.signal, reading.scene.model.enhancement)

    def comparison(self) -> Comparison | None:
        """Return the comparison that is shown; None if there is none."""
        if self._photo is None or self._reading is None:
            return None
        try:
            return self._compare_with(self._reading)
        except MatchError:
            return None

    def stop(self) -> None:
        """Stop the search for stripes."""
        self.runner.stop()
