"""Autosave: writes the session at most a second after every change, and restores it at a start."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.files.document import Document
from occ_gui.files.kept_file import is_readable
from occ_gui.files.session import SessionFile
from occ_gui.files.session_record import Session
from occ_gui.scene.scene_store import SceneStore
from occ_model.errors import OccError
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene

LONGEST_WAIT_MS = 1000
"""Longest time from a change to its writing; later changes within it are written with it."""


class Autosave(QObject):
    """Writes the session of a window to its file; before :meth:`resume` it writes nothing."""

    status_message = Signal(str)
    """What has been restored, or why the session cannot be written; the latter is not repeated."""

    written = Signal()
    """The session is on the disk."""

    def __init__(
        self,
        store: SceneStore,
        document: Document,
        present: Callable[[], Session],
    ) -> None:
        super().__init__()
        self._store = store
        self._document, self._present = document, present
        self._file: SessionFile | None = None
        self._has_failed = False
        # Started by the first change only: if each change restarted it, it would never run out
        # while a slider keeps moving.
        self._timer = QTimer(self, singleShot=True)
        self._timer.setInterval(LONGEST_WAIT_MS)
        self._timer.timeout.connect(self.write)

    @property
    def is_kept(self) -> bool:
        """Whether the session is written, to be restored at the next start."""
        return self._file is not None

    def resume(self, file: SessionFile, session: Session, scene_wins: bool) -> None:
        """Restore a session, and write this window's to a file from now on."""
        self._file = file
        asked = self._store.scene
        if not scene_wins and session.scene_file is not None:
            self._document.resume(session.scene_file, _saved_in(session.scene_file))
        if file.crashed is not None:
            self._restore(file.crashed, asked, scene_wins)
        whole = self._store.store.select(lambda workspace: workspace)
        whole.changed.connect(self.note_change)
        self.note_change()

    def _restore(self, left: Session, asked: Scene, scene_wins: bool) -> None:
        """Restore the scene of a crash with the steps that led to it, or as a step if it is old."""
        crashed, force = left.scene, self._store.settings.settings.force
        if crashed is None:
            return
        left_force = force if left.settings is None else left.settings.force
        self._store.put(crashed, "restoring of the last session", force=left_force)
        if left.history is not None and (scene_wins or crashed == asked):
            self._store.store.resume(left.history)
        if scene_wins and crashed != asked:
            self._store.put(asked, "opening of what was asked for", force=force)
            message = "The last session did not come to its end; Undo brings its scene back."
        else:
            message = "The last session did not come to its end: its scene is restored."
        self.status_message.emit(message)

    @property
    def is_due(self) -> bool:
        """Whether something has changed that is not written yet."""
        return self._timer.isActive()

    def note_change(self) -> None:
        """Write the session within :data:`LONGEST_WAIT_MS`: a part of it has changed."""
        if self._file is not None and not self.is_due:
            self._timer.start()

    def write(self) -> None:
        self._write(in_use=True)

    def _write(self, in_use: bool) -> None:
        self._timer.stop()
        if self._file is None:
            return
        session = self._present()
        try:
            self._file.write(session if in_use else replace(session, history=None), in_use)
        except OccError as error:
            if not self._has_failed:
                self._has_failed = True
                self.status_message.emit(
                    "The scene is not kept over a crash: {reason}".format(
                        reason=str(error).rstrip(".") + "."
                    )
                )
            return
        self._has_failed = False
        self.written.emit()

    def end(self) -> None:
        """Write the session for the last time, and release its file."""
        self._write(in_use=False)
        if self._file is not None:
            self._file.close()
            self._file = None


def _saved_in(path: Path) -> Scene | None:
    try:
        return read_scene_file(path) if is_readable(path) else None
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
