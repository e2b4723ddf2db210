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
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL.ExifTags import IFD, Base

from occ_model.arrays import BoolArray, IndexArray
from occ_model.camera.pixel_arrays import Samples
from occ_model.errors import PhotoError, one_line
from occ_model.photo.reading.dng import (
    BlackLevel,
    black_of_lines,
    has_sensor_samples,
    is_jpeg_xl,
)
from occ_model.photo.reading.exif import CameraNotes, notes_of
from occ_model.photo.reading.image_decoding import DECODED_FRACTION
from occ_model.photo.reading.levels import Levels
from occ_model.photo.reading.limits import check_bytes, check_file_size, check_size
from occ_model.photo.reading.stderr import no_stderr
from occ_model.photo.reading.tiff import STARTS, has_short_tags
from occ_model.photo.reading.watched_file import Reporter, WatchedFile

if TYPE_CHECKING:
    from rawpy import RawPy

_BYTES_A_PIXEL = 8  # bytes of the photosites and the samples while they are converted and turned

_RAW_STARTS = (b"IIRO", b"IIRS", b"MMOR", b"IIU\0", b"FUJIFILMCCD-RAW", b"FOVb")
"""The first bytes of RAW files of Olympus, Panasonic, Fujifilm and Sigma."""

_CR3 = b"ftypcrx "  # bytes 4 to 11 of Canon's newer files

_ANY = "brightest"
MOSAIC = "mosaic"  # all photosites, of a sensor with colours
_NO_COLOUR = 6  # LibRaw's colour number for a sensor without filters

_ORIENTATIONS = {0: 1, 1: 2, 2: 4, 3: 3, 4: 5, 5: 8, 6: 6, 7: 7}
"""The EXIF orientation for LibRaw's flip: bit 0 mirrors columns, bit 1 rows, bit 2 transposes."""

_LINES_AT_ONCE = 128  # lines whose light is computed at once

WHITE_SAMPLE = 65535  # the sample value of the sensor's white level


@dataclass(frozen=True, eq=False, slots=True)
class Mosaic:
    """The photosites of a sensor, as they are stored."""

    photosites: NDArray[np.uint16]  # Values as stored by the camera, shape (lines, columns)
    # Whether each photosite of a square of four is green, shape (2, 2); all of them without colours
    is_green: NDArray[np.bool_]
    black: BlackLevel
    white: float  # The white level of the photosites that are read
    notes: CameraNotes
    orientation: int  # The EXIF orientation, which is not applied to the photosites
    pattern: str = ""  # Filters of the first two photosites of the first two lines, such as rggb

    @property
    def channel(self) -> str:
        return "grey" if self.is_green.all() else "green"

    def all_photosites(self) -> Samples:
        """Return the light of every photosite in its place; 65535 is the green ones' white."""
        picture = np.empty(self.photosites.shape, np.uint16)
        for row, column in np.ndindex(2, 2):
            picture[row::2, column::2] = self._light(row, column)
        return picture

    def one_plane(self) -> Samples:
        """Return the light of one green photosite of each square of four."""
        row, column = np.argwhere(self.is_green)[0].tolist()
        return self._light(row, column)

    def samples(self, along_lines: bool) -> Samples:
        """Return the light as a linear picture, shape (lines, columns); 65535 is white.

        ``along_lines``: whether the photosites of a line are exposed at the same time, else those
        of a column. A photosite of another colour gets the value of its green neighbour of the same
        time.
        """
        if not along_lines:
            transposed = replace(
                self,
                photosites=self.photosites.T,
                is_green=self.is_green.T,
                black=self.black.transposed,
            )
            return transposed.samples(along_lines=True).T
        picture = np.empty(self.photosites.shape, np.uint16)
        for row, column in np.ndindex(2, 2):
            target = picture[row::2, column::2]
            light = self._light(row, column if self.is_green[row, column] else 1 - column)
            width = min(target.shape[1], light.shape[1])
            target[:, :width] = light[:, :width]
            # In an odd number of columns, the last one's green neighbour is on the other side.
            target[:, width:] = light[:, -1:]
        return picture

    def _light(self, row: int, column: int) -> Samples:
        """Return the light of a photosite of each square of four."""
        values = self.photosites[row::2, column::2]
        height, width = self.photosites.shape
        lines, columns = np.arange(row, height, 2), np.arange(column, width, 2)
        # All lines are amplified alike, so the largest black level tells the range of all.
        span = self.white - self.black.largest
        if self.black.is_of_squares:
            level = self.black.at(np.array([row]), np.array([column])).item()
            return Levels(level, level + span).tabulate(WHITE_SAMPLE)[values]
        light = np.empty(values.shape, np.uint16)
        for first in range(0, len(values), _LINES_AT_ONCE):
            part = slice(first, first + _LINES_AT_ONCE)
            fraction = (values[part] - self.black.at(lines[part], columns)) / span
            light[part] = np.rint(np.clip(fraction, 0.0, 1.0) * WHITE_SAMPLE)
        return light


def is_raw(file: IO[bytes]) -> bool:
    """Return whether a file is a camera's RAW file, by its first bytes or, for TIFF, its tags."""
    file.seek(0, os.SEEK_SET)
    start = file.read(16)
    if start.startswith(_RAW_STARTS) or start[4:12] == _CR3:
        return True
    return start.startswith(STARTS) and (start[8:10] == b"CR" or has_sensor_samples(file))


