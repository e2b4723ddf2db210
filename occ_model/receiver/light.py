"""Convert grey levels to light by the camera's tone curve, or by an estimate if it is unknown.

A detector that adds up light needs a signal proportional to it, up to a constant. Histogram
equalization depends on the picture, so the picture alone does not show the light of a level, only
the order of levels. For random data the distribution of the exposures' light is known, so a level's
rank gives its light as far as the data in the picture are random.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import Scheme, scheme_of

_CHIPS = 1500  # chips of random payloads from which the distribution of light is computed
PER_CHIP = 16  # exposures per chip in :func:`expected_light`


@dataclass(frozen=True, eq=False, slots=True)
class Ranks:
    """The order of the values of a signal, without the values."""

    fractions: FloatArray  # Shape (levels,): fraction of the values below each level, half of equal
    level: IndexArray  # Shape (columns,): the level of each value, from the lowest

    @classmethod
    def of(cls, signal: FloatArray) -> Self:
        _, level, counts = np.unique(signal, return_inverse=True, return_counts=True)
        return cls((np.cumsum(counts) - 0.5 * counts) / len(signal), level)

    def to_light(self, ordered: FloatArray) -> FloatArray:
        """Return the value of the same rank in another distribution, given in order."""
        fractions = (np.arange(ordered.size) + 0.5) / ordered.size
        return np.asarray(np.interp(self.fractions, fractions, ordered)[self.level])


@dataclass(frozen=True, eq=False, slots=True)
class Light:
    # Shape (columns,): proportional to the light of each column, up to a constant
    values: FloatArray
    # Shape (columns,): whether a column has the largest level, so that its light may be larger
    clipped: BoolArray
    # The order of the levels, if nothing else was used because the tone curve is unknown
    ranks: Ranks | None = None

    @property
    def is_estimated(self) -> bool:
        return self.ranks is not None


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
        ranks = Ranks.of(signal)
        light = ranks.to_light(_ordered_light(*_scheme_and_exposure(scene)))
        return Light(light, np.zeros_like(clipped), ranks)
    if model.enhancement == "stretch":
        clipped = np.zeros_like(clipped)  # the brightest column is white but not clipped
    if model.averaging == "light":
        # Levels are the averaged light to the power of 1 / gamma.
        return Light(np.maximum(signal / WHITE, 0.0) ** scene.camera.gamma, clipped)
    return Light(signal / WHITE, clipped)


def expected_light(scene: Scene) -> FloatArray:
    """Return the lit fractions of exposures of random data in time order, 16 per chip."""
    return _expected_light(*_scheme_and_exposure(scene))


def _scheme_and_exposure(scene: Scene) -> tuple[Scheme | None, float]:
    """Return the scheme, None of a pattern, and the exposure in chips."""
    transmitter = scene.transmitter
    exposure = scene.camera.exposure_time * transmitter.switching_frequency
    return None if transmitter.pattern else scheme_of(transmitter), exposure


@lru_cache(maxsize=32)
def _expected_light(scheme: Scheme | None, exposure: float) -> FloatArray:
    light = light_of_chips(_random_chips(scheme), exposure)
    light.flags.writeable = False
    return light


@lru_cache(maxsize=8)
def _random_chips(scheme: Scheme | None) -> ByteArray:
    """Return the chips of random payloads, or random chips if there is no scheme."""
    random = np.random.default_rng(1)
    if scheme is None:
        return random.integers(0, 2, _CHIPS, dtype=np.uint8)
    count = max(1, _CHIPS // scheme.length)
    payloads = random.integers(0, 2, (count, scheme.bits), dtype=np.uint8)
    return np.concatenate([scheme.encode(payload) for payload in payloads])


@lru_cache(maxsize=32)
def _ordered_light(scheme: Scheme | None, exposure: float) -> FloatArray:
    light = np.sort(_expected_light(scheme, exposure))
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
