"""What is drawn is taken for unchanged only where every part of it is."""

import numpy as np
import pytest

from occ_gui.widgets.unchanged import are_same

ARRAY = np.array([1.0, 2.0])


@pytest.mark.parametrize(
    ("ones", "others", "same"),
    [
        ([], [], True),
        ([1, "a"], [1, "a"], True),
        ([1, "a"], [1, "b"], False),
        ([1, "a"], [2, "a"], False),
        ([1], [1, 2], False),
        ([1, 2], [1], False),
        ([ARRAY, 1], [ARRAY.copy(), 1], True),
        ([ARRAY, 1], [ARRAY, 2], False),
        ([ARRAY], [ARRAY + 1.0], False),
        ([ARRAY], [ARRAY[:1]], False),
        ([ARRAY], [1.0], False),
        ([1.0], [ARRAY], False),
    ],
)
def test_lists_are_the_same_where_every_value_is(
    ones: list[object], others: list[object], same: bool
) -> None:
    assert are_same(ones, others) is same
