"""Decode an image or a profile: check it, locate the panel, and run a decoder on the signal."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_arrays import bytes_of, check_pixels
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import DecodeInputError
from occ_model.receiver.decoders import decoder_named, read_with
from occ_model.receiver.signal import column_means, locate
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, Region
from occ_model.scene.scene import Scene

_LARGEST_LEVEL = 1e5  # largest accepted grey level, above those of any bit depth


def decode(image: NDArray[Any], scene: Scene, decoder: str = PAPER_DECODER) -> DecodeResult:
    """Read the code that an image shows.

    Parameters
    ----------
    image : ndarray, shape (rows, columns) or (columns,)
        A grey image with the columns as scan axis: uint8, uint16 (65535 is white) or floating
        point. Floating-point pixels are fractions of white if none exceeds 1, and grey levels if
        the largest exceeds 2 and none exceeds 255; others are refused. An array of one dimension is
        a profile in grey levels, with any gain and offset, in which no panel is located.
    scene
        The parameters that the receiver knows.
    decoder
        A name from ``DECODERS``.

    Returns
    -------
    DecodeResult
        Its ``failure`` is a sentence on why there is no code.

    Raises
    ------
    DecodeInputError
        The array is not a grey image or profile, is empty or too large, contains a value that is
        not a number, or does not show which value is white.
    ParameterError
        The decoder does not exist.
    PluginError
        The decoder is a plug-in that cannot be imported; if it fails later, ``failure`` names it.
    """
    decoder_named(decoder)
    try:
        image = np.asarray(image)
    except ValueError:
        raise DecodeInputError(
            "The image is not an array: its rows have different lengths."
        ) from None
    _check_shape(image)
    if image.ndim == 1:
        levels = _convert_to_levels(check_pixels(image))
        result = replace(read_with(decoder, levels, scene), region=Region(0, 1, 0, len(image)))
        return _with_hint(result, levels) if image.dtype.kind == "f" else result
    grey = bytes_of(image)
    found = locate(grey, scene.receiver.bright_fraction)
    if found is None:
        return DecodeResult(
            decoder, failure=f"No panel found: every pixel has the grey level {grey.flat[0]}."
        )
    result = read_with(decoder, column_means(grey, found.region), scene)
    return replace(result, region=found.region, location=found)


def _convert_to_levels(profile: NDArray[Any]) -> FloatArray:
    """Convert a profile of any type to grey levels."""
    levels = profile.astype(np.float64)
    if profile.dtype == np.uint16:
        return levels / 257.0
    largest = float(np.abs(levels).max())
    if largest > _LARGEST_LEVEL:
        raise DecodeInputError(
            f"The profile contains the value {largest:.3g}; grey levels are from 0 to {WHITE:.0f}."
        )
    return levels


def _with_hint(result: DecodeResult, levels: FloatArray) -> DecodeResult:
    """Add to a failure how to scale a profile that may be in fractions of white."""
    if result.failure is None or not 0.0 < np.abs(levels).max() <= 1.0:
        return result
    hint = (
        "A profile must be in grey levels: if this one is in fractions of white, multiply it by "
        "255."
    )
    return replace(result, failure=f"{result.failure} {hint}")


def _check_shape(image: NDArray[Any]) -> None:
    if image.ndim not in (1, 2):
        raise DecodeInputError(
            "A decoder reads a grey image (rows, columns) or a profile (columns,), not an array of "
            f"shape {image.shape}."
        )
    if image.size > MAX_PIXELS:
        raise DecodeInputError(
            f"The image has {image.size / 1e6:.0f} million pixels; "
            f"allowed: up to {MAX_PIXELS // 1_000_000} million."
        )
