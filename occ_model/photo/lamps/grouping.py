"""Put together the segments of neighbouring strips that belong to one lamp.

All rows of a lamp have their edges at the same columns, whatever its shape; those of another lamp
have not, even where both touch.
"""

from collections.abc import Sequence

import numpy as np

from occ_model.photo.lamps.edges import Edges, equal_within, matches
from occ_model.photo.lamps.segments import Segment

_MOST_DISTANCE = 2  # maximum distance of neighbouring segments in strips, for noise

LEAST_EQUAL_FRACTION = 0.65
"""Minimum fraction of equal edges of two segments, relative to the longer one: in a strip, noise or
a rim can join the edges of two lamps, and such a segment must not join the lamps."""

LEAST_STRIPS = 2
"""Minimum number of strips of a lamp: in one, noise makes edges equal."""

_LEAST_STRIP_FRACTION = 0.2  # minimum fraction of a group's strips that show an edge


def groups_of(segments: Sequence[Segment]) -> list[list[Segment]]:
    """Put together the segments of each lamp, in order of the strips.

    What stands in a single strip is texture or the border of two lamps, and is left out.
    """
    parents = list(range(len(segments)))

    def root(index: int) -> int:
        while parents[index] != index:
            parents[index] = parents[parents[index]]
            index = parents[index]
        return index

    by_strip: dict[int, list[int]] = {}
    for index, segment in enumerate(segments):
        by_strip.setdefault(segment.strip, []).append(index)
    for index, segment in enumerate(segments):
        for strip in range(segment.strip + 1, segment.strip + 1 + _MOST_DISTANCE):
            for other in by_strip.get(strip, ()):
                if _agree(segment, segments[other]):
                    parents[root(other)] = root(index)
    groups: dict[int, list[Segment]] = {}
    for index, segment in enumerate(segments):
        groups.setdefault(root(index), []).append(segment)
    return [group for group in groups.values() if len({one.strip for one in group}) >= LEAST_STRIPS]


def _agree(one: Segment, other: Segment) -> bool:
    chip = min(one.chip, other.chip)
    off = equal_within(chip)
    counts = len(one.edges), len(other.edges)
    here, there = one.edges.place, other.edges.place
    if min(counts) < LEAST_EQUAL_FRACTION * max(counts) or not (
        here[0] <= there[-1] + off and there[0] <= here[-1] + off
    ):
        return False
    near = np.count_nonzero(matches(one.edges, other.edges, chip))
    return bool(near >= LEAST_EQUAL_FRACTION * max(counts))


def common_edges(group: Sequence[Segment]) -> tuple[Edges, np.ndarray]:
    """Return the edges that several segments of a group share, and how many share each.

    The rim of a round lamp lies at other columns in each strip, and so is not among them.
    """
    off = equal_within(float(np.median([one.chip for one in group])))
    place = np.concatenate([one.edges.place for one in group])
    rises = np.concatenate([one.edges.rises for one in group])
    low = np.concatenate([one.edges.low for one in group])
    high = np.concatenate([one.edges.high for one in group])
    rows: list[tuple[float, bool, float, float, int]] = []
    least = max(LEAST_STRIPS, _LEAST_STRIP_FRACTION * len(group))
    for kind in (True, False):
        order = np.flatnonzero(rises == kind)
        order = order[np.argsort(place[order], kind="stable")]
        for same in np.split(order, np.flatnonzero(np.diff(place[order]) > off) + 1):
            if len(same) >= least:
                levels = (float(np.median(low[same])), float(np.median(high[same])))
                rows.append((float(np.median(place[same])), kind, *levels, len(same)))
    rows.sort()
    columns = [np.array(column) for column in zip(*rows, strict=True)] or [np.zeros(0)] * 5
    return Edges(columns[0], columns[1].astype(bool), columns[2], columns[3]), columns[4]
