"""Search for the lamps of the open photo, started by the user."""

from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.background.task import Task
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_work import find_lamps
from occ_gui.shell.results import ResultsStore
from occ_model.photo.reading.load import Photo
from occ_model.results.lamp import Lamp


class LampSearch(QObject):
    def __init__(self, photos: PhotoController, results_store: ResultsStore) -> None:
        super().__init__()
        self._photos = photos
        self.task: Task[Photo, tuple[Lamp, ...]] = Task(
            find_lamps, "search for lamps", impatient=True
        )
        self.task.finished.connect(lambda lamps: self._put(is_searched=False, lamps=lamps))
        self.task.failed.connect(lambda why: self._put(is_searched=False, why_no_lamps=why))
        results_store.select(lambda results: results.photo).changed.connect(self.task.cancel)

    def find(self) -> None:
        document = self._photos.document
        if document is not None:
            self._put(is_searched=True, lamps=(), why_no_lamps="")
            self.task.ask(document.photo)

    def _put(self, **changes: object) -> None:
        document = self._photos.document
        if document is not None:
            self._photos.put(replace(document, **changes))  # type: ignore[arg-type]  # its fields
