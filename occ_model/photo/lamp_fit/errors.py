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
_LEAST_FREEDOM = 0.2  # of a column, whose residual a fit follows
_EDGE_SHIFT, _RAMP_SHIFT = 11.0, 18.0
"""Columns by which all edges alike, and a ramp's length, may be off, if the levels' misfit were all
of the stripes' height."""
_MOST_PROCESSED = 0.6
"""Columns up to which blur is processing's. By what is more, edges and their lengths may be off: a
lamp that is slow to light up follows no normal law, and goes out in another way."""
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
    period, place, width, ramp = np.sqrt(_variances(fit))
    of_view = math.hypot(_EDGE_SHIFT * cues.unexplained * free**2, hidden)
    slow = math.sqrt(max(cues.blur**2 - _MOST_PROCESSED**2, 0.0))
    of_edges, of_ramps = (
        math.hypot(each * cues.unexplained, hidden, slow) / wave.period
        for each in (_EDGE_SHIFT, _RAMP_SHIFT)
    )
    smaller = min(wave.width, 1.0 - wave.width)
    return ReadingErrors(
        period=wave.period * math.hypot(period, of_view / len(fit.profile.values)),
        place=math.hypot(place, hidden),
        width=min(math.hypot(width, of_edges), _UNKNOWN),
        ramp=min(math.hypot(ramp, of_ramps), _UNKNOWN * smaller),
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


def _variances(fit: LampFit) -> FloatArray:
    """Return the variances of what `_directions` tells, by noise and by each edge's own errors.

    What processing does to an edge, its columns share: an edge's residuals are added first (the
    estimate of Liang and Zeger, Biometrika 73:13, 1986), as if the fit had not followed them.
    """
    slopes, directions = fit.slopes, _directions(fit)
    followed = slopes @ fit.inverse
    leverages = np.einsum("ij,ij->i", followed, slopes)
    freedom = np.maximum(1.0 - leverages, _LEAST_FREEDOM)
    unfitted = fit.residual / (fit.noise * np.sqrt(freedom))
    responses = followed @ directions.T
    edges = np.floor(2.0 * (fit.profile.columns - fit.wave.place) / fit.wave.period)
    first = np.flatnonzero(np.diff(edges, prepend=edges[0] - 1.0))  # column of each edge
    shifts = np.add.reduceat(responses * unfitted[:, None], first)
    shares = np.add.reduceat(responses**2, first)
    by_noise = np.einsum("ij,jk,ik->i", directions, fit.covariance, directions)
    both = np.sum(shifts**2, axis=0) + by_noise
    of_few = np.sum(shares**2, axis=0) / np.maximum(np.sum(shares, axis=0) ** 2, 1e-300)
    by_edges = _SPREAD * both * (1.0 + _FEW_EDGES * of_few)
    return np.asarray(np.where(of_few > 0.0, by_edges, by_noise), dtype=np.float64)


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
