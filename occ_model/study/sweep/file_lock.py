"""Lock an open file for one process; the lock ends with the process, however that ends."""

import os
import sys
from errno import EACCES, EAGAIN
from typing import BinaryIO
from weakref import WeakSet

_open_here: "WeakSet[BinaryIO]" = WeakSet()

if sys.platform == "win32":
    import msvcrt

    _FAR = 2**40
    """A byte beyond any file's end: the bytes of the file itself stay readable by others."""

    def _lock(file: BinaryIO) -> None:
        place = file.tell()
        file.seek(_FAR)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        finally:
            file.seek(place)

else:
    import fcntl

    def _lock(file: BinaryIO) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def is_locked_by_us(file: BinaryIO) -> bool:
    """Lock a file until it is closed; return False where another process has locked it.

    On file systems without locks no process is kept out.
    """
    try:
        _lock(file)
    except OSError as error:
        return error.errno not in (EACCES, EAGAIN)
    _open_here.add(file)
    return True


def _close_in_child() -> None:
    """Close the parent's locked files: a forked worker that outlives it must hold no lock."""
    for file in list(_open_here):
        os.close(file.fileno())


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_in_child)
