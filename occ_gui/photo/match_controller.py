"""Controller of matching: fit the scene to the photo in the background, and use the result."""

from dataclasses import replace
from datetime import date

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Task
from occ_gui.photo.match_figures import is_match_certain
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_work import match
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import ResultsStore
from occ_gui.values.choices import MatchChoice
from occ_gui.values.photo_results import MatchOutcome, MatchRequest
from occ_model.errors import OccError
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.presets import save_preset
from occ_model.study.bands.advice import cure_of

_RECORDED = ("exposure_time", "f_number", "iso")
"""Parameters of the scene that cameras record in their photos."""


def describe_sources(
    match: Match, photo_name: str, known: str, day: date, *, assumed: bool
) -> dict[str, str]:
    """Describe the source and the uncertainty of every value that a match estimated."""
    parameter = quantity(known)
    value = parameter.format(float(match.scene.value(known)))
    assumption = "assumed to be" if assumed else "being"
    origin = (
        f"photo {photo_name}, {day.isoformat()}, the {parameter.in_sentence} {assumption} {value}"
    )
    sources = {}
    for name, deviation in match.uncertainties.items():
        if name in PARAMETERS:
            precision = quantity(name).unit.format_deviation(deviation)
            doubt = "; doubtful" if name in match.doubtful_alone else ""
            sources[name] = f"measured to ±{precision} from {origin}{doubt}"
    for name in ("rows", "columns"):
        sources[name] = f"the size of the photo {photo_name}"
    if match.pattern_was_read and match.lamp is None:
        sources["pattern"] = f"read from the photo {photo_name}"
    return sources


class MatchController(QObject):
    failed = Signal(str)  # why a match or a setting of the scene is refused

    def __init__(
        self, scenes: SceneStore, photos: PhotoController, results_store: ResultsStore
    ) -> None:
        super().__init__()
        self._scenes, self._store, self._results_store = scenes, scenes.store, results_store
        self._photos = photos
        self.task: Task[MatchRequest, MatchOutcome] = Task(
            match, "match of the photo", impatient=True
        )
        self.task.finished.connect(self._take_match)
        self.task.failed.connect(self._show_refusal)
        results_store.select(lambda results: results.photo).changed.connect(self._follow_photo)

    def _follow_photo(self) -> None:
        """End the match of the previous photo; start one if it was requested with the new photo."""
        self.task.cancel()
        choice = self._photos.choice
        if choice.is_match_wanted and self.photo is not None:
            self._photos.edit(lambda each: replace(each, is_match_wanted=False))
            self.start(choice.form, apply=True)

    @property
    def photo(self) -> Photo | None:
        return self._results_store.results.photo

    @property
    def _shown_photo(self) -> ShownPhoto:
        return ShownPhoto.of(self._store.workspace, self._results_store.results)

    @property
    def match(self) -> Match | None:
        return self._shown_photo.match

    def start(self, choice: MatchChoice, *, apply: bool = False) -> None:
        """Match the open photo; with ``apply``, apply the match to the scene once it is found."""
        document = self._photos.document
        if document is None:
            return
        self._photos.edit(lambda each: replace(each, form=choice))
        scene = self._store.workspace.scene
        request = MatchRequest(document.photo, scene, choice, self._shown_photo.part, apply)
        self._photos.put(replace(document, match_request=request))
        self.task.ask(request)

    def cancel(self) -> None:
        """Cancel the running match; the previous one stays."""
        document = self._photos.document
        if document is not None and not self.task.is_idle:
            self.task.cancel()
            self._photos.put(replace(document, match_request=None))

    def _take_match(self, outcome: MatchOutcome) -> None:
        document = self._photos.document
        if document is None or document.match_request is None:
            return
        if outcome.refusal:
            self._show_refusal(*outcome.refusal)
            return
        self._photos.put(replace(document, match_request=None, outcome=outcome))
        # The user's placement belongs to the picture before the match.
        self._photos.edit(lambda each: replace(each, placed_photo=None))
        if document.match_request.applies_result:
            self.apply()

    def _show_refusal(self, *reasons: str) -> None:
        """Show why there is no match; the photo's last match stays."""
        document = self._photos.document
        if document is None or document.match_request is None:
            return
        part = document.match_request.part
        outcome = document.outcome or MatchOutcome(part, None, ("", 0.0))
        outcome = outcome.with_refusal(reasons, part)
        self._photos.put(replace(document, match_request=None, outcome=outcome))
        self.failed.emit(reasons[0])  # the verdict bar contains it, even in its short form

    def apply_camera_settings(self) -> None:
        """Apply the settings that the camera recorded to the scene, as one undo step."""
        photo = self.photo
        if photo is None:
            return
        recorded = {name: getattr(photo, name) for name in _RECORDED}
        changes = {name: value for name, value in recorded.items() if value is not None}
        title = f"settings of {photo.path.name}"
        try:
            self._scenes.put(self._scenes.scene.replace(**changes), title)
        except OccError as error:
            self.failed.emit(str(error))

    def apply(self) -> None:
        match, photo = self._take_usable_match(), self.photo
        if match is not None and photo is not None:
            self._scenes.put(match.scene, f"match with {photo.path.name}")

    def cure(self) -> None:
        """Apply the match, with a shutter speed that shows no bars, as one undo step."""
        match = self._take_usable_match()
        if match is not None:
            self._scenes.put(cure_of(match.scene).scene, "shutter speed without bars")

    def save(self, name: str, title: str, day: date | None = None) -> bool:
        """Save the scene of the match as a preset; return whether it was saved."""
        match, photo = self._take_usable_match(), self.photo
        if match is None or photo is None:
            return False
        certain = self._store.workspace.photo.certain
        sources = describe_sources(
            match, photo.path.name, match.known, day or date.today(),
            assumed=not is_match_certain(match, certain),
        )  # fmt: skip
        try:
            save_preset(name, match.scene, title=title, sources=sources)
        except OccError as error:
            self.failed.emit(str(error))
            return False
        return True

    def _take_usable_match(self) -> Match | None:
        """Return the match; if it is of another part or photo, report that and return None."""
        photo = self._shown_photo
        if photo.match is not None and photo.why_unusable:
            self.failed.emit(f"This match is {photo.why_unusable}; it is not used.")
            return None
        return photo.match
