"""Chips whose bright runs are too long by as much may be fewer."""

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st

from occ_model.photo.fit.chip_runs import chips_if_longer, is_single_pulse


@given(st.lists(st.integers(1, 5), min_size=2, max_size=12), st.integers(2, 5), st.data())
def test_chips_whose_bright_runs_are_longer_by_as_much_may_be_fewer(
    runs: list[int], together: int, data: st.DataObject
) -> None:
    bright = [together * run for run in runs]
    dark = [together * run for run in reversed(runs)]
    longer = data.draw(st.integers(1, together - 1))
    chips = np.concatenate(
        [[1] * (on + longer) + [0] * (off - longer) for on, off in zip(bright, dark, strict=True)]
    ).astype(np.uint8)
    assume(not is_single_pulse(chips))
    found, by = chips_if_longer(chips)
    assert (found, by) == (together, longer) or found > together


@pytest.mark.parametrize(
    "chips", ["111", "10", "1110", "1101001", "10100010", "1110100110", "1100110000"]
)
def test_chips_of_no_such_kind_are_no_fewer(chips: str) -> None:
    assert chips_if_longer(np.array(list(chips), dtype=np.uint8)) == (1, 0)
