"""The CSV file to which a study appends its results, and from which it can be continued.

Each point is written at once and in one piece, so that the file stays valid if the program is
stopped. Only the study that began a file can continue it: the file's comment lines contain all that
determines the numbers, and are compared with those that the study would write.
"""

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import BinaryIO, Generic, Protocol, Self, TypeVar

from occ_model.errors import OutputError, ParameterError, one_line, quote
from occ_model.files.writing import check_replaceable, lock, write_whole

_LONGEST_LINE = 100_000  # bytes of a line; usual ones have some hundred
_SYNC_SECONDS = 2.0  # maximum seconds of work lost by a power cut


class Indexed(Protocol):
    @property
    def index(self) -> int:
        """Number of the point, from 0."""


Point = TypeVar("Point", bound=Indexed)


class TableText(Protocol[Point]):
    """The text form of a study's points."""

    study_name: str  # such as "sweep"

    title: str  # start of the header of every such table

    header: str  # all that determines the numbers, and the column names

    point_count: int  # of the whole study

    lines_a_point: int

    def read(self, lines: Sequence[str], number: int) -> Point | None:
        """Parse a point from its lines; ``number``: the line number of the first.

        Returns None if they do not belong to this study. Raises ParameterError if a count is
        impossible.
        """

    def text(self, point: Point) -> str:
        """Format a point."""


class ResultsFile(Generic[Point]):
    """A CSV file of one study, open and locked within its context.

    Entering raises OutputError and leaves the file unchanged if it is not a regular file, cannot be
    written, is in use by another study, or contains anything else than this study.
    """

    def __init__(self, path: Path, table: TableText[Point]) -> None:
        self._path = path
        self._name = one_line(str(path))
        self._table = table
        self._study_name = table.study_name
        self._header = table.header.encode("utf-8")
        self._is_in_order = True
        self._last_index = -1
        self._sync_time = monotonic()

    def __enter__(self) -> Self:
        self._file = self._open_locked()
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

    def _open_locked(self) -> BinaryIO:
        """Open and lock the file; if it was replaced before it was locked, open the new one."""
        while True:
            check_replaceable(self._path)
            try:
                descriptor = os.open(self._path, os.O_RDWR | os.O_CREAT | _BINARY, 0o666)
                file = os.fdopen(descriptor, "r+b", buffering=0)
            except OSError as error:
                raise self._unwritable(error) from None
            if lock(file) is False:
                file.close()
                raise OutputError(
                    f"{self._name} is being written by another {self._study_name}; wait for it, or "
                    "name another file."
                )
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(file.fileno()), self._path.stat()):
                    return file
            file.close()

    def _check_header(self) -> None:
        """Refuse a file with other contents; complete the header of a file that was just begun."""
        content = self._file.read(len(self._header))
        if content == self._header:
            return
        if self._header.startswith(content):
            self._file.seek(0)
            self._write(self._header, keep=0)
            return
        if not content.startswith(self._table.title.encode("utf-8")):
            raise OutputError(
                f"{self._name} contains no results of a {self._study_name}; name another file."
            )
        expected_lines = self._header.decode("utf-8").splitlines()
        file_lines = content.decode("utf-8", errors="replace").splitlines()
        last = (
            len(file_lines) - 1
        )  # may be cut, since only as many bytes as this header has were read
        for index, (own_line, line) in enumerate(zip(expected_lines, file_lines, strict=False)):
            if own_line != line and not (index == last and own_line.startswith(line)):
                raise OutputError(
                    f"{self._name} contains the results of another {self._study_name}: it says "
                    f"{quote(_shorten(line))} where this one has {quote(_shorten(own_line))}; name "
                    "another file."
                )
        raise OutputError(f"{self._name} was changed by another program; name another file.")

    def read_points(self) -> Iterator[Point]:
        """Read the points in the file before any is appended; cut off an incomplete last one."""
        count = self._table.lines_a_point
        is_read = bytearray(self._table.point_count)
        end, line_number = len(self._header), self._header.count(b"\n")
        with open(self._file.fileno(), "rb", closefd=False) as buffered:
            buffered.seek(end)
            while True:
                read = (buffered.readline(_LONGEST_LINE) for _ in range(count))
                lines = [line for line in read if line]
                text = b"".join(lines)
                is_cut = len(lines) < count or not text.endswith(b"\n")
                if is_cut and all(len(line) < _LONGEST_LINE for line in lines):
                    break  # at the end of the file; too long a line is refused below
                decoded = text.decode("utf-8", errors="replace").splitlines()
                try:
                    point = self._table.read(decoded, line_number + 1)
                except ParameterError as impossible:
                    raise OutputError(
                        f"{self._name}, {impossible} Correct or remove the line, or name another "
                        "file."
                    ) from None
                if point is None or is_read[point.index] or self._text(point) != text:
                    raise OutputError(
                        f"Line {line_number + 1} of {self._name} is not a new row of this "
                        f"{self._study_name}; correct or remove it, or name another file."
                    )
                is_read[point.index] = 1
                end, line_number = end + len(text), line_number + count
                self._note_order(point)
                yield point
        try:
            self._file.truncate(end)
        except OSError as error:
            raise self._unwritable(error) from None
        self._file.seek(end)

    def append(self, point: Point) -> None:
        self._note_order(point)
        self._write(self._text(point), keep=self._file.tell())

    def finish(self, lines: Iterable[str]) -> None:
        """Rewrite the complete table in the order of the axes, unless it has this order."""
        try:
            os.fsync(self._file.fileno())
        except OSError as error:
            raise self._unwritable(error) from None
        if not self._is_in_order:
            # Without space for a second file the first one remains, which is complete, too.
            with suppress(OutputError):
                write_whole(self._path, "".join(lines).encode("utf-8"))

    def _text(self, point: Point) -> bytes:
        return self._table.text(point).encode("utf-8")

    def _note_order(self, point: Point) -> None:
        self._is_in_order &= point.index > self._last_index
        self._last_index = point.index

    def _write(self, text: bytes, keep: int) -> None:
        """Write at the end; if that fails, cut the file back to its length before."""
        try:
            remaining = memoryview(text)
            while remaining:
                remaining = remaining[os.write(self._file.fileno(), remaining) :]
            if monotonic() - self._sync_time > _SYNC_SECONDS:
                os.fsync(self._file.fileno())
                self._sync_time = monotonic()
        except OSError as error:
            # If this fails too, the incomplete line is cut off when the study is continued.
            with suppress(OSError):
                self._file.truncate(keep)
            raise self._unwritable(error) from None

    def _unwritable(self, error: OSError) -> OutputError:
        return OutputError(f"{self._name} cannot be written: {error.strerror or error}.")


_BINARY = getattr(os, "O_BINARY", 0)


def _shorten(line: str) -> str:
    text = line.lstrip("# ")
    return text if len(text) <= 60 else f"{text[:57]}..."
