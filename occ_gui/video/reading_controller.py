"""Controller of the reading: reads the film in the background, and knows when that is outdated."""

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Task
from occ_gui.video.film_reading import FilmReading
from occ_gui.video.reading_jobs import ReadingRequest, read_film
from occ_model.results.video import Video
from occ_model.scene.scene import Scene


class ReadingController(QObject):
    """The reading of one film at a time, which grows while the film is read."""

    changed = Signal()  # more has been read, the reading has ended, or it is of another film
    failed = Signal(str)  # why a film cannot be read on; what was read of it stays

    def __init__(self) -> None:
        super().__init__()
        self.reading = FilmReading.nothing()
        self._request: ReadingRequest | None = None
        self.is_done = False
        self.runner: Task[ReadingRequest, FilmReading] = Task(
            read_film, "reading of the film", impatient=True
        )
        self.runner.reported.connect(self._on_report)
        self.runner.finished.connect(self._on_end)
        self.runner.failed.connect(self._on_failure)

    @property
    def is_running(self) -> bool:
        return not self.runner.is_idle

    @property
    def scene(self) -> Scene | None:
        return None if self._request is None else self._request.scene

    def start(self, film: Video, scene: Scene, is_live: bool = False) -> None:
        self._request, self.is_done = ReadingRequest(film, scene, is_live), False
        self.reading = FilmReading.nothing()
        self.runner.ask(self._request)
        self.changed.emit()

    def cancel(self) -> None:
        if not self.runner.is_idle:
            self.runner.cancel()
            self.changed.emit()

    def forget(self) -> None:
        self.runner.cancel()
        self._request, self.is_done = None, False
        self.reading = FilmReading.nothing()
        self.changed.emit()

    def _on_report(self, reading: FilmReading) -> None:
        self.reading = reading
        self.changed.emit()

    def _on_end(self, reading: FilmReading) -> None:
        self.reading, self.is_done = reading, True
        self.changed.emit()

    def _on_failure(self, sentence: str) -> None:
        self.failed.emit(sentence)
        self.changed.emit()
