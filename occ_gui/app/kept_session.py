"""Kept session: what the user works on, written while the window is open, and restored."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from occ_gui.app.parts import Parts
from occ_gui.files.autosave import Autosave
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Session

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo


class KeptSession(QObject):
    """Writes the session at every change, and restores the last one."""

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._parts = parts
        self.autosave = Autosave(parts.store, parts.document, self.session)
        self.autosave.status_message.connect(parts.window.say)
        parts.photos.opened.connect(self._on_photo)
        parts.pins.changed.connect(self.autosave.note_change)
        parts.window.closing.connect(self.autosave.end)

    def session(self) -> Session:
        """Return what the user is working on; what a lesson shows in its place is not kept."""
        parts = self._parts
        own = parts.lessons.users_own() or parts.store.store.workspace
        return Session(
            scene=own.scene,
            settings=own.settings,
            scene_file=parts.document.path,
            photo=own.photo,
            film=own.film,
            preset=parts.presets.base_of(own.scene),
            pins=parts.pins.kept,
            history=parts.store.store.history(own.step),
        )

    def resume(self, file: SessionFile, session: Session, scene_wins: bool, fresh: bool) -> None:
        """Restore the last session before the window is shown, and store this one.

        Parameters
        ----------
        file
            The file of this window's session, which also contains that of a crash.
        session
            The last session; its scene and settings are in the stores already.
        scene_wins
            Whether the command line names the scene.
        fresh
            Whether the window is to look as at its first start.
        """
        parts = self._parts
        if not fresh:
            parts.options.restore()
            left = file.crashed or session
            parts.pins.restore(left.pins)
            if left.scene is not None:
                parts.presets.resume(left.scene, left.preset)
        self.autosave.resume(file, session, scene_wins)
        self.autosave.written.connect(self._keep_view)

    def _on_photo(self, photo: "Photo | None") -> None:
        self._parts.document.show_photo(None if photo is None else photo.path.name)

    def _keep_view(self) -> None:
        """Store how the window looks, unless a lesson has its own panes in it."""
        if self._parts.lessons.users_own() is None:
            self._parts.options.keep()
