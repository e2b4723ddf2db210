"""Read the user's files: whole, of a bounded size, and only regular files."""

import errno
import io
import os
import stat
from pathlib import Path

from occ_model.errors import SceneFileError, one_line

LARGEST_TEXT = 1_000_000  # bytes allowed in a scene, preset or lesson; ours have a few thousand

MOST_READS = 1_000_000  # of a file by its decoder; one in Python takes some seconds for them
MOST_BYTES_ONE_BY_ONE = 4_000_000  # of a file that a decoder may read byte by byte, as that of QOI

_NO_FILE = "it is a device, pipe or socket"

# Flags that a system lacks it does not need: Windows has no pipes among its files.
_FLAGS = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_NOCTTY", 0)
    | getattr(os, "O_BINARY", 0)
)


def read_bytes(path: Path, largest: int) -> bytes:
    """Read a regular file of at most so many bytes.

    A pipe is not waited for and a device is not read: the kind checked is that of the open file,
    not of whatever has the name by then.
    """
    content = read_start(path, largest + 1)
    if len(content) > largest:
        raise _unreadable(path, f"it has more than {largest:,} bytes")
    return content


def read_start(path: Path, count: int) -> bytes:
    """Read the first bytes of a regular file, as :func:`read_bytes` does a whole one."""
    try:
        descriptor = os.open(path, _FLAGS)
    except OSError as error:
        raise _failed(path, error) from None
    except ValueError as error:  # a name that no file can have
        raise _unreadable(path, reason_of(error)) from None
    try:
        _check_kind(path, os.fstat(descriptor).st_mode)
        chunks, left = [], count
        # A file may hold more, or less, than its size says.
        while left > 0 and (chunk := os.read(descriptor, left)):
            chunks.append(chunk)
            left -= len(chunk)
    except OSError as error:
        raise _failed(path, error) from None
    finally:
        os.close(descriptor)
    return b"".join(chunks)


def read_text(path: Path, largest: int = LARGEST_TEXT) -> str:
    """Read a regular file of text in UTF-8, without the byte order mark that some editors write."""
    try:
        return read_bytes(path, largest).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise _unreadable(path, "it is not text in UTF-8") from None


class BoundedFile(io.BufferedReader):
    """A file whose decoder goes from part to part as the file says, but not for ever.

    Whatever blocks, chunks, segments or directories a file states, each step is a read. One too
    many raises SceneFileError, and so does every later one, should a decoder suppress the first.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path.open("rb", buffering=0))
        self._path, self._reads = path, 0
        size = os.fstat(self.fileno()).st_size
        self._most = max(size if size <= MOST_BYTES_ONE_BY_ONE else 0, MOST_READS)

    def read(self, size: int | None = -1, /) -> bytes:
        self._reads += 1
        if self._reads > self._most:
            raise _unreadable(self._path, f"it is in more than {self._most:,} parts")
        return super().read(size)


def _check_kind(path: Path, mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise _unreadable(path, "it is a folder")
    if not stat.S_ISREG(mode):
        raise _unreadable(path, _NO_FILE)


def _failed(path: Path, error: OSError) -> SceneFileError:
    if error.errno == errno.ENXIO:  # a socket, or a device that is not there
        return _unreadable(path, _NO_FILE)
    return _unreadable(path, reason_of(error))


def reason_of(error: OSError | ValueError) -> str:
    """Explain why a path cannot be opened; Python refuses impossible names by ValueError."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return "no file can have this name"


def _unreadable(path: Path, reason: str) -> SceneFileError:
    return SceneFileError(f"{one_line(str(path))} cannot be read: {one_line(reason)}.")
