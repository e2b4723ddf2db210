"""Read what a DNG notes of its sensor and LibRaw leaves out: the black level of each line.

DNG Specification 1.7.1, chapter 4: the black level is that of a pattern repeated over the active
area, plus a number for each line and one for each column.
"""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import IO, Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.reading.tiff import STARTS, Field, directories, numbers_of

_COMPRESSION, _PHOTOMETRIC, _VERSION = 259, 262, 50706
_REPEAT, _LEVELS, _OF_COLUMNS, _OF_LINES, _AREA = 50713, 50714, 50715, 50716, 50829
_JPEG_XL = 52546
_READ = {_COMPRESSION, _REPEAT, _LEVELS, _OF_COLUMNS, _OF_LINES, _AREA}
_SENSOR_SAMPLES = ([32803], [34892])  # TIFF/EP's and DNG's: a colour filter array, linear samples


@dataclass(frozen=True, eq=False, slots=True)
class BlackLevel:
    """The black level of a sensor's photosites, a sum of three."""

    repeated: FloatArray  # Shape (lines, columns) of a pattern that is repeated over the sensor
    of_lines: FloatArray  # Shape (lines of the sensor,)
    of_columns: FloatArray  # Shape (columns of the sensor,)

    @property
    def transposed(self) -> Self:
        return type(self)(self.repeated.T, self.of_columns, self.of_lines)

    def at(self, lines: NDArray[np.intp], columns: NDArray[np.intp]) -> FloatArray:
        """Return the black level of some lines and columns, shape (lines, columns)."""
        height, width = self.repeated.shape
        repeated = self.repeated[np.ix_(lines % height, columns % width)]
        return repeated + self.of_lines[lines, None] + self.of_columns[columns]

    @property
    def is_of_squares(self) -> bool:
        """Whether it is the same for all photosites of one place in a square of four."""
        is_added = self.of_lines.any() or self.of_columns.any()
        return not is_added and all(2 % count == 0 for count in self.repeated.shape)

    @property
    def largest(self) -> float:
        height, width = self.repeated.shape
        lines = [self.of_lines[first::height].max(initial=-np.inf) for first in range(height)]
        columns = [self.of_columns[first::width].max(initial=-np.inf) for first in range(width)]
        return float((self.repeated + np.array(lines)[:, None] + columns).max())


def has_sensor_samples(file: IO[bytes]) -> bool:
    """Return whether a TIFF is a DNG, or has samples of a sensor in a directory."""
    return any(
        entry.tag == _VERSION or _is_of_sensor(file, entry)
        for entries in directories(file)
        for entry in entries
    )


def _is_of_sensor(file: IO[bytes], entry: Field) -> bool:
    return entry.tag == _PHOTOMETRIC and numbers_of(file, entry)[:1] in _SENSOR_SAMPLES


def is_jpeg_xl(file: IO[bytes]) -> bool:
    """Return whether a sensor's samples are compressed as JPEG XL, which LibRaw does not decode."""
    return any(tags.get(_COMPRESSION) == [_JPEG_XL] for tags in _tags_of_sensor(file))


def black_of_lines(
    file: IO[bytes], shape: tuple[int, int], margins: tuple[int, int]
) -> BlackLevel | None:
    """Return the black level of a DNG that notes it by lines or columns; None for others.

    ``shape``: lines and columns that are read; ``margins``: those above and left of them.
    """
    for tags in _tags_of_sensor(file):
        if not tags.keys().isdisjoint({_REPEAT, _OF_COLUMNS, _OF_LINES}):
            return _black_level(tags, shape, margins)
    return None


def _tags_of_sensor(file: IO[bytes]) -> Iterator[dict[int, list[float]]]:
    """Read the numbers of tags in each directory of a TIFF that has samples of a sensor."""
    file.seek(0, os.SEEK_SET)
    if not file.read(4).startswith(STARTS):
        return
    for entries in list(directories(file)):
        if any(_is_of_sensor(file, entry) for entry in entries):
            yield {entry.tag: numbers_of(file, entry) for entry in entries if entry.tag in _READ}


def _black_level(
    tags: dict[int, list[float]], shape: tuple[int, int], margins: tuple[int, int]
) -> BlackLevel:
    area = tags.get(_AREA, [0.0, 0.0])
    first = [margin - int(start) for margin, start in zip(margins, area[:2], strict=True)]
    repeat = [int(number) for number in tags.get(_REPEAT, [1.0, 1.0])]
    levels = np.array(tags.get(_LEVELS, [0.0])[: repeat[0] * repeat[1]])
    repeated = np.roll(np.reshape(levels, repeat), [-first[0], -first[1]], axis=(0, 1))
    added = []
    for tag, begin, count in zip((_OF_LINES, _OF_COLUMNS), first, shape, strict=True):
        numbers = np.array(tags.get(tag, [0.0]))
        places = np.clip(np.arange(begin, begin + count), 0, len(numbers) - 1)
        if len(numbers) > 1 and begin + count > len(numbers):
            raise ValueError(f"tag {tag} has too few numbers")
        added.append(numbers[places])
    return BlackLevel(repeated, *added)
