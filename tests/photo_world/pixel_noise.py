"""The noise of a row of pixels as the diagonals of its covariance, from the main one downwards."""

import numpy as np
from scipy.linalg import cholesky_banded, solve_banded

from photo_world.photograph import World

_TABLE = np.array([16, 11, 10, 16, 24, 40, 51, 61])
"""Quantization steps of the coefficients that are constant along a column, at quality 50 (ITU-T
T.81, table K.1)."""


def jpeg_steps(world: World) -> np.ndarray:
    """Return JPEG's quantization steps for the cosines of eight columns."""
    quality = world.quality
    percent = 5000 // quality if quality < 50 else 200 - 2 * quality
    return np.asarray(np.clip((_TABLE * percent + 50) // 100, 1, 255), dtype=np.float64)


def cosines_of_eight() -> np.ndarray:
    """Return the orthonormal cosine transform of eight columns, shape (8, 8)."""
    place = np.arange(8)
    return np.sqrt(np.where(place == 0, 1.0, 2.0) / 8.0)[:, None] * np.cos(
        np.pi / 8.0 * np.outer(place, place + 0.5)
    )


def jpeg_covariance(world: World) -> np.ndarray:
    """Return the covariance that JPEG gives a row's pixels, as eight diagonals."""
    cosines = cosines_of_eight()
    block = cosines.T @ np.diag(jpeg_steps(world) ** 2 / 12.0) @ cosines
    bands = np.zeros((8, world.columns))
    for lag in range(8):
        bands[lag] = np.resize(np.pad(np.diag(block, -lag), (0, lag)), world.columns)
        bands[lag, world.columns - lag :] = 0.0
    return bands


def whiten(bands: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Multiply slopes by the inverse root of a covariance."""
    root = cholesky_banded(bands, lower=True)
    return np.asarray(solve_banded((len(bands) - 1, 0), root, slopes.T).T)
