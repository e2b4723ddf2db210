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

_MIN_CYCLES = 2.0  # of the light in a lamp's columns
_MAX_HARMONICS = 3  # harmonics that are fitted
_MAX_UNREPEATED = 0.25  # fraction of the stripes' variance that no periodic light explains
_MAX_DEVIATIONS = 5.0  # between a measured frequency and that of the lamp, in standard errors
_MIN_COLUMNS = 8
_EDGE_ERROR = 0.075  # measured standard error of the width in columns, which sample edges coarsely
_ALIAS_ERROR = 0.1  # standard error in cycles due to a harmonic with nearly the same alias
_MAX_ERROR = 0.01  # fraction of the frequency; other lamps may be as close
_MAX_FREQUENCY = 0.48  # cycles a column, above which light looks like slower light
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
        aliases = np.abs(cycles - np.rint(cycles)) / readout_time
        return bool((np.abs(aliases - self.value) <= _MAX_DEVIATIONS * self.error).any())


def _frequencies_of(lamp: RoomLamp) -> FloatArray:
    """Return the frequencies in Hz that can be the strongest in a lamp's stripes.

    For light with one symmetric pulse a cycle it is the fundamental, whatever the tone curve: such
    light is a sum of centred rectangles, and |sin(k x)| is at most k |sin(x)|.
    """
    light = light_of(lamp.transmitter)
    if isinstance(light, Cosine):
        return np.array([light.frequency])
    has_one_pulse = blinking_lamp(lamp.transmitter) is not None
    return np.arange(1, 2 if has_one_pulse else light.waveform.period + 1) / float(light.period)


def measure_frequency(signal: FloatArray, readout_time: float) -> MeasuredFrequency | str:
    """Measure how often the light in a lamp's columns repeats, or say why it is unknown."""
    count, scale = len(signal), float(signal.std())
    if count < _MIN_COLUMNS:
        return f"only {inflect(count, 'column')} show its full height."
    if not scale:
        return "its light shows no stripes."
    column = np.arange(count)
    values = (signal - np.polynomial.Polynomial.fit(column, signal, 1)(column)) / scale
    strengths = np.abs(np.fft.rfft(values, _OVERSAMPLING * count))
    first, last = _OVERSAMPLING, int(_MAX_FREQUENCY * _OVERSAMPLING * count)  # from one cycle on
    strongest = first + int(strengths[first:last].argmax())
    harmonics = _distinct_harmonics(count, _OVERSAMPLING * count / strongest)
    candidates = _OVERSAMPLING * count / (strongest + np.linspace(-2.0, 2.0, 9))
    rough_period = min(
        candidates.tolist(), key=lambda period: unrepeated_fraction(values, period, harmonics)
    )
    period, deviation = refine_period(values, rough_period, harmonics)
    if unrepeated_fraction(values, period, harmonics) > _MAX_UNREPEATED:
        return "its light shows no stripes that repeat."
    if count < _MIN_CYCLES * period:
        return (
            f"its {inflect(count, 'column')} show {count / period:.1f} cycles of its light; at "
            f"least {_MIN_CYCLES:g} are needed."
        )
    cycles = 1.0 / period
    error = cycles * math.hypot(deviation / period, _EDGE_ERROR / count)
    if harmonics < _MAX_HARMONICS:
        error = math.hypot(error, _ALIAS_ERROR / count)
    if error > _MAX_ERROR * cycles:
        return f"it is determined to {PERCENT.format(error / cycles, 2)} only."
    return MeasuredFrequency(cycles / readout_time, error / readout_time, period)


def _distinct_harmonics(count: int, period: float) -> int:
    """Return the number of lowest harmonics whose frequencies differ after sampling by columns."""
    cycles = np.arange(_MAX_HARMONICS + 1) * (count / period)
    aliases = np.abs(cycles - count * np.rint(cycles / count))  # cycles over all columns
    for number in range(2, _MAX_HARMONICS + 1):
        others = [*aliases[:number], count / 2.0]
        if min(abs(aliases[number] - other) for other in others) < _MIN_CYCLES:
            return number - 1
    return _MAX_HARMONICS
