"""The results for the laws reach the process that prints them."""

import numpy as np
import pytest

from hard_cases import laws


@pytest.fixture
def found(monkeypatch: pytest.MonkeyPatch) -> dict[str, laws.LawResult]:
    """Start without results."""
    empty: dict[str, laws.LawResult] = {}
    monkeypatch.setattr(laws, "FOUND", empty)
    return empty


@pytest.mark.usefixtures("found")
def test_errors_are_sent_as_plain_numbers() -> None:
    laws.record("a law", "everywhere", np.float64(0.25))
    assert [tuple(map(type, row)) for row in laws.rows()] == [(str, str, int, float)]


def test_the_results_of_two_processes_are_combined(found: dict[str, laws.LawResult]) -> None:
    laws.record("a law", "everywhere", 0.5)
    laws.merge("a law", "everywhere", 3, 0.25)
    laws.merge("another", "nowhere", 1, 2.0)
    assert (found["a law"].cases, found["a law"].worst) == (4, 0.5)
    assert laws.table()[2:] == [
        "| a law | everywhere | 4 | 5.0e-01 |",
        "| another | nowhere | 1 | 2.0e+00 |",
    ]
