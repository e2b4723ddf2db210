"""A photo in the stores that the pane of the photo depends on, without a window."""

from dataclasses import replace
from pathlib import Path

from gui.stores import store_of
from PySide6.QtGui import QAccessible

from occ_gui.photo.match_controller import cure_of_match
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_verdict import PhotoSteps
from occ_gui.photo.photo_view import PhotoView
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.photo.window_actions import WindowActions
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.choices import MatchChoice, PhotoChoice, PhotoSource
from occ_gui.values.photo_results import MatchOutcome, PhotoDocument
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import Cure
from occ_model.results.match import Match, known_value
from occ_model.scene.scene import Scene


class PhotoBench:
    """The stores of a photo that was loaded."""

    def __init__(self, scene: Scene | None = None) -> None:
        self.scenes = store_of(scene)
        self.store = self.scenes.store
        self.results_store = ResultsStore()
        self.photos = PhotoController(self.store, self.results_store)
        self.photos.work.task.ask = lambda request: None  # type: ignore[method-assign]  # they are read

    @property
    def choice(self) -> PhotoChoice:
        return self.store.workspace.photo

    @property
    def part(self) -> ShownPhoto:
        return ShownPhoto.of(self.store.workspace, self.results_store.results)

    def choose(self, **changes: object) -> None:
        photo = replace(self.choice, **changes)  # type: ignore[arg-type]  # fields of its own
        self.store.put(replace(self.store.workspace, photo=photo))

    def show_photo(self, photo: Photo | None) -> None:
        """Open a photo that was read already, or close it."""
        choice = self.choice.close() if photo is None else self.choice.open(photo.path)
        self.store.put(replace(self.store.workspace, photo=choice))
        document = None
        if photo is not None:
            source = choice.source or PhotoSource(Path(), choice.load_options, 0)
            document = PhotoDocument(photo, source)
        self.results_store.put(replace(self.results_store.results, document=document))

    def change(self, **changes: object) -> None:
        """Let something else be found in the open photo, or be asked of it."""
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


def spoken(steps: PhotoSteps) -> list[str]:
    """Return what a screen reader says about the steps."""
    faces = [QAccessible.queryAccessibleInterface(button) for button in steps.buttons.values()]
    return [face.text(QAccessible.Text.Name) for face in faces]


class LiveView(PhotoView):
    """A view that shows what the user chooses in it, as in its pane."""

    def __init__(self) -> None:
        super().__init__()
        self.choice = PhotoChoice()
        self.form.chosen.connect(self._take_form)
        self.form.certain_chosen.connect(self._take_certain)
        self.many.files_shown.connect(self._list)

    def _list(self) -> None:
        self.choose(replace(self.choice.clear_certain(), listed=self.many.rows.paths))

    def _take_form(self, form: MatchChoice) -> None:
        self.choose(replace(self.choice, form=form))

    def _take_certain(self, name: str, value: float | None) -> None:
        self.choose(self.choice.with_certain(name, value))

    def choose(self, choice: PhotoChoice) -> None:
        self.choice = choice
        self.show_choice(choice)

    def confirm(self, certain: dict[str, float]) -> None:
        self.choose(replace(self.choice, certain=certain))

    def open(self, photo: Photo | None) -> None:
        self.show_photo(photo)
        self.choose(self.choice.close() if photo is None else self.choice.open(photo.path))

    def show_matched(self, match: Match | None, cure: Cure | None = None) -> None:
        """Show a match that was asked for in the present scene, with its own cure or another."""
        self.show_match_running(False)
        if match is None or self._photo is None:
            self.show_match(None)
            return
        given = ("", 0.0) if self._scene is None else known_value(match.estimate, self._scene)
        self.show_match(MatchOutcome(None, match, given), cure or cure_of_match(match))
