"""Read a camera's RAW file: the light in its green photosites, line by line of the sensor.

The black level is taken off, and the white level is the largest sample. What is darker than black
is 0. LibRaw, by way of rawpy, decodes the files.

Under a Bayer filter every line of the sensor, and every column, has a green photosite in each pair
of neighbours. So the picture is made of these alone: each stands for itself and for its neighbour
of another colour in the same line. No value is interpolated between lines, which were exposed at
different times, and a line of the picture is a line of the sensor: its readout time is that of the
sensor, not of a plane of half the lines.
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
from occ_model.photo.reading.image_decoding import DECODED_FRACTION, no_stderr
from occ_model.photo.reading.limits import check_bytes, check_file_size, check_size
from occ_model.photo.reading.tiff import STARTS, Entry, are_short, directories
from occ_model.photo.reading.watched_file import Reporter, WatchedFile

if TYPE_CHECKING:
    from rawpy import RawPy

_BYTES_A_PIXEL = 8  # samples and those taken of them, while converted and turned

_OTHERS = (b"IIRO", b"IIRS", b"MMOR", b"IIU\0", b"FUJIFILMCCD-RAW", b"FOVb")
"""The first bytes of RAW files of Olympus, Panasonic, Fujifilm and Sigma."""

_CR3 = b"ftypcrx "  # bytes 4 to 11 of Canon's newer files

_PHOTOMETRIC, _DNG_VERSION = 262, 50706
_SENSOR_SAMPLES = (32803, 34892)  # TIFF/EP's and DNG's: a colour filter array, linear samples

_GREEN = b"G"[0]
_ANY = "brightest"
_NO_COLOUR = 6  # LibRaw's colour of a sensor without filters

_ORIENTATIONS = {0: 1, 1: 2, 2: 4, 3: 3, 4: 5, 5: 8, 6: 6, 7: 7}
"""The EXIF orientation for LibRaw's flip: bit 0 mirrors columns, bit 1 rows, bit 2 transposes."""

WHITE_SAMPLE = 65535  # the sample value of the sensor's white level


@dataclass(frozen=True, eq=False, slots=True)
class Mosaic:
    """The photosites of a sensor, as they are stored."""

    photosites: NDArray[np.uint16]  # shape (lines, columns); their values as the camera wrote them
    # Shape (2, 2); which photosites of a square of four are taken; all of them where there are no
    # colours.
    is_green: NDArray[np.bool_]
    # The black and the white level of each photosite of a square, shape (2, 2, 2).
    levels: NDArray[np.float64]
    # notes, orientation: the camera's notes, and the EXIF orientation that the photosites still
    # have.
    notes: CameraNotes
    orientation: int

    @property
    def channel(self) -> str:
        return "grey" if self.is_green.all() else "green"

    def one_plane(self) -> Samples:
        """Return one green photosite of each square of four, shape (lines / 2, columns / 2)."""
        row, column = np.argwhere(self.is_green)[0].tolist()
        return np.ascontiguousarray(self.photosites[row::2, column::2])

    def samples(self, along_lines: bool) -> Samples:
        """Return the light as a picture, shape (lines, columns), in proportion; 65535 is white.

        ``along_lines``: whether photosites of a line are of one time, else those of a column. A
        photosite of another colour has the value of its green neighbour of the same time.
        """
        photosites, is_green, levels = self.photosites, self.is_green, self.levels
        if not along_lines:
            photosites, is_green, levels = photosites.T, is_green.T, levels.transpose(0, 2, 1)
        picture = np.empty(photosites.shape, np.uint16, order="C" if along_lines else "F")
        for row, column in np.ndindex(2, 2):
            to = picture[row::2, column::2]
            taken = column if is_green[row, column] else 1 - column
            light = _light_of(*levels[:, row, taken].tolist())
            found = light[photosites[row::2, taken::2]]
            width = min(to.shape[1], found.shape[1])
            to[:, :width] = found[:, :width]
            # The last of an odd number has its green neighbour on the other side.
            to[:, width:] = found[:, -1:]
        return picture if along_lines else picture.T


def is_raw(file: IO[bytes]) -> bool:
    """Whether a file is a camera's RAW file, by its first bytes and, of a TIFF, by its tags."""
    file.seek(0, os.SEEK_SET)
    start = file.read(16)
    if start.startswith(_OTHERS) or start[4:12] == _CR3:
        return True
    if not start.startswith(STARTS):
        return False
    order: Literal["little", "big"] = "little" if start.startswith(b"II") else "big"
    entries = chain.from_iterable(directories(file))
    return start[8:10] == b"CR" or any(_is_of_a_sensor(one, order) for one in entries)


