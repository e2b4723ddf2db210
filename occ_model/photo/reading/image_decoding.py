"""Decode a picture in the full depth of its file, convert it part by part, and take one channel."""

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

_PART = 1 << 20  # number of pixels that are converted at once: some megabytes

_NATIVE, _SWAPPED = ("16L", "16B") if sys.byteorder == "little" else ("16B", "16L")

_OTHER_BYTE = {
    f"{colours};{order}": f"{colours};{other}"
    for colours in ("RGB", "RGBA", "RGBX")
    for order, other in (("16B", "16L"), ("16L", "16B"), ("16N", _SWAPPED))
}
"""Pillow keeps the upper byte of 16-bit colours; read in the other byte order it keeps the
lower."""

_Take: TypeAlias = Callable[[Samples], Samples]  # extracts a channel from some pixels

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5  # difference of means in grey levels that lossy formats cause in grey


class DecodedPicture:
    """A decoded picture, whose colours are converted part by part to bound the memory.

    ``opened``: function that opens the file's picture, not yet decoded; its arguments are the
    fractions of the work between which it will be decoded.
    """

    def __init__(self, opened: "Callable[[float, float], ImageFile]") -> None:
        self.picture = opened(0.0, DECODED_FRACTION / 2)
        self._raw_modes = raw_modes_of(self.picture)
        _load(self.picture)
        self._lower: ImageFile | None = None
        if is_deep_in_colours(self._raw_modes):
            # OpenCV reads such files in one go, but prints the errors of damaged ones on stderr,
            # reports no progress and cannot be cancelled: Pillow reads them twice instead.
            self._lower = opened(DECODED_FRACTION / 2, DECODED_FRACTION)
            _take_lower_bytes(self._lower)
            _load(self._lower)
        elif self.picture.mode == "I":
            _, most = self.picture.getextrema()
            if isinstance(most, int | float) and most > 65535:
                raise PhotoError(f"The photo has samples up to {most:,}; allowed: up to 65,535.")
        self._white = self._white_of_floats() if self.picture.mode == "F" else 0.0
        self._palette = _palette_of(self.picture) if self.picture.mode == "P" else None

    @property
    def shape(self) -> tuple[int, int]:
        return self.picture.height, self.picture.width

    def boxes(self) -> Iterator[Box]:
        """Return rectangles that cover the picture, from top to bottom."""
        rows, columns = self.shape
        across = min(columns, _PART)
        down = max(_PART // across, 1)
        for top in range(0, rows, down):
            for left in range(0, columns, across):
                yield left, top, min(left + across, columns), min(top + down, rows)

    def part(self, box: Box) -> Samples:
        """Convert a rectangle of the picture to samples, transparent parts being black.

        Shape (rows, columns), grey, or red, green and blue. 16 bits where the file has more than 8.
        Of floating point NaN and minus infinity are black, and infinity is white.
        """
        part = self.picture.crop(box)
        if self._palette is not None:
            return np.asarray(self._palette[np.asarray(part)])
        if self._lower is not None:
            return deep_colours(part, self._lower.crop(box))
        if part.mode == "F":
            return round_to_16_bits(np.asarray(part), self._white)
        if part.mode.startswith("I"):
            return _whole_numbers(part, self._raw_modes)
        return _colours(part)

    def _white_of_floats(self) -> float:
        """Return which value of all that are finite is white."""
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
    """Convert pixels of 8 bits, on black where they are transparent."""
    from PIL import Image

    shown = part
    if part.has_transparency_data:
        shown = part.convert("RGBA")
        if shown.getchannel("A").getextrema() != (255, 255):
            backed = Image.new("RGBA", part.size, (0, 0, 0, 255))
            shown = Image.alpha_composite(backed, shown)
    if shown.mode == "LAB":  # which Pillow does not convert to RGB
        shown = shown.getchannel("L")
    grey = shown.mode in ("1", "L")
    return np.asarray(shown.convert("L" if grey else "RGB"))


def _whole_numbers(part: "PillowImage", raw_modes: set[str]) -> Samples:
    """Convert whole numbers to samples of 16 bits, however dark the picture."""
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
        # Divided by 65535 and rounded, without the division, which takes longer than all else.
        seen = pixels[..., :3].astype(np.uint32)
        seen *= pixels[..., 3:]
        seen += 32768
        seen += seen >> 16
        seen >>= 16
        return seen.astype(np.uint16)
    return np.ascontiguousarray(pixels[..., :3])


def _take_lower_bytes(picture: "ImageFile") -> None:
    for place, tile in enumerate(picture.tile):
        raw, *more = tile[3] if isinstance(tile[3], tuple) else (tile[3],)
        other = _OTHER_BYTE[raw]
        arguments = (other, *more) if isinstance(tile[3], tuple) else other
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
        kept = os.dup(2)
    except OSError:  # a program without a console has none
        yield
        return
    try:
        with Path(os.devnull).open("wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def take_channel(picture: DecodedPicture, channel: str, report: Progress) -> tuple[Samples, str]:
    """Take one channel of a picture.

    Where the brightest nearly ties with green, green is taken: a sensor has the most pixels of it.
    The name is ``"grey"`` if the picture has no colours, also where its file has three equal
    channels.
    """
    first = picture.part((0, 0, 1, 1))
    take: _Take = lambda pixels: pixels  # noqa: E731 - a channel may be all there is
    name = "grey"
    if first.ndim == 3:
        means, has_colours = _colours_of(picture, lambda fraction: report(0.5 * fraction))
        take, name = _choice(means, has_colours, channel, _NEAR_TIE * white_of(first) / 255)
    samples = np.empty(picture.shape, first.dtype)
    rows = len(samples)
    for left, top, right, bottom in picture.boxes():
        samples[top:bottom, left:right] = take(picture.part((left, top, right, bottom)))
        report(0.5 + 0.5 * bottom / rows)
    return samples, name


def _choice(means: FloatArray, has_colours: bool, channel: str, near: float) -> tuple[_Take, str]:
    if not has_colours:
        return _only(_GREEN), "grey"
    if channel == "luma":
        return lambda pixels: cast("Samples", cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)), "luma"
    index = int(np.argmax(means)) if channel == "brightest" else _COLOURS.index(channel)
    if channel == "brightest" and means[index] - means[_GREEN] <= near:
        index = _GREEN
    return _only(index), _COLOURS[index]


def _only(index: int) -> _Take:
    return lambda pixels: cast("Samples", cv2.extractChannel(pixels, index))


def _colours_of(picture: DecodedPicture, report: Progress) -> tuple[FloatArray, bool]:
    rows, columns = picture.shape
    sums, has_colours = np.zeros(3), False
    for left, top, right, bottom in picture.boxes():
        pixels = picture.part((left, top, right, bottom))
        mean = np.array(cv2.mean(pixels)[:3])
        sums += mean * (pixels.shape[0] * pixels.shape[1])
        # The pixels are compared only where all means are equal, which is rare in colours.
        has_colours = has_colours or mean.min() < mean.max() or not _has_no_colours(pixels)
        report(bottom / rows)
    return sums / (rows * columns), has_colours


def _has_no_colours(pixels: Samples) -> bool:
    green = pixels[..., _GREEN]
    return all(np.array_equal(pixels[..., other], green) for other in (0, 2))
