"""Decode an image or a profile: check it, locate the panel, run a decoder on the signal."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.photometry import WHITE
from occ_model.camera.projection import MAX_PIXELS
from occ_model.errors import DecodeInputError
from occ_model.receiver.decoders import PAPER_DECODER, decoder_named
from occ_model.receiver.signal import column_means, locate
from occ_model.results.decoding import DecodeResult, Region
from occ_model.scene.scene import Scene

_LARGEST_LEVEL = 1e5  # largest value accepted as a grey level, above those of any bit depth


def decode(image: NDArray[Any], scene: Scene, decoder: str = PAPER_DECODER) -> DecodeResult:
    """Read the code that an image shows.

    Parameters
    ----------
    image : ndarray, shape (rows, columns) or (columns,)
        A grey image, columns being the scan axis: uint8, uint16 (scaled to 255) or floating point
        (grey levels 0 to 255). An array of one dimension is a profile: no panel is located.
    scene
        The parameters that the receiver knows.
    decoder
        A name from ``DECODERS``.

    Returns
    -------
    DecodeResult
        Its ``failure`` says in a sentence why there is no code.

    Raises
    ------
    DecodeInputError
        The array is not a grey image or profile, is empty or too large, or holds a value that is
        not a number.
    ParameterError
        There is no such decoder.
    """
    read = decoder_named(decoder).read
    try:
        image = np.asarray(image)
    except ValueError:
        raise DecodeInputError(
            "The image is not an array: its rows are of different lengths."
        ) from None
    _check(image)
    if image.ndim == 1:
        whole = Region(0, 1, 0, len(image))
        return replace(read(_levels(image), scene), region=whole)
    grey: ByteArray = image if image.dtype == np.uint8 else to_bytes(_levels(image))
    grey = np.ascontiguousarray(grey)
    found = locate(grey, scene.receiver.bright_fraction)
    if found is None:
        return DecodeResult(
            decoder, failure=f"No panel found: every pixel has the grey level {grey.flat[0]}."
        )
    result = read(column_means(grey, found.region), scene)
    return replace(result, region=found.region, location=found)


def _levels(image: NDArray[Any]) -> FloatArray:
    """Convert pixel values of any type to grey levels, 0 to 255."""
    levels = image.astype(np.float64)
    return levels / 257.0 if image.dtype == np.uint16 else levels


def _check(image: NDArray[Any]) -> None:
    if image.ndim not in (1, 2):
        raise DecodeInputError(
            "A decoder reads a grey image (rows, columns) or a profile (columns,), not an array of "
            f"shape {image.shape}."
        )
    if image.size == 0:
        raise DecodeInputError(f"The image is empty: its shape is {image.shape}.")
    if image.size > MAX_PIXELS:
        raise DecodeInputError(
            f"The image has {image.size / 1e6:.0f} million pixels; "
            f"allowed: up to {MAX_PIXELS // 1_000_000} million."
        )
    if image.dtype not in (np.uint8, np.uint16) and not np.issubdtype(image.dtype, np.floating):
        raise DecodeInputError(
            f"The image has pixels of type {image.dtype}; allowed: uint8, uint16, floating point."
        )
    if not np.issubdtype(image.dtype, np.floating):
        return
    if not np.isfinite(image).all():
        raise DecodeInputError("The image holds values that are not numbers (NaN or infinity).")
    largest = float(np.abs(image).max())
    if largest > _LARGEST_LEVEL:
        raise DecodeInputError(
            f"The image holds the value {largest:.3g}; grey levels reach from 0 to {WHITE:.0f}."
        )
