"""Find the lamps in a photo: where each is, of what shape, and how it blinks."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.lamps.edges import edges_of
from occ_model.photo.lamps.grouping import common_edges, groups_of
from occ_model.photo.lamps.segments import Segment, segments_of
from occ_model.photo.lamps.steady import steady_lamps
from occ_model.photo.lamps.strips import strips_of
from occ_model.photo.lamps.timing import LampTiming, timing_of
from occ_model.photo.reading.load import Photo
from occ_model.results import Lamp, Region

_FAINT = 0.6
"""Share of a lamp's light below which what blinks in time with it is its reflection."""

_GAMMA = 2.2
"""Exponent by which grey levels are compared as light."""

_EVEN = (0.22, 0.78)
"""Shares of a period within which two bright stripes are a lamp's: two panes are nearer."""

_SHORT_EDGES = 5
"""Fewest edges of a lamp whose bright stripes are much wider or narrower than its dark ones."""


@dataclass(frozen=True, eq=False, slots=True)
class _Blinking:
    """A lamp with stripes, and how it blinks."""

    lamp: Lamp
    timing: LampTiming
    light: float


def find_lamps(photo: Photo, progress: Callable[[float], object] | None = None) -> tuple[Lamp, ...]:
    """Find the lamps in a photo.

    A lamp is bright and has stripes, or it is bright and has none. A fainter place that blinks in
    time with a lamp is its reflection.

    Parameters
    ----------
    photo
        The photo, columns being the scan axis.
    progress
        Called with the share of the work that is done. What it raises ends the search.

    Returns
    -------
    tuple of Lamp
        The brightest first, of equally bright ones the largest; also those that touch each other.
    """
    report = progress or (lambda _share: None)
    report(0.0)
    means, bounds = strips_of(photo, lambda share: report(0.4 * share))
    segments: list[Segment] = []
    for strip, profile in enumerate(means):
        segments += segments_of(edges_of(profile), strip)
        report(0.4 + 0.4 * (strip + 1) / len(means))
    blinking = []
    for group in groups_of(segments):
        found = _blinking(group, bounds, means.shape[1])
        if found is not None:
            blinking.append(found)
        report(0.85)
    lamps = _without_reflections(blinking)
    report(0.9)
    lamps += steady_lamps(means, bounds, [one.lamp for one in blinking])
    report(1.0)
    return tuple(sorted(lamps, key=lambda lamp: (-round(lamp.level), -lamp.area)))


def _blinking(group: list[Segment], bounds: IndexArray, columns: int) -> _Blinking | None:
    """Describe the lamp of a group of segments; None where its edges have no period."""
    edges, weights = common_edges(group)
    if len(edges) < 4:  # noqa: PLR2004 - two stripes
        return None
    timing = timing_of(edges, weights)
    if timing is None or not _is_lamp(timing):
        return None
    spans = _spans(group, timing, bounds, columns)
    region = _around(spans)
    low, high = float(np.median(timing.edges.low)), float(np.median(timing.edges.high))
    chip, spacing = timing.chip, timing.spacing
    per_spacing = timing.uncertainty / spacing
    lamp = Lamp(
        region=region,
        spans=spans,
        level=high,
        modulated=True,
        period=None if timing.is_code else spacing,
        period_uncertainty=None if timing.is_code else timing.uncertainty,
        switching_frequency_times_readout=1.0 / chip,
        product_uncertainty=per_spacing / chip,
        periods=None if timing.is_code else region.columns / spacing,
    )
    return _Blinking(lamp, timing, (high / WHITE) ** _GAMMA - (low / WHITE) ** _GAMMA)


def _is_lamp(timing: LampTiming) -> bool:
    """Whether few stripes are as even as those of a lamp, and no two bright things side by side."""
    if timing.is_code or len(timing.edges) >= _SHORT_EDGES:
        return True
    lit = (timing.fall - timing.rise) / timing.spacing % 1.0
    return _EVEN[0] <= lit <= _EVEN[1]


def _spans(
    group: list[Segment], timing: LampTiming, bounds: IndexArray, columns: int
) -> IndexArray:
    """Give the shape of a group of segments: the columns from the first to the last, by strips."""
    reach = 1.2 * (6.0 * timing.chip if timing.is_code else timing.spacing)
    left, right = timing.edges.place[0] - reach, timing.edges.place[-1] + reach
    spans: dict[int, tuple[float, float]] = {}
    for one in group:
        first, last = spans.get(one.strip, (np.inf, -np.inf))
        spans[one.strip] = min(first, max(one.first, left)), max(last, min(one.last, right))
    rows = []
    for strip in range(min(spans), max(spans) + 1):
        # Noise can hide a lamp in a strip: it is as wide there as above.
        span = spans.get(strip) or rows_before
        rows_before = span
        first, last = max(int(np.floor(span[0])), 0), min(int(np.ceil(span[1])) + 1, columns)
        if last > first:
            rows.append((int(bounds[strip]), int(bounds[strip + 1]), first, last))
    return np.array(rows, dtype=np.int64)


def _around(spans: IndexArray) -> Region:
    return Region(
        int(spans[:, 0].min()), int(spans[:, 1].max()),
        int(spans[:, 2].min()), int(spans[:, 3].max()),
    )  # fmt: skip


def _without_reflections(blinking: list[_Blinking]) -> list[Lamp]:
    """Give the lamps, each with the regions of the fainter ones that blink in time with it."""
    ordered = sorted(blinking, key=lambda one: -one.light)
    kept: list[_Blinking] = []
    mirrored: dict[int, list[Region]] = {}
    for one in ordered:
        source = next(
            (
                number for number, lamp in enumerate(kept)
                if one.light < _FAINT * lamp.light and lamp.timing.agrees(one.timing)
            ),
            None,
        )  # fmt: skip
        if source is None:
            kept.append(one)
        else:
            mirrored.setdefault(source, []).append(one.lamp.region)
    return [
        replace(one.lamp, reflections=tuple(mirrored.get(number, ())))
        for number, one in enumerate(kept)
    ]


