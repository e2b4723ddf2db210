"""Measure decoders on a public data set: a folder of pictures and a CSV file of their settings.

The layout is that of "Effects of the camera's exposure time on Rolling Shutter based Optical Camera
Communication Links" (figshare 19153166): ``relative_path`` names a picture, ``tclk`` is the length
of a tick in seconds, and ``sampling_ticks``, ``exposure_ticks`` and ``txsymbol_ticks`` are the time
between rows, the exposure and a symbol. It does not contain the data sent. The results therefore
state how well the chips explain a picture, and how many of them are wrong according to their own
likelihoods.
"""

import csv
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from occ_model.errors import PhotoError, one_line, shown
from occ_model.files.reading import read_text
from occ_model.photo.reading.load import load_photo
from occ_model.receiver.decode import decode
from occ_model.scene.scene import Scene

COLUMNS = ("relative_path", "tclk", "sampling_ticks", "exposure_ticks", "txsymbol_ticks")
"""The columns of the table that are used; it may have more."""


@dataclass(frozen=True, slots=True)
class DataSetPicture:
    """A picture of a data set."""

    path: Path
    # Time between rows, exposure time and duration of a symbol, in seconds
    sampling: float
    exposure: float
    symbol: float


@dataclass(frozen=True, slots=True)
class DataSetReading:
    """What a decoder finds in a picture of a data set."""

    picture: DataSetPicture
    decoder: str
    chips: int
    # Correlation of the light predicted from the chips with the signal; None for decoders without a
    # model
    correlation: float | None
    # Fraction of the chips that are wrong according to their own likelihoods; None without any
    wrong_chips: float | None
    failure: str | None  # A sentence on why there are no chips; None if there are


def load_pictures(table: Path) -> tuple[DataSetPicture, ...]:
    """Read the table of a data set; the pictures' paths are relative to its folder."""
    rows = csv.DictReader(read_text(table).splitlines())
    name = one_line(table.name)
    try:
        missing = [column for column in COLUMNS if column not in (rows.fieldnames or ())]
        if missing:
            raise PhotoError(f"{name} has no column {missing[0]}; needed: {', '.join(COLUMNS)}.")
        return tuple(
            _parse_picture(row, table.parent, f"{name}, line {line}")
            for line, row in enumerate(rows, 2)
        )
    except csv.Error as error:  # for example a cell of more than 131,072 characters
        raise PhotoError(f"{name} is not a table: {one_line(str(error))}.") from None


def _parse_picture(row: dict[str, str | None], folder: Path, where: str) -> DataSetPicture:
    path = _parse_path(row[COLUMNS[0]], folder, where)
    tick, *ticks = (_parse_positive(row, name, where) for name in COLUMNS[1:])
    times = [tick * count for count in ticks]
    if not all(0.0 < time < np.inf and 1.0 / time < np.inf for time in times):
        raise PhotoError(
            f"{where}: times of {times} s; allowed: those that are finite "
            "and positive, as their reciprocals must be."
        )
    return DataSetPicture(path, *times)


def _parse_path(text: str | None, folder: Path, where: str) -> Path:
    """Return the file of a picture, which must be in the folder of the data set."""
    if not text:
        raise PhotoError(f"{where}: {COLUMNS[0]} is missing.")
    try:
        path = (folder / text).resolve()
        is_inside = path.is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # an impossible name, or a link to itself
        raise PhotoError(f"{where}: {shown(text)} cannot be the name of a file.") from None
    if not is_inside:
        raise PhotoError(f"{where}: {shown(text)} is outside the folder of the data set.")
    return path


def _parse_positive(row: dict[str, str | None], name: str, where: str) -> float:
    text = row[name]
    try:
        value = float(text or "")
    except ValueError:
        value = 0.0
    if not 0.0 < value < np.inf:
        raise PhotoError(f"{where}: {name} is {shown(text)}; allowed: numbers above 0.")
    return value


def read_pictures(
    pictures: tuple[DataSetPicture, ...],
    decoder_names: tuple[str, ...],
    line_code: str = "manchester",
    progress: Callable[[int, int], object] = lambda _done, _all: None,
) -> Iterator[DataSetReading]:
    for done, picture in enumerate(pictures):
        progress(done, len(pictures))
        image = load_photo(picture.path, "lines").image
        scene = Scene().replace(
            line_code=line_code,
            framing="preamble",
            readout_time=picture.sampling,
            exposure_time=picture.exposure,
            switching_frequency=1.0 / picture.symbol,
            enhancement="none",
            averaging="light",
        )
        for name in decoder_names:
            found = decode(image, scene, name)
            sure = found.chip_likelihoods
            yield DataSetReading(
                picture,
                name,
                int(found.chips.size),
                found.correlation,
                float(np.mean(1.0 - sure)) if sure is not None and sure.size else None,
                None if found.chips.size else found.failure,
            )
    progress(len(pictures), len(pictures))