def read_mosaic(
    path: Path, file: WatchedFile, channel: str, max_pixels: int, report: Reporter
) -> Mosaic:
    """Read the photosites of a RAW file.

    ``channel``: ``"green"`` or ``"brightest"``, as the others have photosites only in every second
    line; or MOSAIC for the photosites of all three.
    """
    name = one_line(str(path))
    try:
        import rawpy
    except ImportError:
        raise PhotoError(
            f"{name} is a camera's RAW file; to read it: pip install occ-explorer[raw]."
        ) from None
    if channel not in (_ANY, "green", MOSAIC):
        raise PhotoError(
            f"{name} is a camera's RAW file, which is read in green only: red and blue are in "
            f"every second line of the sensor. The channel is {channel}; allowed: green or {_ANY}."
        )
    size = os.fstat(file.fileno()).st_size
    check_file_size(path, "RAW", size)
    if is_jpeg_xl(file):
        raise PhotoError(
            f"{name} cannot be read: its samples are compressed as JPEG XL; allowed: DNG without "
            "compression or with that of JPEG."
        )
    tags = _tags_of(file)
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
            mosaic = _make_mosaic(name, file, raw, tags)
    except (rawpy.LibRawError, rawpy.NotSupportedError) as error:
        if report.ended_by is not None:
            raise report.ended_by from None
        raise PhotoError(
            f"{name} cannot be read: the file is damaged or of an unknown kind "
            f"({_message_of(error)})."
        ) from None
    if channel == MOSAIC and not mosaic.pattern:
        raise PhotoError(f"{name} has no three colours: it is of a sensor without filters.")
    return mosaic


def _make_mosaic(name: str, file: IO[bytes], raw: "RawPy", tags: dict[int, Any]) -> Mosaic:
    photosites = raw.raw_image_visible if raw.raw_type.name == "Flat" else None
    pattern = raw.raw_pattern if photosites is not None else None
    if photosites is None or pattern is None or photosites.dtype != np.uint16:
        raise PhotoError(
            f"{name} cannot be read: it contains interpolated colours instead of a sensor's "
            "photosites; allowed: a Bayer pattern, or a sensor without colours."
        )
    sizes = raw.sizes
    colours, is_green, letters = _colours_of(name, raw, pattern.shape)
    white = min(_white_level(raw, colour) for colour in set(colours[is_green].tolist()))
    black = black_of_lines(file, photosites.shape, (sizes.top_margin, sizes.left_margin))
    if black is None:
        levels = np.array(raw.black_level_per_channel, np.float64)[colours]
        black = BlackLevel(levels, *(np.zeros(count) for count in photosites.shape))
    if not 0.0 <= black.largest < white <= WHITE_SAMPLE:
        raise PhotoError(
            f"{name} cannot be read: the file is damaged (it states that black is "
            f"{black.largest:g} and white {white:g})."
        )
    metadata = raw.other
    tags_of_metadata = {
        Base.ExposureTime: metadata.shutter_speed,
        Base.FNumber: metadata.aperture,
        Base.ISOSpeedRatings: metadata.iso_speed,
    }
    return Mosaic(
        photosites=photosites.copy(),
        is_green=is_green,
        black=black,
        white=white,
        notes=notes_of(tags_of_metadata | tags),
        orientation=_ORIENTATIONS.get(sizes.flip, 1),
        pattern=letters if sorted(letters) == ["b", "g", "g", "r"] else "",
    )


def _colours_of(
    name: str, raw: "RawPy", shape: tuple[int, ...]
) -> tuple[IndexArray, BoolArray, str]:
    """Return LibRaw's colours of 2 x 2 photosites, which of them are green, and their letters."""
    top, left = raw.sizes.top_margin, raw.sizes.left_margin
    colours = np.array(
        [[raw.raw_color(top + row, left + column) for column in (0, 1)] for row in (0, 1)]
    )
    if shape == (1, 1) or (shape == (2, 2) and (colours == _NO_COLOUR).all()):
        return np.zeros((2, 2), np.int64), np.ones((2, 2), np.bool_), ""
    letters = "".join(chr(raw.color_desc[colour]) for colour in colours.ravel()).lower()
    is_green = np.array([letter == "g" for letter in letters]).reshape(2, 2)
    is_bayer = is_green.sum() == 2 and is_green[0, 0] == is_green[1, 1]
    if shape != (2, 2) or not (is_bayer or is_green.all()):
        raise PhotoError(
            f"{name} cannot be read: its sensor's colours are in another pattern; allowed: a "
            "Bayer pattern, or a sensor without colours."
        )
    return colours, is_green, letters


def _white_level(raw: "RawPy", colour: int) -> float:
    white = float(raw.white_level)
    noted = raw.camera_white_level_per_channel
    return float(noted[colour]) if noted is not None and 0 < noted[colour] < white else white


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
        tags |= exif.get_ifd(IFD.Exif)
    return tags


def _message_of(error: Exception) -> str:
    """Return LibRaw's message, which rawpy gives as bytes."""
    text = error.args[0] if error.args else type(error).__name__
    if isinstance(text, bytes):
        text = text.decode("utf-8", errors="replace")
    return one_line(str(text), 120)
