"""Locks on open files, which end with the process that holds them."""

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


def locked(file: BinaryIO) -> bool | None:
    """Lock a file until closed; False if another has locked it, None where there are no locks."""
    try:
        take_lock(file)
    except OSError as error:
        return False if error.errno in (EACCES, EAGAIN) else None
    _open_here.add(file)
    return True


def _close_in_child() -> None:
    """Close the parent's locked files: a forked worker that outlives it must hold no lock."""
    for file in list(_open_here):
        os.close(file.fileno())


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_in_child)
