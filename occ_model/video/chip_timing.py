"""Fit the timing of the chips in one picture, and the certainty of their values.

The light of column i is b(i) + a(i) p(i), with p the lit fraction of its exposure, which starts at
phase + step i chips and lasts a number of chips; b and a are polynomials over the picture. This is
the model of the stripes of a photo, applied to light and to chips that need not repeat.
"""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.photo.fit.least_squares import StripeModel, level_freedom
from occ_model.photo.fit.timing import SHORTEST_EXPOSURE, Timing
from occ_model.photo.stripes.period import correlated_columns

_SHIFTS = np.linspace(-0.75, 0.75, 5)  # chips, because decoders count from different ends
_ADDED_CHIPS = 4  # number of chips added on either side, equal to the outermost ones

_MIN_NOISE = 1e-6  # minimum variance of a column, as a fraction of the squared swing
_MAX_LOG_LIKELIHOOD_RATIO = 50.0  # maximum of a chip, since no model is more certain
_MIN_COLUMNS_PER_RIM = 8  # total columns for each column that is omitted at either end


@dataclass(frozen=True, eq=False, slots=True)
class ChipLattice:
    """The places of chips in a signal, and their values."""

    step: float  # Chips per column
    # Start of the exposure of column 0 in chips; chip number ``first`` + k starts at ``first`` + k
    phase: float
    exposure: float  # Duration of an exposure in chips
    first: int  # The number of the first chip
    values: ByteArray  # Shape (chips,): the chips

    def middle(self, columns: int) -> float:
        """Return the middle of the exposure of the middle column, in chips."""
        return self.phase + 0.5 * self.exposure + 0.5 * self.step * (columns - 1)


@dataclass(frozen=True, eq=False, slots=True)
class ChipTiming:
    """The chips of one picture on their fitted lattice."""

    lattice: ChipLattice  # Its columns are counted from the signal's first one
    middle: float  # Middle of the exposure of the signal's middle column, in chips
    # Standard deviations of ``middle`` and of the lattice's step, in chips
    middle_error: float
    step_error: float
    # Shape (chips,): log-likelihood ratio of each chip, positive if it is more likely lit
    ratios: FloatArray
    unexplained: float  # Fraction of the signal's variance that the chips do not explain


def fit_timing(light: FloatArray, start: ChipLattice) -> ChipTiming | None:
    """Fit the timing of decoded chips to the columns' light; None if it does not fit them."""
    columns, values = len(light), start.values
    if values.size == 0 or values.min() == values.max():
        return None
    exposure, first_number = max(start.exposure, SHORTEST_EXPOSURE), start.first - _ADDED_CHIPS
    middles = start.middle(columns) - first_number + _SHIFTS
    timings = [Timing(start.step, exposure, middle, 1.0) for middle in middles.tolist()]
    model = _model(light, values, start.step)
    timing = min(timings, key=lambda each: float(np.sum((light - model.levels(each)[2]) ** 2)))
    fit = _fit_inner(light, values, timing)
    if fit is None:
        return None
    chip_timing = _to_chip_timing(light, values, *fit, first_number)
    likelier_values = (chip_timing.ratios > 0.0).astype(np.uint8)
    if (likelier_values == values).all():
        return chip_timing
    fit = _fit_inner(light, likelier_values, fit[0])
    return None if fit is None else _to_chip_timing(light, likelier_values, *fit, first_number)


def _model(light: FloatArray, values: ByteArray, step: float) -> StripeModel:
    return StripeModel(light, np.pad(values, _ADDED_CHIPS, mode="edge"), None, step)


