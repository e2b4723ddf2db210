"""Controller of the export: writes the simulated film to a file, in the background."""

from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.cancellable import Cancellable, Report
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import one_line
from occ_model.results.video import Video


@dataclass(frozen=True, eq=False, slots=True)
class _Written:
    path: Path
    film: Video


def _write(request: _Written, report: Report) -> Path:
    count = request.film.frame_count or 1
    occ.write_video(request.film, request.path, lambda frames: report(frames / count))
    return request.path


class FilmExport(QObject):
    """Writes one film at a time, with a bar that shows how far it is and cancels it.

    Parameters
    ----------
    bar
        Shows the progress.
    """

    status_message = Signal(str)
    """The outcome."""

    def __init__(self, bar: WorkBar) -> None:
        super().__init__()
        self._bar = bar
        self.runner: Cancellable[_Written, Path] = Cancellable(_write, "writing of the film")
        self.runner.reported.connect(bar.show_progress)
        self.runner.finished.connect(self._report)
        self.runner.failed.connect(self._fail)
        bar.cancelled.connect(self.cancel)

    @property
    def is_idle(self) -> bool:
        """Whether no film is being written."""
        return not self.runner.is_running

    def write(self, path: Path, film: Video) -> None:
        """Write a film; one that is still being written is given up."""
        self._bar.begin()
        self.runner.start(_Written(path, film))

    def cancel(self) -> None:
        """Give up; nothing is written."""
        if self.runner.is_running:
            self.runner.cancel()
            self._bar.end()
            self.status_message.emit(self.tr("The film was given up."))

    def stop(self) -> None:
        """Give up and stop the thread."""
        self.runner.stop()

    def _report(self, path: Path) -> None:
        self._bar.end()
        self.status_message.emit(self.tr("Saved {name}").format(name=one_line(path.name)))

    def _fail(self, sentence: str) -> None:
        self._bar.end()
        self.status_message.emit(sentence)
