"""Decode what Pillow would reduce to 8 bits: colours, and grey with opacity, of more than 8 bits.

Pillow has no pictures of several channels of more than 8 bits, and by its reduction the white of a
JPEG 2000 becomes black. OpenCV, libheif and NumPy decode them here as they are stored. OpenCV's
decoding cannot be cancelled.
"""

import io
import re
import struct
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.errors import PhotoError
from occ_model.photo.reading.levels import (
    START_OF_JPEG_2000,
    Levels,
    full_range,
    grey_levels,
    limited_range,
    raw_modes_of,
    white_of_ppm,
)
from occ_model.photo.reading.stderr import no_stderr

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

_LUMA_AND_CHROMA = re.compile(rb"colr\x01..\0\0\0\x12", re.DOTALL)
"""JPEG 2000's colour space of video, which OpenCV converts as if they had 16 bits."""

_SIZE_OF_JPEG_2000 = 8  # bytes from the start of its code stream to its size

_BYTES_OF_CHUNK = 12  # of a PNG, beside its content: its length, its name, and a check sum
_MOST_CHUNKS = 1_000_000  # which are walked through in about a second

_COMMENT = re.compile(rb"#[^\r\n]*")


class Opened(NamedTuple):
    """A file's picture that is opened and not decoded."""

    name: str  # the file's path as text
    picture: "ImageFile"
    bits: int  # of a sample; 8 for pictures that Pillow keeps in their full depth
    content: bytes | bytearray  # all of the file if Pillow would reduce it, else nothing


class Stored(NamedTuple):
    """Samples as they are stored.

    The shape of ``values`` is (rows, columns), or (rows, columns, channels) with 2 channels for
    grey and opacity, 3 for colours, and 4 for colours and opacity.
    """

    values: NDArray[np.uint8 | np.uint16]
    levels: Levels
    starts_with_blue: bool = False  # The order of the colours, else from red to blue
    is_upright: bool = False  # Whether the orientation that the file notes has been applied

    def part(self, rows: slice, columns: slice) -> NDArray[np.uint8 | np.uint16]:
        """Cut out a rectangle, with colours from red to blue."""
        part = self.values[rows, columns]
        return part[..., [2, 1, 0, 3][: part.shape[2]]] if self.starts_with_blue else part


def is_reduced(picture: "ImageFile", bits: int) -> bool:
    """Return whether Pillow would reduce a picture of so many bits to 8."""
    is_grey_jpeg_2000 = picture.format == "JPEG2000" and picture.mode == "I;16"
    return bits > 8 and not is_grey_jpeg_2000


def decode_deep(opened: Opened) -> Stored:
    """Decode a file as it is stored."""
    name, picture, bits, content = opened
    if picture.format == "HEIF":
        return _decode_heif(picture, bits, content)
    if picture.format == "PPM":
        return _decode_ppm(picture, content)
    values = None
    if _is_for_opencv(picture, content):
        with no_stderr():
            values = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    if picture.format == "AVIF" and (values is None or values.ndim == 2):
        return _decode_grey_avif(picture, bits, None if values is None else np.asarray(values))
    if values is None or values.shape[0] * values.shape[1] != picture.width * picture.height:
        raise PhotoError(
            f"{name} cannot be read: it is damaged, or its {bits} bits are stored in an unusual "
            "way; allowed above 8 bits: grey, or red, green and blue, as positive numbers."
        )
    has_no_opacity = picture.mode == "RGB" and "transparency" not in picture.info
    is_on_black = any(mode.startswith("RGBa") for mode in raw_modes_of(picture))
    stored: NDArray[Any] = np.asarray(values)
    levels = full_range(bits if stored.dtype == np.uint16 else 8)
    if has_no_opacity or is_on_black:
        stored = stored[..., :3]
    # OpenCV turns TIFF, and TIFF only.
    return Stored(stored, levels, True, picture.format == "TIFF")


def _is_for_opencv(picture: "ImageFile", content: bytes | bytearray) -> bool:
    if picture.format == "PNG":
        return _has_whole_chunks(content)
    return picture.format != "JPEG2000" or _is_usual_jpeg_2000(picture.size, content)


def _has_whole_chunks(content: bytes | bytearray) -> bool:
    """Return whether a PNG's chunks are in the file: OpenCV allocates what lengths they state."""
    place = len(b"\x89PNG\r\n\x1a\n")
    for _ in range(_MOST_CHUNKS):
        end = place + _BYTES_OF_CHUNK + int.from_bytes(content[place : place + 4], "big")
        if end > len(content):
            return False
        if content[place + 4 : place + 8] == b"IEND":
            return True
        place = end
    return False


def _is_usual_jpeg_2000(size: tuple[int, int], content: bytes | bytearray) -> bool:
    """Return whether a JPEG 2000 has no luma and chroma, and its code stream the file's size."""
    start = content.find(START_OF_JPEG_2000) + _SIZE_OF_JPEG_2000
    width, height, left, top = struct.unpack_from(">4L", content, start)
    return (width - left, height - top) == size and _LUMA_AND_CHROMA.search(content) is None


def _decode_grey_avif(
    picture: "ImageFile", bits: int, values: NDArray[np.uint8 | np.uint16] | None
) -> Stored:
    """Find the range of the luma, which OpenCV keeps as it is stored, and Pillow converts.

    OpenCV does not decode grey with opacity, of which Pillow's 8 bits are taken.
    """
    picture.load()
    if values is None:
        return Stored(np.asarray(picture.convert("RGBA")), full_range(8))
    seen = np.asarray(picture.convert("L"))

    def error(levels: Levels) -> float:
        return cv2.norm(levels.tabulate(255).astype(np.uint8)[values], seen, cv2.NORM_L1)

    return Stored(values, min(full_range(bits), limited_range(bits), key=error))


def _decode_heif(picture: "ImageFile", bits: int, content: bytes | bytearray) -> Stored:
    from pillow_heif import HeifFile

    open_heif: Callable[..., Any] = HeifFile  # which declares no types
    file = open_heif(io.BytesIO(content), convert_hdr_to_8bit=False)
    image = file[file.primary_index]
    values = np.asarray(image, np.uint16) >> np.uint16(
        16 - bits
    )  # which pillow-heif has filled up with zeros
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
