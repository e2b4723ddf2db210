"""Controller of matching: fit the scene to the photo in the background, and use the result."""

from collections.abc import Mapping, Sequence
from datetime import date
from typing import Protocol

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Task
from occ_gui.photo.assumption import is_certain
from occ_gui.photo.kept_photo import KeptMatch
from occ_gui.photo.match_choice import MatchChoice
from occ_gui.photo.match_request import MatchRequest, Refusal, match, request_of
from occ_gui.scene.scene_store import SceneStore
from occ_model.errors import OccError
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import Cure
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Match
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.presets import save_preset
from occ_model.study.bands.cure import cure_of

_RECORDED = ("exposure_time", "f_number", "iso")
"""Parameters of the scene that cameras record in their photos."""


class MatchPane(Protocol):
    """A pane that shows the progress and the result of a match."""

    def show_match_begun(self) -> None:
        """Show that a match is running."""

    def show_progress(self, share: float) -> None:
        """Show the fraction of the work that is done, from 0 to 1."""

    def show_match(self, match: Match | None) -> None:
        """Show this match in place of the previous one, or that there is none."""

    def show_cure(self, cure: Cure) -> None:
        """Show what takes the bars out of the match's picture."""

    def show_match_refused(self, reasons: Sequence[str]) -> None:
        """Show the reasons why no match was found, or none; the previous match stays."""

    def show_match_outdated(self, why: str, usable: bool) -> None:
        """Show why the match is not the present one, empty if it is, and whether it can be used."""

    def show_match_failed(self, sentence: str) -> None:
        """Show why the match failed; the previous one stays."""

    def show_match_cancelled(self) -> None:
        """Show that the match was cancelled; the previous one stays."""


def sources_of(
    found: Match, photo_name: str, known: str, day: date, *, assumed: bool
) -> dict[str, str]:
    """Write the source and uncertainty of every value that a match estimated.

    Parameters
    ----------
    found, photo_name
        The match, and the name of its photo.
    known
        The parameter that was taken as known.
    day
        The day of the match.
    assumed
        Whether that parameter's value was only assumed.
    """
    given = quantity(known)
    value = given.format(float(found.scene.value(known)))
    how = "assumed to be" if assumed else "being"
    where = f"photo {photo_name}, {day.isoformat()}, the {given.label.lower()} {how} {value}"
    sources = {}
    for name, spread in found.uncertainties.items():
        if name in PARAMETERS:
            precision = quantity(name).unit.format_deviation(spread)
            doubt = "; doubtful" if name in found.doubtful_alone else ""
            sources[name] = f"measured to ±{precision} from {where}{doubt}"
    for name in ("rows", "columns"):
        sources[name] = f"the size of the photo {photo_name}"
    if found.pattern_was_read:
        sources["pattern"] = f"read from the photo {photo_name}"
    return sources


