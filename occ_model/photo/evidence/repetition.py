"""Whether what an explanation leaves of the stripes still repeats."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

_OWN_HARMONICS = 2  # harmonics of the pattern itself, in numbers of its chips
_LINE_BINS = 2  # half-width of a spectral line in bins: that of a Hann window

_NEIGHBOURS = (-4, -3, 3, 4)
"""Distances to the harmonics that a harmonic is compared with: an error at the edges appears in all
of them. The nearest ones may be sidebands of a light that the pattern modulates."""

_MOST_POWER_RATIO = 4.0  # ratio of powers up to which neighbouring harmonics have the same cause
_LEAST_COLUMNS = 64  # minimum number of columns for a spectrum
_LEAST_CYCLES = 6  # minimum number of periods in view; slower changes are uneven light


@dataclass(frozen=True, slots=True)
class Repetition:
    """The strongest line in the spectrum of a residual."""

    period: float
    # Half the difference of its crests and troughs, as a fraction of the stripes' swing.
    amplitude: float
    above_noise: float  # its power over that of the noise around it
    share: float  # its fraction of the residual's power


def strongest_line(
    residual: FloatArray, swing: FloatArray, pattern_period: float, chips: int
) -> Repetition | None:
    """Find the strongest line of a residual beside the explained pattern's own harmonics.

    The swing is the height of the stripes, the pattern's period is in columns. There is no line
    where there are too few columns.

    The periodogram of white noise has an exponential distribution (Schuster, Terrestrial Magnetism
    3:13, 1898), whose median is ln 2 times its mean: from it the noise around a line is known. A
    sine of the amplitude A has the peak (A sum(w) / 2)^2 under the window w.
    """
    columns = len(residual)
    if columns < _LEAST_COLUMNS:
        return None
    window = np.hanning(columns)
    relative = residual / np.maximum(swing, 1.0)
    power = np.abs(np.fft.rfft(window * (relative - relative.mean()))) ** 2
    possible = np.arange(len(power)) >= _LEAST_CYCLES
    for place, beside in _harmonics(power, columns / pattern_period, _OWN_HARMONICS * chips):
        around = slice(max(0, place - _LINE_BINS), place + _LINE_BINS + 1)
        possible[around] &= power[around] > beside
    if not possible.any():
        return None
    line = int(np.where(possible, power, 0.0).argmax())
    around = slice(max(1, line // 2), 2 * line + 2 * _LEAST_CYCLES)
    noise = max(float(np.median(power[around])) / math.log(2.0), 1e-12)
    amplitude = 2.0 * float(np.sqrt(power[line])) / float(window.sum())
    own = float(power[max(0, line - _LINE_BINS) : line + _LINE_BINS + 1].sum())
    share = own / max(float(power.sum()), 1e-300)
    return Repetition(columns / line, amplitude, float(power[line] / noise), share)


def _harmonics(power: FloatArray, first: float, own: int) -> list[tuple[int, float]]:
    """Return the bin of each harmonic of the pattern, and the power that it may have by itself."""
    places = [round(number * first) for number in range(1, int((len(power) - 1) / first) + 1)]
    strongest = [
        float(power[max(0, place - _LINE_BINS) : place + _LINE_BINS + 1].max()) for place in places
    ]
    return [
        (
            place,
            np.inf
            if index < own
            else _MOST_POWER_RATIO
            * max(
                (strongest[index + step] for step in _NEIGHBOURS if index + step < len(places)),
                default=0.0,
            ),
        )
        for index, place in enumerate(places)
    ]
