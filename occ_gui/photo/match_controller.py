"""Controller of matching: fit the scene to the photo in the background, and use the result."""

from dataclasses import replace
from datetime import date

from PySide6.QtCore import QObject, Signal

from occ_gui.photo.match_figures import is_certain
from occ_gui.photo.photo_part import PhotoPart
from occ_gui.photo.photo_work import match_work
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import Board
from occ_gui.values.photo_choice import MatchAsked, MatchChoice
from occ_gui.values.photo_results import FoundMatch
from occ_model.errors import OccError
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.presets import save_preset
from occ_model.study.bands.advice import cure_of

_RECORDED = ("exposure_time", "f_number", "iso")
"""Parameters of the scene that cameras record in their photos."""


def sources_of(
    found: Match, photo_name: str, known: str, day: date, *, assumed: bool
) -> dict[str, str]:
    """Write the source and uncertainty of every value that a match estimated."""
    given = quantity(known)
    value = given.format(float(found.scene.value(known)))
    how = "assumed to be" if assumed else "being"
    where = f"photo {photo_name}, {day.isoformat()}, the {given.in_sentence} {how} {value}"
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


def cure_of_match(found: Match) -> Cure:
    return cure_of(found.scene, found.uncertainties.get("exposure_time", 0.0))


class MatchController(QObject):
    failed = Signal(str)  # why a match failed, or a setting could not be taken over
    saved = Signal(str)  # the name of the preset that was saved

    def __init__(self, scenes: SceneStore, board: Board) -> None:
        super().__init__()
        self._scenes, self._store, self._board = scenes, scenes.store, board
        self.work = match_work(scenes.store, board)
        self.work.failed.connect(self.failed)
        self.work.found.connect(self._report_refusal)
        self._settled: MatchAsked | None = None
        """The match that is shown, which may have been restored with its photo."""
        board.select(lambda results: results.match).changed.connect(self._settle)

    def _settle(self) -> None:
        self._settled = self._store.workspace.photo.match_asked

    def _report_refusal(self, found: FoundMatch) -> None:
        if found.refusal:
            self.failed.emit(found.refusal[0])  # which the verdict shows, however short it is

    @property
    def photo(self) -> Photo | None:
        return self._board.results.photo

    @property
    def _part(self) -> PhotoPart:
        return PhotoPart.of(self._store.workspace, self._board.results)

    @property
    def match(self) -> Match | None:
        return self._part.match

    def start(self, choice: MatchChoice) -> None:
        opened, workspace = self._board.results.opened, self._store.workspace
        if opened is not None:
            asked = MatchAsked(opened.source, workspace.scene, choice, self._part.part)
            self._ask(asked, choice)

    def cancel(self) -> None:
        """Cancel the running match, and return to the previous one."""
        if not self.work.task.is_idle:
            self._ask(self._settled, self._store.workspace.photo.form)

    def _ask(self, asked: MatchAsked | None, form: MatchChoice) -> None:
        workspace = self._store.workspace
        photo = replace(workspace.photo, match_asked=asked, form=form)
        self._store.put(replace(workspace, photo=photo))

    def use_notes(self) -> None:
        """Apply the settings that the camera recorded to the scene, as one step."""
        photo = self.photo
        if photo is None:
            return
        notes = {name: getattr(photo, name) for name in _RECORDED}
        changes = {name: value for name, value in notes.items() if value is not None}
        title = f"settings of {photo.path.name}"
        try:
            self._scenes.put(self._scenes.scene.replace(**changes), title)
        except OccError as error:
            self.failed.emit(str(error))

    def apply(self) -> None:
        match, photo = self._usable(), self.photo
        if match is not None and photo is not None:
            self._scenes.put(match.scene, f"match with {photo.path.name}")

    def cure(self) -> None:
        """Apply the match at a shutter speed without bars to the scene, as one step."""
        match = self._usable()
        if match is not None:
            self._scenes.put(cure_of(match.scene).scene, "shutter speed without bars")

    def save(self, name: str, title: str, day: date | None = None) -> None:
        match, photo = self._usable(), self.photo
        if match is None or photo is None:
            return
        given = match.known
        known, certain = float(match.scene.value(given)), self._store.workspace.photo.certain
        sources = sources_of(
            match, photo.path.name, given, day or date.today(),
            assumed=not is_certain(given, known, certain),
        )  # fmt: skip
        try:
            save_preset(name, match.scene, title=title, sources=sources)
        except OccError as error:
            self.failed.emit(str(error))
            return
        self.saved.emit(name)

    def _usable(self) -> Match | None:
        """Return the match that is shown; report where it is of something else, and not used."""
        part, match = self._part, self.match
        if match is not None and part.elsewhere:
            self.failed.emit(f"This match is {part.elsewhere}; it is not used.")
            return None
        return match
