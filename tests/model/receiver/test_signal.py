"""Otsu's threshold against its definition."""

from fractions import Fraction

import numpy as np
import pytest
import skimage.filters
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.receiver.signal import otsu_split

histograms = st.lists(st.integers(0, 1000) | st.just(0), min_size=2, max_size=40)


def variances(counts: list[int]) -> dict[int, Fraction]:
    """Variance between the classes for every split that leaves neither empty, exactly."""
    total = sum(counts)
    result = {}
    for split in range(len(counts) - 1):
        lower = sum(counts[: split + 1])
        upper = total - lower
        if lower and upper:
            mean_lower = Fraction(sum(i * n for i, n in enumerate(counts[: split + 1])), lower)
            above = sum(i * n for i, n in enumerate(counts) if i > split)
            mean_upper = Fraction(above, upper)
            result[split] = Fraction(lower * upper, total**2) * (mean_upper - mean_lower) ** 2
    return result


@given(counts=histograms)
def test_of_equally_good_splits_the_middle_one_is_taken(counts: list[int]) -> None:
    exact = variances(counts)
    split = otsu_split(np.array(counts))
    if not exact:
        assert split is None
        return
    largest = max(exact.values())
    best = [place for place, variance in exact.items() if variance == largest]
    nearly = [place for place, variance in exact.items() if variance >= largest * (1 - 1e-9)]
    assert split in nearly
    if nearly == best:
        assert split == best[len(best) // 2]


@pytest.mark.parametrize("counts", [[0], [5], [0, 0, 0], [7, 0, 0], [0, 7, 0], [0, 0, 7]])
def test_fewer_than_two_filled_bins_have_no_split(counts: list[int]) -> None:
    assert otsu_split(np.array(counts, dtype=np.int64)) is None


@given(
    first=st.integers(0, 200),
    gap=st.integers(1, 55),
    weights=st.tuples(st.integers(1, 10**7), st.integers(1, 10**7)),
)
def test_two_filled_bins_are_split_in_the_middle_between_them(
    first: int, gap: int, weights: tuple[int, int]
) -> None:
    counts = np.zeros(256, dtype=np.int64)
    counts[[first, first + gap]] = weights
    assert otsu_split(counts) == first + gap // 2


@given(
    counts=st.lists(st.integers(0, 30), min_size=2, max_size=30).filter(np.count_nonzero),
    factor=st.integers(2, 10**6),
    before=st.integers(0, 20),
    after=st.integers(0, 20),
)
def test_pixel_counts_and_empty_bins_do_not_move_the_split(
    counts: list[int], factor: int, before: int, after: int
) -> None:
    split = otsu_split(np.array(counts))
    assert otsu_split(np.array(counts) * factor) == split
    padded = otsu_split(np.array([0] * before + counts + [0] * after))
    assert padded == (None if split is None else split + before)


@given(
    seed=st.integers(0, 2**32 - 1),
    dark=st.integers(20, 100),
    bright=st.integers(140, 235),
    spread=st.floats(3.0, 25.0),
    share=st.floats(0.1, 0.9),
)
def test_it_agrees_with_skimage_on_two_humps(
    seed: int, dark: int, bright: int, spread: float, share: float
) -> None:
    rng = np.random.default_rng(seed)
    lit = rng.random(5000) < share
    levels = rng.normal(np.where(lit, bright, dark), spread)
    counts = 1 + np.bincount(np.clip(np.rint(levels), 0, 255).astype(int), minlength=256)
    theirs = skimage.filters.threshold_otsu(hist=(counts, np.arange(256)))
    split = otsu_split(counts)
    assert split is not None
    assert abs(split - theirs) <= 1
    assert dark < split < bright


@pytest.mark.parametrize("far", [1e9, -1e9])
def test_a_single_value_that_is_no_grey_level_is_refused_with_it(far: float) -> None:
    image = np.full((4, 30), 100.0)
    image[2, 7] = far
    with pytest.raises(occ.DecodeInputError, match=r"holds the value 1e\+09"):
        occ.decode(image, occ.Scene())
