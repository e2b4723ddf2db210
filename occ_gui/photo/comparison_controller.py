"""Lay the photo's profile over the simulated one, and place the photo on the picture."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from PySide6.QtCore import QObject

from occ_gui.background.latest_wins import LatestWins
from occ_gui.picture.placement import Placement, PlacementStore
from occ_gui.profile.photo_profile import PhotoProfile
from occ_gui.simulation.snapshot import Snapshot
from occ_model.arrays import FloatArray
from occ_model.errors import MatchError
from occ_model.photo.comparison import compare
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results import Comparison, Match, Stripes

_FLAT = 0.5
"""Grey levels of swing below which the simulated columns show no stripes."""


class ProfilePane(Protocol):
    """A pane that shows a photo's profile beside the simulated one."""

    def show_photo_profile(self, profile: PhotoProfile | None) -> None:
        """Show this in place of the last one, or none."""


@dataclass(frozen=True, eq=False, slots=True)
class Found:
    """What was found in a photo: its stripes, or why there are none."""

    photo: Photo
    stripes: Stripes | None
    sentence: str


def find(photo: Photo) -> Found:
    """Look for the stripes in a photo."""
    try:
        return Found(photo, find_stripes(photo), "")
    except MatchError as error:
        return Found(photo, None, str(error))


class ComparisonController(QObject):
    """Compares photo and simulation whenever either changes or the photo is moved.

    A photo's stripes are found once, off the window's thread; those of a match take their place.

    Parameters
    ----------
    placements
        Where the photo lies on the simulated picture.
    pane
        Shows the two profiles.
    """

    def __init__(self, placements: PlacementStore, pane: ProfilePane) -> None:
        super().__init__()
        self._placements = placements
        self._pane = pane
        self._photo: Photo | None = None
        self._snapshot: Snapshot | None = None
        self._stripes: Stripes | None = None
        self._sentence = ""
        self._enhanced = False
        self.runner: LatestWins[Photo, Found] = LatestWins(find, "search for stripes")
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._do_without)
        placements.changed.connect(self._compare)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Compare with these results from now on."""
        self._snapshot = snapshot
        self._suggest_placement()
        self._compare()

    def show_photo(self, photo: Photo | None) -> None:
        """Compare this photo from now on, or none."""
        self._photo = photo
        self._stripes, self._sentence = None, ""
        if photo is not None:
            self.runner.submit(photo)
        self._placements.reset()
        self._suggest_placement()
        self._compare()

    def show_match(self, match: Match) -> None:
        """Take a match's stripes: its levels are those of the fit."""
        self._stripes, self._sentence = match.stripes, ""
        self._compare()

    def set_enhanced(self, enhanced: bool) -> None:
        """Say whether the simulated columns are compared as they stand in the picture."""
        self._enhanced = enhanced
        self._compare()

    def _take(self, found: Found) -> None:
        # Not the stripes of a photo that is gone, nor in place of those of a match.
        if found.photo is self._photo and self._stripes is None:
            self._stripes, self._sentence = found.stripes, found.sentence
            self._compare()

    def _do_without(self, sentence: str) -> None:
        self._sentence = sentence
        self._compare()

    def _suggest_placement(self) -> None:
        """Lay a photo on the whole picture if that has its very size, else on the panel."""
        if self._photo is None or self._snapshot is None:
            return
        same = self._photo.image.shape == self._snapshot.frame.image.shape
        column, row = (0.0, 0.0) if same else self._snapshot.panel_origin
        self._placements.suggest(Placement(column, row))

    def _compare(self) -> None:
        photo, snapshot = self._photo, self._snapshot
        if photo is None or snapshot is None:
            self._pane.show_photo_profile(None)
            return
        placement = self._placements.placement
        comparison, sentence = None, self._sentence
        frame = snapshot.frame
        simulated = frame.enhanced.astype(np.float64) if self._enhanced else frame.profile
        try:
            comparison = self._beside(simulated)
        except MatchError as error:
            sentence = str(error)
        if comparison is not None and float(np.ptp(comparison.simulated)) < _FLAT:
            # A photo that is given the swing of nothing would agree with anything.
            comparison, sentence = None, self.tr("The simulation has no stripes there to compare.")
        self._pane.show_photo_profile(
            PhotoProfile(comparison, photo.profile, placement.column, placement.scale, sentence)
        )

    def _beside(self, simulated: FloatArray) -> Comparison | None:
        """Compare with some simulated columns; None where no stripes are known."""
        placement, stripes = self._placements.placement, self._stripes
        if stripes is None:
            return None
        first = placement.column + stripes.region.first_column * placement.scale
        return compare(stripes.flattened, simulated, first, placement.scale)

    def comparison(self) -> Comparison | None:
        """Compare with the simulated columns before enhancement; None where that cannot be."""
        if self._photo is None or self._snapshot is None:
            return None
        try:
            return self._beside(self._snapshot.frame.profile)
        except MatchError:
            return None

    def stop(self) -> None:
        """Look for no more stripes."""
        self.runner.stop()
