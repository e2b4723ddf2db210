"""A file whose reading is told as it goes on, and can be ended."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

Progress: TypeAlias = Callable[[float], object]
"""Takes the share of the work that is done, from 0 to 1; ends the work by raising."""

_STEP = 1 << 16
"""Bytes after which progress is told again: what decoders ask for at once."""


class Teller:
    """Tells of progress, and keeps what was raised to end the work.

    A decoder may take whatever is raised while it reads for a damaged file.

    Parameters
    ----------
    progress
        Whom to tell, None for nobody.
    """

    def __init__(self, progress: Progress | None) -> None:
        self._progress = progress
        self.ended_by: BaseException | None = None

    def __call__(self, share: float) -> None:
        """Tell which share of the work is done, from 0 to 1."""
        if self._progress is None:
            return
        try:
            self._progress(share)
        except BaseException as error:
            self.ended_by = error
            raise


class WatchedFile(io.BufferedReader):
    """A file that is read.

    Parameters
    ----------
    path
        Where it is.
    tell
        Told of progress as the file is read.
    """

    def __init__(self, path: Path, tell: Teller) -> None:
        super().__init__(path.open("rb", buffering=0))
        self._tell_share = tell
        self._from, self._to, self._size = 0.0, 0.0, 1
        self._next = _STEP
        self.total = 0
        """Bytes read, also those that were read again."""

        self.last = 0
        """Bytes that the last reading gave."""

    def watch(self, size: int, first: float, last: float) -> None:
        """Tell from now on of progress between two shares, while ``size`` bytes are read."""
        self._from, self._to, self._size = first, last, max(size, 1)
        self.total, self._next = 0, 0

    def read(self, size: int | None = -1, /) -> bytes:
        """Read bytes, and tell of them."""
        content = super().read(size)
        self.last = len(content)
        self.total += self.last
        if self.total >= self._next:
            self._next = self.total + _STEP
            done = min(self.total / self._size, 1.0)
            self._tell_share(self._from + (self._to - self._from) * done)
        return content
