"""Find the lamps in a photo: where each is, of what shape, and how it blinks."""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.lamps.blinking import Blinking, describe_lamp, join_parts
from occ_model.photo.lamps.edges import LampEdges, edges_of, matches
from occ_model.photo.lamps.segments import (
    LEAST_EDGES_OF_STRIP,
    LEAST_EQUAL_FRACTION,
    LEAST_STRIPS,
    Segment,
    common_edges,
    groups_of,
    segments_of,
)
from occ_model.photo.lamps.shape import spans_of
from occ_model.photo.lamps.strips import steady_lamps, strips_of
from occ_model.photo.lamps.timing import LampTiming, timings_of
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.photo.stripes.period import repeat_period
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp

_REFLECTED_BRIGHTNESS = 0.45  # most brightness of a reflection, relative to the lamp's
_FAINT_BRIGHTNESS = 0.25
"""Brightness relative to the brightest lamp below which a lamp may be a reflection."""
_FAINTEST, _FEW_PERIODS = 0.1, 3.0  # relative brightness and periods below which none is reported
_BRIGHT_QUANTILE, _SCATTERED_SWING = 0.8, 0.25
"""Quantile of the height of a lamp's edges, and part of it below which edges are of its halo."""

_GAMMA = 2.2  # exponent that converts grey levels to light for comparison
_MOST_DUTY = 0.65  # maximum duty of two stripes; panes of a window are wider
_FEW_EDGES = 4  # number of edges of two bright objects side by side
_LEAST_SPACING = 3.0  # minimum number of columns of a period or a chip
_LEAST_COLUMNS, _LEAST_PERIODS = 16, 2.0  # minimum width of a lamp in columns, and in periods
_LEAST_STRIP_FRACTION = 0.3  # minimum fraction of strips that show the period by themselves
_CHIP_TOLERANCE, _CHIP_COLUMNS = 0.02, 2.0
"""Maximum difference of a chip between a lamp and its segments: relative, plus columns over the
number of a segment's edges."""

_BLURRED_RATIO, _HARDLY_STRIPED_RATIO = 0.15, 0.3
"""Light between the stripes relative to that of the stripes above which the exposure may be longer
than a chip, and above which it is."""

_PERIOD_TOLERANCE = 0.03  # maximum relative difference of periods by edges and autocorrelation
_MOST_COMMON_FRACTION = 0.5  # fraction inside another lamp above which a lamp is a part of it
_OWN_EDGES = 8  # edges that show a lamp in the light that another one scatters around it
_GLOW_BRIGHTNESS = 0.5  # most brightness of the light scattered around a lamp, relative to it


def find_lamps(photo: Photo, progress: Callable[[float], object] | None = None) -> tuple[Lamp, ...]:
    """Find the lamps in a photo.

    A lamp is bright and has stripes, or it is bright and has none. A fainter place that blinks in
    time with a lamp is its reflection.

    Parameters
    ----------
    photo
        The photo, columns being the scan axis.
    progress
        Called with the fraction of the work that is done. What it raises ends the search.

    Returns
    -------
    tuple of Lamp
        The brightest first, of equally bright ones the largest; also those that touch each other.
    """
    report = progress or (lambda _fraction: None)
    report(0.0)
    means, bounds = strips_of(photo, lambda fraction: report(0.4 * fraction))
    strips = []
    for number, profile in enumerate(means):
        strips.append(edges_of(profile))
        report(0.4 + 0.3 * (number + 1) / len(means))
    segments: list[Segment] = []
    for number, edges in enumerate(strips):
        segments += segments_of(edges, number)
        report(0.7 + 0.1 * (number + 1) / len(strips))
    blinking = []
    for group in groups_of(segments):
        blinking += _find_blinking(group, segments, strips, bounds, means)
        report(0.85)
    blinking = _without_parts(join_parts(blinking, means, bounds))
    lamps = _assign_reflections(blinking)
    report(0.9)
    lamps += steady_lamps(means, bounds, [one.lamp for one in blinking])
    report(1.0)
    return tuple(sorted(lamps, key=lambda lamp: (-round(lamp.level), -lamp.area)))


def _find_blinking(
    group: Sequence[Segment],
    segments: Sequence[Segment],
    strips: Sequence[LampEdges],
    bounds: IndexArray,
    means: FloatArray,
) -> list[Blinking]:
    swings = [one.edges.swing for one in group]
    least = _SCATTERED_SWING * float(np.quantile(np.concatenate(swings), _BRIGHT_QUANTILE))
    bright = [float(np.median(swing)) >= least for swing in swings]
    if not any(bright):
        return []
    group = list(itertools.compress(group, bright))
    edges, weights = common_edges(group)
    found = []
    pulses = sum(len(one.edges) for one in group if one.period is not None)
    codes = 2 * pulses < sum(len(one.edges) for one in group)
    for timing in timings_of(edges, weights, codes):
        if not _is_lamp(timing):
            continue
        inner = [
            one.strip for one in group if matches(one.edges, timing.edges, timing.chip).sum() > 2
        ]
        if not inner:
            continue
        spans = spans_of(strips, inner, timing, least, bounds, means.shape[1])
        few = len(timing.edges) < LEAST_EDGES_OF_STRIP
        if len(spans) < (LEAST_STRIPS if few else 1):
            continue
        columns = int(spans[:, 3].max() - spans[:, 2].min())
        # If a period is to be seen repeating, some of them are in view.
        least = 0.0 if timing.is_code else _LEAST_PERIODS * timing.spacing
        if columns < max(_LEAST_COLUMNS, least):
            continue
        if _is_seen(timing, spans, segments, bounds):
            shown = np.searchsorted(bounds, spans[:, 0]).tolist()
            one = _describe_blinking(timing, spans, [strips[strip] for strip in shown])
            if may_be_miscounted(one, means[shown[0] : shown[-1] + 1]):
                one = replace(one, lamp=replace(one.lamp, is_blurred=True))
            found.append(one)
    return found


