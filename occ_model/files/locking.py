"""Lock open files until they are closed or the process ends."""

import os
import sys
from errno import EACCES, EAGAIN
from typing import BinaryIO
from weakref import WeakSet

_open_here: "WeakSet[BinaryIO]" = WeakSet()

if sys.platform == "win32":
    import msvcrt

    _FAR = 2**40
    """Position of a byte beyond any file's end, so that others can still read the file."""

    def take_lock(file: BinaryIO) -> None:
        place = file.tell()
        file.seek(_FAR)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        finally:
            file.seek(place)

else:
    import fcntl

    def take_lock(file: BinaryIO) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def lock(file: BinaryIO) -> bool | None:
    """Lock a file until it is closed; return False if another has, None if locks do not exist."""
    try:
        take_lock(file)
    except OSError as error:
        return False if error.errno in (EACCES, EAGAIN) else None
    _open_here.add(file)
    return True


def _close_in_child() -> None:
    """Close the parent's locked files, so that a forked worker that outlives it holds no lock."""
    for file in list(_open_here):
        os.close(file.fileno())


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_in_child)
