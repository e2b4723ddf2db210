"""Exposures on the waveform of the LED: one column's, and those of a rolling shutter."""

import math
from fractions import Fraction

import numpy as np

from occ_model.camera.exposure import on_time
from occ_model.errors import ParameterError, shown
from occ_model.results.teaching import ExposureWindow, RollingShutter
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


_CHIPS = 4  # chips that the shown columns begin in


def rolling_shutter(scene: Scene, shown: int = 25) -> RollingShutter:
    """Return the exposures of up to ``shown`` first columns, which begin within four chips."""
    check_scene(scene)
    camera, period = scene.camera, scene.transmitter.switching_period
    last = min(camera.columns - 1, max(int(_CHIPS * period / camera.readout_time), 1))
    columns = np.unique(np.linspace(0, last, min(shown, last + 1)).round().astype(np.intp))
    starts = np.multiply(columns, camera.readout_time, dtype=np.float64)
    chips = sent_chips(scene.transmitter)
    phase = (scene.model.start_time * scene.transmitter.switching_frequency) % len(chips)
    first = int(phase)
    needed = (float(starts[-1]) + camera.exposure_time) / period
    count = int(min(np.ceil(needed) + 1, _MAX_CHIPS))
    return RollingShutter(
        columns=columns,
        starts=starts,
        exposure_time=camera.exposure_time,
        lit_fraction=on_time(scene)[columns] / camera.exposure_time,
        edges=np.asarray((first - phase + np.arange(count + 1)) * period, dtype=np.float64),
        lit=chips[(first + np.arange(count)) % len(chips)],
    )
