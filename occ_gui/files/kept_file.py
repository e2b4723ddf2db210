"""Files that the window keeps for itself, read only if they are what it has written."""

import os
import stat
from pathlib import Path

LARGEST = 4_000_000
"""Bytes of a file that the window keeps: a scene has some thousand, the settings ten times that."""


def is_readable(path: Path) -> bool:
    """Say whether a path can be read at once: a regular file, and not too large."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return False
    return stat.S_ISREG(found.st_mode) and found.st_size <= LARGEST


def is_something_else(path: Path) -> bool:
    """Say whether in a file's place there is what cannot be read at once, such as a pipe."""
    return os.path.lexists(path) and not is_readable(path)


def read_kept(path: Path) -> str:
    """Read a file that the window has kept.

    Raises
    ------
    OSError
        It is no regular file (a pipe would never end), too large, or cannot be read.
    UnicodeDecodeError
        It is no text.
    """
    if not is_readable(path):
        raise OSError(f"{path} is no regular file of at most {LARGEST:,} bytes.")
    return path.read_text(encoding="utf-8")
