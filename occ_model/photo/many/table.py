"""Combine the rows of several photos: their mean, outliers, and remarks.

The mean is weighted by the inverse variances. The Birge ratio R is the root of chi-square over its
degrees of freedom (R. T. Birge, "The calculation of errors by the method of least squares",
Physical Review 40, 207, 1932). With s the standard deviation of a mean of n independent estimates:

* R >= 1: the estimates scatter by more than their deviations. The deviation of the mean is R s, as
  by the Particle Data Group.
* R < 1: they scatter by less. The part of their variance that the scatter does not show, (1 - R^2)
  n s^2, may be a common error, as in photos of one scene, which does not average out. The variance
  of the mean is (R^2 + n (1 - R^2)) s^2.
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.photo.many.row import MatchSettings
from occ_model.results.photo_table import SURE, CombinedEstimate, PhotoRow, PhotoTable
from occ_model.scene.parameters import quantity

_SAME_EXPOSURE = 1.02  # maximum ratio of noted exposure times that count as equal

_FALSE_ALARM = 0.01  # probability that correct errors make an outlier
_NORMAL_MAD = 1.4826  # ratio of the standard to the median absolute deviation, if normal
_LEAST_FOR_OUTLIERS = 3  # minimum number of estimates among which an outlier can be identified


def table_of(settings: MatchSettings, rows: Sequence[PhotoRow]) -> PhotoTable:
    sure = [place for place, row in enumerate(rows) if row.verdict == SURE]
    estimate = settings.estimate
    if estimate != "readout_time" and sure and all(rows[place].lamp_frequency for place in sure):
        estimate = "lamp_frequency"
    estimated = _combine_rows(rows, sure, estimate)
    outliers = () if estimated is None else estimated.outliers
    in_mean = [place for place in sure if place not in outliers]
    noted = [row.noted_exposure for row in (rows[p] for p in in_mean) if row.noted_exposure]
    exposures_differ = bool(noted) and max(noted) > _SAME_EXPOSURE * min(noted)
    sure = [place for place in in_mean if rows[place].exposure_verdict == SURE]
    exposure = None if exposures_differ else _combine_rows(rows, sure, "exposure_time")
    table = PhotoTable(settings.scene, estimate, tuple(rows), estimated, exposure)
    return replace(table, notes=tuple(_notes(table, noted if exposures_differ else [])))


def _combine_rows(
    rows: Sequence[PhotoRow], places: Sequence[int], name: str
) -> CombinedEstimate | None:
    values, deviations, indices = [], [], []
    for place in places:
        value, deviation = getattr(rows[place], name), rows[place].uncertainty(name)
        if value is not None and deviation is not None and deviation > 0.0:
            values.append(value)
            deviations.append(deviation)
            indices.append(place)
    combined = combine(values, deviations)
    if combined is None:
        return None
    return replace(combined, outliers=tuple(indices[place] for place in combined.outliers))


def _notes(table: PhotoTable, exposures: Sequence[float]) -> list[str]:
    """Return sentences on disagreements between the photos."""
    in_mean = [row for place, row in enumerate(table.rows) if table.is_counted(place)]
    label = quantity(table.estimate).in_sentence
    notes = []
    if table.estimated is None:
        notes.append(f"No photo is sure: there is no mean of the {label}.")
    elif not table.estimated.agrees:
        notes.append(
            "The photos differ by more than their errors: the error of the mean "
            f"is widened {table.estimated.scale:.2g} times."
        )
    for kind, kinds in (
        # Sorted, as the camera may have been held upright or sideways.
        ("sizes", Counter("{} x {}".format(*sorted(row.size)) for row in in_mean)),
        ("cameras", Counter(row.camera for row in in_mean if row.camera)),
    ):
        if len(kinds) > 1:
            listing = ", ".join(f"{name} ({number})" for name, number in kinds.most_common(4))
            notes.append(
                f"The photos in the mean are of different {kind}, {listing}: their {label} need "
                "not be the same."
            )
    if exposures:
        time = quantity("exposure_time")
        notes.append(
            f"The camera noted exposure times from {time.format(min(exposures))} to "
            f"{time.format(max(exposures))}: they have no mean."
        )
    return notes


def combine(
    values: Sequence[float] | FloatArray, deviations: Sequence[float] | FloatArray
) -> CombinedEstimate | None:
    """Combine estimates of one quantity with standard deviations above 0."""
    if not len(values):
        return None
    x, sigma = np.asarray(values, dtype=np.float64), np.asarray(deviations, dtype=np.float64)
    outliers = _outliers(x, sigma)
    inliers = np.setdiff1d(np.arange(len(x)), outliers)
    x, sigma = x[inliers], sigma[inliers]
    mean, internal = _weighted_mean(x, sigma)
    chi_square = float(np.sum(((x - mean) / sigma) ** 2))
    degrees = len(x) - 1
    scale = _scale(chi_square, degrees)
    return CombinedEstimate(
        value=mean,
        uncertainty=internal * scale,
        count=len(x),
        chi_square=chi_square,
        probability=_probability(chi_square, degrees),
        scale=scale,
        outliers=tuple(outliers.tolist()),
    )


def _weighted_mean(x: FloatArray, sigma: FloatArray) -> tuple[float, float]:
    weights = (sigma.min() / sigma) ** 2
    total = float(weights.sum())
    return float(weights @ x) / total, float(sigma.min()) / math.sqrt(total)


def _scale(chi_square: float, degrees: int) -> float:
    """Return the factor from the deviation of a mean of independent estimates to the actual one."""
    if not degrees:
        return 1.0
    square = chi_square / degrees
    return math.sqrt(square if square >= 1.0 else square + (degrees + 1) * (1.0 - square))


def _probability(chi_square: float, degrees: int) -> float:
    if not degrees:
        return 1.0
    from scipy.special import gammaincc  # slow to import

    return float(gammaincc(0.5 * degrees, 0.5 * chi_square))


def _outliers(x: FloatArray, sigma: FloatArray) -> IndexArray:
    """Find estimates that are too far from the median of all.

    Distances are measured in standard deviations, or in the scatter if it is larger, so that
    deviations that are all too small make no outliers. The median is unweighted, as a wrong
    estimate with a tiny deviation would have nearly all of the weight.
    """
    count = len(x)
    if count < _LEAST_FOR_OUTLIERS:
        return np.zeros(0, np.int64)
    median_deviation = math.sqrt(0.5 * math.pi / count) * float(np.median(sigma))
    distances = np.abs(x - np.median(x)) / np.hypot(sigma, median_deviation)
    scatter = max(1.0, _NORMAL_MAD * float(np.median(distances)))
    from scipy.special import ndtri  # slow to import

    limit = -float(ndtri(0.5 * _FALSE_ALARM / count))
    return np.flatnonzero(distances > limit * scatter)
