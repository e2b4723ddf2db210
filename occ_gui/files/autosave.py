"""The scene is kept on the disk at all times, so that a crash loses a second of work at most."""

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from occ_gui.files.kept_file import is_something_else, read_kept
from occ_gui.scene.scene_store import SceneStore
from occ_model.errors import OccError
from occ_model.files.writing import make_folder, write_whole
from occ_model.scene.scene import Scene

STATE_FOLDER = "OCC_STATE"
"""The environment variable that names another folder for what the program keeps."""

LONGEST_WAIT_MS = 1000
"""How long a change waits at most until it is written; those that come meanwhile go with it."""

_WINDOWS = 8
"""Windows that can be open at a time, each with a file of its own."""


def state_folder() -> Path:
    """Give the folder of what the program keeps, which need not be there yet."""
    folder = os.environ.get(STATE_FOLDER)
    if folder:
        return Path(folder)
    # Not needed where the folder is named.
    from platformdirs import user_state_path

    return user_state_path("occ-explorer", appauthor=False)


class WriteTimer(QTimer):
    """Calls for a writing some time after the first change, whatever changes after that.

    A timer that every change starts anew would never run out while a slider keeps moving.

    Parameters
    ----------
    parent
        The owner.
    write
        Writes all that has changed by then.
    """

    def __init__(self, parent: QObject, write: Callable[[], None]) -> None:
        super().__init__(parent, singleShot=True)
        self.setInterval(LONGEST_WAIT_MS)
        self.timeout.connect(write)

    def note_change(self) -> None:
        """Tell of a change that is to be written."""
        if not self.isActive():
            self.start()


class Autosave(QObject):
    """Writes the scene a moment after every change, and finds what a crash left behind.

    A file whose lock nobody holds is of a window that did not come to its end.

    Parameters
    ----------
    folder
        Where to.
    """

    failed = Signal(str)
    """Why the scene could not be written; told once until it can be again."""

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._store: SceneStore | None = None
        self._lock: QLockFile | None = None
        self._path: Path | None = None
        self._has_failed = False
        self._timer = WriteTimer(self, self.write)
        self.recovered: Scene | None = None
        """The scene of a window that did not come to its end."""
        self._folder = folder
        try:
            make_folder(folder)
        except OccError:
            return  # there will be a sentence when the scene is to be written
        self._take_place(folder)

    def _take_place(self, folder: Path) -> None:
        """Take a place that no other window holds: one with work left behind, if there is one."""
        places = [folder / f"scene-{number}.toml" for number in range(1, _WINDOWS + 1)]
        for path in sorted(places, key=lambda path: not path.exists()):
            if is_something_else(path.with_suffix(".lock")):  # which Qt would read, and wait
                continue
            lock = QLockFile(str(path.with_suffix(".lock")))
            lock.setStaleLockTime(0)  # only that of a process that is gone is broken
            if not lock.tryLock(0):
                continue
            self._lock, self._path = lock, path
            if path.exists():
                self.recovered = _scene_in(path)
            return

    def follow(self, store: SceneStore) -> None:
        """Write this store's scene from now on."""
        self._store = store
        store.changed.connect(self._timer.note_change)

    def write(self) -> None:
        """Write the scene now."""
        self._timer.stop()
        if self._store is None:
            return
        try:
            if self._path is None:
                raise OccError(self.tr("there is no place for it in {0}").format(self._folder))
            write_whole(self._path, self._store.scene.to_toml().encode("utf-8"))
        except OccError as error:
            if not self._has_failed:
                self._has_failed = True
                self.failed.emit(
                    self.tr("The scene is not kept over a crash: {reason}").format(
                        reason=str(error).rstrip(".") + "."
                    )
                )
            return
        self._has_failed = False

    def end(self) -> None:
        """Leave nothing behind: the window comes to its end."""
        self._timer.stop()
        self._store = None
        if self._path is not None:
            with suppress(OSError):
                self._path.unlink(missing_ok=True)
        if self._lock is not None:
            self._lock.unlock()


def _scene_in(path: Path) -> Scene | None:
    """Read what was left behind; what cannot be read stays beside it, for its owner to look at."""
    try:
        return Scene.from_toml(read_kept(path))
    except Exception:  # noqa: BLE001 - whatever is in it, the window starts
        with suppress(OSError):
            path.replace(path.with_suffix(".unreadable"))
        return None
