"""Read the directories of a TIFF: the type and number of each entry's values, not the values."""

import os
import struct
from collections.abc import Iterator
from contextlib import suppress
from typing import IO, NamedTuple

STARTS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
"""The first bytes of a TIFF, and of a BigTIFF, in either byte order."""

_MOST_ENTRIES = 65535  # entries of a directory; a BigTIFF may have more, but no file needs them

_DIRECTORY_TAGS = (330, 34665)  # tags of further directories: parts of a picture, and EXIF
_MOST_DIRECTORIES = 16  # further directories; RAW files have up to five
_OFFSETS = {4: "L", 13: "L", 16: "Q", 18: "Q"}  # layouts of the value types that are offsets

_BYTE_TYPES = (1, 2, 6, 7)  # value types that decoders keep as bytes
MOST_NUMBERS = 4_000_000
"""Most numbers in a tag, as many as the highest picture has strips of one line in four planes."""

_NUMBERS = {1: "B", 3: "H", 4: "L", 5: "2L", 8: "h", 9: "l", 10: "2l", 11: "f", 12: "d", 16: "Q"}
"""Layouts of the value types that are numbers."""
_FRACTIONS = (5, 10)

_SAMPLES = (258, 339)  # tags of the bits of each sample, and of their format
_KINDS = {1: "whole numbers", 2: "whole numbers with a sign", 3: "floating point"}


class Field(NamedTuple):
    tag: int
    kind: int
    number: int  # number of values
    content: bytes  # the values, or their offset if they take more bytes
    order: str  # the byte order, as in a format of struct


def directories(file: IO[bytes]) -> Iterator[list[Field]]:
    """Read the first directory of a TIFF, and then those that it refers to, each of them once.

    Their own references are not followed, as they may be circular. Entries beyond the end of the
    file are left out.
    """
    file.seek(0, os.SEEK_SET)
    start = file.read(4)
    order, is_big = "<" if start.startswith(b"II") else ">", b"+" in start
    counter, offset, entry = ("Q", "Q", "HHQ8s") if is_big else ("H", "L", "HHL4s")
    layout = struct.Struct(order + entry)

    def numbers(kind: str, count: int, place: int) -> tuple[int, ...]:
        numbers_layout = struct.Struct(f"{order}{count}{kind}")
        with suppress(struct.error, OSError, OverflowError):  # beyond the end of any file
            file.seek(place, os.SEEK_SET)
            return numbers_layout.unpack(file.read(numbers_layout.size))
        return ()

    def directory(place: int) -> list[Field]:
        count = sum(numbers(counter, 1, place))
        packed = file.read(layout.size * min(count, _MOST_ENTRIES))
        complete = len(packed) // layout.size * layout.size
        entries = layout.iter_unpack(packed[:complete])
        return [Field(tag, kind, number, content, order) for tag, kind, number, content in entries]

    offsets = [*numbers(offset, 1, 8 if is_big else 4)]
    first = directory(*offsets) if offsets else []
    yield first
    for tag, kind, count, content, _ in first:
        if tag not in _DIRECTORY_TAGS or kind not in _OFFSETS:
            continue
        offset_layout, limit = _OFFSETS[kind], min(count, _MOST_DIRECTORIES)
        if count * struct.calcsize(f"={offset_layout}") <= len(content):
            offsets += struct.unpack_from(f"{order}{limit}{offset_layout}", content)
        else:
            offsets += numbers(offset_layout, limit, *struct.unpack(order + offset, content))
        if len(offsets) > _MOST_DIRECTORIES:
            break
    yield from map(directory, list(dict.fromkeys(offsets))[1 : _MOST_DIRECTORIES + 1])


def numbers_of(file: IO[bytes], entry: Field) -> list[float]:
    """Read the numbers of an entry, an empty list if its values are of another type.

    ValueError is raised if they are beyond the end of the file.
    """
    if entry.kind not in _NUMBERS or entry.number > MOST_NUMBERS:
        return []
    layout = struct.Struct(entry.order + _NUMBERS[entry.kind])
    size, content = layout.size * entry.number, entry.content
    if size > len(content):
        offset = "L" if len(content) == 4 else "Q"
        (place,) = struct.unpack(entry.order + offset, content)
        file.seek(place, os.SEEK_SET)
        content = file.read(size)
    if len(content) < size:
        raise ValueError(f"tag {entry.tag} is incomplete")
    numbers = layout.iter_unpack(content[:size])
    if entry.kind in _FRACTIONS:
        return [numerator / (denominator or 1) for numerator, denominator in numbers]
    return [float(*number) for number in numbers]


def has_short_tags(file: IO[bytes]) -> bool:
    """Return whether no tag has more numbers than a decoder can convert within seconds."""
    return all(
        entry.number <= MOST_NUMBERS or entry.kind in _BYTE_TYPES
        for entries in directories(file)
        for entry in entries
    )


def describe_samples(file: IO[bytes]) -> str:
    """Describe the samples of a TIFF's first picture, and what to do, for a sentence."""
    with suppress(ValueError):
        entries = {entry.tag: entry for entry in next(directories(file))}
        tags = {tag: numbers_of(file, entries[tag]) for tag in _SAMPLES if tag in entries}
        bits, kinds = (tags.get(tag) or [1.0] for tag in _SAMPLES)
        kind = _KINDS.get(round(kinds[0]), "another format")
        samples = f"a pixel has {len(bits)} x {bits[0]:g} bits of {kind}"
        return f"{samples}; save it as PNG, or as TIFF of colours of 8 or 16 bits"
    return "its tags are incomplete"
