"""Decode a picture in its file's full depth, convert it part by part, and extract one channel."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, TypeAlias, cast

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.pixel_arrays import Samples, find_white, white_of
from occ_model.errors import DecodeInputError, PhotoError
from occ_model.photo.reading.conversion import (
    colours_of,
    convert_floats,
    convert_integers,
    palette_of,
    put_on_black,
)
from occ_model.photo.reading.deep import Opened, Stored, decode_deep, is_reduced
from occ_model.photo.reading.exif import orientation_of
from occ_model.photo.reading.levels import full_range, is_white_zero, levels_of, raw_modes_of
from occ_model.photo.reading.stderr import no_stderr
from occ_model.photo.reading.watched_file import Progress

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

Box: TypeAlias = tuple[int, int, int, int]
"""A rectangle of a picture: its first column and row, and the column and row after its last."""

DECODED_FRACTION = 0.8  # fraction of the work that is done when a picture is decoded

_PART = 1 << 20  # number of pixels that are converted at once, which take some megabytes

_Take: TypeAlias = Callable[[Samples], Samples]  # extracts a channel from some pixels
_Convert: TypeAlias = Callable[[Box], Samples]  # converts a part of a picture

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5  # difference of the channels' means, in grey levels, that lossy formats cause


class DecodedPicture:
    """A decoded picture, whose colours are converted part by part to limit the memory."""

    def __init__(self, opened: Opened) -> None:
        self.picture = opened.picture
        raw_modes = raw_modes_of(opened.picture)
        if is_reduced(opened.picture, opened.bits):
            stored = decode_deep(opened)
            self.shape = stored.values.shape[:2]
            self.orientation = 1 if stored.is_upright else orientation_of(opened.picture)
            self._convert = _converter_of(stored)
        else:
            _load(opened.picture)
            self.shape = opened.picture.height, opened.picture.width
            self.orientation = orientation_of(opened.picture)
            self._convert = self._convert_pillows(raw_modes, opened.bits)

    def _convert_pillows(self, raw_modes: set[str], bits: int) -> _Convert:
        """Return the function that converts a part of what Pillow has decoded."""
        picture = self.picture
        if picture.mode == "P":
            palette = palette_of(picture)
            return lambda box: np.asarray(palette[np.asarray(picture.crop(box))])
        if picture.mode == "F":
            white, is_inverted = self._white_of_floats(), is_white_zero(picture)
            return lambda box: convert_floats(np.asarray(picture.crop(box)), white, is_inverted)
        if picture.mode == "I":
            _, largest = picture.getextrema()
            if isinstance(largest, int | float) and largest > 65535:
                raise PhotoError(f"The photo has samples up to {largest:,}; allowed: up to 65,535.")
        levels = levels_of(picture, raw_modes, bits)
        if picture.mode.startswith("I"):
            return lambda box: convert_integers(picture.crop(box), levels)
        return lambda box: colours_of(picture.crop(box), levels)

    def boxes(self) -> Iterator[Box]:
        """Yield rectangles that cover the picture, from top to bottom."""
        rows, columns = self.shape
        width = min(columns, _PART)
        height = max(_PART // width, 1)
        for top in range(0, rows, height):
            for left in range(0, columns, width):
                yield left, top, min(left + width, columns), min(top + height, rows)

    def part(self, box: Box) -> Samples:
        """Convert a rectangle of the picture to samples, with transparent parts black.

        The shape is (rows, columns) for grey, (rows, columns, 3) for colours. Samples have 16 bits
        if the file has more than 8. In floating point, NaN is black, and an infinite number black
        or white.
        """
        return self._convert(box)

    def _white_of_floats(self) -> float:
        """Return the value of white, by the range of the finite values."""
        low, high = np.inf, -np.inf
        for box in self.boxes():
            values = np.asarray(self.picture.crop(box))
            values = values[np.isfinite(values)]
            low = min(low, float(values.min(initial=np.inf)))
            high = max(high, float(values.max(initial=-np.inf)))
        try:
            return find_white(low, high, "The photo") if low <= high else 1.0
        except DecodeInputError as error:
            raise PhotoError(str(error)) from None

    def close(self) -> None:
        """Free the decoded picture, even while this object, or an error, is referenced."""
        self.picture.close()
        del self._convert


def _converter_of(stored: Stored) -> _Convert:
    """Return the function that converts a part of samples as they are stored."""
    table = None if stored.levels == full_range(16) else stored.levels.tabulate(65535)

    def convert(box: Box) -> Samples:
        left, top, right, bottom = box
        part = stored.part(slice(top, bottom), slice(left, right))
        return put_on_black(part if table is None else table[part])

    return convert


def _load(picture: "ImageFile") -> None:
    """Decode a picture without output of libtiff on stderr."""
    if picture.format == "TIFF":
        with no_stderr():
            picture.load()
    else:
        picture.load()


def take_channel(
    picture: DecodedPicture, channel: str | None, report: Progress
) -> tuple[Samples, str]:
    """Take one channel of a picture, or for None all that it has, and free the picture.

    If green is nearly as bright as the brightest, green is taken, as a sensor has the most pixels
    of it. The name is ``"grey"`` if the picture has no colours, even if its file has three equal
    channels; all three of them are ``"colours"``, shape (rows, columns, 3).
    """
    try:
        first = picture.part((0, 0, 1, 1))
        take: _Take = lambda pixels: pixels  # noqa: E731 - for what is taken whole
        name = "grey"
        if first.ndim == 3:
            means, has_colours = _average_colours(picture, lambda fraction: report(0.5 * fraction))
            tie = _NEAR_TIE * white_of(first) / 255
            if channel is None and has_colours:
                name = "colours"
            else:
                take, name = _choose_channel(means, has_colours, channel or "", tie)
        samples = np.empty((*picture.shape, *take(first).shape[2:]), first.dtype)
        rows = len(samples)
        for left, top, right, bottom in picture.boxes():
            samples[top:bottom, left:right] = take(picture.part((left, top, right, bottom)))
            report(0.5 + 0.5 * bottom / rows)
    finally:
        picture.close()
    return samples, name


def _choose_channel(
    means: FloatArray, has_colours: bool, channel: str, tie: float
) -> tuple[_Take, str]:
    if not has_colours:
        return _extract(_GREEN), "grey"
    if channel == "luma":
        return lambda pixels: cast("Samples", cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)), "luma"
    index = int(np.argmax(means)) if channel == "brightest" else _COLOURS.index(channel)
    if channel == "brightest" and means[index] - means[_GREEN] <= tie:
        index = _GREEN
    return _extract(index), _COLOURS[index]


def _extract(index: int) -> _Take:
    return lambda pixels: cast("Samples", cv2.extractChannel(pixels, index))


def _average_colours(picture: DecodedPicture, report: Progress) -> tuple[FloatArray, bool]:
    """Return the channels' means, and whether any pixel has a colour."""
    rows, columns = picture.shape
    sums, has_colours = np.zeros(3), False
    for left, top, right, bottom in picture.boxes():
        pixels = picture.part((left, top, right, bottom))
        mean = np.array(cv2.mean(pixels)[:3])
        sums += mean * (pixels.shape[0] * pixels.shape[1])
        # The pixels are compared only if all means are equal, which is rare in colour photos.
        has_colours = has_colours or mean.min() < mean.max() or not _has_no_colours(pixels)
        report(bottom / rows)
    return sums / (rows * columns), has_colours


def _has_no_colours(pixels: Samples) -> bool:
    green = pixels[..., _GREEN]
    return all(np.array_equal(pixels[..., other], green) for other in (0, 2))
