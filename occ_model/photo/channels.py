"""Decode a picture of any kind to samples of one channel, in the full depth of its file."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import Pixels
from occ_model.errors import PhotoError

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage
    from PIL.ImageFile import ImageFile

Samples: TypeAlias = NDArray[np.uint8 | np.uint16]
"""8 bits or 16, white being the largest number."""

CHANNELS = ("brightest", "luma", "red", "green", "blue")
"""What of a coloured photo is taken; ``"brightest"`` is the colour with the largest mean."""

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5
"""A difference of means, in grey levels, that rounding in a lossy format makes of grey."""

_GREY_LEVEL = 257
"""One grey level in samples of 16 bits: 65535 / 255."""

_NATIVE, _SWAPPED = ("16L", "16B") if sys.byteorder == "little" else ("16B", "16L")

_OTHER_BYTE = {
    f"{colours};{order}": f"{colours};{other}"
    for colours in ("RGB", "RGBA", "RGBX")
    for order, other in (("16B", "16L"), ("16L", "16B"), ("16N", _SWAPPED))
}
"""Pillow keeps the upper byte of 16-bit colours; read in the other order it keeps the lower."""


def white_of(samples: Samples) -> int:
    """Give the sample value of white."""
    return int(np.iinfo(samples.dtype).max)


def decode_picture(picture: "ImageFile", reopen: "Callable[[], ImageFile]") -> Samples:
    """Decode a picture, transparent parts being black.

    Parameters
    ----------
    picture
        As opened, not yet decoded.
    reopen
        Opens the same picture once more.

    Returns
    -------
    ndarray of uint8 or uint16, shape (rows, columns) or (rows, columns, 3)
        Grey, or red, green and blue. 16 bits where the file has more than 8; numbers with a
        fraction are grey levels, of which no number and minus infinity are 0.
    """
    raw_modes = _raw_modes(picture)
    _load(picture)
    if picture.mode == "F":
        return _of_grey_levels(np.asarray(picture))
    if picture.mode.startswith("I"):
        return _whole_numbers(picture, raw_modes)
    if len(raw_modes) == 1 and raw_modes <= _OTHER_BYTE.keys():
        return _deep_colours(picture, reopen())
    from PIL import Image

    shown: PillowImage = picture
    if picture.has_transparency_data:
        backed = Image.new("RGBA", picture.size, (0, 0, 0, 255))
        shown = Image.alpha_composite(backed, picture.convert("RGBA"))
    if shown.mode == "LAB":  # of which Pillow makes no other colours
        shown = shown.getchannel("L")
    grey = shown.mode in ("1", "L")
    return np.asarray(shown.convert("L" if grey else "RGB"))


def take_channel(pixels: Samples, channel: str) -> tuple[Samples, str]:
    """Take one channel of a picture.

    Parameters
    ----------
    pixels : ndarray of uint8 or uint16, shape (rows, columns) or (rows, columns, 3)
        Grey, or red, green and blue.
    channel
        One of :data:`CHANNELS`. A near tie of the brightest is green's, of which a sensor has the
        most pixels.

    Returns
    -------
    samples : ndarray of the same type, shape (rows, columns)
    name
        What was taken: ``"red"``, ``"green"``, ``"blue"``, ``"luma"``; ``"grey"`` if the picture
        has no colours, also where its file has three equal channels.
    """
    if pixels.ndim == 2:
        return pixels, "grey"
    means = cv2.mean(pixels)[:3]
    if means[0] == means[1] == means[2] and _has_no_colours(pixels):
        return cast("Samples", cv2.extractChannel(pixels, _GREEN)), "grey"
    if channel == "luma":
        return cast("Samples", cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)), "luma"
    index = int(np.argmax(means)) if channel == "brightest" else _COLOURS.index(channel)
    near = _NEAR_TIE * white_of(pixels) / 255
    if channel == "brightest" and means[index] - means[_GREEN] <= near:
        index = _GREEN
    return cast("Samples", cv2.extractChannel(pixels, index)), _COLOURS[index]


def _has_no_colours(pixels: Samples) -> bool:
    green = pixels[..., _GREEN]
    return all(np.array_equal(pixels[..., other], green) for other in (0, 2))


def _raw_modes(picture: "ImageFile") -> set[str]:
    """Give how the samples lie in the file, in Pillow's words."""
    arguments = [tile[3] for tile in picture.tile]
    firsts = [given[0] if isinstance(given, tuple) and given else given for given in arguments]
    return {first for first in firsts if isinstance(first, str)}


def _whole_numbers(picture: "ImageFile", raw_modes: set[str]) -> Samples:
    """Give whole numbers, of 16 bits however dark the picture, as samples."""
    values = np.asarray(picture)
    if values.dtype.itemsize > 2:
        if values.max() > 65535:
            raise PhotoError(
                f"The photo has samples up to {values.max():,}; allowed: up to 65,535."
            )
        values = np.maximum(values, 0)
    samples = values.astype(np.uint16)
    if raw_modes == {"I;12"}:  # white is 4095
        samples = ((samples.astype(np.uint32) * 65535 + 2047) // 4095).astype(np.uint16)
    transparent = picture.info.get("transparency")
    if isinstance(transparent, int):
        samples[samples == transparent] = 0
    return samples


def _of_grey_levels(levels: Pixels) -> Samples:
    within = np.nan_to_num(np.clip(levels, 0.0, 255.0), nan=0.0)
    return np.rint(within * _GREY_LEVEL).astype(np.uint16)


def _deep_colours(upper: "ImageFile", lower: "ImageFile") -> Samples:
    """Put colours of 16 bits together from their upper and their lower bytes.

    OpenCV reads such files in one go, but writes what it thinks of a damaged one to stderr, and
    knows no limit of ours; two readings by Pillow are worth that.

    Parameters
    ----------
    upper
        Decoded.
    lower
        The same, not yet decoded.
    """
    _take_lower_bytes(lower)
    _load(lower)
    pixels = np.asarray(upper).astype(np.uint16)
    pixels <<= 8
    pixels |= np.asarray(lower)
    transparent = upper.info.get("transparency")
    if isinstance(transparent, tuple) and pixels.shape[2] == 3:
        pixels[(pixels == np.array(transparent)).all(axis=2)] = 0
    if pixels.shape[2] == 4:
        alpha = pixels[..., 3:].astype(np.uint32)
        pixels[..., :3] = (pixels[..., :3] * alpha + 32767) // 65535
    return np.ascontiguousarray(pixels[..., :3])


def _take_lower_bytes(picture: "ImageFile") -> None:
    for place, tile in enumerate(picture.tile):
        raw, *more = tile[3] if isinstance(tile[3], tuple) else (tile[3],)
        other = _OTHER_BYTE[raw]
        arguments = (other, *more) if isinstance(tile[3], tuple) else other
        picture.tile[place] = tile._replace(args=arguments)


def _load(picture: "ImageFile") -> None:
    """Decode a picture in silence."""
    if picture.format == "TIFF":
        with _no_stderr():
            picture.load()
    else:
        picture.load()


@contextmanager
def _no_stderr() -> Iterator[None]:
    """Let nobody write to stderr: libtiff prints each oddity of a file there, and asks nobody."""
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
