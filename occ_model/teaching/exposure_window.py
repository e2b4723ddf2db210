"""Returns the chips that a column's exposure covers."""

import math
from fractions import Fraction

import numpy as np

from occ_model.camera.exposure import on_time
from occ_model.errors import ParameterError, shown
from occ_model.results.teaching import ExposureWindow
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

_MAX_CHIPS = 400  # largest number of chips that a drawing resolves


def exposure_window(scene: Scene, column: int) -> ExposureWindow:
    """Return the chips that a column's exposure covers, and one before and one after it."""
    check_scene(scene)
    check_count("column", column, 0)
    if column >= scene.camera.columns:
        raise ParameterError.of(
            "column", shown(int(column)), f"0 to {scene.camera.columns - 1}, as the picture has"
        )
    chips = sent_chips(scene.transmitter)
    period = scene.transmitter.switching_period
    # Exact: a column's exposure may begin any number of chips before or after time zero.
    begins = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
    begins *= Fraction(scene.transmitter.switching_frequency)
    first = math.floor(begins)
    within = float(begins - first)
    needed = math.ceil(within + scene.camera.exposure_time / period) + 2
    count = min(needed, _MAX_CHIPS)
    start = (1.0 + within) * period
    # In Python's integers: the first chip's number can exceed an array's.
    places = (first - 1) % len(chips) + np.arange(count)
    return ExposureWindow(
        column=column,
        start=start,
        end=start + scene.camera.exposure_time,
        edges=np.arange(count + 1, dtype=np.float64) * period,
        lit=chips[places % len(chips)],
        on_time=float(on_time(scene)[column]),
        shortened=needed > count,
    )
