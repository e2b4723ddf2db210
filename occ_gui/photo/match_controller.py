"""Match the photo with the scene off the window's thread, and use what was found."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from typing import Protocol

from PySide6.QtCore import QObject, Signal

from occ_gui.background.cancellable import Cancellable, Report
from occ_gui.photo.match_choice import CHIPS_OF_A_CYCLE, MatchChoice
from occ_gui.scene.scene_store import SceneStore
from occ_model.errors import OccError
from occ_model.photo.match import ESTIMATES, match_photo
from occ_model.photo.reading.load import Photo
from occ_model.results import Match
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.presets import save_preset
from occ_model.scene.scene import Scene

SQUARE_WAVE = "10"
"""The chips of an LED that blinks: on for half a cycle, off for the other half."""

_NOTED = ("exposure_time", "f_number", "iso")
"""What a camera notes in its photos, by the names of the scene's parameters."""


class MatchPane(Protocol):
    """A pane that shows how a match goes on and what it gives."""

    def show_match_begun(self) -> None:
        """Tell that a match is being worked on."""

    def show_progress(self, share: float) -> None:
        """Tell which share of the work is done, from 0 to 1."""

    def show_match(self, match: Match | None) -> None:
        """Show what a match gave in place of the last one, or that there is none."""

    def show_match_failed(self, sentence: str) -> None:
        """Tell why there is no match; the last one stays."""

    def show_match_cancelled(self) -> None:
        """Tell that the match was given up; the last one stays."""


@dataclass(frozen=True, eq=False, slots=True)
class MatchRequest:
    """What a thread in the background is asked to match."""

    photo: Photo
    scene: Scene
    estimate: str
    sent: str
    fit_gamma: bool


def request_of(photo: Photo, scene: Scene, choice: MatchChoice) -> MatchRequest:
    """Make out of what the user wants what the model is asked.

    Raises
    ------
    ParameterError
        An LED cannot blink as often as that.
    """
    sent = choice.sent
    if sent == "square":
        chips = CHIPS_OF_A_CYCLE * choice.square_frequency
        scene, sent = scene.replace(pattern=SQUARE_WAVE, switching_frequency=chips), "scene"
    return MatchRequest(photo, scene, choice.estimate, sent, choice.fit_gamma)


def match(request: MatchRequest, report: Report) -> Match:
    """Match a photo.

    Raises
    ------
    MatchError
        No scene explains the photo's stripes.
    """
    report(0.0)
    return match_photo(
        request.photo,
        request.scene,
        estimate=request.estimate,
        sent=request.sent,
        fit_gamma=request.fit_gamma,
        progress=report,
    )


def sources_of(found: Match, photo_name: str, known: str, day: date) -> dict[str, str]:
    """Say of every value that a match estimated where it comes from, and how sure it is."""
    given = quantity(known)
    value = given.format(float(found.scene.value(known)))
    where = f"photo {photo_name}, {day.isoformat()}, the {given.label.lower()} being {value}"
    sources = {}
    for name, spread in found.uncertainties.items():
        if name in PARAMETERS:
            precision = quantity(name).format(spread, 3)
            sources[name] = f"measured to ±{precision} from {where}"
    for name in ("rows", "columns"):
        sources[name] = f"the size of the photo {photo_name}"
    if found.pattern_was_read:
        sources["pattern"] = f"read from the photo {photo_name}"
    return sources


class MatchController(QObject):
    """Runs matches, and puts what they found into the scene or a preset.

    Parameters
    ----------
    scenes
        Gives what is known, and takes what is found.
    pane
        Shows how it goes on.
    """

    failed = Signal(str)
    """Why there is no match, or a setting could not be taken over."""

    matched = Signal(object)
    """The match that was found."""

    saved = Signal(str)
    """The name of the preset that was saved."""

    def __init__(self, scenes: SceneStore, pane: MatchPane) -> None:
        super().__init__()
        self._scenes = scenes
        self._pane = pane
        self._photo: Photo | None = None
        self._known = self._asked_known = ""
        self.match: Match | None = None
        self.runner: Cancellable[MatchRequest, Match] = Cancellable(match, "match of the photo")
        self.runner.reported.connect(pane.show_progress)
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._fail)

    @property
    def photo(self) -> Photo | None:
        """The photo that is matched, None if there is none."""
        return self._photo

    def show_photo(self, photo: Photo | None) -> None:
        """Match this photo from now on, or none."""
        self.cancel()
        self._photo = photo
        self.match = None
        self._pane.show_match(None)

    def start(self, choice: MatchChoice) -> None:
        """Match the photo with the scene as it is now."""
        if self._photo is None:
            return
        try:
            request = request_of(self._photo, self._scenes.scene, choice)
        except OccError as error:
            self._fail(str(error))
            return
        (self._asked_known,) = (name for name in ESTIMATES if name != choice.estimate)
        self._pane.show_match_begun()
        self.runner.start(request)

    def cancel(self) -> None:
        """Give up the match that is being worked on."""
        if self.runner.is_running:
            self.runner.cancel()
            self._pane.show_match_cancelled()

    def use_notes(self) -> None:
        """Put what the camera noted in the photo into the scene, as one step."""
        if self._photo is None:
            return
        notes = {name: getattr(self._photo, name) for name in _NOTED}
        changes = {name: value for name, value in notes.items() if value is not None}
        title = self.tr("settings of {name}").format(name=self._photo.path.name)
        try:
            self._scenes.put(self._scenes.scene.replace(**changes), title)
        except OccError as error:
            self.failed.emit(str(error))

    def apply(self) -> None:
        """Put the scene that was found in place of the scene, as one step."""
        if self.match is not None and self._photo is not None:
            title = self.tr("match with {name}").format(name=self._photo.path.name)
            self._scenes.put(self.match.scene, title)

    def save(self, name: str, title: str, day: date | None = None) -> None:
        """Save the scene that was found as one of the user's presets."""
        if self.match is None or self._photo is None:
            return
        sources: Mapping[str, str] = sources_of(
            self.match,
            self._photo.path.name,
            self._known,
            day or date.today(),
        )
        try:
            save_preset(name, self.match.scene, title=title, sources=sources)
        except OccError as error:
            self.failed.emit(str(error))
            return
        self.saved.emit(name)

    def _take(self, found: Match) -> None:
        self.match, self._known = found, self._asked_known
        self._pane.show_match(found)
        self.matched.emit(found)

    def _fail(self, sentence: str) -> None:
        self._pane.show_match_failed(sentence)
        self.failed.emit(sentence)

    def stop(self) -> None:
        """Match no more."""
        self.runner.stop()
