"""The session: kept while the window is at work, and taken up again at the next start."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from occ_gui.files.autosave import Autosave, WriteTimer
from occ_gui.files.document import Document
from occ_gui.files.kept_file import is_readable
from occ_gui.files.preferences import Memory
from occ_gui.files.session import Session, keep_session
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene


class SessionKeeper(QObject):
    """Keeps what the window is at work on; until :meth:`resume` it keeps nothing.

    Parameters
    ----------
    store, settings
        The scene, and how it is simulated.
    document
        Knows the scene's file.
    memory
        Where the session is kept.
    photo
        Gives the photo that is open, if any.
    """

    status_message = Signal(str)
    """What has been restored, or what cannot be kept."""

    def __init__(
        self,
        store: SceneStore,
        settings: SettingsStore,
        document: Document,
        memory: Memory,
        photo: Callable[[], Path | None],
    ) -> None:
        super().__init__()
        self._store, self._settings = store, settings
        self._document = document
        self._memory = memory
        self._photo = photo
        self._autosave: Autosave | None = None
        self._timer = WriteTimer(self, self.keep)

    def resume(self, autosave: Autosave, session: Session, scene_wins: bool) -> None:
        """Take up a session, and keep this one from now on.

        Parameters
        ----------
        autosave
            Keeps the scene, and knows what a crash has left behind.
        session
            The session; its scene and settings are in the stores already, if they are wanted.
        scene_wins
            Whether the store's scene was asked for, and stays whatever was left behind.
        """
        self._autosave = autosave
        autosave.failed.connect(self.status_message)
        left, asked = autosave.recovered, self._store.scene
        if not scene_wins and session.scene_file is not None:
            self._document.resume(session.scene_file, _saved_in(session.scene_file))
        if left is not None:
            self._put_back(left, asked, scene_wins)
        autosave.follow(self._store)
        for store in (self._store, self._settings):
            store.changed.connect(self._timer.note_change)
        self.note()

    @property
    def is_kept(self) -> bool:
        """Whether there will be a next start that takes this session up."""
        return self._autosave is not None

    def note(self) -> None:
        """Keep the session in a moment: something of it has changed."""
        if self._autosave is not None:
            self._timer.note_change()

    def _put_back(self, left: Scene, asked: Scene, scene_wins: bool) -> None:
        title = self.tr("restoring of the last session")
        self._store.put(left, title)
        if scene_wins and left != asked:
            self._store.put(asked, self.tr("opening of what was asked for"))
            message = self.tr(
                "The last session did not come to its end; Undo brings its scene back."
            )
        else:
            message = self.tr("The last session did not come to its end: its scene is restored.")
        self.status_message.emit(message)

    def keep(self) -> None:
        """Keep the session now."""
        self._timer.stop()
        if self._autosave is None:
            return
        keep_session(
            self._memory,
            Session(self._store.scene, self._settings.settings, self._document.path, self._photo()),
        )

    def end(self) -> None:
        """Keep the session for the last time."""
        self.keep()
        if self._autosave is not None:
            self._autosave.end()
            self._autosave = None


def _saved_in(path: Path) -> Scene | None:
    try:
        return read_scene_file(path) if is_readable(path) else None
    except Exception:  # noqa: BLE001 - whatever is in it, the window starts
        return None
