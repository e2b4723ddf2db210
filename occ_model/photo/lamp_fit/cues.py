"""What tells a lamp's stripes from other regular things, measured on a fit."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamp_fit.fit import LampFit
from occ_model.photo.lamp_fit.model import BLUR, COUNT, FAR, NEAR
from occ_model.photo.lamp_fit.readings import readings_of
from occ_model.products import row_products

_LEAST_BLUR = 0.3  # columns; the error of a smaller blur is stated as if it were this one
_CHANCE_SCATTER = 0.3 / 4.13  # of edges at random places, as a fraction of the period


@dataclass(frozen=True, slots=True)
class Cues:
    """Measures of how much stripes look like a lamp's.

    Lengths are in columns, light and residuals are fractions of the stripes' height.
    """

    floor: float  # Light between the stripes that no reading explains
    floor_expected: float  # Light between the stripes by the nearest reading
    blur: float  # Standard deviation of all blur
    blur_error: float  # Standard deviation of ``blur``
    ramp: float
    period: float
    edges: int  # Number of edges in view
    scatter: float  # Deviation of the edges from even spacing
    scatter_noise: float  # The scatter that noise alone would cause
    drift: float  # Shift of the stripes from the first row to the last
    drift_error: float  # Standard deviation of ``drift``
    rows_scatter: float  # Deviation of the stripes in bands of rows from a straight shift
    misfit: float  # Root mean square of the part of the residual that repeats with the period
    unexplained: float  # Root mean square of the whole residual
    dips: int  # Times that the envelope falls and rises again
    unusual_tone: float  # Distance of the tone curve from usual ones, in standard deviations
    narrowest: float  # The shorter of a stripe and the gap between two
    white: float  # Fraction of the columns that have clipped pixels

    @property
    def bits(self) -> float:
        """Evidence that the spacing is even, in bits; three edges give none."""
        limit = max(self.scatter, 1e-3)
        gain = math.log2(_CHANCE_SCATTER * self.period / limit)
        return (self.edges - 3) * max(gain, 0.0)


def cues_of(fit: LampFit, rows: FloatArray) -> Cues:
    """Measure the cues of a fit; ``rows``: profiles of bands of rows, shape (bands, columns)."""
    wave = fit.wave
    blur, blur_error = _blur(fit)
    floors = np.array([one.floor for one in readings_of(wave.width, wave.ramp_part)])
    nearest = float(floors[np.argmin(np.abs(floors - fit.floor))])
    shifts, deviations = _edge_shifts(fit)
    scatter, scatter_noise = _scatter(shifts, deviations)
    drift, drift_error, rows_scatter = _rows_shift(fit, rows)
    return Cues(
        floor=abs(fit.floor - nearest),
        floor_expected=nearest,
        blur=blur,
        blur_error=blur_error,
        ramp=wave.ramp_columns,
        period=wave.period,
        edges=len(shifts),
        scatter=scatter,
        scatter_noise=scatter_noise,
        drift=drift,
        drift_error=drift_error,
        rows_scatter=rows_scatter,
        misfit=_periodic_misfit(fit),
        unexplained=math.sqrt(float(np.mean(fit.residual**2))) / fit.height,
        dips=_dips(fit),
        unusual_tone=fit.model.unusual_tone(fit.values),
        narrowest=min(wave.width, 1.0 - wave.width) * wave.period,
        white=float(fit.profile.clipped.mean()),
    )


def _blur(fit: LampFit) -> tuple[float, float]:
    """Return the standard deviation of all blur, 0 if sharpening outweighs it, and its error."""
    own = math.exp(2.0 * fit.values[BLUR])
    moment = own + 2.0 * fit.values[NEAR] + 8.0 * fit.values[FAR]
    slopes = np.zeros(len(fit.values))
    slopes[[BLUR, NEAR, FAR]] = 2.0 * own, 2.0, 8.0
    blur = math.sqrt(max(moment, 0.0))
    error = math.sqrt(max(float(slopes @ fit.covariance @ slopes), 0.0))
    return blur, error / (2.0 * max(blur, _LEAST_BLUR))


def _edge_shifts(fit: LampFit) -> tuple[FloatArray, FloatArray]:
    """Return how far each edge in view is from its place in the model, and the error of that.

    Both in columns.
    """
    wave, columns = fit.wave, fit.profile.columns
    by_place = fit.model.slopes(fit.values)[1][:, 1]
    half = 0.5 * wave.width * wave.period
    first = math.ceil((columns[0] - wave.place) / wave.period - 0.5)
    last = math.floor((columns[-1] - wave.place) / wave.period + 0.5)
    middles = wave.place + wave.period * np.arange(first, last + 1)
    reach = min(half, 0.5 * wave.period - half)
    weight = np.where(fit.profile.clipped, 0.0, 1.0 / fit.noise**2)
    residual = fit.residual
    shifts, deviations = [], []
    for edge in np.sort(np.concatenate([middles - half, middles + half])):
        near = np.abs(columns - edge) <= max(reach, 1.0)
        if not columns[0] <= edge <= columns[-1]:
            continue
        information = float((weight * by_place**2)[near].sum())
        # An edge that may be anywhere within a period is not seen.
        if information * (_CHANCE_SCATTER * wave.period) ** 2 > 1.0:
            shifts.append(float((weight * by_place * residual)[near].sum()) / information)
            deviations.append(1.0 / math.sqrt(information))
    return np.array(shifts), np.array(deviations)


def _scatter(shifts: FloatArray, deviations: FloatArray) -> tuple[float, float]:
    """Return the root mean square of shifts, and that which their noise alone would cause."""
    if len(shifts) < 2:
        return 0.0, 0.0
    # Each edge counts by how well it is known, as faint ones say little.
    weight = 1.0 / deviations**2
    total = float(weight.sum())
    freedom = max(1.0 - 3.0 / len(shifts), 1.0 / len(shifts))  # period, place and width are fitted
    scatter = math.sqrt(float(weight @ shifts**2) / total / freedom)
    return scatter, math.sqrt(len(shifts) / total)


def _rows_shift(fit: LampFit, rows: FloatArray) -> tuple[float, float, float]:
    """Return the drift of the stripes over the rows, its deviation, and the scatter about it."""
    bands = len(rows)
    if bands < 2:
        return 0.0, 0.0, 0.0
    # Of each band a shift, a brightness and an envelope of its own are fitted.
    levels, slopes = fit.model.slopes(fit.values)
    parts = np.column_stack([slopes[:, 1], levels, slopes[:, COUNT:]])
    weight = np.where(fit.profile.clipped, 0.0, 1.0)
    system = parts * weight[:, None]
    products = row_products(system.T, system.T)
    products[np.diag_indices_from(products)] *= 1.0 + 1e-6
    products[np.diag_indices_from(products)] += 1e-12
    shifts = np.linalg.solve(products, system.T @ ((rows - levels) * weight).T)[0]
    place = np.linspace(-0.5, 0.5, bands)
    slope = float(place @ shifts) / float(place @ place)
    rest = shifts - shifts.mean() - slope * place
    scatter = math.sqrt(float(rest @ rest) / max(bands - 2, 1))
    return slope, scatter / math.sqrt(float(place @ place)), scatter


def _periodic_misfit(fit: LampFit) -> float:
    """Return the root mean square of the residual's mean over all periods, over the height."""
    wave, columns = fit.wave, fit.profile.columns
    count = int(min(max(wave.period, 3), 24))
    bins = np.floor((columns - wave.place) / wave.period % 1.0 * count).astype(int)
    counts = np.maximum(np.bincount(bins, minlength=count), 1)
    means = np.bincount(bins, weights=fit.residual, minlength=count) / counts
    # Subtract the square that noise alone leaves in such a mean.
    left = float(np.mean(means**2)) - float(np.mean(fit.noise**2)) * count / len(columns)
    return math.sqrt(max(left, 0.0)) / fit.height


def _dips(fit: LampFit) -> int:
    """Count how often the envelope falls notably and rises again."""
    log = fit.model.envelope @ fit.values[COUNT:]
    turns, last, direction = 0, float(log[0]), 0
    for value in log:
        if abs(value - last) > 0.25:
            now = 1 if value > last else -1
            turns += int(direction < 0 < now)
            direction, last = now, float(value)
        elif (value - last) * direction > 0:
            last = float(value)
    return turns
