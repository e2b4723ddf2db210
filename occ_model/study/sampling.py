"""Reference exposures for the accuracy study: by samples in time, and in rational arithmetic."""

from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

_SAMPLES_AT_ONCE = 1_000_000


def sampled_lit_fraction(scene: Scene, samples: int) -> FloatArray:
    """Return t_on / t of every column from samples in the middle of equal parts of its exposure."""
    chips = sent_chips(scene.transmitter)
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    within = (np.arange(samples) + 0.5) * (camera.exposure_time / samples)
    lit = np.empty(camera.columns)
    step = max(1, _SAMPLES_AT_ONCE // samples)
    for first in range(0, camera.columns, step):
        column = np.arange(first, min(first + step, camera.columns))
        start = scene.model.start_time + column * camera.readout_time
        chip = np.floor((start[:, None] + within) * frequency).astype(np.int64)
        lit[column] = chips[chip % len(chips)].mean(axis=1)
    return lit


def exact_lit_fraction(scene: Scene, columns: IndexArray) -> FloatArray:
    """Return t_on / t of some columns in rational arithmetic, rounded once at the end."""
    chips = sent_chips(scene.transmitter).tolist()
    frequency = Fraction(scene.transmitter.switching_frequency)
    exposure = Fraction(scene.camera.exposure_time) * frequency
    before = [0]
    for chip in chips:
        before.append(before[-1] + chip)

    def lit_until(time: Fraction) -> Fraction:
        period, residual = divmod(time, len(chips))
        chip = int(residual)
        lit: Fraction = period * before[-1] + before[chip] + (residual - chip) * chips[chip]
        return lit

    shares = []
    for column in columns.tolist():
        start = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
        start *= frequency
        shares.append(float((lit_until(start + exposure) - lit_until(start)) / exposure))
    return np.array(shares)
