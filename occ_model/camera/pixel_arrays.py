"""Conversion of pixel arrays of any depth and byte order, by the value that is white."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, Samples as Samples
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.photometry import WHITE
from occ_model.errors import DecodeInputError

_WHITE_OF_16_BITS = 65535.0
_ROUNDING = 0.5 / WHITE  # of white, by which a value may exceed it
_LEAST_BEYOND_FRACTIONS = 2.0  # larger values are grey levels; those from 1 on may be either
_LEAST = -0.1  # of white, for noise about black; pixels from -1 to 1 have another scale


def bytes_of(
    pixels: NDArray[Any], name: str = "The image", white: float | None = None
) -> ByteArray:
    """Round pixels to bytes in which 255 is white.

    Parameters
    ----------
    pixels
        Of uint8 or uint16, where white is the largest number; or of floating point, where white is
        1 if no value is larger, and 255 if the largest value is between 2 and 255.
    name
        Their name at the start of a sentence.
    white
        The value of white in floating-point pixels; None applies the rule above.

    Raises
    ------
    DecodeInputError
        There are no pixels, they are of another type or not finite, or the rule does not tell which
        value is white.
    """
    pixels = check_pixels(pixels, name)
    if pixels.dtype == np.uint8:
        return np.ascontiguousarray(pixels)
    white = white_of(pixels, name, white)
    return np.ascontiguousarray(to_bytes(pixels.astype(np.float64) * (WHITE / white)))


def samples_of(pixels: NDArray[Any], name: str = "The image") -> Samples:
    """Round floating-point pixels to 16 bits; arguments and errors as :func:`bytes_of`."""
    pixels = check_pixels(pixels, name)
    return pixels if pixels.dtype.kind == "u" else round_to_16_bits(pixels, white_of(pixels, name))


def round_to_16_bits(pixels: NDArray[Any], white: float) -> Samples:
    """Round floating-point pixels to 16 bits; NaN becomes black."""
    clipped = np.nan_to_num(np.clip(pixels, 0.0, white), nan=0.0)
    return np.asarray(np.rint(clipped * (_WHITE_OF_16_BITS / white)), np.uint16)


def white_of(pixels: NDArray[Any], name: str = "The image", white: float | None = None) -> float:
    """Return the value that is white in pixels; arguments and errors as :func:`bytes_of`."""
    pixels = check_pixels(pixels, name)
    if pixels.dtype.kind == "u":
        return WHITE if pixels.dtype == np.uint8 else _WHITE_OF_16_BITS
    return find_white(float(pixels.min()), float(pixels.max()), name, white)


def find_white(low: float, high: float, name: str, white: float | None = None) -> float:
    """Find the value that is white in floating-point pixels between two values."""
    is_ambiguous = 1.0 + _ROUNDING < high <= _LEAST_BEYOND_FRACTIONS and white is None
    white = white or (1.0 if high <= 1.0 + _ROUNDING else WHITE)
    if is_ambiguous or high > white * (1.0 + _ROUNDING) or low < _LEAST * white:
        raise DecodeInputError(
            f"{name} has values from {low:.6g} to {high:.6g}; allowed in floating point: "
            "fractions of white, from 0 to 1, or grey levels, from 0 to 255, with the largest "
            f"above {_LEAST_BEYOND_FRACTIONS:g}."
        )
    return white


def check_pixels(pixels: NDArray[Any], name: str = "The image") -> NDArray[Any]:
    """Convert pixels to this computer's byte order, or refuse them as :func:`bytes_of` does."""
    pixels = pixels.astype(pixels.dtype.newbyteorder("="), copy=False)
    is_floating = np.issubdtype(pixels.dtype, np.floating)
    if not is_floating and pixels.dtype not in (np.uint8, np.uint16):
        raise DecodeInputError(
            f"{name} has pixels of type {pixels.dtype}; allowed: uint8, uint16, floating point."
        )
    if pixels.size == 0:
        raise DecodeInputError(f"{name} is empty: its shape is {pixels.shape}.")
    if is_floating and not np.isfinite(pixels).all():
        raise DecodeInputError(f"{name} has values that are not numbers (NaN or infinity).")
    return pixels
