"""Session file: what a window is working on, in one file that the window keeps locked."""

import json
import os
from contextlib import suppress
from pathlib import Path
from typing import Any

from PySide6.QtCore import QLockFile

from occ_gui.files.kept_file import LARGEST
from occ_gui.files.session_record import Kept, kept_in, record_of
from occ_model.errors import OccError, OutputError
from occ_model.files.reading import read_text
from occ_model.files.writing import make_folder, write_whole

STATE_FOLDER = "OCC_STATE"
"""The environment variable that names another folder for the files that the program keeps."""

_FORMAT = 1

_MOST_WINDOWS = 8  # Windows that can be open at a time, each with its own session file


def state_folder() -> Path:
    """Return the folder of the files that the program keeps, which may not exist yet."""
    folder = os.environ.get(STATE_FOLDER)
    if folder:
        return Path(folder)
    # Not needed where the folder is named.
    from platformdirs import user_state_path

    return user_state_path("occ-explorer", appauthor=False)


class SessionFile:
    """The session file of one window, locked while the window is open.

    A file that says it is in use, but is not locked, belongs to a window that crashed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock: QLockFile | None = None
        self._path: Path | None = None
        self.crashed: Kept | None = None
        self.last: Kept | None = None  # what was written last, whichever window wrote it
        # If the folder cannot be made, the first writing reports it.
        with suppress(OccError):
            make_folder(folder)
            self._open()

    def _paths(self) -> list[Path]:
        numbers = range(1, _MOST_WINDOWS + 1)
        return [self._folder / f"session-{number}.json" for number in numbers]

    def _open(self) -> None:
        """Lock a file that no other window uses, preferably that of a window that crashed."""
        paths = self._paths()
        records = {path: _record_in(path) for path in paths}
        readable = [path for path in paths if records[path] is not None]
        if readable:
            newest = max(readable, key=lambda path: (_count_in(records[path]), _time_of(path)))
            self.last = kept_in(records[newest])
        for path in sorted(paths, key=lambda path: not _is_in_use(records[path])):
            lock = QLockFile(str(path.with_suffix(".lock")))
            lock.setStaleLockTime(0)  # never stale by age, only if its process has ended
            if not lock.tryLock(0):
                continue
            self._lock, self._path = lock, path
            self._recover(path)
            return

    def _recover(self, path: Path) -> None:
        """Take over a file: restore the session of a crash, and put damaged content aside."""
        record = _record_in(path)  # now that no other window can write it
        kept = kept_in(record)
        if _is_in_use(record):
            self.crashed = kept
        if kept is None and os.path.lexists(path):
            with suppress(OSError):
                path.replace(path.with_suffix(".unreadable"))

    def write(self, kept: Kept, in_use: bool) -> None:
        if self._path is None:
            raise OutputError(f"there is no free session file in {self._folder}.")
        record = {
            "format": _FORMAT,
            # Which session was written last is counted: clocks can be put back.
            "count": 1 + max(_count_in(_record_in(path)) for path in self._paths()),
            "in_use": in_use,
            **record_of(kept),
        }
        write_whole(self._path, json.dumps(record, indent=1).encode("ascii"))

    def close(self) -> None:
        self._path = None
        if self._lock is not None:
            self._lock.unlock()


def _record_in(path: Path) -> dict[str, Any] | None:
    try:
        record = json.loads(read_text(path, LARGEST))
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
    return record if isinstance(record, dict) and record.get("format") == _FORMAT else None


def _is_in_use(record: dict[str, Any] | None) -> bool:
    return record is not None and record.get("in_use") is True


def _count_in(record: dict[str, Any] | None) -> int:
    count = None if record is None else record.get("count")
    return count if type(count) is int and count > 0 else 0


def _time_of(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:  # another window has just replaced it
        return 0
