"""The photo in the window: what reading and matching it change outside its own pane."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject

from occ_gui.app.parts import Parts
from occ_gui.files.file_controller import sample_photos
from occ_gui.values.photo_choice import MatchAsked
from occ_gui.window.menus import words_of

if TYPE_CHECKING:
    from occ_gui.photo.pane import PhotoPane
    from occ_gui.values.photo_results import OpenPhoto
    from occ_model.photo.reading.load import Photo
    from occ_model.results.match import Match


class PhotoInWindow(QObject):
    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._parts = parts
        self._match_next, self._front_next = False, True
        self._applied: MatchAsked | None = None
        """The match whose result is applied as soon as it is found."""
        self._path: Path | None = None
        window, photos, reading = parts.window, parts.photos, parts.photos.work
        reading.begun.connect(self._begin)
        reading.task.reported.connect(window.reading.show_progress)
        reading.ended.connect(window.reading.end)
        reading.found.connect(self._on_read)
        photos.opened.connect(self._on_photo)
        photos.failed.connect(self._on_failure)
        axis = parts.store.store.select(lambda workspace: workspace.photo.reading.scan_axis)
        axis.changed.connect(self._show_scan_axis)
        window.reading.cancelled.connect(self._cancel)
        window.menus.scan_axes.triggered.connect(lambda action: photos.scan_along(action.data()))
        window.actions_by_name["match_all"].setEnabled(False)
        parts.files.several_opened.connect(self._show_several)
        parts.shell.made.connect(self._on_made)

    @property
    def pane(self) -> "PhotoPane":
        pane: PhotoPane = self._parts.shell.pane("photo")
        return pane

    def open(self, path: Path, match: bool = False, front: bool = True) -> None:
        """Open a photo; ``match`` applies its match to the scene, ``front`` shows its pane."""
        self._match_next, self._front_next = match, front
        self._parts.photos.open(path)

    def keep_in_background(self, path: Path | None) -> None:
        """Do not bring to the front the photo that is about to be opened, if any."""
        self._front_next = path is None

    def match(self) -> None:
        self._parts.window.bring_to_front("photo")
        self.pane.match()

    def save_match(self) -> None:
        self._parts.presets.ask_to_save_match(self.pane.matching)

    def _on_made(self, name: str, pane: Any) -> None:
        if name != "photo":
            return
        parts, view = self._parts, pane.view
        parts.messages.follow(view)
        parts.window.leave_messages_to(view.verdict.sentence, view.verdict.wrapped)
        view.open_asked.connect(parts.files.ask_for_photo)
        view.show_samples({words_of(path.stem): path for path in sample_photos()})
        view.sample_chosen.connect(parts.files.open_sample)
        view.form.edited.connect(parts.editor.edit)
        view.result.save_asked.connect(self.save_match)
        view.many.save_asked.connect(parts.files.ask_to_save_table)
        view.many.files_shown.connect(self._show_listed)
        for copying in (view.many, view.result.paste):
            copying.copied.connect(parts.window.say)
        pane.matching.saved.connect(parts.presets.report_saved)
        pane.match_shown.connect(self._on_match)
        pane.matching.failed.connect(parts.messages.show_match_failure)

    def _begin(self) -> None:
        self._parts.shell.pane("photo")  # before there is something to show
        self._parts.window.reading.begin()

    def _on_photo(self, photo: "Photo | None") -> None:
        self._parts.messages.end_photo_failure()
        self._parts.window.menus.show_photo_open(photo is not None)
        if photo is None:
            self._path = None
        if self._match_next:
            self._match_next = False
            self.pane.match()
            self._applied = self._parts.photos.choice.match_asked

    def _on_match(self, match: "Match | None") -> None:
        self._parts.window.menus.show_match_found(match is not None)
        if match is None:
            return
        self._parts.messages.end_match_failure()
        applied, self._applied = self._applied, None
        if applied is not None and applied is self._parts.photos.choice.match_asked:
            self.pane.matching.apply()

    def _on_failure(self, sentence: str) -> None:
        self._match_next = False
        self._parts.messages.show_photo_failure(sentence)

    def _cancel(self) -> None:
        self._match_next = False
        self._parts.photos.cancel()

    def _on_read(self, opened: "OpenPhoto") -> None:
        """Bring a newly opened photo to the front, but not one that is only read again."""
        last, self._path = self._path, opened.source.path
        if self._front_next and last != self._path:
            self._parts.window.bring_to_front("photo")
        self._front_next = True

    def _show_scan_axis(self, scan_axis: str) -> None:
        menus = self._parts.window.menus
        menus.show_choice(menus.scan_axes, scan_axis)

    def _show_several(self, paths: list[Path]) -> None:
        self.pane.many.choose_files(paths)
        for name in ("photo", "photos"):
            self._parts.window.bring_to_front(name)

    def _show_listed(self) -> None:
        paths = self.pane.view.many.rows.paths
        self._parts.window.actions_by_name["match_all"].setEnabled(bool(paths))
