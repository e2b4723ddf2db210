"""Controller of the open photo: loads another one in the background when it is chosen."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.core.store import Store
from occ_gui.shell.results import Results, ResultsStore, ResultUpdater
from occ_gui.values.choices import PhotoChoice, PhotoSource
from occ_gui.values.photo_results import PhotoDocument

KEPT_PHOTOS = 3  # photos kept to be shown again at once: two of a lesson, and the user's own


def _load(source: PhotoSource, report: Report) -> PhotoDocument:
    report(0.0)
    axis, channel = source.load_options.scan_axis, source.load_options.channel
    photo = occ.load_photo(source.path, axis, channel=channel, progress=report)
    return PhotoDocument(photo, source)


def _put(results: Results, document: PhotoDocument | None) -> Results:
    return replace(results, document=document)


class PhotoController(QObject):
    """Opens and closes photos, and loads them again along another axis or in another channel."""

    opened = Signal(object)  # the photo that is shown now, or None
    failed = Signal(str)  # why a photo could not be loaded; the previous one stays

    def __init__(self, store: Store, results_store: ResultsStore) -> None:
        super().__init__()
        self._store, self._results_store = store, results_store
        self._shown_choice = store.workspace.photo
        task: Task[PhotoSource, PhotoDocument] = Task(_load, "loading of the photo", impatient=True)
        self.loading = ResultUpdater(
            store, results_store, task, lambda workspace, _: workspace.photo.source, _put,
            stays=True, keep=KEPT_PHOTOS,
        )  # fmt: skip
        self.loading.failed.connect(self._fail)
        results_store.select(lambda results: results.photo).changed.connect(self._keep_shown_choice)
        results_store.select(lambda results: results.photo).changed.connect(self.opened)

    @property
    def choice(self) -> PhotoChoice:
        return self._store.workspace.photo

    @property
    def document(self) -> PhotoDocument | None:
        return self._results_store.results.document

    def put(self, document: PhotoDocument) -> None:
        """Store the open photo's document, and keep its results for when it is opened again."""
        self.loading.keep(document.without_work())
        self._results_store.put(_put(self._results_store.results, document))

    def edit(self, change: Callable[[PhotoChoice], PhotoChoice]) -> None:
        if self.loading.task.is_idle:
            self._shown_choice = self.choice
        workspace = self._store.workspace
        self._store.put(replace(workspace, photo=change(workspace.photo)))

    def open(self, path: Path, *, match: bool = False) -> None:
        """Open a photo; with ``match``, match it as well and apply the match to the scene."""
        self.edit(lambda choice: choice.open(path, match=match))

    def list_files(self, paths: Sequence[Path]) -> None:
        """List these photos in place of the previous ones, without assumptions about them."""
        listed = tuple(paths)
        self.edit(lambda each: replace(each.drop_assumptions() if listed else each, listed=listed))

    def cancel(self) -> None:
        """Cancel the loading of a photo; the previous photo stays."""
        if not self.loading.task.is_idle:
            self._restore_shown_choice()

    def set_scan_axis(self, scan_axis: str) -> None:
        self._reload_with(scan_axis=scan_axis)

    def set_channel(self, channel: str) -> None:
        self._reload_with(channel=channel)

    def _reload_with(self, **changes: str) -> None:
        self.edit(lambda each: replace(each, load_options=replace(each.load_options, **changes)))

    def close(self) -> None:
        self.edit(PhotoChoice.close)

    def _keep_shown_choice(self) -> None:
        self._shown_choice = self.choice

    def _restore_shown_choice(self) -> None:
        shown = self._shown_choice
        changes = {
            name: getattr(shown, name)
            for name in ("path", "load_options", "opening", "form", "certain", "forgotten", "parts")
        }
        self._shown_choice = replace(self.choice, **changes, is_match_wanted=False)
        self._store.put(replace(self._store.workspace, photo=self._shown_choice))

    def _fail(self, sentence: str) -> None:
        self._restore_shown_choice()
        self.failed.emit(sentence)
