"""Read a camera's RAW file: the light in its green photosites, line by line of the sensor.

The black level is subtracted, and the white level becomes the largest sample. Values below black
become 0. LibRaw decodes the files, through rawpy.

Under a Bayer filter, each pair of neighbours in a line or column of the sensor has a green
photosite. The picture is made of these alone: each gives its value to itself and to its neighbour
of another colour in the same line. No value is interpolated between lines, which were exposed at
different times. A line of the picture is thus a line of the sensor with the sensor's readout time,
unlike in a plane of half the lines.
"""

import os
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from occ_model.camera.pixel_arrays import Samples
from occ_model.errors import PhotoError, one_line
from occ_model.photo.reading.exif import (
    EXIF_IFD,
    EXPOSURE_TIME,
    F_NUMBER,
    ISO,
    CameraNotes,
    notes_of,
)
from occ_model.photo.reading.image_decoding import DECODED_FRACTION
from occ_model.photo.reading.limits import check_bytes, check_file_size, check_size
from occ_model.photo.reading.stderr import no_stderr
from occ_model.photo.reading.tiff import STARTS, Entry, directories, has_short_tags
from occ_model.photo.reading.watched_file import Reporter, WatchedFile

if TYPE_CHECKING:
    from rawpy import RawPy

_BYTES_A_PIXEL = 8  # bytes of the photosites and the samples while they are converted and turned

_RAW_STARTS = (b"IIRO", b"IIRS", b"MMOR", b"IIU\0", b"FUJIFILMCCD-RAW", b"FOVb")
"""The first bytes of RAW files of Olympus, Panasonic, Fujifilm and Sigma."""

_CR3 = b"ftypcrx "  # bytes 4 to 11 of Canon's newer files

_PHOTOMETRIC, _DNG_VERSION = 262, 50706
_SENSOR_SAMPLES = (32803, 34892)  # TIFF/EP's and DNG's: a colour filter array, linear samples

_GREEN = b"G"[0]
_ANY = "brightest"
_NO_COLOUR = 6  # LibRaw's colour number for a sensor without filters

_ORIENTATIONS = {0: 1, 1: 2, 2: 4, 3: 3, 4: 5, 5: 8, 6: 6, 7: 7}
"""The EXIF orientation for LibRaw's flip: bit 0 mirrors columns, bit 1 rows, bit 2 transposes."""

WHITE_SAMPLE = 65535  # the sample value of the sensor's white level


@dataclass(frozen=True, eq=False, slots=True)
class Mosaic:
    """The photosites of a sensor, as they are stored."""

    photosites: NDArray[np.uint16]  # Values as stored by the camera, shape (lines, columns)
    # Whether each photosite of a square of four is green, shape (2, 2); all of them without colours
    is_green: NDArray[np.bool_]
    # The black and the white level of each photosite of a square, shape (2, 2, 2)
    levels: NDArray[np.float64]
    notes: CameraNotes
    orientation: int  # The EXIF orientation, which is not applied to the photosites

    @property
    def channel(self) -> str:
        return "grey" if self.is_green.all() else "green"

    def one_plane(self) -> Samples:
        """Return one green photosite of each square of four, shape (lines / 2, columns / 2)."""
        row, column = np.argwhere(self.is_green)[0].tolist()
        return np.ascontiguousarray(self.photosites[row::2, column::2])

    def samples(self, along_lines: bool) -> Samples:
        """Return the light as a linear picture, shape (lines, columns); 65535 is white.

        ``along_lines``: whether the photosites of a line are exposed at the same time, else those
        of a column. A photosite of another colour gets the value of its green neighbour of the same
        time.
        """
        photosites, is_green, levels = self.photosites, self.is_green, self.levels
        if not along_lines:
            photosites, is_green, levels = photosites.T, is_green.T, levels.transpose(0, 2, 1)
        picture = np.empty(photosites.shape, np.uint16, order="C" if along_lines else "F")
        for row, column in np.ndindex(2, 2):
            target = picture[row::2, column::2]
            green_column = column if is_green[row, column] else 1 - column
            light = _tabulate_light(*levels[:, row, green_column].tolist())
            values = light[photosites[row::2, green_column::2]]
            width = min(target.shape[1], values.shape[1])
            target[:, :width] = values[:, :width]
            # In an odd number of columns, the last one's green neighbour is on the other side.
            target[:, width:] = values[:, -1:]
        return picture if along_lines else picture.T


def is_raw(file: IO[bytes]) -> bool:
    """Return whether a file is a camera's RAW file, by its first bytes or, for TIFF, its tags."""
    file.seek(0, os.SEEK_SET)
    start = file.read(16)
    if start.startswith(_RAW_STARTS) or start[4:12] == _CR3:
        return True
    if not start.startswith(STARTS):
        return False
    order: Literal["little", "big"] = "little" if start.startswith(b"II") else "big"
    entries = chain.from_iterable(directories(file))
    return start[8:10] == b"CR" or any(_is_of_a_sensor(entry, order) for entry in entries)


def _is_of_a_sensor(entry: Entry, order: Literal["little", "big"]) -> bool:
    # A number of 16 bits is in the first two of the four bytes.
    value = int.from_bytes(entry.content[:2], order)
    return entry.tag == _DNG_VERSION or (entry.tag == _PHOTOMETRIC and value in _SENSOR_SAMPLES)


