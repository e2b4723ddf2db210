"""The manual's table of limits is what the search finds."""

import runpy
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[2]

PAGE = TESTS.parent / "resources" / "docs" / "sweeps.md"

ROWS = [
    row
    for row in PAGE.read_text(encoding="utf-8").splitlines()
    if row.endswith(" s |") and "-real |" not in row  # which take minutes
]


def parameters() -> list[object]:
    """One row every day; the others take up to half a minute each."""
    is_daily = [row.startswith("| phone-68us | threshold |") for row in ROWS]
    assert sum(is_daily) == 1
    return [
        pytest.param(row, marks=() if daily else pytest.mark.whole, id=f"row {number}")
        for number, (row, daily) in enumerate(zip(ROWS, is_daily, strict=True))
    ]


@pytest.mark.parametrize("row", parameters())
def test_the_manuals_table_of_limits_is_what_the_search_finds(row: str) -> None:
    line = runpy.run_path(str(TESTS / "benchmarks" / "limits.py"))["line"]
    preset, decoder = (cell.strip() for cell in row.split("|")[1:3])
    assert line(preset, decoder).split("|")[:-2] == row.split("|")[:-2]  # but for its time
