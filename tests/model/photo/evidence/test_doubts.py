"""Figures of a match have limits."""

from typing import Any

import numpy as np
import pytest
from hypotheses import hypothesis

from occ_model.errors import distinct_texts
from occ_model.photo.evidence.doubts import doubts
from occ_model.photo.fit.timing import Timing
from occ_model.results.decoding import Region
from occ_model.results.match import Stripes

COLUMNS = 600
FLAT = np.ones(COLUMNS)


def explained(
    chips: np.ndarray | str = "1110100100", was_read: bool = False, saturated: float = 0.0,
    row_correlation: float = 1.0, periods: float = 9.0, exposure: float = 0.5, **figures: Any,
) -> list[str]:  # fmt: skip
    """Return the doubts of chips that are explained well but for some figure."""
    timing = Timing(periods * len(chips) / COLUMNS, exposure, 0.0, 2.2)
    figures = {"information": 900.0, **figures}
    found = hypothesis(chips, timing, COLUMNS, was_read=was_read, **figures)
    stripes = Stripes(Region(0, 9, 0, COLUMNS), FLAT, FLAT, FLAT, None, None, saturated)
    return doubts(found, stripes, row_correlation)


@pytest.mark.parametrize(
    ("name", "sure", "doubtful", "said", "was_read"),
    [
        ("periods", 1.5, 1.49, "Only 1.49 periods of 10 chips are in view; at least 1.50", False),
        ("periods", 3.0, 2.96, "Only 2.96 periods of 10 chips are in view; at least 3.00", True),
        ("exposure", 3.2, 3.3, "The exposure is 3.3 times as long as a chip; above 3.2", False),
        ("correlation", 0.9, 0.89, "The correlation is 0.89; below 0.90", False),
        ("information", 40.1, 39.0, "by chance by 39 bits only; at least 40", False),
        ("information", 100.1, 99.0, "by chance by 99 bits only; at least 100", True),
        ("row_correlation", 0.85, 0.84, "only with a correlation of 0.84; at least 0.85", False),
        ("saturated", 0.5, 0.51, "51.0 % of the pixels are saturated", True),
    ],
)
def test_each_figure_has_a_limit_from_which_a_match_is_doubtful(
    name: str, sure: float, doubtful: float, said: str, was_read: bool
) -> None:
    figures: list[dict[str, Any]] = [{name: sure}, {name: doubtful}]
    none, (why,) = (explained(was_read=was_read, **each) for each in figures)
    assert none == []
    assert said in why


def test_bright_runs_that_white_lengthens_may_be_those_of_longer_chips() -> None:
    runs = [(2, 1), (1, 3), (3, 2)]  # bright and dark, in chips of two, each a half too long
    chips = np.concatenate([[1] * (2 * on + 1) + [0] * (2 * off - 1) for on, off in runs])
    (why,) = explained(chips, was_read=True, saturated=0.5)
    assert "12 chips that last 2 times as long explain the same edges" in why
    assert explained(chips, was_read=True) == []


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
