"""The sentences of doubts: a number that is beyond its limit is seen to be."""

import pytest

from occ_model.photo.evidence.doubts import told_apart


@pytest.mark.parametrize(
    ("value", "limit", "texts"),
    [
        (10.04, 3.0, ("10.0", "3.0")),
        (3.54, 3.52, ("3.54", "3.52")),
        (3.500_04, 3.5, ("3.50004", "3.50000")),
    ],
)
def test_a_number_and_its_limit_are_written_apart(
    value: float, limit: float, texts: tuple[str, str]
) -> None:
    assert told_apart(value, limit) == texts
