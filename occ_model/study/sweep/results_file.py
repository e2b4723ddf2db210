"""The CSV file to which a study appends its results, and from which it can be continued.

Each point is written at once, in one piece, so that the file survives the end of the program. Only
the study that began a file can continue it: the file's comment lines hold all that determines the
numbers, and are compared with those that the study would write.
"""

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import BinaryIO, Generic, Protocol, Self, TypeVar

from occ_model.errors import OutputError, ParameterError, one_line, shown
from occ_model.files.locking import locked
from occ_model.files.writing import check_replaceable, write_whole

_LONGEST_LINE = 100_000  # bytes of a line; ours have some hundred
_SYNC_SECONDS = 2.0  # maximum seconds of work lost by a power cut


class Indexed(Protocol):
    @property
    def index(self) -> int:
        """Its number, from 0."""


Point = TypeVar("Point", bound=Indexed)


class TableText(Protocol[Point]):
    """The text form of a study's points."""

    what: str  # name of the study, such as a sweep

    title: str  # start of the header of every such table

    header: str  # all that determines the numbers, and the names of the columns

    points: int  # number of points of the whole study

    lines_a_point: int

    def read(self, lines: Sequence[str], number: int) -> Point | None:
        """Parse a point from its lines, of which the first has this number.

        None where they are not of this study; ParameterError where a count cannot be.
        """

    def text(self, point: Point) -> str:
        """Format a point."""


class ResultsFile(Generic[Point]):
    """A CSV file of one study, open and locked within its context.

    On entering it raises OutputError, and leaves the file unchanged: it is not a regular file,
    cannot be written, is in use by another study, or holds something else than this one.
    """

    def __init__(self, path: Path, table: TableText[Point]) -> None:
        self._path = path
        self._name = one_line(str(path))
        self._table = table
        self._header = table.header.encode("utf-8")
        self._in_order = True
        self._last = -1
        self._synced = monotonic()

    def __enter__(self) -> Self:
        self._file = self._opened()
        try:
            self._check_header()
        except BaseException:
            self._file.close()
            raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._file.close()

    def _opened(self) -> BinaryIO:
        """Open and lock the file; where it was replaced before it was locked, open the new one."""
        while True:
            check_replaceable(self._path)
            try:
                descriptor = os.open(self._path, os.O_RDWR | os.O_CREAT | _BINARY, 0o666)
                file = os.fdopen(descriptor, "r+b", buffering=0)
            except OSError as error:
                raise self._unwritable(error) from None
            if locked(file) is False:
                file.close()
                raise OutputError(
                    f"{self._name} is being written by another {self._table.what}; wait for it, or "
                    "name another file."
                )
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(file.fileno()), self._path.stat()):
                    return file
            file.close()

    def _check_header(self) -> None:
        """Refuse a file of anything else; complete the header of a file that was just begun."""
        there = self._file.read(len(self._header))
        if there == self._header:
            return
        if self._header.startswith(there):
            self._file.seek(0)
            self._write(self._header, keep=0)
            return
        if not there.startswith(self._table.title.encode("utf-8")):
            raise OutputError(
                f"{self._name} holds no results of a {self._table.what}; name another file."
            )
        wanted = self._header.decode("utf-8").splitlines()
        found = there.decode("utf-8", errors="replace").splitlines()
        last = len(found) - 1  # may be cut: only as many bytes as this header has were read
        for place, (mine, other) in enumerate(zip(wanted, found, strict=False)):
            if mine != other and not (place == last and mine.startswith(other)):
                raise OutputError(
                    f"{self._name} holds the results of another {self._table.what}: it says "
                    f"{shown(_short(other))} where this one has {shown(_short(mine))}; name "
                    "another file."
                )
        raise OutputError(f"{self._name} was changed by another program; name another file.")

    def points_there(self) -> Iterator[Point]:
        """Read the points that the file holds, before any is appended; cut off half of one."""
        height = self._table.lines_a_point
        seen = bytearray(self._table.points)
        whole, line_number = len(self._header), self._header.count(b"\n")
        with open(self._file.fileno(), "rb", closefd=False) as buffered:
            buffered.seek(whole)
            while True:
                rows = (buffered.readline(_LONGEST_LINE) for _ in range(height))
                lines = [line for line in rows if line]
                text = b"".join(lines)
                is_cut = len(lines) < height or not text.endswith(b"\n")
                if is_cut and all(len(line) < _LONGEST_LINE for line in lines):
                    break
                rows_of_point = text.decode("utf-8", errors="replace").splitlines()
                try:
                    point = self._table.read(rows_of_point, line_number + 1)
                except ParameterError as impossible:
                    raise OutputError(
                        f"{self._name}, {impossible} Mend or remove the line, or name another file."
                    ) from None
                if point is None or seen[point.index] or self._text(point) != text:
                    raise OutputError(
                        f"{self._name} holds something else in line {line_number + 1}: it is no "
                        f"new row of this {self._table.what}; mend or remove it, or name another "
                        "file."
                    )
                seen[point.index] = 1
                whole, line_number = whole + len(text), line_number + height
                self._note_order(point)
                yield point
        try:
            self._file.truncate(whole)
        except OSError as error:
            raise self._unwritable(error) from None
        self._file.seek(whole)

    def append(self, point: Point) -> None:
        self._note_order(point)
        self._write(self._text(point), keep=self._file.tell())

    def finish(self, lines: Iterable[str]) -> None:
        """Rewrite the complete table in the order of the axes, unless it is in that order."""
        try:
            os.fsync(self._file.fileno())
        except OSError as error:
            raise self._unwritable(error) from None
        if not self._in_order:
            # Where there is no space for a second file the first stays: it is as complete.
            with suppress(OutputError):
                write_whole(self._path, "".join(lines).encode("utf-8"))

    def _text(self, point: Point) -> bytes:
        return self._table.text(point).encode("utf-8")

    def _note_order(self, point: Point) -> None:
        self._in_order &= point.index > self._last
        self._last = point.index

    def _write(self, text: bytes, keep: int) -> None:
        """Write at the end; where that fails, cut the file back to its length before."""
        try:
            left = memoryview(text)
            while left:
                left = left[os.write(self._file.fileno(), left) :]
            if monotonic() - self._synced > _SYNC_SECONDS:
                os.fsync(self._file.fileno())
                self._synced = monotonic()
        except OSError as error:
            # Where this fails too, the incomplete line is cut off when the sweep is continued.
            with suppress(OSError):
                self._file.truncate(keep)
            raise self._unwritable(error) from None

    def _unwritable(self, error: OSError) -> OutputError:
        return OutputError(f"{self._name} cannot be written: {error.strerror or error}.")


_BINARY = getattr(os, "O_BINARY", 0)


def _short(line: str) -> str:
    text = line.lstrip("# ")
    return text if len(text) <= 60 else f"{text[:57]}..."
