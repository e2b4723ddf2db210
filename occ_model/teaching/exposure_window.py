"""One column's exposure: which chips it sees."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import on_time
from occ_model.checks import check_count
from occ_model.errors import ParameterError
from occ_model.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

_MOST_CHIPS = 400
"""Chips that a drawing can tell apart."""


@dataclass(frozen=True, eq=False, slots=True)
class ExposureWindow:
    """One column's exposure on the waveform of the LED.

    Times are in seconds from the start of the first chip that is drawn.

    Parameters
    ----------
    column
        Its number.
    start, end
        When the exposure begins and ends.
    edges : ndarray of float64, shape (chips + 1,)
        When the chips about it begin, and the last one ends.
    lit : ndarray of uint8, shape (chips,)
        Whether the LED is on in each.
    on_time
        How long it is on within the exposure.
    shortened
        Whether the exposure holds more chips than are drawn; these are its first ones.
    """

    column: int
    start: float
    end: float
    edges: FloatArray
    lit: np.ndarray[tuple[int, ...], np.dtype[np.uint8]]
    on_time: float
    shortened: bool


def exposure_window(scene: Scene, column: int) -> ExposureWindow:
    """Say which chips a column sees.

    Parameters
    ----------
    scene
        The scene.
    column
        A column of the picture, from 0.

    Returns
    -------
    ExposureWindow
        With a chip before the exposure and one after it.

    Raises
    ------
    ParameterError
        The picture has no such column.
    """
    check_scene(scene)
    check_count("column", column, 0)
    if column >= scene.camera.columns:
        raise ParameterError(
            f"column is {column}; allowed: 0 to {scene.camera.columns - 1}, as the picture has."
        )
    chips = sent_chips(scene.transmitter)
    period = scene.transmitter.switching_period
    begins = scene.model.start_time + column * scene.camera.readout_time
    first = math.floor(begins / period) - 1
    needed = math.floor((begins + scene.camera.exposure_time) / period) - first + 2
    count = min(needed, _MOST_CHIPS)
    start = begins - first * period
    return ExposureWindow(
        column=column,
        start=start,
        end=start + scene.camera.exposure_time,
        edges=np.arange(count + 1, dtype=np.float64) * period,
        lit=chips[(first + np.arange(count)) % len(chips)],
        on_time=float(on_time(scene)[column]),
        shortened=needed > count,
    )
