"""Temporary folder of an export: its files are moved into place once all of them are written."""

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from secrets import token_hex

from PySide6.QtCore import QLockFile

_PREFIX = ".export-"
_NAME = re.compile(re.escape(_PREFIX) + r"[a-z0-9_]{8}")


@contextmanager
def folder_aside(folder: Path) -> Iterator[Path]:
    """Create a temporary folder in a folder, with a lock file beside it while it exists."""
    aside = folder / f"{_PREFIX}{token_hex(4)}"
    lock = _lock_of(aside)
    is_locked = lock.tryLock(0)  # before the folder exists, which another process could remove
    aside.mkdir(mode=0o700)
    try:
        if not is_locked:
            raise OSError(f"no lock can be made beside {aside.name}")
        yield aside
    finally:
        shutil.rmtree(aside, ignore_errors=True)
        lock.unlock()


def remove_left_behind(folder: Path) -> None:
    names = {path.name.removesuffix(".lock") for path in folder.glob(f"{_PREFIX}*")}
    for name in filter(_NAME.fullmatch, names):
        aside = folder / name
        lock = _lock_of(aside)
        if not lock.tryLock(0):  # its process is running, here or on another computer
            continue
        if _holds_only_files(aside):
            shutil.rmtree(aside, ignore_errors=True)
        lock.unlock()


def _lock_of(aside: Path) -> QLockFile:
    lock = QLockFile(f"{aside}.lock")
    lock.setStaleLockTime(0)  # never stale by age, only if its process has ended
    return lock


def _holds_only_files(path: Path) -> bool:
    """Return whether a path is a folder of regular files only, as an export creates it."""
    try:
        is_folder = path.is_dir() and not path.is_symlink()
        return is_folder and all(
            each.is_file() and not each.is_symlink() for each in path.iterdir()
        )
    except OSError:
        return False
