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
        self.task: Task[ManyRequest, PhotoTable] = Task(
            match_all, "match of several photos", impatient=True
        )
        self.task.reported.connect(self._take_row)
        self.task.finished.connect(self._take_table)
        self.task.failed.connect(self._fail)
        view.cancelled.connect(self.cancel)
        view.closed.connect(lambda: photos.list_files(()))
        view.rows.known_entered.connect(self._match_again)

    def forget_rows(self) -> None:
        """End the work on the previous photos, and forget its results."""
        self.task.cancel()
        self._put(None)

    @property
    def listed(self) -> ListedRows | None:
        return self._results_store.results.listed

    def _put(self, listed: ListedRows | None) -> None:
        self._results_store.put(replace(self._results_store.results, listed=listed))

    def start(self, choice: MatchChoice) -> None:
        paths, options = self.photos.choice.listed, self.photos.choice.load_options
        if not paths:
            return
        try:
            scene, sent = put_known_values(self._scenes.scene, choice)
        except OccError as error:
            self._view.show_note(str(error))
            return
        from occ_model.photo.many.row import MatchSettings

        known = known_parameter(choice.estimate, scene.transmitter)
        settings = MatchSettings(
            scene,
            choice.estimate,
            sent,
            fit_gamma=choice.fit_gamma,
            scan_axis=options.scan_axis,
            channel=options.channel,
            known=self._view.rows.entered_values(known),
        )
        given = known_value(choice.estimate, self._scenes.scene)
        self._put(ListedRows(paths, {}, options, given, settings, is_running=True))
        self.task.ask(ManyRequest(paths, settings, self._jobs))

    def _match_again(self, index: int) -> None:
        """Match a photo again after its known value was entered, if all have been matched."""
        listed = self.listed
        if listed is None:
            return
        settings, table = listed.settings, listed.table
        parameter = known_parameter(settings.estimate, settings.scene.transmitter)
        settings = replace(settings, known=self._view.rows.entered_values(parameter))
        rows = {place: row for place, row in listed.rows.items() if place != index}
        is_running = table is not None
        self._put(replace(listed, rows=rows, settings=settings, table=None, is_running=is_running))
        if table is not None:
            self.task.ask(ManyRequest(listed.paths, settings, self._jobs, table.rows, index))

    def cancel(self) -> None:
        """Cancel the work; finished rows stay."""
        if not self.task.is_idle:
            self.task.cancel()
            self._change(is_running=False)

    def _change(self, **changes: object) -> None:
        if self.listed is not None:
            self._put(replace(self.listed, **changes))  # type: ignore[arg-type]  # its fields

    def _take_row(self, result: tuple[int, PhotoRow] | None) -> None:
        if result is not None and self.listed is not None:
            index, row = result
            self._change(rows={**self.listed.rows, index: row})

    def _take_table(self, table: PhotoTable) -> None:
        self._change(rows=dict(enumerate(table.rows)), table=table, is_running=False)

    def _fail(self, sentence: str) -> None:
        self._change(is_running=False)
        self._view.show_note(sentence)
