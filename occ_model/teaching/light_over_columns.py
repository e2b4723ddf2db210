"""Returns the light of the LED over the columns of the picture, column i at t_0 + i t_r."""

import math
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError, shown
from occ_model.results.teaching import LightCurve
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.packet import sent_chips

_ROUNDING = 1e-12  # relative error of a whole ratio, by how its parts are written


def light_over_columns(
    scene: Scene, first: float, last: float, most: int, edged: bool = False
) -> LightCurve | None:
    """Return the light while some columns begin their exposures; None for more than ``most`` chips.

    Column ``i`` begins at ``t_0 + i t_r``, and so does every point ``i`` of this axis, also between
    columns. ``edged``: whether the light rises and falls linearly within the scene's edge time,
    from the start of a chip on.
    """
    check_scene(scene)
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
    check_scene(scene)
    ratio = Fraction(scene.camera.exposure_time) * Fraction(scene.transmitter.switching_frequency)
    # 100 us at 10 kHz are one chip, though no binary fraction is 100 us.
    nearest = round(ratio)
    return nearest if math.isclose(ratio, nearest, rel_tol=_ROUNDING) else math.ceil(ratio)
