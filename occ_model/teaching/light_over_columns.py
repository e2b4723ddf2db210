"""The light of the LED, over the columns of the picture and in the exposures of some of them."""

import math
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import on_time
from occ_model.errors import ParameterError, shown
from occ_model.results.teaching import ExposureWindow, LightCurve, RollingShutter
from occ_model.scene.argument_checks import check_count
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

_RELATIVE_ERROR = 1e-12  # relative error of a whole ratio, by how its parts are written


def light_over_columns(
    scene: Scene, first: float, last: float, most: int, edged: bool = False
) -> LightCurve | None:
    """Return the light while some columns begin their exposures; None for more than ``most`` chips.

    Column ``i`` begins at ``t_0 + i t_r``, and so does every point ``i`` of this axis, also between
    columns. ``edged``: whether the light rises and falls linearly within the scene's edge time,
    from the start of a chip on.
    """
    if not first < last:
        raise ParameterError.of(
            "last", shown(last), f"above {shown(first)}, where the columns begin"
        )
    frequency = Fraction(scene.transmitter.switching_frequency)
    step = Fraction(scene.camera.readout_time) * frequency
    # Exact: time zero may be any number of chips away.
    begin = Fraction(scene.model.start_time) * frequency + Fraction(first) * step
    end = begin + (Fraction(last) - Fraction(first)) * step
    edge = Fraction(scene.transmitter.edge_time) * frequency if edged else Fraction(0)
    before = math.ceil(edge)
    start, stop = math.floor(begin), math.floor(end) + 1
    if stop - start + before > most:
        return None
    chips = sent_chips(scene.transmitter)
    # In Python's integers: the first chip's number can exceed an array's.
    numbers = (start - before) % len(chips) + np.arange(stop - start + before)
    lit = chips[numbers % len(chips)]
    edges: FloatArray = first + (
        np.arange(stop - start + 1, dtype=np.float64) - float(begin - start)
    ) / float(step)
    columns, light = _curve(lit.astype(np.float64), before, float(edge))
    return LightCurve(
        columns=first + (columns - float(begin - start)) / float(step),
        light=light,
        edges=edges,
        lit=lit[before:],
        places=numbers[before:] % len(chips),
    )


def _curve(lit: FloatArray, before: int, edge: float) -> tuple[FloatArray, FloatArray]:
    """Return the knots of the light, in chips after the first ``before``, and its values there."""
    count = len(lit) - before
    if edge == 0.0:
        knots = np.repeat(np.arange(count + 1, dtype=np.float64), 2)[1:-1]
        return knots, np.repeat(lit, 2)
    starts = np.arange(count + 1, dtype=np.float64)
    ends = np.arange(-before, count, dtype=np.float64) + edge
    knots = np.unique(np.concatenate([starts, ends[(ends > 0.0) & (ends < count)]]))
    integral = np.concatenate([[0.0], np.cumsum(lit)])
    at = np.arange(-before, count + 1, dtype=np.float64)
    light = (np.interp(knots, at, integral) - np.interp(knots - edge, at, integral)) / edge
    return knots, np.clip(light, 0.0, 1.0)


def chips_in_exposure(scene: Scene) -> int:
    """Return n where an exposure sees parts of n chips or of n + 1, by where it begins."""
    ratio = Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)
    # 100 us at 10 kHz are one chip, though no binary fraction is 100 us.
    nearest = round(ratio)
    return nearest if math.isclose(ratio, nearest, rel_tol=_RELATIVE_ERROR) else math.ceil(ratio)


_MAX_CHIPS = 400  # largest number of chips that a drawing resolves


def exposure_window(scene: Scene, column: int) -> ExposureWindow:
    """Return the chips that a column's exposure covers, and one before and one after it."""
    check_count("column", column, 0)
    if column >= scene.camera.columns:
        raise ParameterError.of(
            "column", shown(int(column)), f"0 to {scene.camera.columns - 1}, as the picture has"
        )
    chips = sent_chips(scene.transmitter)
    period = scene.transmitter.switching_period
    # Exact: a column's exposure may begin any number of chips before or after time zero.
    begins = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
    begins *= Fraction(scene.transmitter.switching_frequency)
    first = math.floor(begins)
    within = float(begins - first)
    needed = math.ceil(within + scene.camera.exposure_time / period) + 2
    count = min(needed, _MAX_CHIPS)
    start = (1.0 + within) * period
    # In Python's integers: the first chip's number can exceed an array's.
    places = (first - 1) % len(chips) + np.arange(count)
    return ExposureWindow(
        column=column,
        start=start,
        end=start + scene.camera.exposure_time,
        edges=np.arange(count + 1, dtype=np.float64) * period,
        lit=chips[places % len(chips)],
        on_time=float(on_time(scene)[column]),
        shortened=needed > count,
    )


_CHIPS = 4  # chips that the shown columns begin in


def rolling_shutter(scene: Scene, shown: int = 25) -> RollingShutter:
    """Return the exposures of up to ``shown`` first columns, which begin within four chips."""
    camera, period = scene.camera, scene.transmitter.switching_period
    last = min(camera.columns - 1, max(int(_CHIPS * period / camera.readout_time), 1))
    columns = np.unique(np.linspace(0, last, min(shown, last + 1)).round().astype(np.intp))
    starts = np.multiply(columns, camera.readout_time, dtype=np.float64)
    chips = sent_chips(scene.transmitter)
    phase = (scene.model.start_time * scene.transmitter.switching_frequency) % len(chips)
    first = int(phase)
    needed = (float(starts[-1]) + camera.exposure_time) / period
    count = int(min(np.ceil(needed) + 1, _MAX_CHIPS))
    return RollingShutter(
        columns=columns,
        starts=starts,
        exposure_time=camera.exposure_time,
        lit_fraction=on_time(scene)[columns] / camera.exposure_time,
        edges=np.asarray((first - phase + np.arange(count + 1)) * period, dtype=np.float64),
        lit=chips[(first + np.arange(count)) % len(chips)],
    )
