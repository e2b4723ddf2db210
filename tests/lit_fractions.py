"""Lit fractions of exposures by the running sum of chips, computed apart from the program."""

import numpy as np
from photo_world.exposures import mean_light

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.seen_stripes import BLUR_REACH, BlurShape, blur_kernel, blur_rows
from occ_model.photo.fit.timing import ChipLight, Timing

_SIDE = 9
"""Chips before the first and after the last one, which are as these."""


def lit_fractions(chips: ByteArray, starts: np.ndarray, exposure: float) -> FloatArray:
    """Return the lit fraction of each exposure, by the chips at which it starts and its length."""
    values = np.pad(chips.astype(float), _SIDE, mode="edge")
    running, places = np.concatenate([[0.0], np.cumsum(values)]), np.arange(len(values) + 1.0)
    first, last = (np.interp(starts + _SIDE + end, places, running) for end in (0.0, exposure))
    return np.asarray((last - first) / exposure)


def light_of(chips: ByteArray, timing: Timing, columns: int) -> FloatArray:
    """Return the lit fraction of each column, of chips that are sent again and again."""
    starts = timing.start(columns) + timing.step * np.arange(columns)
    return mean_light(chips, starts, timing.exposure)


def blurred_light(
    chips: ByteArray, columns: int, timing: Timing, blur: float, longer: float = 0.0,
    shape: BlurShape = "normal",
) -> FloatArray:  # fmt: skip
    """Return the lit fractions as the program blurs them, each time on being longer by chips."""
    light = ChipLight(chips, columns, BLUR_REACH).expose(timing, longer).lit
    return blur_rows(light, blur_kernel(blur, shape))
