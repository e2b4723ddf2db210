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
    combine_bytes,
    convert_floats,
    convert_integers,
    palette_of,
    put_on_black,
    swap_bytes,
)
from occ_model.photo.reading.deep import Opened, decode_deep, needs_own_decoder
from occ_model.photo.reading.levels import is_white_zero, levels_of
from occ_model.photo.reading.limits import is_deep_in_colours, raw_modes_of
from occ_model.photo.reading.stderr import no_stderr
from occ_model.photo.reading.watched_file import Progress

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

Box: TypeAlias = tuple[int, int, int, int]
"""A rectangle of a picture: its first column and row, and the column and row after its last."""

DECODED_FRACTION = 0.8  # fraction of the work that is done when a picture is decoded

_PART = 1 << 20  # number of pixels that are converted at once, which take some megabytes

_GREY_AND_OPACITY = {"LA;16B"}  # the raw mode of a PNG of 16 bits

_Take: TypeAlias = Callable[[Samples], Samples]  # extracts a channel from some pixels
_Convert: TypeAlias = Callable[[Box], Samples]  # converts a part of a picture

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5  # difference of the channels' means, in grey levels, that lossy formats cause


class DecodedPicture:
    """A decoded picture, whose colours are converted part by part to limit the memory.

    ``open_picture`` opens the file's picture without decoding it; its arguments are the fractions
    of the work between which it will be decoded.
    """

    def __init__(self, open_picture: Callable[[float, float], Opened]) -> None:
        opened = open_picture(0.0, DECODED_FRACTION / 2)
        self.picture, raw_modes = opened.picture, raw_modes_of(opened.picture)
        self._lower: ImageFile | None = None
        if needs_own_decoder(self.picture, opened.bits):
            self._convert = _convert_stored(opened)
            return
        if raw_modes == _GREY_AND_OPACITY:
            # In the file these are four bytes, as a pixel of four channels has in memory.
            _change_raw_modes(self.picture, lambda _: "RGBA")
        _load(self.picture)
        if is_deep_in_colours(raw_modes):
            # Pillow reads such files twice. OpenCV would read them once, but prints errors on
            # stderr, reports no progress and cannot be cancelled.
            self._lower = open_picture(DECODED_FRACTION / 2, DECODED_FRACTION).picture
            _change_raw_modes(self._lower, swap_bytes)
            _load(self._lower)
        self._convert = self._converter(raw_modes, opened.bits)

    def _converter(self, raw_modes: set[str], bits: int) -> _Convert:
        """Return the function that converts a part of what Pillow has decoded."""
        picture, lower = self.picture, self._lower
        if lower is not None:
            return lambda box: combine_bytes(picture.crop(box), lower.crop(box))
        if raw_modes == _GREY_AND_OPACITY:
            return lambda box: put_on_black(np.asarray(picture.crop(box)).view(">u2"))
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

    @property
    def shape(self) -> tuple[int, int]:
        return self.picture.height, self.picture.width

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
        """Free the decoded picture, even while this object is referenced."""
        self.picture.close()
        if self._lower is not None:
            self._lower.close()
        del self._convert


def _convert_stored(opened: Opened) -> _Convert:
    """Decode what Pillow would reduce to 8 bits, and return the function that converts a part."""
    values, levels = decode_deep(opened)
    table = levels.tabulate(65535)

    def convert(box: Box) -> Samples:
        left, top, right, bottom = box
        return put_on_black(table[values[top:bottom, left:right]])

    return convert


def _change_raw_modes(picture: "ImageFile", change: Callable[[str], str]) -> None:
    for place, tile in enumerate(picture.tile):
        raw, *others = tile[3] if isinstance(tile[3], tuple) else (tile[3],)
        arguments = (change(raw), *others) if isinstance(tile[3], tuple) else change(raw)
        picture.tile[place] = tile._replace(args=arguments)


def _load(picture: "ImageFile") -> None:
    """Decode a picture without output of libtiff on stderr."""
    if picture.format == "TIFF":
        with no_stderr():
            picture.load()
    else:
        picture.load()


def take_channel(picture: DecodedPicture, channel: str, report: Progress) -> tuple[Samples, str]:
    """Take one channel of a picture.

    If green is nearly as bright as the brightest, green is taken, as a sensor has the most pixels
    of it. The name is ``"grey"`` if the picture has no colours, even if its file has three equal
    channels.
    """
    first = picture.part((0, 0, 1, 1))
    take: _Take = lambda pixels: pixels  # noqa: E731 - for pictures of a single channel
    name = "grey"
    if first.ndim == 3:
        means, has_colours = _average_colours(picture, lambda fraction: report(0.5 * fraction))
        take, name = _choose_channel(means, has_colours, channel, _NEAR_TIE * white_of(first) / 255)
    samples = np.empty(picture.shape, first.dtype)
    rows = len(samples)
    for left, top, right, bottom in picture.boxes():
        samples[top:bottom, left:right] = take(picture.part((left, top, right, bottom)))
        report(0.5 + 0.5 * bottom / rows)
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
