"""The mean over fits of several models, each weighted by how likely it is."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.joint_fit import JointFit
from occ_model.photo.fit.timing import SHORTEST

_UNMODELLED = 0.05
"""Fraction of the data's misfit by which explanations must differ: effects outside the model change
the misfit of each by chance. Without it, a blur of the wrong shape is often the only one left. The
misfit of the priors has no such error and counts in full."""

_MOST_STEP_RATIO = 5.0
"""Maximum ratio of a step's standard deviation to the smallest one: all models have the same
distances of edges, so that a larger one comes from a degenerate fit."""

_MOST_GAMMA_VARIANCE = 1e3  # that of gamma's logarithm is larger only at its bound


def averaged(fits: Sequence[JointFit]) -> JointFit:
    """Average over models, each weighted by the density of its best fit.

    The estimate is the fit of the median exposure: where an edge is either blur's or the
    exposure's, the mean of both is neither. The deviation is that of densities which are trusted
    less, since they are of noise alone. An exposure that has shrunk to nothing, a gamma at its
    bound, or a step that is far less known than by another fit, has no slope, and so no
    covariance: such a fit counts only where there is no other.
    """
    most = _MOST_STEP_RATIO**2 * min(one.covariance[0, 0] for one in fits)
    known = [one for one in fits if one.covariance[0, 0] <= most]
    usable = [
        one
        for one in known
        if one.exposure > 2.0 * SHORTEST and one.covariance[3, 3] < _MOST_GAMMA_VARIANCE
    ]
    fits = sorted(usable or known, key=lambda fit: fit.exposure)
    likeliest = min(fits, key=lambda fit: fit.misfit)
    likely = np.cumsum(_weights(np.array([fit.misfit for fit in fits])))
    middle = fits[int(np.searchsorted(likely, 0.5))].values
    trust = max(1.0, _UNMODELLED * (likeliest.misfit - likeliest.prior))
    weights = _weights(np.array([(fit.misfit - fit.prior) / trust + fit.prior for fit in fits]))
    covariance = sum(
        weight * (fit.covariance + np.outer(fit.values - middle, fit.values - middle))
        for weight, fit in zip(weights, fits, strict=True)
    )
    return JointFit(middle, np.asarray(covariance), likeliest.misfit, likeliest.prior)


def distinct(fits: Sequence[JointFit]) -> list[JointFit]:
    """Keep the best fit of each minimum, the best first: several starts may end in the same one.

    Two are the same where their exposures differ by less than the better one's deviation.
    """
    kept: list[JointFit] = []
    for fit in sorted(fits, key=lambda one: one.misfit):
        if all(abs(fit.exposure - other.exposure) > other.deviation for other in kept):
            kept.append(fit)
    return kept


def _weights(misfits: FloatArray) -> FloatArray:
    density = np.exp(-0.5 * (misfits - misfits.min()))
    return np.asarray(density / density.sum())
