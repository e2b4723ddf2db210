"""Bars of mains lamps in lines of a quotient, as a linear model with normal priors.

Each tile of columns is a slow change plus a periodic wave of N cycles a frame, whose harmonics are
modulated slowly, in amplitude and phase: lamps on other phases of the mains light other parts of
the room. Given N and a few scales, the likelihood integrated over all coefficients is exact.
"""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.camera.quotient import LineValues

_SLOW = 6  # cosines of the slow change, the constant included
_CONSTANT = 10.0  # prior deviation of the constant, over the slow change's: hardly any prior


@dataclass(frozen=True, slots=True)
class Scales:
    """Prior standard deviations of the coefficients, and the noise over its first estimate.

    Parameters
    ----------
    wave
        For the first harmonic.
    decay
        Power of 1/h with which they fall for the h-th harmonic; it is 1 for a wave with steps.
    modulation
        For a modulation of half a cycle a frame, relative to the wave; 1/j of it for j half cycles.
    slow
        For a slow change of half a cycle a frame; 1/j^1.5 of it for j half cycles.
    noise
        Factor on the deviations of the lines.
    """

    wave: float
    decay: float
    modulation: float
    slow: float
    noise: float


@dataclass(frozen=True, slots=True)
class Shape:
    """Number of half cycles a frame by which each harmonic of the wave is modulated."""

    modulations: tuple[int, ...]


COARSE = Shape((1,) * 3)
FINE = Shape((2,) * 4 + (1,) * 8)  # 12 harmonics: dimmers and rectifiers make steps


class BarsModel:
    """The model for a number of bars: its likelihood for any scales, and its fit.

    ``weights``: inverse variances of the lines, 0 where nothing is seen.
    """

    def __init__(
        self, lines: LineValues, weights: FloatArray, bars: float, shape: Shape, bend: float = 0.0
    ) -> None:
        self._shape = shape
        basis = _basis(lines.positions(bend), bars, shape)  # (tiles or 1, lines, coefficients)
        self._tiled_basis = np.broadcast_to(basis, (len(lines.values), *basis.shape[1:]))
        weighted = weights[:, :, None] * basis
        self._squares = np.swapaxes(weighted, 1, 2) @ self._tiled_basis
        self._products = np.einsum("tlk,tl->tk", weighted, lines.values)
        self._energy = (weights * lines.values**2).sum(axis=1)
        self._count = (weights > 0.0).sum(axis=1)

    def _solve(self, scales: Scales) -> tuple[FloatArray, FloatArray, FloatArray]:
        prior = _prior(scales, self._shape)
        # In units of the prior's deviations, of which any may be 0.
        precision = prior[:, None] * self._squares * prior / scales.noise**2 + np.eye(len(prior))
        product = prior * self._products / scales.noise**2
        return precision, product, prior

    def log_evidences(self, scales: Scales) -> FloatArray:
        """Return the log-likelihood of each tile, integrated over its coefficients."""
        precision, product, _ = self._solve(scales)
        root = np.linalg.cholesky(precision)
        determinants = 2.0 * np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1)
        found = np.linalg.solve(precision, product[:, :, None])[:, :, 0]
        noise = self._energy / scales.noise**2 + 2.0 * self._count * math.log(scales.noise)
        return np.asarray(0.5 * ((product * found).sum(axis=1) - determinants - noise))

    def log_evidence(self, scales: Scales) -> float:
        return float(self.log_evidences(scales).sum())

    def coefficients(self, scales: Scales) -> FloatArray:
        """Return the most likely coefficients, shape (tiles, coefficients)."""
        precision, product, prior = self._solve(scales)
        return np.asarray(prior * np.linalg.solve(precision, product[:, :, None])[:, :, 0])

    def harmonic_energies(self, scales: Scales) -> FloatArray:
        """Return the squares of the coefficients of each harmonic, over all tiles."""
        found = np.split(
            self.coefficients(scales)[:, _SLOW:],
            np.cumsum([2 * (each + 1) for each in self._shape.modulations])[:-1],
            axis=1,
        )
        return np.array([float((each**2).sum()) for each in found])

    def fit(self, scales: Scales) -> FloatArray:
        """Return the fitted values, shape (tiles, lines)."""
        return self._values(self.coefficients(scales))

    def waves(self, scales: Scales) -> FloatArray:
        """Return the periodic part of the fitted values, shape (tiles, lines)."""
        found = self.coefficients(scales)
        found[:, :_SLOW] = 0.0
        return self._values(found)

    def _values(self, coefficients: FloatArray) -> FloatArray:
        return np.asarray((self._tiled_basis @ coefficients[:, :, None])[:, :, 0])


def _basis(positions: FloatArray, bars: float, shape: Shape) -> FloatArray:
    slow = [np.cos(math.pi * j * positions) for j in range(_SLOW)]
    waves = []
    for harmonic, modulations in enumerate(shape.modulations, 1):
        angle = 2.0 * math.pi * harmonic * bars * positions
        pair = (np.cos(angle), np.sin(angle))
        waves += [gain * each for gain in slow[: modulations + 1] for each in pair]
    return np.stack([*slow, *waves], axis=-1)


def _prior(scales: Scales, shape: Shape) -> FloatArray:
    slow = [_CONSTANT, *(j**-1.5 for j in range(1, _SLOW))]
    waves = [
        each / harmonic**scales.decay
        for harmonic, modulations in enumerate(shape.modulations, 1)
        for j in range(modulations + 1)
        for each in [1.0 if j == 0 else scales.modulation / j] * 2
    ]
    return np.array(
        [*(scales.slow * each for each in slow), *(scales.wave * each for each in waves)]
    )
