"""Take one channel of a decoded picture, in the full depth of its file."""

from collections.abc import Callable
from typing import TypeAlias, cast

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.reading.image_decoding import DecodedPicture, Samples
from occ_model.photo.reading.watched_file import Progress

_Take: TypeAlias = Callable[[Samples], Samples]  # extracts a channel from some pixels

_COLOURS = ("red", "green", "blue")
_GREEN = 1

_NEAR_TIE = 0.5  # difference of means in grey levels that lossy formats cause in grey


def white_of(samples: Samples) -> int:
    """Return the sample value of white."""
    return int(np.iinfo(samples.dtype).max)


def take_channel(picture: DecodedPicture, channel: str, report: Progress) -> tuple[Samples, str]:
    """Take one channel of a picture.

    Where the brightest nearly ties with green, green is taken: a sensor has the most pixels of it.
    The name is ``"grey"`` if the picture has no colours, also where its file has three equal
    channels.
    """
    first = picture.part((0, 0, 1, 1))
    take: _Take = _all_of
    name = "grey"
    if first.ndim == 3:
        means, has_colours = _colours_of(picture, lambda share: report(0.5 * share))
        take, name = _choice(means, has_colours, channel, _NEAR_TIE * white_of(first) / 255)
    samples = np.empty(picture.shape, first.dtype)
    rows = len(samples)
    for left, top, right, bottom in picture.boxes():
        samples[top:bottom, left:right] = take(picture.part((left, top, right, bottom)))
        report(0.5 + 0.5 * bottom / rows)
    return samples, name


def _all_of(pixels: Samples) -> Samples:
    return pixels


def _luma(pixels: Samples) -> Samples:
    return cast("Samples", cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY))


def _choice(means: FloatArray, has_colours: bool, channel: str, near: float) -> tuple[_Take, str]:
    if not has_colours:
        return _only(_GREEN), "grey"
    if channel == "luma":
        return _luma, "luma"
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
