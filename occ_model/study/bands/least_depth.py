"""The depth of the bars over ranges of frequency and exposure, for sharp edges."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.bands import DepthMap
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, check_scene
from occ_model.study.bands.depth import light_shares
from occ_model.transmitter.packet import sent_chips

_MOST_NODES = 10_000
"""Whole chips of a range that are looked at; by then bars are far below what is seen."""

_EXPOSURES = (1e-5, 0.1)
"""Ends of the map's exposures in s: up to usual shutter speeds, past the slider."""

_CELLS = 120
"""On each side of the map."""


@dataclass(frozen=True, eq=False, slots=True)
class DepthOver:
    """Peak to peak depth of a scene's light at any frequency and exposure.

    Of an exposure of a chips the light varies by a number of lit chips that repeats with the code,
    and is linear in a between whole chips. An LED's edges only average it further: with them bars
    are at most as deep.
    """

    # Shape (chips + 1,): largest less smallest number of lit chips in exposures of 0, 1, ... chips.
    swing: FloatArray
    # Light of the lit lamp, and largest swing of the surroundings', relative to the mean
    of_lamp: float
    of_flicker: float
    flicker_frequency: float  # Hz

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Return the depth for a scene's code and light."""
        check_scene(scene)
        of_lamp, around = light_shares(scene)
        surroundings = scene.surroundings
        chips = sent_chips(scene.transmitter).tobytes()
        swing = 2.0 * surroundings.flicker_depth * around
        return cls(_swing(chips), of_lamp, swing, surroundings.flicker_frequency)

    @property
    def period(self) -> int:
        """Chips after which the code repeats, the fewest: exposures of as many show no bars."""
        return int(np.flatnonzero(self.swing[1:] == 0.0)[0]) + 1

    @property
    def most(self) -> float:
        """Bound of the depth of the code's bars, times the chips of an exposure."""
        return self.of_lamp * float(self.swing.max())

    def of_code(self, chips: FloatArray) -> FloatArray:
        """Return the depth of the code's bars in exposures of some chips."""
        return np.asarray(self.of_lamp * self.swing_in(chips) / chips)

    def swing_in(self, chips: FloatArray) -> FloatArray:
        """Return the largest less the smallest number of lit chips in exposures of some chips."""
        period = len(self.swing) - 1
        return np.asarray(np.interp(chips % period, np.arange(period + 1), self.swing))

    def flicker(self, exposures: FloatArray) -> FloatArray:
        """Return the depth that the surroundings' flicker has in some exposures, in seconds."""
        return np.asarray(self.of_flicker * np.abs(np.sinc(self.flicker_frequency * exposures)))

    def least(self, frequency: float, ends: FloatArray) -> FloatArray:
        """Return the least depth within ranges of exposures, at a switching frequency.

        Between whole chips, and between the flicker's nulls, the depth is quasi-concave: the least
        is at one of these or at an end.

        Parameters
        ----------
        frequency
            In Hz.
        ends : ndarray of float64, shape (ranges + 1,)
            Where each range ends and the next starts, in seconds.

        Returns
        -------
        ndarray of float64, shape (ranges,)
        """
        at_ends = self.of_code(frequency * ends) + self.flicker(ends)
        least = np.minimum(at_ends[:-1], at_ends[1:])
        for rate in (frequency, self.flicker_frequency):
            node = np.maximum(np.ceil(rate * ends[:-1]), 1.0)
            for _ in range(_MOST_NODES):
                inside = node <= rate * ends[1:]
                if not inside.any():
                    break
                exposures = node / rate
                chips = node if rate == frequency else frequency * exposures
                depth = self.of_code(chips) + self.flicker(exposures)
                least = np.where(inside, np.minimum(least, depth), least)
                node = node + 1.0
        return np.asarray(least)


def depth_map(scene: Scene) -> DepthMap:
    """Return the least depth of a scene's bars over frequency and exposure."""
    over = DepthOver.of(scene)
    frequencies, exposures = (
        np.geomspace(*ends, _CELLS + 1)
        for ends in (quantity("switching_frequency").slider, _EXPOSURES)
    )
    middles = np.sqrt(frequencies[:-1] * frequencies[1:])
    least = np.stack([over.least(float(each), exposures) for each in middles])
    return DepthMap(frequencies, exposures, least, over.period)


@lru_cache(maxsize=16)
def _swing(chips: bytes) -> FloatArray:
    """Return the largest less the smallest number of lit chips in each whole number of chips."""
    level = np.frombuffer(chips, dtype=np.uint8).astype(np.int64)
    period = len(level)
    before = np.concatenate([[0], np.cumsum(np.tile(level, 2))])
    # As many chips are dark without an exposure as within it: the two halves are alike.
    half = [float(np.ptp(before[k : k + period] - before[:period])) for k in range(period // 2 + 1)]
    swing = np.empty(period + 1)
    swing[: len(half)] = half
    swing[period - len(half) + 1 :] = half[::-1]
    swing.flags.writeable = False
    return swing
