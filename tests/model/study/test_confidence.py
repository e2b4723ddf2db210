"""Laws of the interval of a rate; hard_cases/test_statistics.py checks it in high precision."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from occ_model.study.confidence import interval_of_pictures, wilson_interval


def test_numbers_of_other_types_are_accepted() -> None:
    others: list[tuple[Any, Any, Any]] = [
        (np.int32(3), np.uint8(10), np.float64(0.9)),
        (3, 10, Fraction(9, 10)),
    ]
    expected = wilson_interval(3, 10, 0.9)
    assert [wilson_interval(*numbers) for numbers in others] == [expected, expected]


@pytest.mark.parametrize("fraction", [0.02, 0.1, 0.37, 0.5, 0.8, 0.9, 0.95, 0.98])
def test_the_interval_of_pictures_holds_if_bits_of_a_picture_fail_together(
    fraction: float,
) -> None:
    random = np.random.default_rng(3)
    held = wide = 0
    for _ in range(800):
        whole = int(random.binomial(20, fraction))
        low, high = interval_of_pictures(10 * whole, 200, 20)
        held += low <= 100.0 * fraction <= high
        near, far = (100.0 * end for end in wilson_interval(10 * whole, 200))
        wide += near <= 100.0 * fraction <= far
    assert 0.90 <= held / 800 <= 0.995
    # Counted by bits it would not hold, so the test can fail.
    assert wide / 800 < 0.9
    assert interval_of_pictures(200, 200, 20)[0] == pytest.approx(83.89, abs=0.01)
