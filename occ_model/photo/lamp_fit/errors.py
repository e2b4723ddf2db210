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

_SCATTER_WEIGHT = 0.35  # factor on the sum of the variances by noise and by the edges' scatter
_FEW_EDGES = 14.0  # number of edges for which the variance by their scatter is doubled
_LEAST_FREEDOM = 0.2  # least fraction of a column's residual that the fit leaves
_EDGE_SHIFT, _RAMP_SHIFT = 11.0, 18.0
"""Errors in columns that all edges have in common, and of a ramp's length, in proportion to the
residual over the stripes' height."""
_MOST_PROCESSED = 0.6
"""Largest blur in columns that image processing causes. More blur is of a lamp that lights up and
goes out slowly, and not alike: its edges and their lengths may be off by as much."""
_UNKNOWN = math.sqrt(1.0 / 12.0)  # standard deviation of an unknown number from 0 to 1


@dataclass(frozen=True, slots=True)
class ReadingErrors:
    """Standard deviations; of width and ramp as fractions of a period, else in columns."""

    period: float
    place: float
    width: float
    ramp: float

    def shape_errors(self, one: StripeReading) -> tuple[float, float]:
        """Return the errors of a reading's duty and exposure."""
        return (self.width, self.ramp) if one.is_width_of_pulses else (self.ramp, self.width)


def errors_of(fit: LampFit, cues: Cues, hidden_group: float) -> ReadingErrors:
    """Return the errors of a fit.

    ``hidden_group``: number of columns that the sensor may have read together, at least 1. An edge
    that is steeper may lie anywhere in the part of a group in which no other edge is seen.
    """
    wave = fit.wave
    free = _largest_gap(fit, hidden_group)
    hidden = _UNKNOWN * max(0.0, hidden_group * free - wave.ramp_columns - 2.0 * wave.blur)
    period, place, width, ramp = np.sqrt(_variances(fit))
    of_all_columns = math.hypot(_EDGE_SHIFT * cues.unexplained * free**2, hidden)
    slow = math.sqrt(max(cues.blur**2 - _MOST_PROCESSED**2, 0.0))
    of_edges, of_ramps = (
        math.hypot(each * cues.unexplained, hidden, slow) / wave.period
        for each in (_EDGE_SHIFT, _RAMP_SHIFT)
    )
    smaller = min(wave.width, 1.0 - wave.width)
    return ReadingErrors(
        period=wave.period * math.hypot(period, of_all_columns / len(fit.profile.values)),
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
    """Return the variances of the quantities of `_directions`, by noise and by the edges' scatter.

    Processing changes all columns of an edge in common: their residuals, as they would be if the
    fit had not followed them, are added before they are squared (Liang and Zeger, Biometrika
    73:13, 1986).
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
    by_edges = _SCATTER_WEIGHT * both * (1.0 + _FEW_EDGES * of_few)
    return np.asarray(np.where(of_few > 0.0, by_edges, by_noise), dtype=np.float64)


def _largest_gap(fit: LampFit, group: float) -> float:
    """Return the largest fraction of a group of columns in which no edge lies in any group.

    It is taken for the rising and for the falling edges; the smaller one is returned.
    """
    wave, last = fit.wave, len(fit.profile.values) - 1
    gaps = [1.0]
    for side in (-0.5, 0.5):
        first = (wave.place + side * wave.width * wave.period) % wave.period
        places = np.sort(np.arange(first, last, wave.period) / group % 1.0)
        if len(places):
            gaps.append(float(np.diff(places, append=places[0] + 1.0).max()))
    return min(gaps)