def _is_of_a_sensor(entry: Entry, order: Literal["little", "big"]) -> bool:
    # A number of 16 bits stands first in the four bytes.
    value = int.from_bytes(entry.content[:2], order)
    return entry.tag == _DNG_VERSION or (entry.tag == _PHOTOMETRIC and value in _SENSOR_SAMPLES)


def read_mosaic(
    path: Path, file: WatchedFile, channel: str, max_pixels: int, report: Reporter
) -> Mosaic:
    """Read the photosites of a RAW file.

    ``channel``: ``"green"`` or ``"brightest"``: the others have photosites in every second line
    only.
    """
    shown = one_line(str(path))
    try:
        import rawpy
    except ImportError:
        raise PhotoError(
            f"{shown} is a camera's RAW file; to read it: pip install occ-explorer[raw]."
        ) from None
    if channel not in (_ANY, "green"):
        raise PhotoError(
            f"{shown} is a camera's RAW file, which is read in green only: red and blue are in "
            f"every second line of the sensor. The channel {channel} was asked for; allowed: green "
            f"or {_ANY}."
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
            return _mosaic(shown, raw, notes)
    except (rawpy.LibRawError, rawpy.NotSupportedError) as error:
        if report.ended_by is not None:
            raise report.ended_by from None
        raise PhotoError(
            f"{shown} cannot be read: the file is damaged or of an unknown kind ({_words(error)})."
        ) from None


def _mosaic(shown: str, raw: "RawPy", tags: dict[int, Any]) -> Mosaic:
    photosites = raw.raw_image_visible if raw.raw_type.name == "Flat" else None
    pattern = raw.raw_pattern if photosites is not None else None
    if photosites is None or pattern is None or photosites.dtype != np.uint16:
        raise PhotoError(
            f"{shown} cannot be read: it holds no photosites of one sensor, but colours that were "
            "interpolated already; allowed: a Bayer pattern, or a sensor without colours."
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
            f"{shown} cannot be read: its sensor's colours are in another pattern; allowed: a "
            "Bayer pattern, or a sensor without colours."
        )
    levels = np.array([[_levels(shown, raw, int(c)) for c in line] for line in colours])
    other = raw.other
    found = {EXPOSURE_TIME: other.shutter_speed, F_NUMBER: other.aperture, ISO: other.iso_speed}
    return Mosaic(
        photosites=photosites.copy(),
        is_green=is_green,
        levels=levels.transpose(2, 0, 1),
        notes=notes_of(found | tags),
        orientation=_ORIENTATIONS.get(sizes.flip, 1),
    )


def _levels(shown: str, raw: "RawPy", colour: int) -> tuple[float, float]:
    black = float(raw.black_level_per_channel[colour])
    white = float(raw.white_level)
    noted = raw.camera_white_level_per_channel
    if noted is not None and 0 < noted[colour] < white:
        white = float(noted[colour])
    if not 0.0 <= black < white <= WHITE_SAMPLE:
        raise PhotoError(
            f"{shown} cannot be read: the file is damaged (it says that black is {black:g} and "
            f"white {white:g})."
        )
    return black, white


def _tags_of(file: IO[bytes]) -> dict[int, Any]:
    """Read the EXIF tags of a RAW file that is a TIFF; none of another one."""
    from PIL import Image

    tags: dict[int, Any] = {}
    with suppress(Exception):
        if not are_short(file):
            return tags
        file.seek(0, os.SEEK_SET)
        exif = Image.Exif()
        exif.load_from_fp(file)
        tags = dict(exif)
        tags |= exif.get_ifd(EXIF_IFD)
    return tags


def _words(error: Exception) -> str:
    """Return LibRaw's message, which rawpy passes on as bytes."""
    text = error.args[0] if error.args else type(error).__name__
    if isinstance(text, bytes):
        text = text.decode("utf-8", errors="replace")
    return one_line(str(text), 120)


def _light_of(black: float, white: float) -> NDArray[np.uint16]:
    """Return the sample of every value that a photosite can have, shape (65536,)."""
    fraction = np.clip((np.arange(65536) - black) / (white - black), 0.0, 1.0)
    light: NDArray[np.uint16] = np.rint(fraction * WHITE_SAMPLE).astype(np.uint16)
    return light
