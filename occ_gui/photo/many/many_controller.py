"""Controller of several photos: match them in the background, and combine what they measure."""

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Report, Task
from occ_gui.photo.many.many_view import ManyPhotosView
from occ_gui.photo.match_choice import MatchChoice
from occ_gui.photo.match_request import known_scene
from occ_gui.photo.photo_controller import PhotoReading
from occ_gui.scene.scene_store import SceneStore
from occ_model.errors import OccError
from occ_model.results.photo_table import PhotoRow, PhotoTable, known_beside

if TYPE_CHECKING:  # imported with the first match, not with the window
    from occ_model.photo.many.row import MatchSettings


@dataclass(frozen=True, slots=True)
class ManyRequest:
    """The photos to match, and how."""

    paths: tuple[Path, ...]
    settings: "MatchSettings"
    jobs: int | None
    rows: tuple[PhotoRow, ...] = ()
    """What was found before; empty where all photos are matched."""

    only: int = 0
    """The place of the photo that is matched again, where others were matched before."""


def match_all(request: ManyRequest, report: Report) -> PhotoTable:
    """Match all photos, and report each row with its place."""
    from occ_model.photo.many.match_photos import matched_rows, usual_jobs
    from occ_model.photo.many.table import table_of

    if request.rows:
        # The same photo, at the first place of a table of one.
        settings = replace(request.settings.of(request.only), known=())
        ((_, row),) = matched_rows([request.paths[request.only]], settings, 1, lambda: report(None))
        given = dict(request.settings.known).get(request.only)
        again = [*request.rows]
        again[request.only] = replace(row, given=given)
        report((request.only, again[request.only]))
        return table_of(request.settings, again)
    rows: dict[int, PhotoRow] = {}
    jobs = request.jobs or usual_jobs()
    work = matched_rows(request.paths, request.settings, jobs, lambda: report(None))
    # Closed here: processes that are not closed would go on after a cancel.
    with closing(work) as found:
        for place, row in found:
            rows[place] = row
            report((place, row))
    return table_of(request.settings, [rows[place] for place in range(len(rows))])


class ManyPhotosController(QObject):
    """Matches the photos of a table.

    Parameters
    ----------
    scenes
        The scene with the known values.
    view
        The table.
    jobs
        Number of processes; by default one for each core.
    """

    matched = Signal(object)
    """The complete table: a PhotoTable."""

    def __init__(self, scenes: SceneStore, view: ManyPhotosView, jobs: int | None = None) -> None:
        super().__init__()
        self._scenes = scenes
        self._view = view
        self._jobs = jobs
        self._paths: tuple[Path, ...] = ()
        self._done = 0
        self._settings: MatchSettings | None = None
        self.table: PhotoTable | None = None
        self.reading: PhotoReading | None = None
        """How the photos of the table were read; None before they are matched."""
        self.runner: Task[ManyRequest, PhotoTable] = Task(
            match_all, "match of several photos", impatient=True
        )
        self.runner.reported.connect(self._take_row)
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(view.show_failed)
        view.cancelled.connect(self.cancel)
        view.closed.connect(self._close)
        view.rows.known_given.connect(self._match_again)

    def _close(self) -> None:
        self.show_files(())

    def show_files(self, paths: Sequence[Path]) -> None:
        """Show these files in place of the previous ones."""
        self.runner.cancel()
        self._paths, self.table = tuple(paths), None
        self._view.show_files(self._paths)

    def start(self, choice: MatchChoice, reading: PhotoReading) -> None:
        """Match all photos with the current scene."""
        if not self._paths:
            return
        try:
            scene, sent = known_scene(self._scenes.scene, choice)
        except OccError as error:
            self._view.show_failed(str(error))
            return
        from occ_model.photo.many.row import MatchSettings

        settings = MatchSettings(
            scene,
            choice.estimate,
            sent,
            fit_gamma=choice.fit_gamma,
            scan_axis=reading.scan_axis,
            channel=reading.channel,
            known=self._view.rows.given(known_beside(choice.estimate)),
        )
        self._settings = settings
        self._done, self.table, self.reading = 0, None, reading
        self._view.show_begun(choice.estimate, scene)
        self.runner.ask(ManyRequest(self._paths, settings, self._jobs))

    def _match_again(self, place: int) -> None:
        """Match the photo whose known value was given; before all are matched, only with them."""
        table, settings = self.table, self._settings
        if table is None or settings is None:
            return
        known = self._view.rows.given(known_beside(settings.estimate))
        self._settings = settings = replace(settings, known=known)
        self._done, self.table = len(table.rows) - 1, None
        self._view.show_busy(settings.estimate, settings.scene)
        self.runner.ask(ManyRequest(self._paths, settings, self._jobs, table.rows, place))

    def cancel(self) -> None:
        """Cancel the work; the rows that are done stay."""
        if not self.runner.is_idle:
            self.runner.cancel()
            self._view.show_ended()

    def stop(self) -> None:
        """Stop the work, and end its thread."""
        self.runner.stop()

    def _take_row(self, found: tuple[int, PhotoRow] | None) -> None:
        if found is not None:
            self._done += 1
            self._view.show_row(*found, self._done)

    def _take(self, table: PhotoTable) -> None:
        self.table = table
        self._view.show_table(table)
        self.matched.emit(table)
