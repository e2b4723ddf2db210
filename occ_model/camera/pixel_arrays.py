"""Take arrays of pixels of any depth and byte order, by which of their values is white."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.photometry import WHITE
from occ_model.errors import DecodeInputError

Samples: TypeAlias = NDArray[np.uint8 | np.uint16]  # 8 bits or 16, white being the largest number

_WHITE_OF_16_BITS = 65535.0
_ROUNDING = 0.5 / WHITE  # of white by which a value may be beyond it
_LEAST_BEYOND_FRACTIONS = 2.0  # a value above it is a grey level, one from 1 to it may be either
_LEAST = -0.1  # of white: noise about black; pixels from -1 to 1 have another scale


def bytes_of(
    pixels: NDArray[Any], what: str = "The image", white: float | None = None
) -> ByteArray:
    """Round pixels to bytes, 255 being white.

    Parameters
    ----------
    pixels
        Of uint8 or uint16, whose largest number is white; or of floating point, where white is 1 if
        no value is beyond it, and 255 if the largest is beyond 2 and none beyond 255.
    what
        Their name, which begins a sentence.
    white
        The value of white that floating-point pixels have; None: by this rule.

    Raises
    ------
    DecodeInputError
        There are no pixels, they are of another type or not finite, or the rule leaves open which
        value is white.
    """
    pixels = numbers_of(pixels, what)
    if pixels.dtype == np.uint8:
        return np.ascontiguousarray(pixels)
    white = _white_of(pixels, what, white)
    return np.ascontiguousarray(to_bytes(pixels.astype(np.float64) * (WHITE / white)))


def samples_of(pixels: NDArray[Any], what: str = "The image") -> Samples:
    """Round floating-point pixels to 16 bits; arguments and errors as for :func:`bytes_of`."""
    pixels = numbers_of(pixels, what)
    return pixels if pixels.dtype.kind == "u" else in_16_bits(pixels, _white_of(pixels, what))


def in_16_bits(pixels: NDArray[Any], white: float) -> Samples:
    """Round floating-point pixels to 16 bits; what is not a number is black."""
    within = np.nan_to_num(np.clip(pixels, 0.0, white), nan=0.0)
    return np.asarray(np.rint(within * (_WHITE_OF_16_BITS / white)), np.uint16)


def white_of(pixels: NDArray[Any], what: str = "The image") -> float:
    """Return which value of pixels is white; arguments and errors as for :func:`bytes_of`."""
    return _white_of(numbers_of(pixels, what), what)


def _white_of(pixels: NDArray[Any], what: str, white: float | None = None) -> float:
    if pixels.dtype.kind == "u":
        return WHITE if pixels.dtype == np.uint8 else _WHITE_OF_16_BITS
    return white_between(float(pixels.min()), float(pixels.max()), what, white)


def white_between(low: float, high: float, what: str, white: float | None = None) -> float:
    """Return which value is white in floating-point pixels from one value to another."""
    is_open = 1.0 + _ROUNDING < high <= _LEAST_BEYOND_FRACTIONS and white is None
    white = white or (1.0 if high <= 1.0 + _ROUNDING else WHITE)
    if is_open or high > white * (1.0 + _ROUNDING) or low < _LEAST * white:
        raise DecodeInputError(
            f"{what} holds values from {low:.6g} to {high:.6g}; allowed in floating point: "
            "fractions of white, from 0 to 1, or grey levels, from 0 to 255, of which the largest "
            f"is beyond {_LEAST_BEYOND_FRACTIONS:g}."
        )
    return white


def numbers_of(pixels: NDArray[Any], what: str = "The image") -> NDArray[Any]:
    """Return pixels in the byte order of this computer, or refuse them as :func:`bytes_of` does."""
    pixels = pixels.astype(pixels.dtype.newbyteorder("="), copy=False)
    is_floating = np.issubdtype(pixels.dtype, np.floating)
    if not is_floating and pixels.dtype not in (np.uint8, np.uint16):
        raise DecodeInputError(
            f"{what} has pixels of type {pixels.dtype}; allowed: uint8, uint16, floating point."
        )
    if pixels.size == 0:
        raise DecodeInputError(f"{what} is empty: its shape is {pixels.shape}.")
    if is_floating and not np.isfinite(pixels).all():
        raise DecodeInputError(f"{what} holds values that are not numbers (NaN or infinity).")
    return pixels
