"""Standard deviations of what is read from a lamp's stripes.

Numbers were set on simulated lamps.
"""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamp_fit.cues import Cues
from occ_model.photo.lamp_fit.fit import LampFit
from occ_model.photo.lamp_fit.model import PERIOD, PLACE, RAMP, WIDTH
from occ_model.photo.lamp_fit.readings import StripeReading

_SPREAD = 0.35  # weight of the variances by noise and by edges
_FEW_EDGES = 14.0  # edges of which each tells the others' spread half as well as many do
_PERIOD_SHIFT, _SHAPE_SHIFT = 8.0, 12.0
"""Columns by which all edges alike may be off, if the levels' misfit were all of their swing."""
_TONE_ERROR, _COMMON_PART = 0.014, 0.2
"""Parts of an edge's length by which its stripe's two edges may be off for each deviation of the
tone curve from a usual one, and of that, by which all edges alike may be."""
_UNKNOWN = math.sqrt(1.0 / 12.0)  # deviation of what may be anything from 0 to 1


@dataclass(frozen=True, slots=True)
class ReadingErrors:
    """Standard deviations; of width and ramp as fractions of a period, else in columns."""

    period: float
    place: float
    width: float
    ramp: float

    def of_shape(self, one: StripeReading) -> tuple[float, float]:
        """Return the errors of a reading's duty and exposure."""
        return (self.width, self.ramp) if one.is_width_of_pulses else (self.ramp, self.width)


def errors_of(fit: LampFit, cues: Cues, hidden_group: float) -> ReadingErrors:
    """Return the errors of a fit.

    ``hidden_group``: columns that may have been read together, at least 1. Edges steeper than these
    may lie anywhere between those places within a group at which others are seen.
    """
    wave = fit.wave
    free = _free_part(fit, hidden_group)
    hidden = _UNKNOWN * max(0.0, hidden_group * free - wave.ramp_columns - 2.0 * wave.blur)
    period, place, width, ramp = np.sqrt([_variance(fit, each) for each in _directions(fit)])
    edge = math.hypot(wave.ramp_columns, math.sqrt(12.0) * wave.blur)
    of_tone = _TONE_ERROR * fit.model.tension(fit.values) * edge
    of_view = math.hypot(_PERIOD_SHIFT * cues.unexplained * free**2, hidden, _COMMON_PART * of_tone)
    of_shape = math.hypot(_SHAPE_SHIFT * cues.unexplained, of_tone, hidden) / wave.period
    smaller = min(wave.width, 1.0 - wave.width)
    return ReadingErrors(
        period=wave.period * math.hypot(period, of_view / len(fit.profile.values)),
        place=math.hypot(place, hidden),
        width=min(math.hypot(width, of_shape), _UNKNOWN),
        ramp=min(math.hypot(ramp, of_shape), _UNKNOWN * smaller),
    )


def _directions(fit: LampFit) -> FloatArray:
    """Return the slopes of the period's logarithm, place, width and ramp over the parameters.

    Width and ramp are fractions of a period.
    """
    width, ramp = fit.wave.width, fit.wave.ramp
    slope, smaller = width * (1.0 - width), min(width, 1.0 - width)
    slopes = np.zeros((4, len(fit.values)))
    slopes[[0, 1, 2], [PERIOD, PLACE, WIDTH]] = 1.0, 1.0, slope
    slopes[3, WIDTH] = ramp * slope if width < 0.5 else -ramp * slope
    slopes[3, RAMP] = smaller * ramp * (1.0 - ramp)
    return slopes


def _variance(fit: LampFit, direction: FloatArray) -> float:
    """Return the variance of a combination of parameters, by noise and by each edge's own errors.

    What processing does to an edge, its columns share: an edge's residuals are added first (the
    estimate of Liang and Zeger, Biometrika 73:13, 1986).
    """
    responses = fit.responses @ direction
    halves = 2.0 * (fit.profile.columns - fit.wave.place) / fit.wave.period
    edges = np.floor(halves).astype(int) - math.floor(halves[0])
    shifts = np.bincount(edges, weights=responses * fit.unfitted)
    shares = np.bincount(edges, weights=responses**2)
    total = float(shares.sum())
    if total == 0.0:
        return float(direction @ fit.covariance @ direction)
    effective = total**2 / float(shares @ shares)
    both = float(shifts @ shifts) + float(direction @ fit.covariance @ direction)
    return _SPREAD * both * (1.0 + _FEW_EDGES / effective)


def _free_part(fit: LampFit, group: float) -> float:
    """Return the largest part of a group of columns in which no rising, or no falling, edge lies.

    The smaller of the two.
    """
    wave, last = fit.wave, len(fit.profile.values) - 1
    found = [1.0]
    for side in (-0.5, 0.5):
        first = (wave.place + side * wave.width * wave.period) % wave.period
        places = np.sort(np.arange(first, last, wave.period) / group % 1.0)
        if len(places):
            found.append(float(np.diff(places, append=places[0] + 1.0).max()))
    return min(found)
