"""Exposures, frequencies and shutter speeds without bars."""

from collections.abc import Callable

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError
from occ_model.results.bands import NO_BARS_DEPTH, BandAdvice, SpeedDepth
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_depth
from occ_model.study.bands.least_depth import DepthOver
from occ_model.study.bands.shutter_speeds import shutter_speeds

_MAX_CHIPS = 10_000  # exposure in chips from which the code's bars are bounded, not computed
_MIN_LIMIT = 1e-4

_HALVINGS = 60

_GOLDEN = (5.0**0.5 - 1.0) / 2.0

Depths = Callable[[FloatArray], FloatArray]
Ranges = tuple[tuple[float, float], ...]


def band_advice(scene: Scene, limit: float = NO_BARS_DEPTH) -> BandAdvice:
    """Find exposures, frequencies and shutter speeds with bars below a depth.

    Exposures hold at the scene's switching frequency, frequencies at its exposure time. Both are
    computed for sharp edges, the worst case; the depth at shutter speeds includes the LED's edges.

    Parameters
    ----------
    limit
        Peak-to-peak depth relative to the mean, below which there are no bars.

    Raises
    ------
    ParameterError
        The limit is out of range.
    """
    over = DepthOver.of(scene)
    if not _MIN_LIMIT <= limit <= 1.0:
        raise ParameterError.of(
            "limit", f"{100.0 * limit:g} %", f"{100.0 * _MIN_LIMIT:g} % to 100 %"
        )
    frequency = scene.transmitter.switching_frequency
    exposures, all_exposures = _exposures(over, frequency, limit)
    frequencies, all_frequencies = _frequencies(over, scene.camera.exposure_time, limit)
    return BandAdvice(
        limit,
        over.period / frequency,
        exposures,
        all_exposures,
        frequencies,
        all_frequencies,
        speed_depths(scene),
    )


def speed_depths(scene: Scene) -> tuple[SpeedDepth, ...]:
    """Return the depth of the bars at the usual shutter speeds."""

    def depth(exposure: float) -> float:
        return light_depth(scene.replace(exposure_time=exposure)).peak_to_peak

    return tuple(
        SpeedDepth(each.name, each.nominal, each.real, depth(each.nominal), depth(each.real))
        for each in shutter_speeds()
    )


def _exposures(over: DepthOver, frequency: float, limit: float) -> tuple[Ranges, float | None]:
    allowed = quantity("exposure_time")
    # The code's bars fall as 1 / (f t), the flicker's as 1 / (pi F t).
    flicker = over.of_flicker / np.pi / over.flicker_frequency
    end = (over.most / frequency + flicker) / limit
    known = min(end, _MAX_CHIPS / frequency)
    nodes = np.arange(1, int(known * frequency) + 1) / frequency
    nulls = np.arange(1, int(end * over.flicker_frequency) + 1) / over.flicker_frequency
    nodes = np.concatenate([nodes, nulls if over.of_flicker else [], [known, end]])

    def depths(exposures: FloatArray) -> FloatArray:
        chips = frequency * exposures
        code = np.where(chips > _MAX_CHIPS, over.most / chips, over.of_code(chips))
        return code + over.flicker(exposures)

    return _split(_below(depths, nodes, limit, allowed.low, end), allowed.high)


def _frequencies(over: DepthOver, exposure: float, limit: float) -> tuple[Ranges, float | None]:
    allowed = quantity("switching_frequency")
    left = limit - float(over.flicker(np.array([exposure]))[0])
    if left <= 0.0:
        return (), None
    end = over.most / left
    nodes = np.arange(1, int(min(end, _MAX_CHIPS)) + 1) / exposure

    def depths(frequencies: FloatArray) -> FloatArray:
        chips = frequencies * exposure
        return np.where(chips > _MAX_CHIPS, over.most / chips, over.of_code(chips))

    nodes = np.concatenate([nodes, [end / exposure]])
    return _split(_below(depths, nodes, left, allowed.low, end / exposure), allowed.high)


def _split(ranges: list[tuple[float, float]], highest: float) -> tuple[Ranges, float | None]:
    """Separate the last range, which extends to infinity, from those before."""
    *others, last = ranges
    kept = tuple((low, min(high, highest)) for low, high in others if low < highest)
    return kept, last[0] if last[0] < highest else None


def _below(
    depths: Depths, nodes: FloatArray, limit: float, low: float, end: float
) -> list[tuple[float, float]]:
    """Return the ranges in which depths, quasi-concave between nodes, are below a limit.

    From ``end`` on all are.
    """
    inner = nodes[(nodes > low) & (nodes < end)]
    places = np.unique(np.concatenate([[min(low, end)], inner, [end]]))
    first, last = places[:-1], places[1:]
    peak = _peaks(depths, first, last)
    rising = _crossings(depths, first, peak, limit)
    falling = _crossings(depths, last, peak, limit)
    found: list[tuple[float, float]] = []
    for pieces in zip(first, rising, falling, last, strict=True):
        for start, stop in (pieces[:2], pieces[2:]):
            if stop <= start:
                continue
            if found and start <= found[-1][1]:
                found[-1] = (found[-1][0], float(stop))
            else:
                found.append((float(start), float(stop)))
    if found and found[-1][1] >= end:
        return [*found[:-1], (found[-1][0], np.inf)]
    return [*found, (end, np.inf)]


def _peaks(depths: Depths, first: FloatArray, last: FloatArray) -> FloatArray:
    """Return the place of the maximum between each pair, by golden-section search."""
    first, last = first.copy(), last.copy()
    for _ in range(_HALVINGS):
        width = _GOLDEN * (last - first)
        left, right = last - width, first + width
        is_left = depths(left) > depths(right)
        first, last = np.where(is_left, first, left), np.where(is_left, right, last)
    return np.asarray(0.5 * (first + last))


def _crossings(depths: Depths, low: FloatArray, high: FloatArray, limit: float) -> FloatArray:
    """Return the crossing of a limit between ``low`` and ``high``, where values rise."""
    is_free = depths(high) < limit
    inner, outer = low.copy(), high.copy()
    for _ in range(_HALVINGS):
        middle = 0.5 * (inner + outer)
        is_below = depths(middle) < limit
        inner, outer = np.where(is_below, middle, inner), np.where(is_below, outer, middle)
    return np.where(is_free, high, inner)