def read_mosaic(
    path: Path, file: WatchedFile, channel: str, max_pixels: int, report: Reporter
) -> Mosaic:
    """Read the photosites of a RAW file.

    ``channel``: ``"green"`` or ``"brightest"``, as the others have photosites only in every second
    line.
    """
    name = one_line(str(path))
    try:
        import rawpy
    except ImportError:
        raise PhotoError(
            f"{name} is a camera's RAW file; to read it: pip install occ-explorer[raw]."
        ) from None
    if channel not in (_ANY, "green"):
        raise PhotoError(
            f"{name} is a camera's RAW file, which is read in green only: red and blue are in "
            f"every second line of the sensor. The channel is {channel}; allowed: green or {_ANY}."
        )
    size = os.fstat(file.fileno()).st_size
    check_file_size(path, "RAW", size)
    notes = _tags_of(file)
    file.seek(0, os.SEEK_SET)
    file.watch(size, 0.0, 0.5 * DECODED_FRACTION)
    try:
        with rawpy.RawPy() as raw, no_stderr():
            raw.open_buffer(file)
            width, height = raw.sizes.raw_width, raw.sizes.raw_height
            check_size(path, width, height, max_pixels)
            check_bytes(path, width, height, _BYTES_A_PIXEL * width * height, size)
            raw.unpack()
            report(DECODED_FRACTION)
            return _make_mosaic(name, raw, notes)
    except (rawpy.LibRawError, rawpy.NotSupportedError) as error:
        if report.ended_by is not None:
            raise report.ended_by from None
        raise PhotoError(
            f"{name} cannot be read: the file is damaged or of an unknown kind "
            f"({_message_of(error)})."
        ) from None


def _make_mosaic(name: str, raw: "RawPy", tags: dict[int, Any]) -> Mosaic:
    photosites = raw.raw_image_visible if raw.raw_type.name == "Flat" else None
    pattern = raw.raw_pattern if photosites is not None else None
    if photosites is None or pattern is None or photosites.dtype != np.uint16:
        raise PhotoError(
            f"{name} cannot be read: it contains interpolated colours instead of a sensor's "
            "photosites; allowed: a Bayer pattern, or a sensor without colours."
        )
    sizes = raw.sizes
    colours = np.array(
        [
            [raw.raw_color(sizes.top_margin + row, sizes.left_margin + column) for column in (0, 1)]
            for row in (0, 1)
        ]
    )
    if pattern.shape == (1, 1) or (colours == _NO_COLOUR).all():
        is_green, colours = np.ones((2, 2), np.bool_), np.zeros((2, 2), np.int64)
    else:
        is_green = np.array([[raw.color_desc[c] == _GREEN for c in line] for line in colours])
    if pattern.shape not in ((1, 1), (2, 2)) or not (
        is_green.all() or (is_green.sum() == 2 and is_green[0, 0] == is_green[1, 1])
    ):
        raise PhotoError(
            f"{name} cannot be read: its sensor's colours are in another pattern; allowed: a "
            "Bayer pattern, or a sensor without colours."
        )
    levels = np.array([[_levels(name, raw, int(c)) for c in line] for line in colours])
    metadata = raw.other
    tags_of_metadata = {
        EXPOSURE_TIME: metadata.shutter_speed,
        F_NUMBER: metadata.aperture,
        ISO: metadata.iso_speed,
    }
    return Mosaic(
        photosites=photosites.copy(),
        is_green=is_green,
        levels=levels.transpose(2, 0, 1),
        notes=notes_of(tags_of_metadata | tags),
        orientation=_ORIENTATIONS.get(sizes.flip, 1),
    )


def _levels(name: str, raw: "RawPy", colour: int) -> tuple[float, float]:
    black = float(raw.black_level_per_channel[colour])
    white = float(raw.white_level)
    noted = raw.camera_white_level_per_channel
    if noted is not None and 0 < noted[colour] < white:
        white = float(noted[colour])
    if not 0.0 <= black < white <= WHITE_SAMPLE:
        raise PhotoError(
            f"{name} cannot be read: the file is damaged (it states that black is {black:g} and "
            f"white {white:g})."
        )
    return black, white


def _tags_of(file: IO[bytes]) -> dict[int, Any]:
    """Read the EXIF tags of a RAW file if it is a TIFF; others have none."""
    from PIL import Image

    tags: dict[int, Any] = {}
    with suppress(Exception):
        if not has_short_tags(file):
            return tags
        file.seek(0, os.SEEK_SET)
        exif = Image.Exif()
        exif.load_from_fp(file)
        tags = dict(exif)
        tags |= exif.get_ifd(EXIF_IFD)
    return tags


def _message_of(error: Exception) -> str:
    """Return LibRaw's message, which rawpy gives as bytes."""
    text = error.args[0] if error.args else type(error).__name__
    if isinstance(text, bytes):
        text = text.decode("utf-8", errors="replace")
    return one_line(str(text), 120)


def _tabulate_light(black: float, white: float) -> NDArray[np.uint16]:
    """Return the sample for every possible value of a photosite, shape (65536,)."""
    fraction = np.clip((np.arange(65536) - black) / (white - black), 0.0, 1.0)
    light: NDArray[np.uint16] = np.rint(fraction * WHITE_SAMPLE).astype(np.uint16)
    return light
