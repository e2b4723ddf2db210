"""The light of the LED, along the columns of the picture and during some exposures."""

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

_RELATIVE_ERROR = 1e-12  # relative error of a ratio from writing its parts as decimals


def light_over_columns(
    scene: Scene, first: float, last: float, most: int, edged: bool = False
) -> LightCurve | None:
    """Return the light along an axis of columns; None for more than ``most`` chips.

    The point ``i`` of the axis, which may be between columns, is the time ``t_0 + i t_r`` at which
    column ``i`` begins its exposure. With ``edged``, the light rises and falls linearly during the
    scene's edge time, from the start of a chip.
    """
    if not first < last:
        raise ParameterError.of("last", shown(last), f"above {shown(first)}, the first column")
    frequency = Fraction(scene.transmitter.switching_frequency)
    step = Fraction(scene.camera.readout_time) * frequency
    # Exact, since time zero may be any number of chips away.
    begin = Fraction(scene.model.start_time) * frequency + Fraction(first) * step
    end = begin + (Fraction(last) - Fraction(first)) * step
    edge = Fraction(scene.transmitter.edge_time) * frequency if edged else Fraction(0)
    before = math.ceil(edge)
    start, stop = math.floor(begin), math.floor(end) + 1
    if stop - start + before > most:
        return None
    chips = sent_chips(scene.transmitter)
    # The first chip's number is a Python integer, as it can be too large for an array.
    numbers = (start - before) % len(chips) + np.arange(stop - start + before)
    lit = chips[numbers % len(chips)]
    edges: FloatArray = first + (
        np.arange(stop - start + 1, dtype=np.float64) - float(begin - start)
    ) / float(step)
    columns, light = _light_knots(lit.astype(np.float64), before, float(edge))
    return LightCurve(
        columns=first + (columns - float(begin - start)) / float(step),
        light=light,
        edges=edges,
        lit=lit[before:],
        places=numbers[before:] % len(chips),
    )


def _light_knots(lit: FloatArray, before: int, edge: float) -> tuple[FloatArray, FloatArray]:
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
    """Return n if an exposure, depending on its start, includes parts of n or of n + 1 chips."""
    ratio = Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)
    # 100 us at 10 kHz is one chip, although no binary fraction equals 100 us.
    nearest = round(ratio)
    return nearest if math.isclose(ratio, nearest, rel_tol=_RELATIVE_ERROR) else math.ceil(ratio)


_MAX_CHIPS = 400  # most chips that a drawing resolves


def exposure_window(scene: Scene, column: int) -> ExposureWindow:
    """Return the chips during a column's exposure, with one before and one after."""
    check_count("column", column, 0)
    if column >= scene.camera.columns:
        raise ParameterError.of(
            "column", shown(int(column)), f"0 to {scene.camera.columns - 1}, as the picture has"
        )
    chips = sent_chips(scene.transmitter)
    period = scene.transmitter.switching_period
    # Exact, since an exposure may begin any number of chips before or after time zero.
    begins = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
    begins *= Fraction(scene.transmitter.switching_frequency)
    first = math.floor(begins)
    within = float(begins - first)
    needed = math.ceil(within + scene.camera.exposure_time / period) + 2
    count = min(needed, _MAX_CHIPS)
    start = (1.0 + within) * period
    # The first chip's number is a Python integer, as it can be too large for an array.
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


_CHIPS = 4  # chips during which the shown columns begin their exposures


def rolling_shutter(scene: Scene, shown: int = 25) -> RollingShutter:
    """Return the exposures of up to ``shown`` columns that begin within the first four chips."""
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
