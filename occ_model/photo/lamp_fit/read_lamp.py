"""Read a lamp's period, place, duty and exposure from a place in a photo."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import MatchError
from occ_model.photo.lamp_fit.cues import Cues, cues_of
from occ_model.photo.lamp_fit.fit import LampFit, fit_lamp
from occ_model.photo.lamp_fit.model import PERIOD, PLACE, RAMP, WIDTH
from occ_model.photo.lamp_fit.periods import likely_periods
from occ_model.photo.lamp_fit.place import LampPlace
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.verdict import doubts, refusals

_OTHER_PERIOD = 0.03  # relative difference from which a fit has another period
_EDGE_ERROR, _EDGES_BEFORE = 0.03, 4.0
"""Columns by which processing moves an edge, as is believed before, and of how many edges' weight
that is. These, and the factors below, were set on 320 simulated lamps."""
_PERIOD_FACTOR = 1.5  # of deviations, as what processing does is alike from one column to the next
_WIDTH_ERROR, _RAMP_ERROR = 0.03, 0.13  # columns, by blur and sharpening that the model lacks
_TONE_ERROR = 0.01  # of the ramp, by tone curves that the model lacks
_LEAST_COLUMNS = 16
_UNKNOWN = math.sqrt(1.0 / 12.0)  # deviation of what may be anything from 0 to 1
_PERIODS = 2  # of the likely ones, of which multiples are tried, too
_BANDS = 6  # of rows, whose phases are compared


@dataclass(frozen=True, eq=False, slots=True)
class LampReading:
    """A lamp's stripes as they were read.

    Parameters
    ----------
    place, profile
        Its pixels, and the mean of each column.
    fit, cues
        The model, and what was measured on it.
    period_error, place_error
        Standard deviations in columns.
    width, ramp, width_error, ramp_error
        Of the stripes, as fractions of a period.
    """

    place: LampPlace
    profile: LampProfile
    lines_at_once: int  # that the sensor reads together
    step: int  # columns of the photo for each of the fit
    first: int  # the first of them, in the place's region
    fit: LampFit
    cues: Cues
    period_error: float
    place_error: float
    width: float
    ramp: float
    width_error: float
    ramp_error: float
    gap: float
    other_period: float | None

    @property
    def period(self) -> float:
        """Columns of the photo from one stripe to the next."""
        return self.fit.wave.period * self.step

    @property
    def column(self) -> float:
        """Column of the place's region at which the middle of a stripe is."""
        return float(self._of_photo(np.array(self.fit.wave.place)))

    def _of_photo(self, column: FloatArray) -> FloatArray:
        """Return where columns of the fit are in the place's region."""
        return np.asarray(self.first + self.step * (column + 0.5) - 0.5)

    @property
    def levels(self) -> FloatArray:
        """The model in every column of the place's region, in fractions of white."""
        return self._spread(self.fit.levels)

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The levels of dark and of lit columns, there."""
        dark, lit = self.fit.ends
        return self._spread(dark), self._spread(lit)

    def _spread(self, values: FloatArray) -> FloatArray:
        places = self._of_photo(self.fit.profile.columns)
        return np.asarray(np.interp(np.arange(self.place.region.columns), places, values))

    def reasons(self, *, has_note: bool) -> list[str]:
        return doubts(self.cues, self.gap, self.other_period, has_note)


def read_lamp(
    place: LampPlace, *, is_linear: bool, check: Callable[[], object] = lambda: None
) -> LampReading:
    """Fit a lamp's stripes; ``check`` as in :func:`fit_lamp`.

    Raises
    ------
    MatchError
        There are none, or they are no lamp's.
    """
    whole = LampProfile.of(place.pixels, place.shown)
    together, first = whole.lines_at_once()
    profile = whole.averaged(together, first)
    periods = likely_periods(profile.values, _PERIODS)
    if len(profile.values) < _LEAST_COLUMNS or not periods:
        raise MatchError("No period of stripes is found in it.")
    more = profile.reduction(0.5 * min(periods))
    profile, step = profile.averaged(more, 0), together * more
    bands = _bands(place, step, first)
    starts = [each / more for each in periods]
    ranked = fit_lamp(profile, starts, is_linear=is_linear, check=check)
    if not ranked:
        raise MatchError("No period of stripes is found in it.")
    fit, cues = ranked[0], cues_of(ranked[0], bands)
    if problems := refusals(cues):
        raise MatchError(*problems)
    others = [
        (fit.score - other.score, other.wave.period)
        for other in ranked[1:]
        if abs(other.wave.period / fit.wave.period - 1.0) > _OTHER_PERIOD
    ]
    gap, other_period = min(others, default=(math.inf, None))
    deviations = np.sqrt(np.maximum(np.diag(fit.covariance), 0.0))
    scale = _scale(cues)
    of_edges = _PERIOD_FACTOR * scale * deviations
    width_error, ramp_error = _shape_errors(fit, scale)
    return LampReading(
        place=place,
        profile=whole,
        lines_at_once=together,
        step=step,
        first=first,
        fit=fit,
        cues=cues,
        period_error=fit.wave.period * float(of_edges[PERIOD]),
        place_error=float(of_edges[PLACE]),
        width=fit.wave.width,
        ramp=fit.wave.ramp_columns / fit.wave.period,
        width_error=width_error,
        ramp_error=ramp_error,
        gap=gap,
        other_period=other_period,
    )


def _bands(place: LampPlace, step: int, first: int) -> FloatArray:
    """Return profiles of bands of rows, all columns of which show the lamp, shape (bands, n)."""
    whole = np.flatnonzero(place.shown.all(axis=1))
    rows = place.pixels[whole if len(whole) >= _BANDS else slice(None)]
    groups = np.array_split(rows, min(_BANDS, len(rows)))
    bands = np.stack([group.mean(axis=0, dtype=np.float64) for group in groups])
    last = first + (bands.shape[1] - first) // step * step
    return np.asarray(bands[:, first:last].reshape(len(bands), -1, step).mean(axis=2))


def _scale(cues: Cues) -> float:
    """Return the deviation of edges from even spacing, in those that their noise makes.

    Of few edges it is known badly, so that it is joined with what is believed before.
    """
    freedom = max(cues.edges - 3, 1)
    before = cues.scatter_noise**2 + _EDGE_ERROR**2
    variance = freedom * cues.scatter**2 + _EDGES_BEFORE * before
    return math.sqrt(variance / (freedom + _EDGES_BEFORE)) / max(cues.scatter_noise, 1e-9)


def _shape_errors(fit: LampFit, scale: float) -> tuple[float, float]:
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
            + (of_processing**2 + of_tone**2) / wave.period**2
        )
        for each, of_processing in ((by_width, _WIDTH_ERROR), (by_ramp, _RAMP_ERROR))
    )
    return min(of_width, _UNKNOWN), min(of_ramp, _UNKNOWN * smaller)
