"""A photo in the stores that the pane of the photo depends on, without a window."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from gui.stores import store_of
from PySide6.QtGui import QAccessible

from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_verdict import PhotoSteps
from occ_gui.photo.photo_view import PhotoView
from occ_gui.photo.photo_work import cure_of_match
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.photo.window_actions import WindowActions
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.choices import PhotoChoice
from occ_gui.values.photo_results import MatchOutcome, MatchRequest, PhotoDocument
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match, known_value
from occ_model.scene.scene import Scene


class PhotoBench:
    """The stores of a photo that was loaded."""

    def __init__(self, scene: Scene | None = None) -> None:
        self.scenes = store_of(scene)
        self.store = self.scenes.store
        self.results_store = ResultsStore()
        self.photos = PhotoController(self.store, self.results_store)
        self.photos.loading.task.ask = lambda request: None  # type: ignore[method-assign]  # they are read

    @property
    def choice(self) -> PhotoChoice:
        return self.store.workspace.photo

    @property
    def shown(self) -> ShownPhoto:
        return ShownPhoto.of(self.store.workspace, self.results_store.results)

    def choose(self, **changes: object) -> None:
        photo = replace(self.choice, **changes)  # type: ignore[arg-type]  # fields of its own
        self.store.put(replace(self.store.workspace, photo=photo))

    def show_photo(self, photo: Photo | None) -> None:
        """Open a photo that was read already, or close it."""
        choice = self.choice.close() if photo is None else self.choice.open(photo.path)
        self.store.put(replace(self.store.workspace, photo=choice))
        document = None if photo is None else PhotoDocument(photo, choice.source)
        self.results_store.put(replace(self.results_store.results, document=document))

    def follow(self, show: Callable[[ShownPhoto], object]) -> None:
        """Show the photo from now on whenever workspace or results change."""
        for changed in (self.store.select(lambda each: each).changed, self.results_store.changed):
            changed.connect(lambda: show(self.shown))

    def change(self, **changes: object) -> None:
        """Change the requests for the open photo, or their results."""
        document = self.results_store.results.document
        self.photos.put(replace(document, **changes))  # type: ignore[arg-type]  # fields of its own

    def show_reading(self, reading: Reading) -> None:
        self.results_store.show_reading(reading)


def no_actions() -> WindowActions:
    """Return actions of a window that do nothing."""
    return WindowActions(
        ask_for_photo=lambda: None,
        samples=dict,
        open_sample=lambda _path: None,
        edit_scene=lambda _name, _value, _gesture: None,
        save_match=lambda _matching: None,
        save_table=lambda _text: None,
    )


def names_of_steps(steps: PhotoSteps) -> list[str]:
    """Return what a screen reader says about the steps."""
    faces = [QAccessible.queryAccessibleInterface(button) for button in steps.buttons.values()]
    return [face.text(QAccessible.Text.Name) for face in faces]


def shown_photo(photo: Photo, scene: Scene, match: Match | None = None) -> ShownPhoto:
    """Return a photo that has been opened, with a match that was asked for in a scene."""
    choice, outcome = PhotoChoice().open(photo.path), None
    if match is not None:
        outcome = MatchOutcome(None, match, known_value(match.estimate, scene))
    document = PhotoDocument(photo, choice.source)
    return ShownPhoto(scene, choice, document=document, outcome=outcome)


class LiveView(PhotoView):
    """A view that shows what the user chooses in it, as in its pane."""

    def __init__(self) -> None:
        super().__init__()
        self.shown = ShownPhoto(Scene())
        for signal in (self.form.chosen, self.form.asked):
            signal.connect(lambda form: self.choose(replace(self.choice, form=form)))
        self.form.certain_chosen.connect(
            lambda name, value: self.choose(self.choice.with_certain(name, value))
        )

    @property
    def choice(self) -> PhotoChoice:
        return self.shown.choice

    def change(self, **changes: object) -> None:
        self.shown = replace(self.shown, **changes)  # type: ignore[arg-type]  # fields of its own
        self.show_photo(self.shown)

    def list_files(self, paths: tuple[Path, ...]) -> None:
        self.choose(replace(self.choice.drop_assumptions(), listed=paths))

    def choose(self, choice: PhotoChoice) -> None:
        self.change(choice=choice)

    def confirm(self, certain: dict[str, float]) -> None:
        self.choose(replace(self.choice, certain=certain))

    def open(self, photo: Photo | None) -> None:
        if photo is None:
            self.change(choice=self.choice.close(), document=None, outcome=None)
            return
        document = shown_photo(photo, self.shown.scene).document
        self.change(choice=self.choice.open(photo.path), document=document, outcome=None)

    def show_running(self, running: bool) -> None:
        photo, choice = self.shown.photo, self.choice.form
        request = MatchRequest(photo, self.shown.scene, choice, None) if running else None
        self.change(document=replace(self.shown.document, match_request=request))

    def show_matched(self, match: Match | None, *refusal: str) -> None:
        """Show a match that was asked for in the present scene, or why it was refused."""
        self.show_running(False)
        given = ("", 0.0) if match is None else known_value(match.estimate, self.shown.scene)
        self.change(outcome=MatchOutcome(None, match, given, refusal), cure=cure_of_match(match))
