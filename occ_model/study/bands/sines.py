"""The sines of a repeated light, and the time after which it repeats."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.light.waveform import Waveform
from occ_model.scene.scene import Transmitter
from occ_model.transmitter.scheme import shortest_period

_MOST_TERMS = 4_000_000  # sines times pieces that are added up for pieces of unequal lengths


@dataclass(frozen=True, eq=False, slots=True)
class Sines:
    """The sines of a transmitter's light, including its LED's edges."""

    base: Fraction  # Frequency of the first in Hz
    # Shapes (n,): multiples of the first, and amplitudes, 1 being the panel fully lit
    orders: IndexArray
    amplitudes: FloatArray

    @property
    def frequencies(self) -> FloatArray:
        """Frequencies in Hz."""
        return np.asarray(float(self.base) * self.orders)

    def in_exposure(self, seconds: Fraction) -> FloatArray:
        """Return the amplitudes after averaging over an exposure."""
        periods = self.base * seconds
        # Whole periods are subtracted before the sine.
        swing = np.abs(np.sin(np.pi * self.orders * float(periods % 1)))
        return np.asarray(self.amplitudes * (swing / (np.pi * self.orders * float(periods))))


def sines_of(transmitter: Transmitter, per_piece: int, highest: float = math.inf) -> Sines:
    """Return the sines of a light.

    ``per_piece``: maximum number of sines per duration of the shortest piece. ``highest``: maximum
    frequency in Hz.
    """
    light, edge = light_of(transmitter), Fraction(transmitter.edge_time)
    if isinstance(light, Cosine):
        amplitude = light.depth * abs(light.response(edge))
        return Sines(Fraction(light.frequency), np.ones(1, dtype=np.int64), np.array([amplitude]))
    waveform, base = light.waveform, 1 / light.period
    pieces = float(waveform.period / min(waveform.lengths))
    count = min(per_piece * pieces, highest / float(base))
    if not waveform.has_equal_pieces:
        count = min(count, _MOST_TERMS / waveform.period)
    orders = np.arange(1, int(count) + 1)
    edge_periods = float(edge * base)
    return Sines(
        base, orders, _sharp_sines(waveform, orders) * np.abs(np.sinc(orders * edge_periods))
    )


def _sharp_sines(waveform: Waveform, orders: IndexArray) -> FloatArray:
    """Return the amplitudes of the sines of a light with sharp edges."""
    period = waveform.period
    levels = waveform.levels.astype(np.float64)
    if waveform.has_equal_pieces:
        amplitudes = 2.0 * np.abs(np.fft.fft(levels))[orders % period] / period
        return np.asarray(amplitudes * np.abs(np.sinc(orders / period)))
    lengths = (waveform.lengths / period).astype(np.float64)
    middles = np.cumsum(lengths) - 0.5 * lengths
    total = np.zeros(len(orders), dtype=complex)
    for level, length, middle in zip(levels - levels.min(), lengths, middles, strict=True):
        if level:
            phasors = np.exp(-2j * np.pi * (orders * middle % 1.0))
            total += level * length * np.sinc(orders * length) * phasors
    return np.asarray(2.0 * np.abs(total))


def repeat_time(transmitter: Transmitter) -> Fraction:
    """Return the period of a transmitter's light in seconds; 0 if it is steady."""
    light = light_of(transmitter)
    if isinstance(light, Cosine):
        return light.period if light.depth else Fraction(0)
    return repeat_units(light.waveform) / light.rate


def repeat_units(waveform: Waveform) -> int:
    """Return the period of a light in units of its waveform; 0 if it is steady."""
    levels, lengths = waveform.levels, waveform.lengths
    if (levels == levels[0]).all():
        return 0
    return math.lcm(shortest_period(levels), shortest_period(lengths))
