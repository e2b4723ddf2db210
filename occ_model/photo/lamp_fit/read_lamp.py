"""Read a lamp's period, place, duty and exposure from a place in a photo."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import MatchError
from occ_model.photo.lamp_fit.cues import Cues, cues_of
from occ_model.photo.lamp_fit.errors import ReadingErrors, errors_of
from occ_model.photo.lamp_fit.fit import LampFit, fit_lamp
from occ_model.photo.lamp_fit.periods import likely_periods
from occ_model.photo.lamp_fit.place import LampPlace
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.verdict import refusals

_OTHER_PERIOD = 0.03  # relative difference from which a fit has another period
_LEAST_COLUMNS = 16
_PERIODS = 2  # likely periods whose multiples are tried, too
_BANDS = 6  # bands of rows whose phases are compared


@dataclass(frozen=True, eq=False, slots=True)
class LampReading:
    """A lamp's stripes as they were read."""

    place: LampPlace
    profile: LampProfile  # Of all columns of the place
    lines_at_once: int  # Number of lines that the sensor reads together
    step: int  # Columns of the photo in each column of the fit
    first: int  # First column of the place's region that is in the fit
    fit: LampFit
    cues: Cues
    errors: ReadingErrors  # Those in columns are in columns of the fit
    gap: float  # Evidence over that of the next best period
    other_period: float | None  # That period, in columns of the fit

    @property
    def period(self) -> float:
        """Columns of the photo from one stripe to the next."""
        return self.fit.wave.period * self.step

    @property
    def column(self) -> float:
        """Column of the place's region at which the middle of a stripe is."""
        return float(self._to_region(np.array(self.fit.wave.place)))

    def _to_region(self, column: FloatArray) -> FloatArray:
        """Return where columns of the fit are in the place's region."""
        return np.asarray(self.first + self.step * (column + 0.5) - 0.5)

    @property
    def levels(self) -> FloatArray:
        """The model in every column of the place's region, in fractions of white."""
        return self._spread(self.fit.levels)

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The levels of dark and of lit columns in every column of the place's region."""
        dark, lit = self.fit.ends
        return self._spread(dark), self._spread(lit)

    def _spread(self, values: FloatArray) -> FloatArray:
        places = self._to_region(self.fit.profile.columns)
        return np.asarray(np.interp(np.arange(self.place.region.columns), places, values))


def read_lamp(
    place: LampPlace, *, is_linear: bool, check: Callable[[], object] = lambda: None
) -> LampReading:
    """Fit a lamp's stripes; ``is_linear`` and ``check`` as in :func:`fit_lamp`.

    Raises
    ------
    MatchError
        There are no stripes, or they are not a lamp's.
    """
    whole = LampProfile.of(place.pixels, place.shown)
    together, first = whole.lines_at_once()
    profile = whole.average(together, first)
    periods = likely_periods(profile.values, _PERIODS)
    if len(profile.values) < _LEAST_COLUMNS or not periods:
        raise MatchError("No period of stripes is found in it.")
    more = profile.reduction(0.5 * min(periods))
    profile, step = profile.average(more, 0), together * more
    bands = _bands(place, step, first)
    starts = [each / more for each in periods]
    ranked = fit_lamp(profile, starts, is_linear=is_linear, check=check)
    if not ranked:
        raise MatchError("No period of stripes is found in it.")
    fit, cues = ranked[0], cues_of(ranked[0], bands)
    if problems := refusals(cues):
        raise MatchError(*problems)
    dark, lit = fit.ends
    if np.any(lit <= dark):
        raise MatchError("In some columns dark and lit stripes are equally bright.")
    others = [
        (fit.score - other.score, other.wave.period)
        for other in ranked[1:]
        if abs(other.wave.period / fit.wave.period - 1.0) > _OTHER_PERIOD
    ]
    gap, other_period = min(others, default=(math.inf, None))
    hidden_group = max(1.0, whole.most_lines_at_once() / step) if together == 1 else 1.0
    return LampReading(
        place=place,
        profile=whole,
        lines_at_once=together,
        step=step,
        first=first,
        fit=fit,
        cues=cues,
        errors=errors_of(fit, cues, hidden_group),
        gap=gap,
        other_period=other_period,
    )


def _bands(place: LampPlace, step: int, first: int) -> FloatArray:
    """Return profiles of bands of rows, all columns of which show the lamp, shape (bands, n)."""
    whole = np.flatnonzero(place.shown.all(axis=1))
    # A lamp's place is convex, so that the rows in which all columns show it are adjacent.
    rows = slice(whole[0], whole[-1] + 1) if len(whole) >= _BANDS else slice(None)
    groups = np.array_split(place.pixels[rows], _BANDS)
    bands = np.stack([group.mean(axis=0, dtype=np.float64) for group in groups if len(group)])
    last = first + (bands.shape[1] - first) // step * step
    return np.asarray(bands[:, first:last].reshape(len(bands), -1, step).mean(axis=2))
