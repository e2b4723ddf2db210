"""Decode colours of more than 8 bits in formats of which Pillow keeps 8 bits.

Pillow has no pictures of several channels of more than 8 bits. It reduces HEIC, AVIF, JPEG 2000 and
PPM to 8 bits, by which the white of JPEG 2000 becomes black. Here they are decoded by libheif,
OpenCV and NumPy as they are stored.
"""

import io
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.errors import PhotoError
from occ_model.photo.reading.levels import (
    Levels,
    full_range,
    grey_levels,
    limited_range,
    white_of_ppm,
)
from occ_model.photo.reading.stderr import no_stderr

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

_LUMA_AND_CHROMA = re.compile(rb"colr\x01..\0\0\0\x12", re.DOTALL)
"""JPEG 2000's colour space of video, which OpenCV converts as if they had 16 bits."""

_COMMENT = re.compile(rb"#[^\r\n]*")


class Opened(NamedTuple):
    """A file's picture that is opened and not decoded."""

    name: str  # the file's path as text
    picture: "ImageFile"
    bits: int  # of the samples of JPEG 2000, AVIF, HEIC and PPM
    content: bytes | bytearray  # all of the file if it needs a decoder of its own, else nothing


class Stored(NamedTuple):
    """Samples as they are stored.

    The shape of ``values`` is (rows, columns), or (rows, columns, channels) with 2 channels for
    grey and opacity, 3 for red, green and blue, and 4 for these and opacity.
    """

    values: NDArray[np.uint8 | np.uint16]
    levels: Levels


def needs_own_decoder(picture: "ImageFile", bits: int) -> bool:
    """Return whether Pillow would reduce a picture of so many bits to 8."""
    is_grey_jpeg_2000 = picture.format == "JPEG2000" and picture.mode == "I;16"
    return bits > 8 and not is_grey_jpeg_2000


def decode_deep(opened: Opened) -> Stored:
    """Decode a file as it is stored; of AVIF without colours its picture is decoded, too."""
    name, picture, bits, content = opened
    if picture.format == "HEIF":
        return _decode_heif(picture, bits, content)
    if picture.format == "PPM":
        return _decode_ppm(picture, content)
    values = None
    if picture.format != "JPEG2000" or _LUMA_AND_CHROMA.search(content) is None:
        with no_stderr():
            values = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    if values is None or values.shape[:2] != (picture.height, picture.width):
        raise PhotoError(
            f"{name} cannot be read: it is damaged, or its {bits} bits are stored in an unusual "
            "way; allowed above 8 bits: grey, or red, green and blue, as positive numbers."
        )
    return _stored_by_opencv(picture, bits, np.asarray(values))


def _stored_by_opencv(
    picture: "ImageFile", bits: int, values: NDArray[np.uint8 | np.uint16]
) -> Stored:
    bits = 8 if values.dtype == np.uint8 else bits
    if values.ndim == 3:  # blue, green, red
        values = values[..., ::-1] if values.shape[2] == 3 else values[..., [2, 1, 0, 3]]
        return Stored(values, full_range(bits))
    if picture.format != "AVIF":
        return Stored(values, full_range(bits))
    # OpenCV keeps the luma as it is stored, and Pillow converts its range.
    picture.load()
    seen = np.asarray(picture.convert("L"))

    def error(levels: Levels) -> float:
        return cv2.norm(levels.tabulate(255).astype(np.uint8)[values], seen, cv2.NORM_L1)

    return Stored(values, min(full_range(bits), limited_range(bits), key=error))


def _decode_heif(picture: "ImageFile", bits: int, content: bytes | bytearray) -> Stored:
    from pillow_heif import HeifFile

    open_heif: Callable[..., Any] = HeifFile  # which declares no types
    file = open_heif(io.BytesIO(content), convert_hdr_to_8bit=False)
    image = file[file.primary_index]
    values = np.asarray(image) >> (16 - bits)  # which pillow-heif has filled up with zeros
    if values.ndim == 2:
        return Stored(values, grey_levels(picture, values, bits) or full_range(bits))
    # Colours that are multiplied with their opacity are already those on black.
    return Stored(values[..., :3] if image.premultiplied_alpha else values, full_range(bits))


def _decode_ppm(picture: "ImageFile", content: bytes | bytearray) -> Stored:
    decoder, _, start, _ = picture.tile[0]
    count = 3 * picture.width * picture.height
    if decoder == "ppm":
        numbers = np.frombuffer(content, ">u2", count, start)
    else:  # numbers as text
        words = _COMMENT.sub(b"", content[start:]).split(maxsplit=count)[:count]
        numbers = np.array([min(int(word), 65535) for word in words], np.uint16)
    return Stored(
        numbers.reshape(picture.height, picture.width, 3), Levels(0, white_of_ppm(picture))
    )
