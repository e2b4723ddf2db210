"""The smallest depth of the bars over ranges of frequency and exposure, for sharp edges."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.light.waveform import Waveform
from occ_model.results.bands import DepthMap, FrequencyAxis
from occ_model.scene.light_words import blinking_lamp, has_chips
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, Transmitter
from occ_model.study.bands.depth import light_fractions
from occ_model.study.bands.sines import repeat_units

MAX_NODES = 10_000
"""Nodes within an exposure, and cycles of the flicker, up to which depths are computed; beyond,
bounds replace them. The flicker's depth is below 0.01 % there."""

_MOST_PIECES = 16  # unequal pieces of which all differences of two edges are nodes
_GRID = 512  # nodes of a period that has more pieces

_MAP_EXPOSURES = (1e-5, 0.1)  # seconds; includes usual shutter speeds beyond the slider
_MAP_CELLS = 120


@dataclass(frozen=True, eq=False, slots=True)
class DepthOver:
    """Peak-to-peak depth of a scene's light at any frequency and exposure.

    Time is counted in cycles of the frequency that is varied: in chips of a code, else in periods.
    The light of an exposure of c cycles varies by a swing that is periodic in c, as the light is.
    It is exact at nodes; between them it is convex, and a chord bounds it from above. An LED's
    edges can only reduce it.
    """

    axis: FrequencyAxis
    # Cycles after which the light repeats, an exposure without bars; 0 for steady light
    period: float
    # Shape (nodes,): from 0 to a period, in cycles
    nodes: FloatArray
    swing_in: Callable[[FloatArray], FloatArray]
    # Light of the lit lamp, and largest swing of the ambient light, relative to the mean
    lamp_fraction: float
    flicker_swing: float
    flicker_frequency: float  # Hz

    @classmethod
    def of(cls, scene: Scene) -> Self:
        lamp_fraction, ambient_fraction = light_fractions(scene)
        transmitter, surroundings = scene.transmitter, scene.surroundings
        light, axis = light_of(transmitter), frequency_axis(transmitter)
        if isinstance(light, Cosine):
            # The surroundings follow the lamp: both are one cosine, and no flicker is left.
            fraction_of_both = lamp_fraction + ambient_fraction
            largest_swing = 2.0 / np.pi * light.depth
            return cls(
                axis, float(fraction_of_both * largest_swing > 0.0), np.array([0.0, 0.5, 1.0]),
                lambda cycles: np.asarray(largest_swing * np.abs(np.sin(np.pi * cycles))),
                fraction_of_both, 0.0, 1.0,
            )  # fmt: skip
        units = float(light.rate / Fraction(axis.frequency))  # a cycle
        period = repeat_units(light.waveform)
        nodes, swing = _swings(light.waveform)
        nodes = nodes / units

        def swing_in(cycles: FloatArray) -> FloatArray:
            return np.asarray(np.interp(cycles % nodes[-1], nodes, swing) / units)

        return cls(
            axis, period / units if lamp_fraction else 0.0, nodes, swing_in, lamp_fraction,
            2.0 * surroundings.flicker_depth * ambient_fraction, surroundings.flicker_frequency,
        )  # fmt: skip

    @property
    def lamp_bound(self) -> float:
        """Bound of the lamp's depth times the exposure in cycles."""
        return self.lamp_fraction * float(self.swing_in(self.nodes).max()) if self.period else 0.0

    @property
    def flicker_bound(self) -> float:
        """Bound of the flicker's depth times the exposure in its cycles."""
        return self.flicker_swing / np.pi

    @property
    def _last_cycle(self) -> float:
        """Cycles up to which depths are computed."""
        return float(MAX_NODES * self.nodes[-1] / (len(self.nodes) - 1))

    def bound_of_lamp(self, cycles: FloatArray) -> FloatArray:
        """Return the depth of the lamp's bars, or its upper bound in long exposures."""
        return np.where(
            cycles > self._last_cycle, self.lamp_bound / cycles, self.depth_of_lamp(cycles)
        )

    def bound_of_flicker(self, exposures: FloatArray) -> FloatArray:
        """Return the depth of the flicker's bars, or its upper bound in long exposures."""
        cycles = self.flicker_frequency * exposures
        bound, depth = self.flicker_bound / cycles, self.depth_of_flicker(exposures)
        return np.where(cycles > MAX_NODES, bound, depth)

    def depth_of_lamp(self, cycles: FloatArray) -> FloatArray:
        """Return the depth of the lamp's bars for exposures in cycles."""
        return np.asarray(self.lamp_fraction * self.swing_in(cycles) / cycles)

    def depth_of_flicker(self, exposures: FloatArray) -> FloatArray:
        """Return the depth of the ambient flicker for exposures in seconds."""
        return np.asarray(self.flicker_swing * np.abs(np.sinc(self.flicker_frequency * exposures)))

    def depths(self, exposures: FloatArray) -> FloatArray:
        """Return the depth of all bars at the scene's frequency, for exposures in seconds."""
        lamp = self.depth_of_lamp(self.axis.frequency * exposures)
        return np.asarray(lamp + self.depth_of_flicker(exposures))

    def nodes_to(self, end: float, low: float = 0.0) -> FloatArray:
        """Return the computed nodes above 0 between two exposures in cycles."""
        last, period = min(end, self._last_cycle), self.nodes[-1]
        periods = np.arange(low // period, last // period + 1.0)
        nodes = (period * periods[:, None] + self.nodes[1:]).ravel()
        return np.asarray(nodes[(nodes >= low) & (nodes <= last)])

    def least_depths(self, frequency: float, ends: FloatArray) -> FloatArray:
        """Return the smallest depth within each range of exposures, between ``ends`` in seconds.

        It lies at a node, at a null of the flicker or at an end, because the depth is
        quasi-concave in between. Nodes beyond the computed ones are not tried.
        """
        at_ends = self.depth_of_lamp(frequency * ends) + self.depth_of_flicker(ends)
        least_depths = np.minimum(at_ends[:-1], at_ends[1:])
        nulls = np.arange(1.0, min(self.flicker_frequency * ends[-1], MAX_NODES) + 1.0)
        node_cycles = self.nodes_to(frequency * ends[-1], frequency * ends[0])
        for cycles, exposures in (
            (node_cycles, node_cycles / frequency),
            (frequency * (nulls / self.flicker_frequency), nulls / self.flicker_frequency),
        ):
            ranges = np.searchsorted(ends, exposures) - 1
            inside = (ranges >= 0) & (ranges < len(least_depths))
            depths = self.depth_of_lamp(cycles) + self.depth_of_flicker(exposures)
            np.minimum.at(least_depths, ranges[inside], depths[inside])
        return np.asarray(least_depths)


def frequency_axis(transmitter: Transmitter) -> FrequencyAxis:
    """Return the frequency of a light that is varied: a lamp's, a code's, else the light's own."""
    lamp = blinking_lamp(transmitter)
    if lamp is not None and transmitter.light != "pulses":
        return FrequencyAxis("lamp_frequency", lamp.frequency, quantity("lamp_frequency").label)
    if has_chips(transmitter):
        switching = quantity("switching_frequency")
        return FrequencyAxis(switching.name, transmitter.switching_frequency, switching.label)
    frequency = float(1 / light_of(transmitter).period)
    return FrequencyAxis("lamp_frequency", frequency, "Frequency of the light")


def depth_map(scene: Scene) -> DepthMap:
    """Return the smallest depth of a scene's bars in each cell of frequency and exposure."""
    depths = DepthOver.of(scene)
    frequencies, exposures = (
        np.geomspace(*ends, _MAP_CELLS + 1)
        for ends in (quantity(depths.axis.parameter).slider, _MAP_EXPOSURES)
    )
    middles = np.sqrt(frequencies[:-1] * frequencies[1:])
    least = np.stack([depths.least_depths(float(middle), exposures) for middle in middles])
    return DepthMap(
        depths.axis, frequencies, exposures, least, depths.period if depths.lamp_bound else 0.0
    )


@lru_cache(maxsize=16)
def _swings(waveform: Waveform) -> tuple[FloatArray, FloatArray]:
    """Return exposures up to a period, in units, and the range of the light in each."""
    if waveform.has_equal_pieces:
        nodes, swing = np.arange(waveform.period + 1.0), _swings_of_units(waveform)
    else:
        nodes, swing = _swings_of_pieces(waveform)
    swing.flags.writeable = False
    return nodes, swing


def _swings_of_units(waveform: Waveform) -> FloatArray:
    """Return the range of the light in exposures of 0, 1, ... units, for pieces of equal length."""
    level = waveform.levels
    if level.dtype == object:
        level = level.astype(np.float64)
    period = len(level)
    before = np.concatenate([[0], np.cumsum(np.tile(level, 2))])
    # Light inside and outside an exposure complement each other: the halves are symmetric.
    half = [float(np.ptp(before[k : k + period] - before[:period])) for k in range(period // 2 + 1)]
    swing = np.empty(period + 1)
    swing[: len(half)] = half
    swing[period - len(half) + 1 :] = half[::-1]
    return swing


def _swings_of_pieces(waveform: Waveform) -> tuple[FloatArray, FloatArray]:
    """Return exposures and the range of the light in each, for pieces of any lengths.

    Few pieces have a node at the difference of any two edges, between which the range is convex.
    Many are evaluated on a grid, between whose nodes the range grows at most by the largest step
    of light per unit of time.
    """
    period, levels = float(waveform.period), waveform.levels.astype(np.float64)
    edges = np.concatenate([[0.0], np.cumsum(waveform.lengths.astype(np.float64))])
    edges[-1] = period
    before = np.concatenate([[0.0], np.cumsum(levels * np.diff(edges))])

    def swing(length: float) -> float:
        ends = np.concatenate([edges + length, edges - length])
        light = np.interp(ends % period, edges, before) + before[-1] * (ends // period)
        return float(np.ptp(np.abs(light - np.tile(before, 2))))

    if len(levels) <= _MOST_PIECES:
        nodes = np.unique((edges - edges[:, None]) % period)
        nodes = np.append(nodes, period)
        return nodes, np.array([0.0, *map(swing, nodes[1:-1].tolist()), 0.0])
    nodes = np.linspace(0.0, period, _GRID + 1)
    values = np.array([0.0, *map(swing, nodes[1:-1].tolist()), 0.0])
    # The highest place between two nodes, where lines of the largest slope meet.
    slope, step = float(np.ptp(levels)), period / _GRID
    rise = 0.5 * np.diff(values) / slope
    between = nodes[:-1] + 0.5 * step + rise
    highest = values[:-1] + slope * (0.5 * step + rise)
    order = np.argsort(np.concatenate([nodes, between]), kind="stable")
    return (np.concatenate([nodes, between])[order], np.concatenate([values, highest])[order])
