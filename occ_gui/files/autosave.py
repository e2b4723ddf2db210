"""Autosave: writes the session at most a second after every change, and restores it at a start."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.files.document import Document
from occ_gui.files.kept_file import is_readable
from occ_gui.files.session import Session, SessionFile, UserState
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
from occ_model.errors import OccError
from occ_model.results import Region
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene

LONGEST_WAIT_MS = 1000
"""Longest time from a change to its writing; later changes within it are written with it."""


class Autosave(QObject):
    """Writes the session of a window to its file; before :meth:`resume` it writes nothing.

    Parameters
    ----------
    store, settings
        The stores of the scene and of the settings of its simulation.
    document
        Knows the file of the scene.
    photo
        Returns the path of the open photo, if any.
    region
        Returns the rectangle of the photo that was drawn by hand, if any.
    film
        Returns the path of the open film, if any.
    set_aside
        Returns what the user was working on, while a lesson shows something else.
    """

    status_message = Signal(str)
    """What has been restored, or why the session cannot be written; the latter is not repeated."""

    def __init__(  # noqa: PLR0917 - one a part of the session
        self,
        store: SceneStore,
        settings: SettingsStore,
        document: Document,
        photo: Callable[[], Path | None],
        set_aside: Callable[[], UserState | None],
        region: Callable[[], Region | None] = lambda: None,
        film: Callable[[], Path | None] = lambda: None,
    ) -> None:
        super().__init__()
        self._store, self._settings = store, settings
        self._document = document
        self._photo, self._region, self._film = photo, region, film
        self._set_aside = set_aside
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
        """Restore a session, and write this window's to a file from now on.

        Parameters
        ----------
        file
            The window's file, which also contains the scene of a window that crashed.
        session
            The session; its scene and settings are in the stores already, if they are wanted.
        scene_wins
            Whether the store's scene was asked for and is to stay, even after a crash.
        """
        self._file = file
        asked = self._store.scene
        if not scene_wins and session.scene_file is not None:
            self._document.resume(session.scene_file, _saved_in(session.scene_file))
        if file.crashed is not None:
            self._restore(file.crashed, asked, scene_wins)
        for store in (self._store, self._settings):
            store.changed.connect(self.note_change)
        self.note_change()

    def _restore(self, crashed: Scene, asked: Scene, scene_wins: bool) -> None:
        self._store.put(crashed, self.tr("restoring of the last session"))
        if scene_wins and crashed != asked:
            self._store.put(asked, self.tr("opening of what was asked for"))
            message = self.tr(
                "The last session did not come to its end; Undo brings its scene back."
            )
        else:
            message = self.tr("The last session did not come to its end: its scene is restored.")
        self.status_message.emit(message)

    def note_change(self) -> None:
        """Write the session within :data:`LONGEST_WAIT_MS`: a part of it has changed."""
        if self._file is not None and not self._timer.isActive():
            self._timer.start()

    def write(self) -> None:
        """Write the session now."""
        self._write(in_use=True)

    def _write(self, in_use: bool) -> None:
        self._timer.stop()
        if self._file is None:
            return
        aside = self._set_aside()
        own = aside or UserState(self._store.scene, self._settings.settings, self._photo())
        region = None if aside else self._region()
        session = Session(
            own.scene, own.settings, self._document.path, own.photo, region, self._film()
        )
        try:
            self._file.write(session, in_use)
        except OccError as error:
            if not self._has_failed:
                self._has_failed = True
                self.status_message.emit(
                    self.tr("The scene is not kept over a crash: {reason}").format(
                        reason=str(error).rstrip(".") + "."
                    )
                )
            return
        self._has_failed = False

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
