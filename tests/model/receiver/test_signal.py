"""Otsu's threshold against its definition."""

import numpy as np
import pytest
import skimage.filters
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.receiver.signal import otsu_split


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
    assert abs(split - theirs) <= 1
    assert dark < split < bright


@pytest.mark.parametrize("far", [1e9, -1e9])
def test_a_single_value_that_is_no_grey_level_is_refused_with_it(far: float) -> None:
    image = np.full((4, 30), 100.0)
    image[2, 7] = far
    with pytest.raises(occ.DecodeInputError, match=r"holds the value 1e\+09"):
        occ.decode(image, occ.Scene())
