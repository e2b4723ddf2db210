"""Exposures, frequencies and shutter speeds without bars, and scenes of equal brightness."""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError
from occ_model.results.bands import NO_BARS_DEPTH, BandAdvice, Cure, ShutterSpeed, SpeedDepth
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_depth, mean_light
from occ_model.study.bands.least_depth import MAX_NODES, DepthOver
from occ_model.study.bands.sines import repeat_time

_MIN_LIMIT = 1e-4

_HALVINGS = 60

_GOLDEN = (5.0**0.5 - 1.0) / 2.0

Depths = Callable[[FloatArray], FloatArray]
Ranges = tuple[tuple[float, float], ...]


def band_advice(scene: Scene, limit: float = NO_BARS_DEPTH) -> BandAdvice:
    """Find exposures, frequencies and shutter speeds with bars below a depth.

    Exposures hold at the scene's frequency of the lamp or of switching, frequencies at its exposure
    time. Both are computed for sharp edges, the worst case; the depth at shutter speeds includes
    the LED's edges. In none of the ranges is the depth above the limit.

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
    exposures, all_exposures = _exposures(over, limit)
    frequencies, all_frequencies = _frequencies(over, scene.camera.exposure_time, limit)
    return BandAdvice(
        over.axis,
        limit,
        over.period / over.axis.frequency,
        1.0 / over.flicker_frequency if over.flicker_swing else 0.0,
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


def _exposures(over: DepthOver, limit: float) -> tuple[Ranges, float | None]:
    allowed, frequency = quantity("exposure_time"), over.axis.frequency
    # The lamp's bars fall as 1 / (f t), the flicker's as 1 / (pi F t).
    end = (over.lamp_bound / frequency + over.flicker_bound / over.flicker_frequency) / limit
    nulls = np.arange(1, int(min(end * over.flicker_frequency, MAX_NODES)) + 1)
    nodes = [over.nodes_to(end * frequency) / frequency, nulls / over.flicker_frequency]

    def depths(exposures: FloatArray) -> FloatArray:
        return over.bound_of_lamp(frequency * exposures) + over.bound_of_flicker(exposures)

    return _split(_below(depths, np.concatenate(nodes), limit, allowed.low, end), allowed.high)


def _frequencies(over: DepthOver, exposure: float, limit: float) -> tuple[Ranges, float | None]:
    allowed = quantity(over.axis.parameter)
    remaining_limit = limit - float(over.depth_of_flicker(np.array([exposure]))[0])
    if remaining_limit <= 0.0:
        return (), None
    end = over.lamp_bound / remaining_limit

    def depths(frequencies: FloatArray) -> FloatArray:
        return over.bound_of_lamp(frequencies * exposure)

    nodes = over.nodes_to(end) / exposure
    return _split(_below(depths, nodes, remaining_limit, allowed.low, end / exposure), allowed.high)


def _split(ranges: list[tuple[float, float]], highest: float) -> tuple[Ranges, float | None]:
    """Separate the last range, which extends to infinity, from those before."""
    *others, last = ranges
    finite = tuple((low, min(high, highest)) for low, high in others if low < highest)
    return finite, last[0] if last[0] < highest else None


def _below(
    depths: Depths, nodes: FloatArray, limit: float, low: float, end: float
) -> list[tuple[float, float]]:
    """Return the ranges in which depths, quasi-concave between nodes, are below a limit.

    From ``end`` on, all depths are.
    """
    inner = nodes[(nodes > low) & (nodes < end)]
    places = np.unique(np.concatenate([[min(low, end)], inner, [end]]))
    first, last = places[:-1], places[1:]
    peak = _peaks(depths, first, last)
    rising = _crossings(depths, first, peak, limit)
    falling = _crossings(depths, last, peak, limit)
    ranges: list[tuple[float, float]] = []
    for pieces in zip(first, rising, falling, last, strict=True):
        for start, stop in (pieces[:2], pieces[2:]):
            if stop <= start:
                continue
            if ranges and start <= ranges[-1][1]:
                ranges[-1] = (ranges[-1][0], float(stop))
            else:
                ranges.append((float(start), float(stop)))
    if ranges and ranges[-1][1] >= end:
        return [*ranges[:-1], (ranges[-1][0], np.inf)]
    return [*ranges, (end, np.inf)]


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


_THIRDS = (
    "1", "0.8", "0.6", "0.5", "0.4", "0.3", "1/4", "1/5", "1/6", "1/8", "1/10", "1/13", "1/15",
    "1/20", "1/25", "1/30", "1/40", "1/50", "1/60", "1/80", "1/100", "1/125", "1/160", "1/200",
    "1/250", "1/320", "1/400", "1/500", "1/640", "1/800", "1/1000", "1/1250", "1/1600", "1/2000",
    "1/2500", "1/3200", "1/4000", "1/5000", "1/6400", "1/8000",
)  # fmt: skip
"""Marked times in seconds, in thirds of a stop. The k-th is really 2^(-k/3) s, so that 1/60 s is
1/64 s and 1/125 s is 1/128 s."""

_OTHERS = ("1/48", "1/96", "1/120", "1/240")  # speeds of film cameras and phones, kept as marked


def shutter_speeds() -> tuple[ShutterSpeed, ...]:
    """Return the usual shutter speeds from 1 s to 1/8000 s, the longest first."""
    thirds = [
        ShutterSpeed(f"{name} s", float(Fraction(name)), 2.0 ** (-step / 3.0))
        for step, name in enumerate(_THIRDS)
    ]
    others = [ShutterSpeed(f"{name} s", *[float(Fraction(name))] * 2) for name in _OTHERS]
    return tuple(sorted(thirds + others, key=lambda speed: -speed.nominal))


_MAX_SPEEDS = 2

_SAMPLES = 65  # exposures within the error at which the depth is sampled


def cure_of(scene: Scene, exposure_error: float = 0.0) -> Cure:
    """Return speeds without bars, and the scene at the shortest; ``exposure_error`` in s."""
    over, period = DepthOver.of(scene), repeat_time(scene.transmitter)
    speeds = shutter_speeds()[::-1]
    depths = over.depths(np.array([(each.nominal, each.real) for each in speeds]))
    flags = list(zip(speeds, (depths < NO_BARS_DEPTH).tolist(), strict=True))
    marked_speeds = [speed for speed, is_free in flags if is_free[0]]
    safe_speeds = [speed for speed, is_free in flags if all(is_free)]
    exposure = marked_speeds[0].nominal if marked_speeds else float(period)
    bright_scene = as_bright(scene, exposure)
    return Cure(
        float(1 / period) if period else 0.0, mean_light(scene.transmitter),
        _present_depth(scene, over, exposure_error),
        tuple(marked_speeds[:_MAX_SPEEDS]), tuple(safe_speeds[:_MAX_SPEEDS]), bright_scene,
    )  # fmt: skip


def _present_depth(scene: Scene, over: DepthOver, error: float) -> tuple[float, float]:
    """Return the range of the present depth of the bars in the lamp's own light."""
    exposure, frequency = scene.camera.exposure_time, over.axis.frequency
    mean = mean_light(scene.transmitter)
    if not mean:
        return 0.0, 0.0
    ends = frequency * np.clip(exposure + np.array([-2.0, 2.0]) * error, 0.01 * exposure, None)
    low, high = ends.tolist()
    # The swing is linear in the exposure between nodes.
    nodes = over.nodes_to(min(high, low + over.nodes[-1]), low)
    cycles = np.concatenate([np.linspace(low, high, _SAMPLES), nodes])
    depths = over.swing_in(cycles) / cycles / mean
    return float(depths.min()), float(depths.max())


def as_bright(scene: Scene, exposure: float) -> Scene:
    """Return a scene at another exposure, as bright as ISO speed and then aperture allow."""
    camera = scene.camera
    low, high = quantity("iso").slider
    wanted_iso = camera.iso * camera.exposure_time / exposure
    iso = float(np.clip(wanted_iso, min(low, camera.iso), max(high, camera.iso)))
    f_number = quantity("f_number")
    wanted_f_number = camera.f_number * float(np.sqrt(iso / wanted_iso))
    return scene.replace(
        exposure_time=exposure, iso=iso,
        f_number=float(np.clip(wanted_f_number, f_number.low, f_number.high)),
    )  # fmt: skip
