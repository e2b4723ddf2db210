"""Measure the frequency of a lamp that sends no code, from the stripes in its picture."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import inflect
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.photo.stripes.period import refine_period, unrepeated_fraction
from occ_model.room.room import RoomLamp
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.units import HERTZ, PERCENT

_LEAST_CYCLES = 2.0  # of the light in a lamp's columns
_MOST_ALIASES = 3  # harmonics that are fitted where columns resolve fewer
_MOST_UNREPEATED = 0.25  # fraction of the stripes' variance that no repeated light explains
_MOST_DEVIATIONS = 5.0  # between a measured frequency and that of the lamp
_LEAST_COLUMNS = 8
_EDGE = 0.075  # standard error of the width in columns, as they sample edges coarsely; measured
_SHIFT = 0.1  # standard error in cycles by a harmonic that looks almost like the first
_MOST_ERROR = 0.01  # of the frequency; other lamps may be as near
_FINEST = 0.48  # cycles a column above which a light cannot be told from a slower one
_OVERSAMPLING = 8  # of the spectrum in which the strongest frequency is searched


@dataclass(frozen=True, slots=True)
class MeasuredFrequency:
    """A frequency up to half that of the columns, and its standard error, in Hz."""

    value: float
    error: float
    period: float  # columns

    @property
    def words(self) -> str:
        return HERTZ.format_estimate(self.value, self.error)

    def is_of(self, lamp: RoomLamp, readout_time: float) -> bool:
        """Return whether a lamp's light can have this frequency in a picture."""
        cycles = _frequencies_of(lamp) * readout_time
        seen = np.abs(cycles - np.rint(cycles)) / readout_time
        return bool((np.abs(seen - self.value) <= _MOST_DEVIATIONS * self.error).any())


def sends_code(lamp: RoomLamp) -> bool:
    """Return whether a lamp is named by its code, and not by its frequency."""
    return lamp.transmitter.light == "code" and blinking_lamp(lamp.transmitter) is None


def _frequencies_of(lamp: RoomLamp) -> FloatArray:
    """Return the frequencies one of which is the strongest in a lamp's stripes, in Hz.

    Of light with one symmetric pulse a cycle it is the first, whatever the tone curve: such light
    is a sum of centred rectangles, and a sine's k-th multiple is at most k times as large.
    """
    light = light_of(lamp.transmitter)
    if isinstance(light, Cosine):
        return np.array([light.frequency])
    single = blinking_lamp(lamp.transmitter) is not None
    return np.arange(1, 2 if single else light.waveform.period + 1) / float(light.period)


def measure_frequency(signal: FloatArray, readout_time: float) -> MeasuredFrequency | str:
    """Measure how often the light of a lamp's columns repeats, or say why that is not known."""
    count, scale = len(signal), float(signal.std())
    if count < _LEAST_COLUMNS:
        return f"only {inflect(count, 'column')} show its whole height."
    if not scale:
        return "its light shows no stripes."
    column = np.arange(count)
    values = (signal - np.polynomial.Polynomial.fit(column, signal, 1)(column)) / scale
    strengths = np.abs(np.fft.rfft(values, _OVERSAMPLING * count))
    first, last = _OVERSAMPLING, int(_FINEST * _OVERSAMPLING * count)  # from one cycle on
    strongest = first + int(strengths[first:last].argmax())
    harmonics = _distinct_harmonics(count, _OVERSAMPLING * count / strongest)
    near = _OVERSAMPLING * count / (strongest + np.linspace(-2.0, 2.0, 9))
    rough = min(near.tolist(), key=lambda one: unrepeated_fraction(values, one, harmonics))
    period, deviation = refine_period(values, rough, harmonics)
    if unrepeated_fraction(values, period, harmonics) > _MOST_UNREPEATED:
        return "its light shows no stripes that repeat."
    if count < _LEAST_CYCLES * period:
        return (
            f"its {inflect(count, 'column')} show {count / period:.1f} cycles of its light; at "
            f"least {_LEAST_CYCLES:g} are needed."
        )
    cycles = 1.0 / period
    error = cycles * math.hypot(deviation / period, _EDGE / count)
    if harmonics < _MOST_ALIASES:
        error = math.hypot(error, _SHIFT / count)
    if error > _MOST_ERROR * cycles:
        return f"it is determined to {PERCENT.format(error / cycles, 2)} only."
    return MeasuredFrequency(cycles / readout_time, error / readout_time, period)


def _distinct_harmonics(count: int, period: float) -> int:
    """Return the number of first harmonics whose frequencies differ as columns sample them."""
    cycles = np.arange(_MOST_ALIASES + 1) * (count / period)
    seen = np.abs(cycles - count * np.rint(cycles / count))  # in the columns together
    for number in range(2, _MOST_ALIASES + 1):
        others = [*seen[:number], count / 2.0]
        if min(abs(seen[number] - other) for other in others) < _LEAST_CYCLES:
            return number - 1
    return _MOST_ALIASES
