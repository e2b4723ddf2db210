"""The manual's table of limits is what the search finds.

A row of each preset and each decoder is searched again: all of them take minutes, those with a lens
many, and ``python tests/benchmarks/limits.py`` prints them.
"""

import runpy
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[2]

PAGE = TESTS.parent / "resources" / "docs" / "sweeps.md"

ROWS = [row for row in PAGE.read_text(encoding="utf-8").splitlines() if row.endswith(" s |")]


@pytest.mark.whole
@pytest.mark.parametrize(
    ("preset", "decoder"),
    [
        ("phone-68us", "threshold"),
        ("phone-136us", "matched"),
        ("tablet-61us", "equalizer"),
        ("tablet-122us", "sequence"),
    ],
)
def test_the_manuals_table_of_limits_is_what_the_search_finds(preset: str, decoder: str) -> None:
    line = runpy.run_path(str(TESTS / "benchmarks" / "limits.py"))["line"]
    (row,) = [row for row in ROWS if row.startswith(f"| {preset} | {decoder} |")]
    assert line(preset, decoder).split("|")[:-2] == row.split("|")[:-2]  # but for its time
