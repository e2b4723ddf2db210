"""Depth of the bars over ranges of frequency and exposure, for sharp edges."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.bands import DepthMap
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_fractions
from occ_model.transmitter.scheme import sent_chips

MAX_NODES = 10_000
"""Chips, and cycles of the flicker, of an exposure up to which bars are computed; beyond they are
bounded. The flicker's are below 0.01 % there."""

_MAP_EXPOSURES = (1e-5, 0.1)  # seconds; to usual shutter speeds, beyond the slider
_MAP_CELLS = 120


@dataclass(frozen=True, eq=False, slots=True)
class DepthOver:
    """Peak-to-peak depth of a scene's light at any frequency and exposure.

    The light of an exposure of a chips varies by a number of lit chips that is periodic in a with
    the code and linear between integers. An LED's edges can only reduce it.
    """

    # Shape (chips + 1,): range of the number of lit chips in exposures of 0, 1, ... chips
    swing: FloatArray
    # Light of the lit lamp, and largest swing of the ambient light, relative to the mean
    of_lamp: float
    of_flicker: float
    flicker_frequency: float  # Hz

    @classmethod
    def of(cls, scene: Scene) -> Self:
        of_lamp, around = light_fractions(scene)
        surroundings = scene.surroundings
        chips = sent_chips(scene.transmitter).tobytes()
        swing = 2.0 * surroundings.flicker_depth * around
        return cls(_swing(chips), of_lamp, swing, surroundings.flicker_frequency)

    @property
    def period(self) -> int:
        """Fundamental period of the code in chips: such exposures show no bars."""
        return int(np.flatnonzero(self.swing[1:] == 0.0)[0]) + 1

    @property
    def most(self) -> float:
        """Bound of the code's depth times the exposure in chips."""
        return self.of_lamp * float(self.swing.max())

    @property
    def most_flicker(self) -> float:
        """Bound of the flicker's depth times the exposure in its cycles."""
        return self.of_flicker / np.pi

    def code_bound(self, chips: FloatArray) -> FloatArray:
        """Return the depth of the code's bars, or what it is at most in long exposures."""
        return np.where(chips > MAX_NODES, self.most / chips, self.of_code(chips))

    def flicker_bound(self, exposures: FloatArray) -> FloatArray:
        """Return the depth of the flicker's bars, or what it is at most in long exposures."""
        cycles = self.flicker_frequency * exposures
        return np.where(cycles > MAX_NODES, self.most_flicker / cycles, self.flicker(exposures))

    def of_code(self, chips: FloatArray) -> FloatArray:
        """Return the depth of the code's bars for exposures in chips."""
        return np.asarray(self.of_lamp * self.swing_in(chips) / chips)

    def swing_in(self, chips: FloatArray) -> FloatArray:
        """Return the range of the number of lit chips for exposures in chips."""
        period = len(self.swing) - 1
        return np.asarray(np.interp(chips % period, np.arange(period + 1), self.swing))

    def flicker(self, exposures: FloatArray) -> FloatArray:
        """Return the depth of the ambient flicker for exposures in seconds."""
        return np.asarray(self.of_flicker * np.abs(np.sinc(self.flicker_frequency * exposures)))

    def least(self, frequency: float, ends: FloatArray) -> FloatArray:
        """Return the smallest depth within each range of exposures, between ``ends`` in seconds.

        It lies at whole chips, at the flicker's nulls or at an end: quasi-concave between. Nodes
        beyond the first many are not tried.
        """
        at_ends = self.of_code(frequency * ends) + self.flicker(ends)
        least = np.minimum(at_ends[:-1], at_ends[1:])
        for rate in (frequency, self.flicker_frequency):
            first = np.maximum(np.ceil(rate * ends[:-1]), 1.0)
            last = np.minimum(np.floor(rate * ends[1:]), MAX_NODES)
            count = np.maximum(last - first + 1.0, 0.0).astype(np.int64)
            place = np.repeat(np.arange(len(count)), count)
            node = first[place] + np.arange(len(place)) - (np.cumsum(count) - count)[place]
            exposures = node / rate
            chips = node if rate == frequency else frequency * exposures
            np.minimum.at(least, place, self.of_code(chips) + self.flicker(exposures))
        return np.asarray(least)


def depth_map(scene: Scene) -> DepthMap:
    """Return the smallest depth of a scene's bars in each cell of frequency and exposure."""
    over = DepthOver.of(scene)
    frequencies, exposures = (
        np.geomspace(*ends, _MAP_CELLS + 1)
        for ends in (quantity("switching_frequency").slider, _MAP_EXPOSURES)
    )
    middles = np.sqrt(frequencies[:-1] * frequencies[1:])
    least = np.stack([over.least(float(each), exposures) for each in middles])
    return DepthMap(frequencies, exposures, least, over.period if over.most else 0)


@lru_cache(maxsize=16)
def _swing(chips: bytes) -> FloatArray:
    """Return the range of the number of lit chips for each integer exposure in chips."""
    level = np.frombuffer(chips, dtype=np.uint8).astype(np.int64)
    period = len(level)
    before = np.concatenate([[0], np.cumsum(np.tile(level, 2))])
    # Chips inside and outside an exposure complement each other: the halves are symmetric.
    half = [float(np.ptp(before[k : k + period] - before[:period])) for k in range(period // 2 + 1)]
    swing = np.empty(period + 1)
    swing[: len(half)] = half
    swing[period - len(half) + 1 :] = half[::-1]
    swing.flags.writeable = False
    return swing
