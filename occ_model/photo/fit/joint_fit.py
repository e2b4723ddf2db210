"""A joint fit's timing with its covariance, and the mean over the fits of several models.

The covariance takes into account that the residual of a fit to stripes is not mere noise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.fit.timing import SHORTEST_EXPOSURE
from occ_model.products import row_products

_UNMODELLED_FRACTION = 0.05
"""Fraction of the data's misfit by which effects outside the model change it by chance. Without it,
a blur of the wrong shape often gets all of the weight. The misfit of the priors has no such error
and counts in full."""

_MOST_STEP_RATIO = 5.0
"""Maximum ratio of a step's standard deviation to the smallest one: all models have the same
distances of edges, so that a larger one comes from a degenerate fit."""

_MOST_GAMMA_VARIANCE = 1e3  # that of gamma's logarithm is larger only at its bound

CORRELATED_COLUMNS = 4.0
"""Number of columns of a residual that count as one: it is not mere noise, but repeats with the
stripes. Of 151 exposures of simulated photographs one standard deviation covers 76 %, and two 91 %;
with 6 one covers 81 %, with 2 two cover 87 %."""


@dataclass(frozen=True, eq=False, slots=True)
class JointFit:
    # Shape (9,); step, exposure and middle as of a timing, and the six unknowns in the order of
    # ``USUAL``.
    values: FloatArray
    covariance: FloatArray  # shape (9, 9); 0 for what is not fitted
    misfit: float  # twice the negative logarithm of the posterior density, less a constant
    prior: float = 0.0  # part of the misfit that is due to unknowns that are not as usual
    shift: FloatArray | None = None  # shape (9,); bias of the values by blurred levels

    @property
    def unbiased(self) -> "JointFit":
        """The fit without the bias by blurred levels, whose relative error is twice the blur's."""
        if self.shift is None or not self.values[7] > 0.0:
            return self
        error = min(1.0, 2.0 * math.sqrt(float(self.covariance[7, 7])) / float(self.values[7]))
        covariance = self.covariance + np.outer(error * self.shift, error * self.shift)
        return replace(self, values=self.values - self.shift, covariance=covariance, shift=None)

    @property
    def exposure(self) -> float:
        """The exposure in chips."""
        return float(self.values[1])

    @property
    def deviation(self) -> float:
        """The exposure's standard deviation in chips."""
        return math.sqrt(float(self.covariance[1, 1]))


def covariance_of(slopes: FloatArray, residual: FloatArray, block: NDArray[np.int64]) -> FloatArray:
    """Return the parameters' covariance.

    Of two estimates the larger one is taken: the inverse of the information, and the sandwich with
    the scores summed over blocks of columns (White, Econometrica 50:1, 1982; Newey and West,
    Econometrica 55:703, 1987), times n/(n-1) for n blocks. For the step the information is that of
    noise alone, as if every column counted: what repeats with the stripes makes the edges wider or
    narrower, and leaves their distances as they are.

    ``slopes``: shape (residuals, parameters); the first parameter is the step. ``residual``: in
    standard deviations; after the data's come those of what is usual. ``block``: that of each
    of the data. All profiles show the same stripes with the same errors of compression: a block
    holds the columns of all of them.
    """
    information = row_products(slopes.T, slopes.T)
    information[np.diag_indices_from(information)] += 1e-9
    inverse = np.linalg.inv(information)
    data, blocks = len(block), int(block.max()) + 1
    products = slopes[:data] * residual[:data, None]
    scores = np.stack([np.bincount(block, part, blocks).astype(float) for part in products.T])
    prior = slopes[data:].T @ slopes[data:]
    score = row_products(scores, scores)
    sandwich = inverse @ (score + prior) @ inverse * (blocks / max(1, blocks - 1))
    ratio = np.diag(sandwich) / np.diag(inverse)
    ratio = np.maximum(ratio, np.append(1.0 / CORRELATED_COLUMNS, np.ones(len(ratio) - 1)))
    return np.asarray(inverse * np.sqrt(np.outer(ratio, ratio)))


def average_fits(fits: Sequence[JointFit]) -> JointFit:
    """Average over models, each weighted by the density of its best fit.

    The estimate is the fit of the median exposure: if an edge is wide by blur or by the exposure,
    the mean of both explanations is neither. For the covariance, differences of the misfit count
    less, as effects outside the model change it. A fit counts only if there is no other where its
    covariance means nothing: its exposure has shrunk to nothing, its gamma is at a bound, or its
    step is far less known than in another fit.
    """
    most = _MOST_STEP_RATIO**2 * min(one.covariance[0, 0] for one in fits)
    known = [one for one in fits if one.covariance[0, 0] <= most]
    usable = [
        one
        for one in known
        if one.exposure > 2.0 * SHORTEST_EXPOSURE and one.covariance[3, 3] < _MOST_GAMMA_VARIANCE
    ]
    fits = sorted(usable or known, key=lambda fit: fit.exposure)
    likeliest = min(fits, key=lambda fit: fit.misfit)
    likely = np.cumsum(_weights(np.array([fit.misfit for fit in fits])))
    middle = fits[int(np.searchsorted(likely, 0.5))].values
    trust = max(1.0, _UNMODELLED_FRACTION * (likeliest.misfit - likeliest.prior))
    weights = _weights(np.array([(fit.misfit - fit.prior) / trust + fit.prior for fit in fits]))
    covariance = sum(
        weight * (fit.covariance + np.outer(fit.values - middle, fit.values - middle))
        for weight, fit in zip(weights, fits, strict=True)
    )
    return JointFit(middle, np.asarray(covariance), likeliest.misfit, likeliest.prior)


def keep_distinct(fits: Sequence[JointFit]) -> list[JointFit]:
    """Keep the best fit of each minimum, the best first, as several starts may end in the same one.

    Two fits are of the same minimum if their exposures differ by less than the better one's error.
    """
    kept: list[JointFit] = []
    for fit in sorted(fits, key=lambda one: one.misfit):
        if all(abs(fit.exposure - other.exposure) > other.deviation for other in kept):
            kept.append(fit)
    return kept


def _weights(misfits: FloatArray) -> FloatArray:
    density = np.exp(-0.5 * (misfits - misfits.min()))
    return np.asarray(density / density.sum())
