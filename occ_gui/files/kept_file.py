"""Checks of the program's own files, made before Qt reads them: Qt would block on a pipe."""

import os
import stat
from pathlib import Path

LARGEST = 4_000_000
"""Bytes of a file of the program's own; a session has thousands, the settings ten times that."""

MOST_NAMES = 8
"""Most names that are tried for the file of the settings."""


def is_readable(path: Path) -> bool:
    """Return whether a path is a regular file of at most LARGEST bytes."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return False
    return stat.S_ISREG(found.st_mode) and found.st_size <= LARGEST


def is_something_else(path: Path) -> bool:
    """Return whether a path exists but is not such a file, for example a pipe."""
    return os.path.lexists(path) and not is_readable(path)


def usable_settings_path(path: Path) -> Path | None:
    """Return where Qt can store settings without waiting forever.

    Qt waits both on a file and on its lock file beside it if they are pipes, and on a lock file
    that is a folder.

    Parameters
    ----------
    path
        The preferred file; otherwise, a file of a similar name in the same folder is chosen.

    Returns
    -------
    path
        The first usable file, whether it exists or not; None if none of MOST_NAMES is usable.
    """
    endings = ("", "-new", *(f"-new-{number}" for number in range(2, MOST_NAMES)))
    paths = (path.with_stem(f"{path.stem}{ending}") for ending in endings)
    return next((path for path in paths if not _would_block(path)), None)


def _would_block(path: Path) -> bool:
    return is_something_else(path) or is_something_else(path.with_name(f"{path.name}.lock"))
