"""Session: the state of a window, saved within a second of every change and restored at a start."""

import json
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.files.session_record import SavedSession, make_record, read_session
from occ_model.errors import OccError, OutputError, SceneFileError, one_line, quote
from occ_model.files.reading import read_text
from occ_model.files.writing import make_folder, make_private, write_whole

LARGEST_FILE = 4_000_000  # bytes; larger session files are refused, usual ones have some thousand

STATE_FOLDER = "OCC_STATE"  # environment variable with another folder for the program's own files

_FORMAT = 1

_MOST_WRITINGS = 2**53  # a larger count in a session file is not valid: no window writes so often

_MOST_WINDOWS = 8  # windows that can be open at the same time, each with its own session file


def state_folder() -> Path:
    """Return the folder of the program's own files, which may not exist yet."""
    folder = os.environ.get(STATE_FOLDER)
    if folder:
        return Path(folder)
    # Imported only when no folder is given.
    from platformdirs import user_state_path

    return user_state_path("occ-explorer", appauthor=False)


class SessionFile:
    """The session file of one window, locked while the window is open.

    A file that is marked as in use but is not locked belongs to a window that crashed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock: QLockFile | None = None
        self._path: Path | None = None
        self.crashed: SavedSession | None = None
        self.last: SavedSession | None = None
        """The session written last, except those of windows that are open."""
        self.invalid_file_message: str | None = None  # None if every session file is valid
        # If the folder cannot be made, the first writing reports it.
        with suppress(OccError, OSError):
            make_folder(folder, is_private=True)
            self._open()

    def _paths(self) -> list[Path]:
        numbers = range(1, _MOST_WINDOWS + 1)
        return [self._folder / f"session-{number}.json" for number in numbers]

    def _open(self) -> None:
        """Lock a file that no other window uses, preferably the file of a window that crashed."""
        # Other users could read the files of earlier versions.
        for path in self._folder.glob("session-*"):
            make_private(path)
        paths = self._paths()
        records = {path: _read_record_if_valid(path) for path in paths}
        is_free: dict[Path, bool] = {}
        for path in sorted(paths, key=lambda path: not _is_in_use(records[path])):
            lock = QLockFile(str(path.with_suffix(".lock")))
            lock.setStaleLockTime(0)  # a lock is stale only if its process has ended, not by age
            is_free[path] = lock.tryLock(0)
            if not is_free[path]:
                continue
            make_private(Path(lock.fileName()))  # it names the machine
            if self._path is None and self._recover(path):
                self._lock, self._path = lock, path
            else:
                lock.unlock()
        readable = [path for path in paths if is_free[path] and records[path] is not None]
        if readable:
            newest = max(readable, key=lambda path: (_count_in(records[path]), _time_of(path)))
            self.last = read_session(records[newest])

    def _recover(self, path: Path) -> bool:
        """Take over a file: restore the session of a crash, and rename a file that is not valid.

        Returns False if an invalid file cannot be renamed: it must not be overwritten.
        """
        if not os.path.lexists(path):
            return True
        try:
            record = _read_record(path)  # read again, now that no other window can write it
            session = read_session(record)
            if session is None:
                raise SceneFileError(f"{one_line(str(path))} contains no valid scene.")
        except OccError as error:
            new_path = _find_free_path(path)
            try:
                path.rename(new_path)
            except OSError:
                self.invalid_file_message = f"{error} It stays there, and another file is used."
                return False
            self.invalid_file_message = f"{error} It is kept as {one_line(new_path.name)}."
            return True
        if _is_in_use(record):
            self.crashed = session
        return True

    def write(self, session: SavedSession, in_use: bool) -> None:
        if self._path is None:
            raise OutputError(f"there is no free session file in {self._folder}.")
        record = {
            "format": _FORMAT,
            # Counting tells which session was written last; clocks can be set back.
            "count": 1 + max(_count_in(_read_record_if_valid(path)) for path in self._paths()),
            "in_use": in_use,
            **make_record(session),
        }
        content = json.dumps(record, indent=1).encode("ascii")
        write_whole(self._path, content, is_private=True)

    def close(self) -> None:
        self._path = None
        if self._lock is not None:
            self._lock.unlock()


def _read_record(path: Path) -> dict[str, Any]:
    """Read the record of a session, or raise SceneFileError."""
    text, name = read_text(path, LARGEST_FILE), one_line(str(path))
    try:
        record = json.loads(text)
    except (ValueError, RecursionError):
        raise SceneFileError(f"{name} cannot be read: it is not a session.") from None
    file_format = record.get("format") if isinstance(record, dict) else None
    if type(file_format) is not int or file_format != _FORMAT:
        raise SceneFileError(
            f"{name} cannot be read: its format is {quote(file_format)}; allowed: {_FORMAT}."
        )
    return dict(record)


def _read_record_if_valid(path: Path) -> dict[str, Any] | None:
    try:
        return _read_record(path)
    except OccError:
        return None


def _find_free_path(path: Path) -> Path:
    """Return an unused name for a file that is to be renamed."""
    free_path, number = path.with_suffix(".unreadable"), 1
    while os.path.lexists(free_path):
        number += 1
        free_path = path.with_suffix(f".unreadable-{number}")
    return free_path


def _is_in_use(record: dict[str, Any] | None) -> bool:
    return record is not None and record.get("in_use") is True


def _count_in(record: dict[str, Any] | None) -> int:
    count = None if record is None else record.get("count")
    return count if type(count) is int and 0 < count <= _MOST_WRITINGS else 0


def _time_of(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:  # another window has just replaced it
        return 0


LONGEST_WAIT_MS = 1000
"""Longest time between a change and its saving; changes within it are saved together."""


def restore_workspace(
    file: SessionFile, first: Workspace, *, names_scene: bool, has_settings: bool
) -> Workspace:
    """Return the first workspace: the last session's, except for what the command line gives.

    A scene of the command line is simulated with the settings of a new window.
    """
    last = file.last
    if last is None:
        return first
    # After a crash, everything but the undo state comes from the crashed window; its scene follows
    # as an undo step.
    workspace = last.workspace.undo_state.put_into((file.crashed or last).workspace)
    if names_scene:
        workspace = replace(
            workspace, scene=first.scene, preset="", scene_file=None, photo=first.photo,
            film=first.film,
        )  # fmt: skip
    is_new = names_scene or has_settings
    return replace(workspace, settings=first.settings) if is_new else workspace


class Session(QObject):
    """Saves the workspace of a window to a file, once :meth:`begin` is called.

    ``find_user_workspace`` returns what the user has set, without what a lesson shows.
    """

    status_message = Signal(str)
    """What was restored or renamed; or, only once, why the session cannot be saved."""

    written = Signal()

    def __init__(self, store: Store, find_user_workspace: Callable[[], Workspace]) -> None:
        super().__init__()
        self._store, self._find_user_workspace = store, find_user_workspace
        self._file: SessionFile | None = None
        self._has_failed = False
        # Only the first change starts it: restarted by each change, it would never run out while a
        # slider keeps moving.
        self._timer = QTimer(self, singleShot=True)
        self._timer.setInterval(LONGEST_WAIT_MS)
        self._timer.timeout.connect(self.write)

    def begin(self, file: SessionFile, *, names_scene: bool) -> None:
        """Restore the steps after a crash, and save to the file from now on."""
        self._file = file
        messages = [file.invalid_file_message] if file.invalid_file_message else []
        if file.crashed is not None:
            messages.append(self._restore_crashed(file.crashed, names_scene=names_scene))
        if message := " ".join(filter(None, messages)):
            self.status_message.emit(message)
        self._store.select(lambda workspace: workspace).changed.connect(self._start_timer)
        self._start_timer()

    def _restore_crashed(self, session: SavedSession, *, names_scene: bool) -> str:
        """Restore the scene and steps of a crashed window; return a sentence that says so."""
        store, requested = self._store, self._store.workspace.undo_state
        crashed = session.workspace.undo_state
        store.put(crashed.put_into(store.workspace), "restoring of the last session")
        if session.history is not None and (names_scene or crashed == requested):
            store.resume(session.history)
        if names_scene and crashed != requested:
            store.put(requested.put_into(store.workspace), "opening of the requested scene")
            return "The last session ended unexpectedly; Undo brings its scene back."
        if names_scene:
            return ""  # the requested scene is that of the last session
        return "The last session ended unexpectedly: its scene is restored."

    @property
    def is_due(self) -> bool:
        return self._timer.isActive()

    def _start_timer(self) -> None:
        if self._file is not None and not self.is_due:
            self._timer.start()

    def write(self) -> None:
        workspace = self._find_user_workspace()
        history = self._store.history(workspace.undo_state)
        self._write(SavedSession(workspace, history), in_use=True)

    def end(self) -> None:
        self._write(SavedSession(self._find_user_workspace()), in_use=False)
        if self._file is not None:
            self._file.close()
            self._file = None

    def _write(self, session: SavedSession, *, in_use: bool) -> None:
        self._timer.stop()
        if self._file is None:
            return
        try:
            self._file.write(session, in_use)
        except OccError as error:
            if not self._has_failed:
                self._has_failed = True
                reason = str(error).rstrip(".")
                self.status_message.emit(f"The scene would be lost in a crash: {reason}.")
            return
        self._has_failed = False
        self.written.emit()
