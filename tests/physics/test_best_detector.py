"""The sequence detector makes hardly more errors than the best detector of single bits.

The best is computed here in another way: forward and backward over the bits (L. R. Bahl, J. Cocke,
F. Jelinek and J. Raviv, IEEE Trans. Inf. Theory 20:284, 1974), from the exposures' overlaps with
the chips alone. A bit that has the probability p is decided wrongly with min(p, 1 - p); the mean of
that is the error rate of the best detector, which none with the same knowledge falls below.
"""

import itertools
import math

import numpy as np
import pytest
from numpy.typing import NDArray
from physics.exposed_chips import expose_rows, manchester, noise_of

from occ_model.receiver.sequence.exposures import RowTiming, gather
from occ_model.receiver.sequence.search import find_all_best_chips
from occ_model.receiver.sequence.trellis import Word, make_trellis

EXPOSURE, STEP, PHASE, DECIBELS = 4, 0.2, 0.13, 15.0
ROWS = 10  # rows that begin while a bit, of two chips, lasts
BITS_BACK = EXPOSURE // 2  # bits after its own during the exposure of a row

Floats = NDArray[np.float64]


def branch_light() -> Floats:
    """Return the light of the rows that begin in a bit, for each choice of that and the next bits.

    Shape (2, 2, 2, ROWS): the bit, the two that follow it, and the rows.
    """
    light = np.zeros((2,) * (BITS_BACK + 1) + (ROWS,))
    for bits in itertools.product((0, 1), repeat=BITS_BACK + 1):
        chips = [chip for bit in bits for chip in ((1, 0) if bit else (0, 1))]
        first = manchester(np.array([bits[0]]))
        if list(first) != chips[:2]:
            chips = [1 - chip for chip in chips]
        for row in range(ROWS):
            start = PHASE + STEP * row
            overlaps = [
                max(0.0, min(start + EXPOSURE, place + 1) - max(start, place))
                for place in range(len(chips))
            ]
            light[(*bits, row)] = (
                math.fsum(o * c for o, c in zip(overlaps, chips, strict=True)) / EXPOSURE
            )
    return light


def chances(light: Floats, noise: float) -> Floats:
    """Return the probability of a one for each bit, of many sequences beside each other.

    Parameters
    ----------
    light : ndarray of float64, shape (sequences, bits, ROWS)
        The rows that begin in each bit.
    noise
        Standard deviation of a row.
    """
    model = branch_light()
    sequences, steps = light.shape[:2]
    # log of the likelihood of (bit k, k+1, k+2): states are (k, k+1), branches lead to (k+1, k+2).
    away = light[:, :, None, None, None, :] - model
    metric = -(away**2).sum(axis=-1) / (2.0 * noise**2)
    metric -= metric.max(axis=(2, 3, 4), keepdims=True)
    weight = np.exp(metric)
    ahead = np.empty((steps + 1, sequences, 2, 2))
    ahead[0] = 0.25
    for k in range(steps):
        ahead[k + 1] = np.einsum("sij,sijl->sjl", ahead[k], weight[:, k])
        ahead[k + 1] /= ahead[k + 1].sum(axis=(1, 2), keepdims=True)
    back = np.full((sequences, 2, 2), 0.25)
    found = np.empty((sequences, steps))
    for k in reversed(range(steps)):
        back = np.einsum("sijl,sjl->sij", weight[:, k], back)
        back /= back.sum(axis=(1, 2), keepdims=True)
        both = ahead[k] * back
        found[:, k] = both[:, 1].sum(axis=1) / both.sum(axis=(1, 2))
    return found


def rates(sequences: int, bits: int, seed: int) -> tuple[float, float, float]:
    """Return the error rates of the best detector, expected and counted, and of our detector."""
    random = np.random.default_rng(seed)
    noise = noise_of(DECIBELS)
    sent = random.integers(0, 2, (sequences, bits))
    words = (Word(0, (0, 1), 0), Word(0, (1, 0), 0))
    timing = RowTiming(EXPOSURE, STEP, PHASE)
    whole = bits - BITS_BACK - 1
    seen = np.empty((sequences, whole, ROWS))
    wrong = counted = 0
    for number, payload in enumerate(sent):
        chips = manchester(payload)
        light = expose_rows(chips, EXPOSURE, STEP, PHASE)
        light = light + noise * random.standard_normal(len(light))
        seen[number] = light[: whole * ROWS].reshape(whole, ROWS)
        (found,) = find_all_best_chips(make_trellis(words, timing.memory), [gather(light, timing)])
        decided = found.values[-found.first :][: 2 * whole : 2] == manchester(np.array([1]))[0]
        inside = slice(BITS_BACK, whole)
        wrong += int((decided[inside] != (payload[:whole] == 1)[inside]).sum())
        counted += whole - BITS_BACK
    p = chances(seen, noise)[:, BITS_BACK:]
    best = p > 0.5
    errs = float((best != (sent[:, BITS_BACK:whole] == 1)).mean())
    return float(np.minimum(p, 1.0 - p).mean()), errs, wrong / counted


def test_the_model_of_the_best_detector_is_that_of_the_rows() -> None:
    random = np.random.default_rng(1)
    bits = random.integers(0, 2, 40)
    light = expose_rows(manchester(bits), EXPOSURE, STEP, PHASE)
    model = branch_light()
    for k in range(30):
        expected = model[tuple(bits[k : k + BITS_BACK + 1])]
        np.testing.assert_allclose(light[k * ROWS : (k + 1) * ROWS], expected, atol=1e-12)


@pytest.mark.whole
def test_at_4_chips_and_15_db_no_detector_reaches_5_in_10000() -> None:
    found = np.array([rates(20, 5_000, seed) for seed in range(100, 112)])
    best, counted, sequence = found.mean(axis=0)
    errors = found.std(axis=0, ddof=1) / math.sqrt(len(found))
    assert counted == pytest.approx(best, abs=4.0 * float(errors[1]))  # as stated
    assert best - 2.0 * errors[0] > 5e-4
    assert counted <= sequence < 1.1 * counted
