"""Find the numbers that mean black and white in a file's samples."""

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

_PHOTOMETRIC, _WHITE_IS_ZERO = 262, 0  # a tag of TIFF, and its value if white is stored as 0

START_OF_JPEG_2000 = b"\xff\x4f\xff\x51"  # the markers of its start and of its size
_COMPONENTS = 42  # bytes from there to the descriptions of the components, three bytes each

_DEEP_COLOURS = re.compile("(LA|RGB|RGBA|RGBa|RGBX);16")  # raw modes

_MOST_BEYOND_RANGE = 0.01  # fraction of pixels that a codec may put outside a limited range


class Levels(NamedTuple):
    """The numbers that mean black and white; black is the larger one if white is stored as 0."""

    black: float
    white: float

    def tabulate(self, white: int) -> NDArray[np.uint16]:
        """Return the sample for every number of 16 bits, up to ``white``, shape (65536,)."""
        fraction = (np.arange(65536) - self.black) / (self.white - self.black)
        return np.asarray(np.rint(np.clip(fraction, 0.0, 1.0) * white), np.uint16)


def full_range(bits: int) -> Levels:
    return Levels(0, 2**bits - 1)


def limited_range(bits: int) -> Levels:
    """Return the levels of video, which are 16 and 235 of 8 bits."""
    return Levels(16 << bits - 8, 235 << bits - 8)


def bits_of(picture: "ImageFile", content: bytes | bytearray) -> int:
    """Return how many bits the samples of a picture's file have.

    ``content``: the bytes of the file, used only for JPEG 2000 and AVIF.
    """
    if picture.format == "HEIF":
        return int(picture.info["bit_depth"])
    if picture.format == "AVIF":  # AV1 Codec ISO Media File Format Binding, section 2.3
        flags = [place[2] for place in content.split(b"av1C")[1:] if len(place) > 2]
        return max((8 + 2 * (flag >> 6 & 1) + 2 * (flag >> 5 & 1) for flag in flags), default=8)
    if picture.format == "JPEG2000":  # ISO/IEC 15444-1, A.5.1
        first = content.find(START_OF_JPEG_2000) + _COMPONENTS
        components = content[first : first + 3 * len(picture.getbands()) : 3]
        return max(((component & 0x7F) + 1 for component in components), default=8)
    is_deep = any(_DEEP_COLOURS.match(mode) for mode in raw_modes_of(picture))
    return 16 if is_deep or white_of_ppm(picture) > 255 else 8


def raw_modes_of(picture: "ImageFile") -> set[str]:
    """Return a picture's raw modes, Pillow's names for the layout of samples in a file."""
    arguments = [tile[3] for tile in picture.tile]
    firsts = [
        argument[0] if isinstance(argument, tuple) and argument else argument
        for argument in arguments
    ]
    return {first for first in firsts if isinstance(first, str)}


def white_of_ppm(picture: "ImageFile") -> int:
    """Return the number that is white in colours of PPM; 255 for other pictures."""
    decoder, arguments = (picture.tile[0][0], picture.tile[0][3]) if picture.tile else ("", None)
    is_number = decoder in ("ppm", "ppm_plain") and picture.mode == "RGB"
    return int(arguments[1]) if is_number and isinstance(arguments, tuple) else 255


def levels_of(picture: "ImageFile", raw_modes: set[str], bits: int) -> Levels | None:
    """Return the levels of a decoded picture of integers; None if white is the largest number."""
    if picture.format == "HEIF" and picture.mode == "L":
        return grey_levels(picture, np.asarray(picture), 8)
    if picture.format == "JPEG2000" and bits != 8:  # Pillow fills up the lower bits with zeros
        depth = 16 if picture.mode == "I;16" else 8
        return Levels(0, (1 << depth) - (1 << max(depth - bits, 0)))
    if raw_modes & {"I;12"}:
        return full_range(12)
    if raw_modes & {"I;16S", "I;16BS"}:  # with a sign
        return full_range(15)
    if picture.mode.startswith("I") and is_white_zero(picture):
        return Levels(65535, 0)
    return None


def is_white_zero(picture: "ImageFile") -> bool:
    """Return whether a TIFF says that white is 0, which Pillow applies to 8 bits only."""
    return bool(getattr(picture, "tag_v2", {}).get(_PHOTOMETRIC) == _WHITE_IS_ZERO)


def grey_levels(
    picture: "ImageFile", values: NDArray[np.uint8 | np.uint16], bits: int
) -> Levels | None:
    """Return the levels of a HEIC without colours, which libheif decodes as they are stored.

    A file that libheif was asked to write in the limited range states it, but has the full range;
    its pixels show that.
    """
    limited = limited_range(bits)
    stated = picture.info.get("nclx_profile") or {}
    beyond = np.count_nonzero((values < limited.black) | (values > limited.white))
    if stated.get("full_range_flag") == 0 and beyond <= _MOST_BEYOND_RANGE * values.size:
        return limited
    return full_range(bits) if bits > 8 else None
