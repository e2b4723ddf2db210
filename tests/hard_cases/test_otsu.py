"""Otsu's threshold for histograms full of ties, compared with rational arithmetic."""

import math
from collections.abc import Iterable
from fractions import Fraction
from itertools import accumulate

import numpy as np
from amount import amount
from each_case import each_case
from hypothesis import strategies as st

from hard_cases.laws import cases, record
from hard_cases.references import decades
from occ_model.receiver.signal import otsu_split, otsu_threshold

COUNTS = st.one_of(st.just(0), st.integers(0, 3), decades(1, 1e12).map(int))


def variances(counts: list[int], splits: Iterable[int]) -> dict[int, Fraction]:
    """Return the exact variance between classes for each split that leaves neither empty."""
    weights = list(accumulate(counts))
    moments = list(accumulate(place * count for place, count in enumerate(counts)))
    total, moment = weights[-1], moments[-1]
    return {
        split: Fraction((moment * w - total * m) ** 2, total**2 * w * (total - w))
        for split, w, m in ((split, weights[split], moments[split]) for split in splits)
        if 0 < w < total
    }


def shortfall(counts: list[int], split: int | None) -> float:
    """Return by what fraction a split's variance is below the largest one."""
    filled = {place for place, count in enumerate(counts) if count}
    exact = variances(counts, filled if split is None else {*filled, split})
    if not exact:
        return 0.0 if split is None else math.inf
    if split not in exact:
        return math.inf
    return float(1 - exact[split] / max(exact.values()))


@st.composite
def histograms(draw: st.DrawFn) -> list[int]:
    """Draw filled bins with gaps between them; every other histogram is symmetric."""
    filled = draw(st.lists(st.tuples(COUNTS, st.integers(0, 40)), min_size=1, max_size=12))
    counts = [number for count, gap in filled for number in (count, *[0] * gap)]
    return counts + counts[::-1] if draw(st.booleans()) else counts


@cases(counts=histograms())
def test_otsus_split_is_the_best_of_all_in_rational_arithmetic(counts: list[int]) -> None:
    split = otsu_split(np.array(counts))
    error = shortfall(counts, split)
    record(
        "Otsu: variance lost by the split, of the largest", "counts 0 to 1e12, ties", error, 1e-12
    )
    exact = variances(counts, range(len(counts)))
    if exact:
        largest = max(exact.values())
        best = [place for place, variance in exact.items() if variance == largest]
        close = [place for place, variance in exact.items() if variance > largest * (1 - 1e-9)]
        # If no other is nearly as good, it is the middle one of the best.
        assert close != best or split == best[len(best) // 2]


HISTOGRAMS: dict[str, tuple[list[int], int | None]] = {
    # Nothing to split.
    "no bin": ([0, 0, 0], None),
    "a single bin": ([0, 7, 0], None),
    "a histogram of one bin": ([5], None),
    # Every split between the two, 0 to 9, is equally good, and 5 is the middle one.
    "two bins far apart": ([1, *[0] * 9, 1], 5),
    # One against a trillion, where the variance is 1e-12 of what the counts would allow.
    "one against a trillion": ([10**12, *[0] * 9, 1], 5),
    # Two splits are exactly as good, and mirror each other.
    "three equal bins": ([1, 1, 1], 1),
    # Four are equally good; outside these, the splits between equal bins are worse.
    "two pairs": ([1, 1, 0, 0, 0, 1, 1], 3),
    # Two are, and each leaves one beside very many.
    "one on either side of ten thousand": ([1, 10_000, 1], 1),
    "one on either side of a trillion": ([1, 10**12, 1], 1),
    # All moments except the last are multiples of 1e12, which single precision cannot represent.
    "a trillion each": ([10**12] * 4, 1),
}  # fmt: skip


@each_case(HISTOGRAMS)
def test_otsus_split_of_a_hard_histogram(name: str) -> None:
    counts, expected = HISTOGRAMS[name]
    assert otsu_split(np.array(counts)) == expected
    assert shortfall(counts, expected) == 0.0


def test_otsus_split_of_100000_run_lengths_loses_nothing() -> None:
    # The longest run is as long as the signal, the others are short: 1e5 bins, ten of them filled.
    random = np.random.default_rng(3)
    for _ in range(amount(5, 20)):
        counts = np.zeros(100_000, dtype=np.int64)
        counts[random.integers(1, 40, 8)] = random.integers(1, 3000, 8)
        counts[random.integers(40, 100_000, 2)] = 1
        error = shortfall(counts.tolist(), otsu_split(counts))
        record("Otsu of run lengths: variance lost, of the largest", "1e5 columns", error, 1e-12)


@st.composite
def two_tones(draw: st.DrawFn) -> tuple[np.ndarray, float, float]:
    """Draw a signal of two values with runs of any length, and the values."""
    low = draw(st.floats(-1e4, 1e4))
    high = low + draw(decades(1.001, 1e4))
    lengths = draw(st.lists(decades(1, 1e3).map(int), min_size=2, max_size=30))
    values = np.resize([low, high], len(lengths))
    return np.repeat(values, lengths), low, high


@cases(signal=two_tones())
def test_the_threshold_of_two_values_lies_halfway(signal: tuple[np.ndarray, float, float]) -> None:
    values, low, high = signal
    threshold = otsu_threshold(values)
    # 255 steps have no middle, so that it may be off by half a step.
    error = abs(threshold - (low + high) / 2) / (high - low)
    record(
        "threshold between two values, off the middle, of the swing",
        "one run on",
        error,
        0.5 / 255 + 1e-9,
    )
    assert low < threshold < high
