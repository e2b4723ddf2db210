"""A photo on the board, and all that the pane of the photo follows from, without a window."""

from dataclasses import replace
from pathlib import Path

from gui.stores import store_of
from PySide6.QtGui import QAccessible

from occ_gui.photo.match_controller import cure_of_match
from occ_gui.photo.photo_part import PhotoPart
from occ_gui.photo.photo_verdict import PhotoSteps
from occ_gui.photo.photo_view import PhotoView
from occ_gui.shell.results import Board
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.photo_choice import MatchChoice, PhotoChoice, PhotoSource
from occ_gui.values.photo_results import FoundMatch, OpenPhoto
from occ_model.photo.reading.load import Photo
from occ_model.results.bands import Cure
from occ_model.results.match import Match
from occ_model.scene.scene import Scene


class PhotoBench:
    """Store and board of a photo that was read."""

    def __init__(self, scene: Scene | None = None) -> None:
        self.scenes = store_of(scene)
        self.store = self.scenes.store
        self.board = Board()

    @property
    def choice(self) -> PhotoChoice:
        return self.store.workspace.photo

    @property
    def part(self) -> PhotoPart:
        return PhotoPart.of(self.store.workspace, self.board.results)

    def choose(self, **changes: object) -> None:
        photo = replace(self.choice, **changes)  # type: ignore[arg-type]  # fields of its own
        self.store.put(replace(self.store.workspace, photo=photo))

    def show_photo(self, photo: Photo | None) -> None:
        """Open a photo that was read already, or close it."""
        choice = self.choice.closed() if photo is None else self.choice.opened(photo.path)
        self.store.put(replace(self.store.workspace, photo=choice))
        opened = None
        if photo is not None:
            opened = OpenPhoto(photo, choice.source or PhotoSource(Path(), choice.reading, 0))
        self.board.put(replace(self.board.results, opened=opened))

    def show_reading(self, reading: Reading) -> None:
        self.board.show_reading(reading)


def spoken(steps: PhotoSteps) -> list[str]:
    """Return what a screen reader says of the steps."""
    faces = [QAccessible.queryAccessibleInterface(button) for button in steps.buttons.values()]
    return [face.text(QAccessible.Text.Name) for face in faces]


class LiveView(PhotoView):
    """A view that shows what is chosen in it, as it does in its pane."""

    def __init__(self) -> None:
        super().__init__()
        self.choice = PhotoChoice()
        self.form.chosen.connect(self._take_form)
        self.form.certain_chosen.connect(self._take_certain)
        self.many.files_shown.connect(self._list)

    def _list(self) -> None:
        self.choose(replace(self.choice.uncertain(), listed=self.many.rows.paths))

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
        self.choose(self.choice.closed() if photo is None else self.choice.opened(photo.path))

    def show_matched(self, match: Match | None, cure: Cure | None = None) -> None:
        """Show a match that was asked for in the present scene, with its own cure or another."""
        self.show_match_ended()
        if match is None or self._photo is None:
            self.show_match(None)
            return
        given = 0.0 if self._scene is None else float(self._scene.value(match.known))
        self.show_match(FoundMatch(self._photo, None, match, given), cure or cure_of_match(match))
