"""A file that reports the progress of its reading, and whose reading can be cancelled."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from occ_model.files.reading import BoundedFile

Progress: TypeAlias = Callable[[float], object]
"""Called with the fraction of the work that is done, from 0 to 1; cancels the work by raising."""

_STEP = 1 << 16  # bytes between two reports of progress, the number that decoders read at once


class Reporter:
    """Reports progress, and keeps the exception that cancelled the work.

    It is kept because a decoder may regard any exception of a read as a damaged file.
    """

    def __init__(self, progress: Progress | None) -> None:
        self._progress = progress
        self.ended_by: BaseException | None = None

    def __call__(self, fraction: float) -> None:
        if self._progress is None:
            return
        try:
            self._progress(fraction)
        except BaseException as error:
            self.ended_by = error
            raise


class WatchedFile(BoundedFile):
    def __init__(self, path: Path, report: Reporter) -> None:
        super().__init__(path)
        self._report = report
        self._from, self._to, self._size = 0.0, 0.0, 1
        self._next = _STEP
        self.total = 0  # number of bytes read, including those read again
        self.last = 0  # number of bytes of the last read

    def watch(self, size: int, first: float, last: float) -> None:
        """Report progress from the fraction ``first`` to ``last`` while reading ``size`` bytes."""
        self._from, self._to, self._size = first, last, max(size, 1)
        self.total, self._next = 0, 0

    def read(self, size: int | None = -1, /) -> bytes:
        content = super().read(size)
        self.last = len(content)
        self.total += self.last
        if self.total >= self._next:
            self._next = self.total + _STEP
            done = min(self.total / self._size, 1.0)
            self._report(self._from + (self._to - self._from) * done)
        return content
