"""Read the directories of a TIFF: what each entry states of its values, not the values."""

import os
import struct
from collections.abc import Iterator
from contextlib import suppress
from typing import IO, NamedTuple

STARTS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
"""The first bytes of a TIFF, and of a BigTIFF, in either byte order."""

_MOST_ENTRIES = 65535  # of a directory: a BigTIFF may state more, which no file needs

_NAMES_DIRECTORIES = (330, 34665)  # tags of further directories: parts of a picture, and EXIF
_MOST_NAMED = 16  # directories; RAW files have up to five
_OFFSETS = {4: "L", 13: "L", 16: "Q", 18: "Q"}  # kinds of values that are offsets: their layouts

_KEPT_AS_BYTES = (1, 2, 6, 7)  # kinds of values of which no number is made
MOST_NUMBERS = 4_000_000
"""Numbers by a tag: the places of strips of one line in four planes, of the longest picture."""


class Entry(NamedTuple):
    tag: int
    kind: int
    number: int  # of values
    content: bytes  # the values, or their offset where they take more bytes


def directories(file: IO[bytes]) -> Iterator[list[Entry]]:
    """Read the first directory of a TIFF, and then those that it names, each of them once.

    What these name in turn is not read: they may name each other. Of what the file is too short for
    nothing is returned, but for the whole entries that are there.
    """
    file.seek(0, os.SEEK_SET)
    start = file.read(4)
    order, is_big = "<" if start.startswith(b"II") else ">", b"+" in start
    counter, offset, entry = ("Q", "Q", "HHQ8s") if is_big else ("H", "L", "HHL4s")
    layout = struct.Struct(order + entry)

    def numbers(kind: str, count: int, place: int) -> tuple[int, ...]:
        of_all = struct.Struct(f"{order}{count}{kind}")
        with suppress(struct.error, OSError, OverflowError):  # beyond the end of any file
            file.seek(place, os.SEEK_SET)
            return of_all.unpack(file.read(of_all.size))
        return ()

    def directory(place: int) -> list[Entry]:
        count = sum(numbers(counter, 1, place))
        content = file.read(layout.size * min(count, _MOST_ENTRIES))
        whole = len(content) // layout.size * layout.size
        return [Entry(*values) for values in layout.iter_unpack(content[:whole])]

    named = [*numbers(offset, 1, 8 if is_big else 4)]
    first = directory(*named) if named else []
    yield first
    for tag, kind, count, content in first:
        if tag not in _NAMES_DIRECTORIES or kind not in _OFFSETS:
            continue
        number, most = _OFFSETS[kind], min(count, _MOST_NAMED)
        if count * struct.calcsize(f"={number}") <= len(content):
            named += struct.unpack_from(f"{order}{most}{number}", content)
        else:
            named += numbers(number, most, *struct.unpack(order + offset, content))
        if len(named) > _MOST_NAMED:
            break
    yield from map(directory, list(dict.fromkeys(named))[1 : _MOST_NAMED + 1])


def are_short(file: IO[bytes]) -> bool:
    """Whether no tag has more numbers than a decoder makes objects of within seconds."""
    return all(
        entry.number <= MOST_NUMBERS or entry.kind in _KEPT_AS_BYTES
        for entries in directories(file)
        for entry in entries
    )
