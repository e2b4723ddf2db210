"""Check of the program's own files before they are read."""

import stat
from pathlib import Path

LARGEST = 4_000_000
"""Bytes of a file of the program's own; a session has thousands, the settings ten times that."""


def is_readable(path: Path) -> bool:
    """Return whether a path is a regular file of at most LARGEST bytes."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return False
    return stat.S_ISREG(found.st_mode) and found.st_size <= LARGEST
