"""Generated cases for laws, and the largest error of each law."""

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from amount import amount
from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

LAWS = 40  # laws among which the cases are divided; there are at least as many


@dataclass
class LawResult:
    """The result for one law."""

    ranges: str
    cases: int = 0
    worst: float = 0.0


FOUND: dict[str, LawResult] = {}  # by the law


def record(law: str, ranges: str, error: float, most: float = math.inf) -> None:
    """Note a law's error in one case, and fail if it is too large.

    Parameters
    ----------
    law
        The law in a few words, and what the error is relative to.
    ranges
        The ranges of the parameters in its cases.
    error
        The error, not negative; NaN counts as infinite.
    most
        The largest error allowed.
    """
    found = FOUND.setdefault(law, LawResult(ranges))
    found.cases += 1
    wrong = error if error == error else math.inf
    found.worst = max(found.worst, wrong)
    assert wrong <= most, f"{law}: {error:g} instead of at most {most:g}"


Test = Callable[..., None]


def _cases_of_a_law() -> int:
    """Return how many cases a law gets; called once pytest is configured."""
    return max(int(os.environ.get("OCC_HARD_CASES", amount(800, 3_000))) // LAWS, 20)


def cases(**strategies: SearchStrategy[Any]) -> Callable[[Test], Test]:
    """Run a test on generated cases, always the same ones."""

    def decorate(test: Test) -> Test:
        chosen = settings(
            max_examples=_cases_of_a_law(),
            deadline=None,
            derandomize=True,
            database=None,
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
        )
        return chosen(given(**strategies)(test))

    return decorate


Row = tuple[str, str, int, float]  # A law, its ranges, the cases tried and the worst error


def rows() -> list[Row]:
    """Return the results as plain values, since pytest-xdist sends no numbers of NumPy."""
    return [(law, found.ranges, found.cases, float(found.worst)) for law, found in FOUND.items()]


def merge(law: str, ranges: str, cases: int, worst: float) -> None:
    """Add the results of another process for a law."""
    found = FOUND.setdefault(law, LawResult(ranges))
    found.cases += cases
    found.worst = max(found.worst, worst)


def table() -> list[str]:
    """Write the results as a Markdown table."""
    lines = ["| law | range | cases | worst error |", "|---|---|---|---|"]
    for law, found in sorted(FOUND.items()):
        worst = "none" if found.worst == 0.0 else f"{found.worst:.1e}"
        lines.append(f"| {law} | {found.ranges} | {found.cases:,} | {worst} |")
    return lines
