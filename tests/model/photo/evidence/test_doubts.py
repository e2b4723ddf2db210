"""Figures of a match have limits."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from occ_model.errors import distinct_texts
from occ_model.photo.evidence.doubts import doubts
from occ_model.photo.fit.timing import Timing


def explained(was_read: bool = False, saturated: float = 0.0, **other: float) -> list[str]:
    """Return the doubts of chips that are explained well but for some figure."""
    known = {"periods": 9.0, "exposure": 0.5, "correlation": 0.99, "information": 900.0, **other}
    timing = Timing(0.1, known["exposure"], 0.0, 2.2)
    found: Any = SimpleNamespace(
        chips=np.array([1, 1, 1, 0, 1, 0, 0, 1, 0, 0], dtype=np.uint8),
        was_read=was_read, read_again=False, periods=known["periods"],
        information=known["information"],
        fit=SimpleNamespace(timing=timing, correlation=known["correlation"]),
    )  # fmt: skip
    stripes: Any = SimpleNamespace(saturated=saturated, period=None)
    return doubts(found, stripes, known.get("rows_alike", 1.0))


@pytest.mark.parametrize(
    ("name", "sure", "doubtful", "said", "was_read"),
    [
        ("periods", 1.5, 1.49, "Only 1.49 periods of 10 chips are in view; at least 1.50", False),
        ("periods", 3.0, 2.96, "Only 2.96 periods of 10 chips are in view; at least 3.00", True),
        ("exposure", 3.2, 3.3, "The exposure is 3.3 times as long as a chip; above 3.2", False),
        ("correlation", 0.9, 0.89, "The correlation is 0.89; below 0.90", False),
        ("information", 40.0, 39.0, "by chance by 39 bits only; at least 40", False),
        ("information", 100.0, 99.0, "by chance by 99 bits only; at least 100", True),
        ("rows_alike", 0.85, 0.84, "only with a correlation of 0.84; at least 0.85", False),
        ("saturated", 0.5, 0.51, "51.0 % of the pixels are saturated", True),
    ],
)
def test_each_figure_has_a_limit_from_which_a_match_is_doubtful(
    name: str, sure: float, doubtful: float, said: str, was_read: bool
) -> None:
    assert explained(was_read=was_read, **{name: sure}) == []
    (why,) = explained(was_read=was_read, **{name: doubtful})
    assert said in why


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
    assert distinct_texts(value, limit) == texts
