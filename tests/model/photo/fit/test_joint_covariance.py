"""The covariance of what is fitted to stripes: of noise, of what repeats, and of blur's tails."""

import numpy as np
import pytest

from occ_model.photo.fit.joint_covariance import CORRELATED_COLUMNS, covariance_of

DATA, PRIOR = 6400, 2
BLOCK = np.arange(DATA) // 16
RANDOM = np.random.default_rng(5)
SLOPES = np.vstack([RANDOM.normal(size=(DATA, 3)) @ np.diag([3.0, 1.0, 2.0]), np.eye(3)[:PRIOR]])
NOISE = np.append(RANDOM.normal(size=DATA), np.zeros(PRIOR))
NONE = np.zeros(DATA + PRIOR)
INVERSE = np.linalg.inv(SLOPES.T @ SLOPES)


def test_mere_noise_leaves_the_inverse_of_the_information() -> None:
    """The step's is that of columns that all count: the others' noise was taken as larger."""
    found = covariance_of(SLOPES, 0.1 * NOISE, NONE, BLOCK)
    assert found[1:, 1:] == pytest.approx(INVERSE[1:, 1:], rel=1e-6)
    assert found[0, 0] == pytest.approx(INVERSE[0, 0] / CORRELATED_COLUMNS, rel=1e-6)


def test_what_is_alike_in_a_block_counts_once() -> None:
    """Scores whose sum over a block grows with its length have a variance as many times larger."""
    alike = np.repeat(RANDOM.normal(size=DATA // 16), 16)
    slopes = SLOPES.copy()
    slopes[:DATA, 2] = np.repeat(RANDOM.normal(size=DATA // 16), 16)
    found = covariance_of(slopes, np.append(alike, np.zeros(PRIOR)), NONE, BLOCK)
    single = np.linalg.inv(slopes.T @ slopes)
    assert found[2, 2] / single[2, 2] == pytest.approx(16.0, rel=0.2)
    assert found[1, 1] / single[1, 1] == pytest.approx(1.0, rel=0.2)
    correlation = found[1, 2] / np.sqrt(found[1, 1] * found[2, 2])
    assert correlation == pytest.approx(single[1, 2] / np.sqrt(single[1, 1] * single[2, 2]))


def test_few_blocks_tell_less() -> None:
    """Of n blocks the sum is times n/(n-1)."""
    block = np.arange(DATA) // (DATA // 2)
    residual = np.append(np.where(SLOPES[:DATA, 1] > 0.0, 1.0, -1.0), np.zeros(PRIOR))
    scores = np.stack([np.bincount(block, SLOPES[:DATA, k] * residual[:DATA]) for k in range(3)])
    prior = SLOPES[DATA:].T @ SLOPES[DATA:]
    sandwich = INVERSE @ (scores @ scores.T + prior) @ INVERSE
    found = covariance_of(SLOPES, residual, NONE, block)
    assert found[1, 1] == pytest.approx(2.0 * sandwich[1, 1], rel=1e-6)


def test_what_tails_of_the_blur_would_change_is_added() -> None:
    """A residual that one parameter could explain moves that parameter alone."""
    plain = covariance_of(SLOPES, NOISE, NONE, BLOCK)
    moved = covariance_of(SLOPES, NOISE, 0.3 * SLOPES[:, 2], BLOCK)
    added = np.zeros((3, 3))
    added[2, 2] = 0.09
    assert moved - plain == pytest.approx(added, abs=1e-9)