class MatchController(QObject):
    """Runs matches, and puts their results into the scene or a preset.

    Parameters
    ----------
    scenes
        The scene with the known values, which also takes the result.
    pane
        The pane that shows progress and result.
    """

    failed = Signal(str)
    """Why a match failed, or a setting could not be taken over."""

    matched = Signal(object)
    """The match that was found."""

    saved = Signal(str)
    """The name of the preset that was saved."""

    def __init__(self, scenes: SceneStore, pane: MatchPane) -> None:
        super().__init__()
        self._scenes = scenes
        self._pane = pane
        self._photo: Photo | None = None
        self._region: Lamp | Region | None = None
        self._matched_region: Lamp | Region | None = None
        self._is_reading = self._was_refused = False
        self._why_unusable = ""
        self._known = self._asked_known = ""
        self._certain: Mapping[str, float] = {}
        self.match: Match | None = None
        self.runner: Task[MatchRequest, Match | Refusal] = Task(
            match, "match of the photo", impatient=True
        )
        self.runner.reported.connect(pane.show_progress)
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._fail)

    @property
    def photo(self) -> Photo | None:
        """The photo to be matched, None if none is open."""
        return self._photo

    def show_photo(self, photo: Photo | None) -> None:
        """Match this photo in place of the previous one, or none."""
        self.cancel()
        self._photo = photo
        self.match = None
        self._was_refused = False
        self._pane.show_match(None)

    def show_certain(self, certain: Mapping[str, float]) -> None:
        """Take these known values as certain, all others as assumed, in SI units by name."""
        self._certain = certain

    def set_region(self, region: Lamp | Region | None) -> None:
        """Match this lamp or rectangle from now on, or the whole photo."""
        if region == self._region:
            return
        self.cancel()
        self._region = region
        if self._was_refused:
            self._was_refused = False
            self._pane.show_match_refused(())
        self._show_age()

    def show_reading(self, reading: bool) -> None:
        """Tell apart what was found from a photo that is being read."""
        self._is_reading = reading
        self._show_age()

    def _show_age(self) -> None:
        """Say of the match that is shown whether it answers the present question."""
        if self.match is None:
            return
        elsewhere, why = "", ""
        if self._is_reading:
            elsewhere = "of the photo before: one is being read"
        elif self._matched_region != self._region:
            elsewhere = "of another part of the photo: match again"
        elif self._was_refused:
            why = "of the match before: the last one is refused"
        self._why_unusable = elsewhere
        self._pane.show_match_outdated(elsewhere or why, usable=not elsewhere)

    def start(self, choice: MatchChoice) -> None:
        """Match the photo with the current scene."""
        if self._photo is None:
            return
        try:
            request = request_of(self._photo, self._scenes.scene, choice, self._region)
        except OccError as error:
            self._fail(str(error))
            return
        from occ_model.photo.match import ESTIMATES  # with the first match, not with the window

        (self._asked_known,) = (name for name in ESTIMATES if name != choice.estimate)
        self._pane.show_match_begun()
        self.runner.ask(request)

    def take_over(self, found: Match) -> None:
        """Show a match of the whole photo that the table has found, as if it were made here."""
        if not self.runner.is_idle or self._photo is None:
            return
        from occ_model.photo.match import ESTIMATES

        (self._asked_known,) = (name for name in ESTIMATES if name not in found.uncertainties)
        self._take(found)

    def kept(self) -> KeptMatch | None:
        """Return the match, to be given back with its photo."""
        if self.match is None:
            return None
        return KeptMatch(self.match, self._matched_region)

    def give_back(self, kept: KeptMatch) -> None:
        """Show a match again that was made before another photo was opened."""
        self.take_over(kept.match)
        self._matched_region = kept.region
        self._show_age()

    def cancel(self) -> None:
        """Cancel the running match."""
        if not self.runner.is_idle:
            self.runner.cancel()
            self._pane.show_match_cancelled()

    def use_notes(self) -> None:
        """Put the settings that the camera recorded in the photo into the scene, as one step."""
        if self._photo is None:
            return
        notes = {name: getattr(self._photo, name) for name in _RECORDED}
        changes = {name: value for name, value in notes.items() if value is not None}
        title = f"settings of {self._photo.path.name}"
        try:
            self._scenes.put(self._scenes.scene.replace(**changes), title)
        except OccError as error:
            self.failed.emit(str(error))

    def apply(self) -> None:
        """Replace the scene by the matched one, as one step."""
        if self.match is None or self._photo is None or self._refuses_outdated():
            return
        title = f"match with {self._photo.path.name}"
        self._scenes.put(self.match.scene, title)

    def cure(self) -> None:
        """Replace the scene by the matched one at a shutter speed without bars, as one step."""
        if self.match is None or self._photo is None or self._refuses_outdated():
            return
        self._scenes.put(cure_of(self.match.scene).scene, "shutter speed without bars")

    def save(self, name: str, title: str, day: date | None = None) -> None:
        """Save the matched scene as one of the user's presets."""
        if self.match is None or self._photo is None or self._refuses_outdated():
            return
        known = float(self.match.scene.value(self._known))
        sources: Mapping[str, str] = sources_of(
            self.match,
            self._photo.path.name,
            self._known,
            day or date.today(),
            assumed=not is_certain(self._known, known, self._certain),
        )
        try:
            save_preset(name, self.match.scene, title=title, sources=sources)
        except OccError as error:
            self.failed.emit(str(error))
            return
        self.saved.emit(name)

    def _refuses_outdated(self) -> bool:
        """Say why a match that is not the present one is not used; return whether it is not."""
        if self._why_unusable:
            self.failed.emit(f"This match is {self._why_unusable}; it is not used.")
        return bool(self._why_unusable)

    def _take(self, found: Match | Refusal) -> None:
        self._was_refused = isinstance(found, Refusal)
        if isinstance(found, Refusal):
            self._pane.show_match_refused(found.reasons)
            self._show_age()
            self.failed.emit(" ".join(found.reasons))
            return
        self.match, self._known = found, self._asked_known
        self._matched_region = self._region
        self._pane.show_match(found)
        error = found.uncertainties.get("exposure_time", 0.0)
        self._pane.show_cure(cure_of(found.scene, error))
        self._show_age()
        self.matched.emit(found)

    def _fail(self, sentence: str) -> None:
        self._pane.show_match_failed(sentence)
        self.failed.emit(sentence)

    def stop(self) -> None:
        """Stop matching."""
        self.runner.stop()