def _is_seen(
    timing: LampTiming, spans: IndexArray, segments: Sequence[Segment], bounds: IndexArray
) -> bool:
    """Whether enough strips of a lamp show its edges by themselves.

    Segments of all groups count, as those of a wide lamp may be in several.
    """
    first, last = np.searchsorted(bounds, [spans[0, 0], spans[-1, 0]]).tolist()
    shown = {
        one.strip for one in segments
        if first <= one.strip <= last and _is_of(one, timing)
    }  # fmt: skip
    return len(shown) >= _LEAST_STRIP_FRACTION * len(spans)


def _is_of(segment: Segment, timing: LampTiming) -> bool:
    """Whether a segment is part of a lamp: kind, chip length and most edges agree.

    The kind matters as two lamps in line may together resemble a code, while each of their segments
    is a repeated pulse.
    """
    if (segment.period is None) != timing.is_code:
        return False
    off = _CHIP_TOLERANCE * timing.chip + _CHIP_COLUMNS / len(segment.edges)
    if abs(segment.chip - timing.chip) > off:
        return False
    near = np.count_nonzero(matches(segment.edges, timing.edges, timing.chip))
    return bool(near > 2 and near >= LEAST_EQUAL_FRACTION * len(segment.edges))


def _describe_blinking(
    timing: LampTiming, spans: IndexArray, strips: Sequence[LampEdges]
) -> Blinking:
    own = [one.where(matches(one, timing.edges, timing.chip)) for one in strips]
    low = float(np.median(np.concatenate([one.low for one in own])))
    high = float(np.median(np.concatenate([one.high for one in own])))
    lamp = describe_lamp(timing, spans, high, is_code=timing.is_code)
    light, dark = ((level / WHITE) ** _GAMMA for level in (high, low))
    return Blinking(lamp, timing, light - dark, dark)


def may_be_miscounted(one: Blinking, means: FloatArray) -> bool:
    """Whether edges may have been missed: the stripes are faint, or repeat with another period.

    Stripes are faint where the exposure is longer than a chip: the light then never falls to that
    of the surroundings.
    """
    fraction = one.dark / max(one.light + one.dark, 1e-9)
    if not _BLURRED_RATIO < fraction < _HARDLY_STRIPED_RATIO:
        return fraction >= _HARDLY_STRIPED_RATIO
    region, period = one.lamp.region, one.lamp.period
    quarter = len(means) // 4
    inner = means[quarter : len(means) - quarter, region.first_column : region.last_column]
    found = repeat_period(remove_trend(inner.mean(axis=0)))
    if period is None or found is None:
        return True
    return abs(found[0] - period) > _PERIOD_TOLERANCE * period


def _is_lamp(timing: LampTiming) -> bool:
    """Whether some stripes are those of a lamp, and not of a few bright things side by side."""
    if timing.spacing < _LEAST_SPACING:
        return False
    edges = timing.edges
    if timing.is_code or len(edges) > _FEW_EDGES or not edges.rises[0]:
        return True
    lit = (timing.fall - timing.rise) / timing.spacing % 1.0
    return lit <= _MOST_DUTY


def _without_parts(blinking: Sequence[Blinking]) -> list[Blinking]:
    """Leave out what lies within a lamp of more evidence: noise has split some of its strips."""
    ordered = sorted(blinking, key=lambda one: one.evidence, reverse=True)
    kept: list[Blinking] = []
    for one in ordered:
        # A lamp of its own may lie within the light that another one scatters.
        is_own = one.lamp.period is not None and len(one.timing.edges) >= _OWN_EDGES
        near = [
            other for other in kept
            if other.light > _GLOW_BRIGHTNESS * one.light
            and not (is_own and not other.timing.agrees(one.timing))
        ]  # fmt: skip
        if all(_shared_fraction(one.lamp, other.lamp) < _MOST_COMMON_FRACTION for other in near):
            kept.append(one)
    return kept


def _shared_fraction(one: Lamp, other: Lamp) -> float:
    here, there = one.spans[:, None, :], other.spans[None, :, :]
    high = np.minimum(here[..., 1], there[..., 1]) - np.maximum(here[..., 0], there[..., 0])
    wide = np.minimum(here[..., 3], there[..., 3]) - np.maximum(here[..., 2], there[..., 2])
    return float((np.maximum(high, 0) * np.maximum(wide, 0)).sum() / one.area)


def _mark_faint(blinking: Sequence[Blinking]) -> list[Blinking]:
    """Mark lamps that are faint beside the brightest; leave out fainter ones that are short."""
    brightest = max((one.light for one in blinking), default=0.0)
    return [
        replace(one, lamp=replace(one.lamp, is_faint=one.light < _FAINT_BRIGHTNESS * brightest))
        for one in blinking
        if one.light >= _FAINTEST * brightest or (one.lamp.periods or _FEW_PERIODS) >= _FEW_PERIODS
    ]


def _assign_reflections(blinking: Sequence[Blinking]) -> list[Lamp]:
    """Return the lamps, each with its reflections: fainter places that blink in time with it."""
    ordered = sorted(_mark_faint(blinking), key=lambda one: -one.light)
    kept: list[Blinking] = []
    mirrored: dict[int, list[Region]] = {}
    for one in ordered:
        source = next(
            (
                number for number, lamp in enumerate(kept)
                if one.light < _REFLECTED_BRIGHTNESS * lamp.light and lamp.timing.agrees(one.timing)
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
