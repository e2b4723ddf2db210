"""The light of a transmitter of any kind, from its parameters in exact arithmetic.

It is apart from the program's own light, and takes a loop over the pieces of a period.
"""

from bisect import bisect_right
from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate, pairwise

import mpmath
import numpy as np

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene

_DIGITS = 40

OTHER_LIGHTS: dict[str, dict[str, float | str]] = {  # changes of a scene, by what it then sends
    "lamp": {"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3},
    "mains": {"light": "mains", "mains_frequency": 50.0, "mains_depth": 0.4},
    "levels": {"light": "waveform", "levels": "0 1 2 3 / 3", "switching_frequency": 8e3},
    "recorded": {"light": "waveform", "waveform_file": "0,0.2\n1e-4,0.7\n3e-4,1\n1e-3\n"},
    "pulses": {"light": "pulses", "pulse_frequency": 60.0, "pulse_length": 500e-6},
}


class ExactPieces:
    """A light that repeats, constant on each piece, and its integral from the time 0."""

    def __init__(self, levels: Sequence[Fraction], lengths: Sequence[Fraction]) -> None:
        self.levels, self.lengths = levels, lengths
        self.edges = list(accumulate(lengths, initial=Fraction(0)))
        self.period = self.edges[-1]
        light = (level * length for level, length in zip(levels, lengths, strict=True))
        self._integral = list(accumulate(light, initial=Fraction(0)))
        self.mean = self._integral[-1] / self.period

    def until(self, time: Fraction) -> Fraction:
        periods, since = divmod(time, self.period)
        piece = bisect_right(self.edges, since) - 1  # the last edge at or before the time
        part = (since - self.edges[piece]) * self.levels[piece]
        return periods * self._integral[-1] + self._integral[piece] + part


class ExactLight:
    """The light of a scene, whose mean over any time is exact: 1 is the panel fully lit."""

    def __init__(self, scene: Scene) -> None:
        self._scene, self._sent = scene, scene.transmitter
        if self._sent.light != "mains":
            self._pieces = ExactPieces(*_pieces(scene))

    def mean(self, start: Fraction, step: Fraction, count: int) -> FloatArray:
        """Return the mean light of exposures that start in equal steps, in seconds."""
        length = Fraction(self._scene.camera.exposure_time)
        mean = self._mean_of_cosine if self._sent.light == "mains" else self._mean_of_pieces
        return np.array([float(mean(start + n * step, length)) for n in range(count)])

    def of_columns(self) -> FloatArray:
        """Return the mean light of each column's exposure."""
        camera = self._scene.camera
        start = Fraction(self._scene.model.start_time)
        return self.mean(start, Fraction(camera.readout_time), camera.columns)

    def _mean_of_pieces(self, start: Fraction, length: Fraction) -> Fraction:
        return (self._pieces.until(start + length) - self._pieces.until(start)) / length

    def _mean_of_cosine(self, start: Fraction, length: Fraction) -> mpmath.mpf:
        """Return 1 + m (sin(2 pi b) - sin(2 pi a)) / (2 pi (b - a)), a and b being the cycles."""
        cycles = 2 * Fraction(self._sent.mains_frequency)
        with mpmath.workdps(_DIGITS):
            first, last = (
                mpmath.mpf(each.numerator) / each.denominator
                for each in ((start * cycles) % 1, (start * cycles) % 1 + length * cycles)
            )
            swing = mpmath.sinpi(2 * last) - mpmath.sinpi(2 * first)
            return 1 + self._sent.mains_depth * swing / (2 * mpmath.pi * (last - first))


def _pieces(scene: Scene) -> tuple[list[Fraction], list[Fraction]]:
    """Return the levels and the lengths in seconds of a period's pieces."""
    sent = scene.transmitter
    if sent.light in ("lamp", "pulses"):
        is_lamp = sent.light == "lamp"
        period = 1 / Fraction(sent.lamp_frequency if is_lamp else sent.pulse_frequency)
        lit = Fraction(sent.duty) * period if is_lamp else Fraction(sent.pulse_length)
        lit = min(lit, period)
        return [Fraction(1), 1 - Fraction(sent.depth if is_lamp else 1)], [lit, period - lit]
    if sent.light == "waveform" and sent.waveform_file:
        rows = [
            [Fraction(float(each)) for each in row.split(",")] for row in sent.waveform_file.split()
        ]
        seconds = [row[0] for row in rows]
        lengths = [last - first for first, last in pairwise(seconds)]
        return [row[1] for row in rows[:-1]], lengths
    if sent.light == "waveform":
        line, _, divisor = sent.levels.partition("/")
        levels = [Fraction(level) / Fraction(divisor.strip() or 1) for level in line.split()]
    else:
        levels = [Fraction(int(chip)) for chip in occ.packet(scene)]
    return levels, [1 / Fraction(sent.switching_frequency)] * len(levels)
