"""The mean over fits of several models, each weighted by how likely it is."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.joint_fit import JointFit

_UNMODELLED = 0.05
"""Share of the data's misfit by which explanations must differ to be told apart: what a camera does
beside the model changes each one's misfit by chance. Without it, a blur of the wrong shape is often
taken for the only one. What is usual of a camera has no such error: it counts in full."""

_VANISHED = 2e-3
"""Exposure in chips that is as good as none."""

_UNTOLD_STEP = 5.0
"""Ratio to the smallest deviation of the step from which a fit tells none: the distances of edges
are the same by every model, and so is how well they are known."""

_UNTOLD = 1e3
"""Variance of gamma's logarithm of a fit that ended at gamma's bound, where it has no slope."""


def averaged(fits: Sequence[JointFit]) -> JointFit:
    """Average over models, each weighted by the density of its best fit.

    The estimate is the fit of the median exposure: where an edge is either blur's or the
    exposure's, the mean of both is neither. The deviation is that of densities which are trusted
    less, since they are of noise alone. An exposure that has shrunk to nothing, a gamma at its
    bound, or a step that is far less known than by another fit, has no slope, which tells no
    covariance: such a fit counts only where there is no other.
    """
    most = _UNTOLD_STEP**2 * min(one.covariance[0, 0] for one in fits)
    known = [one for one in fits if one.covariance[0, 0] <= most]
    tell = [one for one in known if one.exposure > _VANISHED and one.covariance[3, 3] < _UNTOLD]
    fits = sorted(tell or known, key=lambda fit: fit.exposure)
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
    """Keep the best fit of each minimum of one model: several starts may end in the same one.

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
