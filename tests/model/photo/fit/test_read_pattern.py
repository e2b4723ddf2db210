"""When chips are read from the edges alone, and when from the harmonics, too."""

import numpy as np
import pytest

from occ_model.photo.fit import read_pattern
from occ_model.photo.fit.chips_of_harmonics import ReadPattern
from occ_model.photo.fit.read_pattern import read_patterns

BY_EDGES = np.array([1, 0, 0, 1, 1, 0], dtype=np.uint8)
BY_LINES = np.array([1, 1, 1, 0, 1, 0], dtype=np.uint8)
LINE = np.tile(np.repeat([0.0, 1.0], 10), 12)


def turned(chips: np.ndarray) -> list[int]:
    """Return one and the same turn of chips that go round."""
    return min(np.roll(chips, turn).tolist() for turn in range(len(chips)))


def read(monkeypatch: pytest.MonkeyPatch, edges: ReadPattern | None) -> list[list[int]]:
    """Read stripes of which edges and harmonics tell these chips."""
    lines = ReadPattern(BY_LINES, 0.99, 0.5, 0.0)
    monkeypatch.setattr(read_pattern, "_fewest", lambda *_: edges)
    monkeypatch.setattr(read_pattern, "_chips_by_lines", lambda *_: lines)
    found = read_patterns(LINE, LINE, 60.0)
    return [turned(one.chips) for one in found]


@pytest.mark.parametrize(
    ("explained", "exposure", "both"),
    [(0.99, 0.5, False), (0.99, 1.4, False), (0.99, 2.0, True), (0.9, 0.5, True)],
)
def test_clear_edges_of_short_exposures_need_no_other_reading(
    monkeypatch: pytest.MonkeyPatch, explained: float, exposure: float, both: bool
) -> None:
    edges = ReadPattern(BY_EDGES, explained, exposure, 0.0)
    expected = [turned(BY_EDGES), turned(BY_LINES)]
    assert read(monkeypatch, edges) == expected[: 1 + both]


def test_without_edges_the_harmonics_are_read(monkeypatch: pytest.MonkeyPatch) -> None:
    assert read(monkeypatch, None) == [turned(BY_LINES)]


def test_chips_that_are_read_in_both_ways_are_given_once(monkeypatch: pytest.MonkeyPatch) -> None:
    assert read(monkeypatch, ReadPattern(BY_LINES, 0.9, 0.5, 0.0)) == [turned(BY_LINES)]
