"""Convert grey levels to light by the camera's tone curve, or by an estimate if it is unknown.

A detector that adds up light needs a signal proportional to it, up to a constant. Histogram
equalization depends on the picture, so the picture alone does not show the light of a level, only
the order of levels. For random data the distribution of the exposures' light is known, so a level's
rank gives its light as far as the data in the picture are random.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import Scheme, scheme_of

_CHIPS = 1500  # chips of random payloads from which the distribution of light is computed
PER_CHIP = 16  # exposures per chip in :func:`expected_light`


@dataclass(frozen=True, eq=False, slots=True)
class Light:
    # Shape (columns,): proportional to the light of each column, up to a constant
    values: FloatArray
    # Shape (columns,): whether a column has the largest level, so that its light may be larger
    clipped: BoolArray
    # Whether only the order of the levels was used, because the tone curve is unknown
    is_estimated: bool


def is_curve_known(scene: Scene) -> bool:
    """Return whether the scene determines the curve from light to the levels of a picture."""
    model = scene.model
    return model.enhancement == "none" or (
        model.enhancement == "stretch" and model.averaging == "pixel-value"
    )


def convert_to_light(signal: FloatArray, scene: Scene) -> Light:
    """Convert grey levels to light; an estimate also uses exposure time, frequency and bits."""
    model = scene.model
    # A signal that exceeds white is not limited to the levels of a picture, so it is not clipped.
    clipped = (signal >= WHITE - 0.5) & (signal.max() <= WHITE)
    if not is_curve_known(scene):
        return Light(rank_to_light(signal, expected_light(scene)), np.zeros_like(clipped), True)
    if model.enhancement == "stretch":
        clipped = np.zeros_like(clipped)  # the brightest column is white but not clipped
    if model.averaging == "light":
        # Levels are the averaged light to the power of 1 / gamma.
        return Light(np.maximum(signal / WHITE, 0.0) ** scene.camera.gamma, clipped, False)
    return Light(signal / WHITE, clipped, False)


def rank_to_light(signal: FloatArray, reference: FloatArray) -> FloatArray:
    """Return the light of each value of a signal: the expected light of the same rank."""
    _, level_index, counts = np.unique(signal, return_inverse=True, return_counts=True)
    fraction = (np.cumsum(counts) - 0.5 * counts) / len(signal)
    sorted_light = np.sort(reference, axis=None)
    sorted_fractions = (np.arange(sorted_light.size) + 0.5) / sorted_light.size
    return np.asarray(np.interp(fraction, sorted_fractions, sorted_light)[level_index])


def expected_light(scene: Scene) -> FloatArray:
    """Return the lit fractions of exposures of random data in time order, 16 per chip."""
    transmitter = scene.transmitter
    exposure = scene.camera.exposure_time * transmitter.switching_frequency
    return _expected_light(None if transmitter.pattern else scheme_of(transmitter), exposure)


@lru_cache(maxsize=32)
def _expected_light(scheme: Scheme | None, exposure: float) -> FloatArray:
    random = np.random.default_rng(1)
    chips: ByteArray
    if scheme is not None:
        count = max(1, _CHIPS // scheme.length)
        payloads = random.integers(0, 2, (count, scheme.bits), dtype=np.uint8)
        chips = np.concatenate([scheme.encode(payload) for payload in payloads])
    else:
        chips = random.integers(0, 2, _CHIPS, dtype=np.uint8)
    light = light_of_chips(chips, exposure)
    light.flags.writeable = False
    return light


def light_of_chips(chips: ByteArray, exposure: float) -> FloatArray:
    """Return the lit fractions of exposures of repeated chips in time order, 16 per chip."""
    starts = (np.arange(len(chips) * PER_CHIP) + 0.5) / PER_CHIP
    lit_time = np.concatenate([[0.0], np.cumsum(chips)])
    ends = starts + exposure % len(chips)
    chip_edges = np.arange(2 * len(chips) + 1)
    integral = np.concatenate([lit_time, lit_time[1:] + lit_time[-1]])
    full_periods = np.floor(exposure / len(chips)) * lit_time[-1]
    light = (
        np.interp(ends, chip_edges, integral)
        - np.interp(starts, chip_edges, integral)
        + full_periods
    )
    return np.asarray(light / exposure)
