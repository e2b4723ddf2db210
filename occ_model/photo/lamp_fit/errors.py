"""Standard deviations of what is read from a lamp's stripes."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamp_fit.cues import Cues
from occ_model.photo.lamp_fit.fit import LampFit
from occ_model.photo.lamp_fit.model import PERIOD, PLACE, RAMP, WIDTH
from occ_model.photo.lamp_fit.readings import StripeReading

_EDGE_ERROR, _EDGES_BEFORE = 0.03, 4.0
"""Prior deviation in columns by which processing moves an edge, and its weight in edges. These, and
the numbers below, were set on 420 simulated lamps."""
_VIEW_ERROR = 0.01  # columns, of all periods in view together
_WIDTH_ERROR, _RAMP_ERROR = 0.07, 0.1  # columns, by blur and sharpening that the model lacks
_TONE_ERROR = 0.006  # of the ramp, by tone curves that the model lacks
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

    ``hidden_group``: columns that may have been read together, at least 1. Steeper edges than that
    may lie anywhere within.
    """
    wave = fit.wave
    scale = _scale(cues)
    deviations = scale * np.sqrt(np.maximum(np.diag(fit.covariance), 0.0))
    of_group = _UNKNOWN * max(0.0, hidden_group - wave.ramp_columns - 2.0 * wave.blur)
    of_view = math.hypot(_VIEW_ERROR, of_group) / len(fit.profile.values)
    width, ramp = _shape_errors(fit, scale, of_group)
    return ReadingErrors(
        period=wave.period * math.hypot(float(deviations[PERIOD]), of_view),
        place=math.hypot(float(deviations[PLACE]), of_group),
        width=width,
        ramp=ramp,
    )


def _scale(cues: Cues) -> float:
    """Return by which factor edges deviate more from even spacing than by their noise, at least 1.

    A few edges determine it badly, so that it is combined with a prior.
    """
    freedom = max(cues.edges - 3, 1)
    before = cues.scatter_noise**2 + _EDGE_ERROR**2
    variance = freedom * cues.scatter**2 + _EDGES_BEFORE * before
    deviation = math.sqrt(variance / (freedom + _EDGES_BEFORE))
    return max(1.0, deviation / max(cues.scatter_noise, 1e-9))


def _shape_errors(fit: LampFit, scale: float, of_group: float) -> tuple[float, float]:
    """Return the deviations of width and ramp, as fractions of a period."""
    wave = fit.wave
    width, ramp = wave.width, wave.ramp
    smaller = min(width, 1.0 - width)
    slope = width * (1.0 - width)
    by_width = np.array([slope, 0.0])
    sign = 1.0 if width < 0.5 else -1.0
    by_ramp = np.array([sign * ramp * slope, smaller * ramp * (1.0 - ramp)])
    covariance: FloatArray = fit.covariance[np.ix_([WIDTH, RAMP], [WIDTH, RAMP])]
    of_tone = _TONE_ERROR * wave.ramp_columns
    of_width, of_ramp = (
        math.sqrt(
            scale**2 * max(float(each @ covariance @ each), 0.0)
            + (of_processing**2 + of_tone**2 + of_group**2) / wave.period**2
        )
        for each, of_processing in ((by_width, _WIDTH_ERROR), (by_ramp, _RAMP_ERROR))
    )
    return min(of_width, _UNKNOWN), min(of_ramp, _UNKNOWN * smaller)
