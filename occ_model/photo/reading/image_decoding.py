"""Decode a picture in its file's full depth, convert it part by part, and extract one channel."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, cast

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.pixel_arrays import Samples, find_white, round_to_16_bits, white_of
from occ_model.errors import DecodeInputError, PhotoError
from occ_model.photo.reading.limits import is_deep_in_colours, raw_modes_of
from occ_model.photo.reading.watched_file import Progress

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage
    from PIL.ImageFile import ImageFile

Box: TypeAlias = tuple[int, int, int, int]
"""A rectangle of a picture: its first column and row, and the column and row after its last."""

DECODED_FRACTION = 0.8  # fraction of the work that is done when a picture is decoded

_PART = 1 << 20  # number of pixels that are converted at once, which take some megabytes

_NATIVE, _SWAPPED = ("16L", "16B") if sys.byteorder == "little" else ("16B", "16L")

_LOWER_BYTE_MODES = {
    f"{colours};{order}": f"{colours};{other}"
    for colours in ("RGB", "RGBA", "RGBX")
    for order, other in (("16B", "16L"), ("16L", "16B"), ("16N", _SWAPPED))
}
"""Raw modes of the other byte order. Pillow keeps the upper bytes of 16-bit colours; in the other
order these are the lower bytes."""

_Take: TypeAlias = Callable[[Samples], Samples]  # extracts a channel from some pixels

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5  # difference of the channels' means, in grey levels, that lossy formats cause


class DecodedPicture:
    """A decoded picture, whose colours are converted part by part to limit the memory.

    ``open_picture`` opens the file's picture without decoding it; its arguments are the fractions
    of the work between which it will be decoded.
    """

    def __init__(self, open_picture: "Callable[[float, float], ImageFile]") -> None:
        self.picture = open_picture(0.0, DECODED_FRACTION / 2)
        self._raw_modes = raw_modes_of(self.picture)
        _load(self.picture)
        self._lower: ImageFile | None = None
        if is_deep_in_colours(self._raw_modes):
            # Pillow reads such files twice. OpenCV would read them once, but prints errors on
            # stderr, reports no progress and cannot be cancelled.
            self._lower = open_picture(DECODED_FRACTION / 2, DECODED_FRACTION)
            _take_lower_bytes(self._lower)
            _load(self._lower)
        elif self.picture.mode == "I":
            _, largest = self.picture.getextrema()
            if isinstance(largest, int | float) and largest > 65535:
                raise PhotoError(f"The photo has samples up to {largest:,}; allowed: up to 65,535.")
        self._white = self._white_of_floats() if self.picture.mode == "F" else 0.0
        self._palette = _palette_of(self.picture) if self.picture.mode == "P" else None

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
        if the file has more than 8. In floating point, NaN and minus infinity are black, and
        infinity is white.
        """
        part = self.picture.crop(box)
        if self._palette is not None:
            return np.asarray(self._palette[np.asarray(part)])
        if self._lower is not None:
            return deep_colours(part, self._lower.crop(box))
        if part.mode == "F":
            return round_to_16_bits(np.asarray(part), self._white)
        if part.mode.startswith("I"):
            return _convert_integers(part, self._raw_modes)
        return _colours(part)

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


def _palette_of(picture: "PillowImage") -> Samples:
    swatch = picture.crop((0, 0, 256, 1))
    swatch.frombytes(bytes(range(256)))
    colours: Samples = _colours(swatch)[0]
    return colours


def _colours(part: "PillowImage") -> Samples:
    """Convert pixels of 8 bits, and put transparent ones on black."""
    from PIL import Image

    visible = part
    if part.has_transparency_data:
        visible = part.convert("RGBA")
        if visible.getchannel("A").getextrema() != (255, 255):
            background = Image.new("RGBA", part.size, (0, 0, 0, 255))
            visible = Image.alpha_composite(background, visible)
    if visible.mode == "LAB":  # Pillow does not convert it to RGB
        visible = visible.getchannel("L")
    grey = visible.mode in ("1", "L")
    return np.asarray(visible.convert("L" if grey else "RGB"))


def _convert_integers(part: "PillowImage", raw_modes: set[str]) -> Samples:
    """Convert integers to samples of 16 bits, without scaling to the picture's brightness."""
    values = np.asarray(part)
    if values.dtype.itemsize > 2:
        values = np.maximum(values, 0)
    samples = values.astype(np.uint16)
    if raw_modes == {"I;12"}:  # white is 4095
        samples = ((samples.astype(np.uint32) * 65535 + 2047) // 4095).astype(np.uint16)
    transparent = part.info.get("transparency")
    if isinstance(transparent, int):
        samples[samples == transparent] = 0
    return samples


def deep_colours(upper: "PillowImage", lower: "PillowImage") -> Samples:
    """Combine colours of 16 bits from their upper and their lower bytes."""
    pixels = np.asarray(upper).astype(np.uint16)
    pixels <<= 8
    pixels |= np.asarray(lower)
    transparent = upper.info.get("transparency")
    if isinstance(transparent, tuple) and pixels.shape[2] == 3:
        pixels[(pixels == np.array(transparent)).all(axis=2)] = 0
    if pixels.shape[2] == 4 and pixels[..., 3].min() < 65535:
        # Divide by 65535 and round, by shifts, as a division would take longer than all else.
        products = pixels[..., :3].astype(np.uint32)
        products *= pixels[..., 3:]
        products += 32768
        products += products >> 16
        products >>= 16
        return products.astype(np.uint16)
    return np.ascontiguousarray(pixels[..., :3])


def _take_lower_bytes(picture: "ImageFile") -> None:
    for place, tile in enumerate(picture.tile):
        raw, *others = tile[3] if isinstance(tile[3], tuple) else (tile[3],)
        other = _LOWER_BYTE_MODES[raw]
        arguments = (other, *others) if isinstance(tile[3], tuple) else other
        picture.tile[place] = tile._replace(args=arguments)


def _load(picture: "ImageFile") -> None:
    """Decode a picture without output of libtiff on stderr."""
    if picture.format == "TIFF":
        with no_stderr():
            picture.load()
    else:
        picture.load()


@contextmanager
def no_stderr() -> Iterator[None]:
    """Redirect stderr to the null device: libtiff and LibRaw print their warnings there."""
    try:
        copy = os.dup(2)
    except OSError:  # a program without a console has none
        yield
        return
    try:
        with Path(os.devnull).open("wb") as null_device:
            os.dup2(null_device.fileno(), 2)
        yield
    finally:
        os.dup2(copy, 2)
        os.close(copy)


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