def _fit_inner(
    light: FloatArray, values: ByteArray, timing: Timing
) -> tuple[Timing, FloatArray] | None:
    """Fit a timing to the columns without the outermost chips; return the covariance as well.

    The outermost chips are cut off at the panel's rim. A bright one appears to extend further out
    than a dark one, which would lengthen all chips. The covariance is that of the middle and the
    step.
    """
    if values.min() == values.max():
        return None
    rim = min(math.ceil((1.0 + timing.exposure) / timing.step), len(light) // _MIN_COLUMNS_PER_RIM)
    inner = light[rim : len(light) - rim]
    model = _model(inner, values, timing.step)
    fit = model.fit(timing)
    if not float(np.median(model.levels(fit.timing)[1])) > 0.0:
        return None
    covariance = fit.covariance[np.ix_([2, 0], [2, 0])]
    return fit.timing, covariance + _edge_covariance(fit.timing, values, len(inner))


def _to_chip_timing(
    light: FloatArray, values: ByteArray, timing: Timing, covariance: FloatArray, first_number: int
) -> ChipTiming:
    """Return a timing with the chips' ratios; ``first_number``: the chip from which it counts."""
    columns = len(light)
    _, swing, profile = _model(light, values, timing.step).levels(timing)
    residual = light - profile
    lattice = ChipLattice(
        timing.step,
        timing.start(columns) + first_number,
        timing.exposure,
        first_number + _ADDED_CHIPS,
        values,
    )
    return ChipTiming(
        lattice=lattice,
        middle=timing.middle + first_number,
        middle_error=float(np.sqrt(covariance[0, 0])),
        step_error=float(np.sqrt(covariance[1, 1])),
        ratios=chip_ratios(lattice, swing, residual),
        unexplained=float(residual @ residual) / max(float(light.var()) * columns, 1e-300),
    )


def _edge_covariance(timing: Timing, values: ByteArray, count: int) -> FloatArray:
    """Return the covariance of middle and step due to edges between short exposures."""
    gap = max(timing.step - timing.exposure, 0.0)
    edges = max(1, int(np.count_nonzero(np.diff(values.astype(np.int64)))))
    variance = gap**2 / 12.0 / edges
    # For edges spread evenly, the variance of a slope is 12 / n^2 of that of the mean.
    return np.diag([variance, 12.0 * variance / count**2])


def noise_of(swing: FloatArray, residual: FloatArray, step: float) -> float:
    """Return the variance of a column about the model, in terms of independent columns."""
    free = max(1, len(residual) - 2 * level_freedom(step * len(residual)) - 3)
    least = _MIN_NOISE * float(np.median(swing)) ** 2
    return max(float(residual @ residual) / free, least) * correlated_columns(residual)


def chip_ratios(lattice: ChipLattice, swing: FloatArray, residual: FloatArray) -> FloatArray:
    """Return the log-likelihood ratio of each chip being lit, with the other chips unchanged.

    With w(i) the light of a chip in column i and r(i) the residual, the opposite value changes the
    squared distance by the sum of w^2 -+ 2 w r.
    """
    count, chips = len(residual), len(lattice.values)
    starts = lattice.phase - lattice.first + lattice.step * np.arange(count)
    reach = int(np.ceil(lattice.exposure)) + 1
    chip = np.floor(starts).astype(np.int64)[:, None] + np.arange(reach)
    overlap = np.minimum(starts[:, None] + lattice.exposure, chip + 1.0) - np.maximum(
        starts[:, None], chip
    )
    weight = np.maximum(overlap, 0.0) * (swing / lattice.exposure)[:, None]
    inside = (chip >= 0) & (chip < chips)
    weight = np.where(inside, weight, 0.0).ravel()
    chip_indices: IndexArray = np.clip(chip, 0, chips - 1).ravel()
    power = np.bincount(chip_indices, weight**2, minlength=chips)
    correlation = np.bincount(chip_indices, weight * np.repeat(residual, reach), minlength=chips)
    lit: BoolArray = lattice.values == 1
    # For a lit chip: the distance if it were dark, minus the present distance.
    distance_increase = np.where(lit, power + 2.0 * correlation, -(power - 2.0 * correlation))
    noise = noise_of(swing, residual, lattice.step)
    return np.clip(
        distance_increase / (2.0 * noise), -_MAX_LOG_LIKELIHOOD_RATIO, _MAX_LOG_LIKELIHOOD_RATIO
    )
