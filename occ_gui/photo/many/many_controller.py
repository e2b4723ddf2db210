"""Controller of several photos: matches them in the background, and combines their estimates."""

from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from occ_gui.background.task import Report, Task
from occ_gui.photo.many.many_view import ManyPhotosView
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.photo.photo_work import put_known_values
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import ResultsStore
from occ_gui.values.choices import MatchChoice
from occ_gui.values.photo_results import ListedRows
from occ_model.errors import OccError
from occ_model.results.match import known_parameter, known_value
from occ_model.results.photo_table import PhotoRow, PhotoTable

if TYPE_CHECKING:  # imported with the first match, not with the window
    from occ_model.photo.many.row import MatchSettings


@dataclass(frozen=True, slots=True)
class ManyRequest:
    paths: tuple[Path, ...]
    settings: "MatchSettings"
    jobs: int | None
    # The rows of the last match, and the index of the photo to match again; if empty, match all
    rows: tuple[PhotoRow, ...] = ()
    only: int = 0


def match_all(request: ManyRequest, report: Report) -> PhotoTable:
    """Match all photos, and report each row with its index."""
    from occ_model.photo.many.match_photos import match_rows, usual_jobs
    from occ_model.photo.many.table import table_of

    if request.rows:
        # In a table of this photo alone, its index is 0.
        settings = replace(request.settings.of(request.only), known=())
        ((_, row),) = match_rows([request.paths[request.only]], settings, 1, lambda: report(None))
        given = dict(request.settings.known).get(request.only)
        new_rows = [*request.rows]
        new_rows[request.only] = replace(row, given=given)
        report((request.only, new_rows[request.only]))
        return table_of(request.settings, new_rows)
    rows: dict[int, PhotoRow] = {}
    jobs = request.jobs or usual_jobs()
    work = match_rows(request.paths, request.settings, jobs, lambda: report(None))
    # Closing ends the processes, even after a cancel.
    with closing(work) as results:
        for index, row in results:
            rows[index] = row
            report((index, row))
    return table_of(request.settings, [rows[index] for index in range(len(rows))])


class ManyPhotosController(QObject):
    """Matches the photos of a table in parallel, by default in a process for each core."""

    def __init__(
        self,
        scenes: SceneStore,
        photos: PhotoController,
        view: ManyPhotosView,
        results_store: ResultsStore,
        jobs: int | None = None,
    ) -> None:
        super().__init__()
        self.photos = photos
        self._scenes, self._results_store = scenes, results_store
        self._view, self._jobs = view, jobs
        self._settings: MatchSettings | None = None
        self._rows: dict[int, PhotoRow] = {}
        self._finished_count = 0
        self.table: PhotoTable | None = None
        self.task: Task[ManyRequest, PhotoTable] = Task(
            match_all, "match of several photos", impatient=True
        )
        self.task.reported.connect(self._take_row)
        self.task.finished.connect(self._take_table)
        self.task.failed.connect(view.show_failure)
        view.cancelled.connect(self.cancel)
        view.closed.connect(lambda: photos.list_files(()))
        view.rows.known_entered.connect(self._match_again)

    def show_files(self, paths: tuple[Path, ...]) -> None:
        self.task.cancel()
        self._rows, self.table = {}, None
        self._results_store.put(replace(self._results_store.results, listed=None))
        self._view.show_files(paths)

    def start(self, choice: MatchChoice) -> None:
        paths, options = self.photos.choice.listed, self.photos.choice.load_options
        if not paths:
            return
        try:
            scene, sent = put_known_values(self._scenes.scene, choice)
        except OccError as error:
            self._view.show_failure(str(error))
            return
        from occ_model.photo.many.row import MatchSettings

        known = known_parameter(choice.estimate, scene.transmitter)
        settings = self._settings = MatchSettings(
            scene,
            choice.estimate,
            sent,
            fit_gamma=choice.fit_gamma,
            scan_axis=options.scan_axis,
            channel=options.channel,
            known=self._view.rows.entered_values(known),
        )
        self._rows, self._finished_count, self.table = {}, 0, None
        self._listed = ListedRows((), options, known_value(choice.estimate, self._scenes.scene))
        self._put_rows()
        self._view.begin_match(choice.estimate, scene)
        self.task.ask(ManyRequest(paths, settings, self._jobs))

    def _match_again(self, index: int) -> None:
        """Match a photo again after its known value was entered, if all have been matched."""
        table, settings = self.table, self._settings
        if table is None or settings is None:
            return
        parameter = known_parameter(settings.estimate, settings.scene.transmitter)
        known = self._view.rows.entered_values(parameter)
        self._settings = settings = replace(settings, known=known)
        self._finished_count, self.table = len(table.rows) - 1, None
        self._view.show_busy(settings.estimate, settings.scene)
        paths = self.photos.choice.listed
        self.task.ask(ManyRequest(paths, settings, self._jobs, table.rows, index))

    def cancel(self) -> None:
        """Cancel the work; finished rows stay."""
        if not self.task.is_idle:
            self.task.cancel()
            self._view.end_match()

    def _take_row(self, result: tuple[int, PhotoRow] | None) -> None:
        if result is not None:
            index, row = result
            self._rows[index] = row
            self._finished_count += 1
            self._view.show_row(index, row, self._finished_count)
            self._put_rows()

    def _take_table(self, table: PhotoTable) -> None:
        self.table = table
        self._rows = dict(enumerate(table.rows))
        self._view.show_table(table)
        self._put_rows()

    def _put_rows(self) -> None:
        listed = replace(self._listed, rows=tuple(self._rows.values()))
        self._results_store.put(replace(self._results_store.results, listed=listed))
