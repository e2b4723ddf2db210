"""The manual's table of limits contains what the search finds.

One row for each preset and each decoder is searched again. All rows take minutes, those with a lens
many; ``python tests/benchmarks/limits.py`` prints them.
"""

import re
import runpy

import pytest
from documents import FOLDER, ROOT, text_of

(TABLE,) = re.findall(
    r"^\| preset \| threshold .*(?:\n\|.*)+", text_of(FOLDER / "validation.md"), re.M
)
HEAD, *ROWS = [line.strip("| ").split(" | ") for line in TABLE.splitlines()]


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
    benchmark = runpy.run_path(str(ROOT / "tests" / "benchmarks" / "limits.py"))
    _, _, lowest, highest, *_ = benchmark["line"](preset, decoder).strip("| ").split(" | ")
    found = f"{lowest} to {highest}".replace(" kHz", "").replace(" (not searched beyond)", "*")
    (row,) = [row for row in ROWS if row[0] == preset]
    assert row[HEAD.index(decoder)] == found
