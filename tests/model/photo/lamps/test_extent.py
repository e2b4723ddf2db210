"""The rim of a lamp: what is scattered around it is not part of its shape."""

import numpy as np

from occ_model.photo.lamps.edges import Edges
from occ_model.photo.lamps.extent import without_halo
from occ_model.photo.lamps.timing import LampTiming

STRIPS, COLUMNS, PERIOD = 60, 640, 20.0
TOP, BOTTOM, LEFT, RIGHT = 20, 40, 240, 400
"""Strips and columns of the lamp."""


def seen(halo: float, hot: float) -> np.ndarray:
    """Strips of a lamp that is hot in its middle, in a halo as large as the picture."""
    down, across = np.mgrid[0:STRIPS, 0:COLUMNS].astype(float)
    far = np.hypot((down - 30) / 10, (across - 320) / 80)
    inside = (down >= TOP) & (down < BOTTOM) & (across >= LEFT) & (across < RIGHT)
    lit = np.where(np.arange(COLUMNS) % PERIOD < PERIOD / 2, 1.0, 0.05)
    light = np.where(inside, np.exp(-hot * far**2), halo * np.exp(-((far / 3) ** 2)))
    return np.asarray(10.0 + 240.0 * light * lit)


def cut(means: np.ndarray, first: int, last: int, left: int, right: int) -> np.ndarray:
    place = np.arange(left, right, PERIOD / 2)
    rises = np.arange(len(place)) % 2 == 0
    edges = Edges(place, rises, np.full(len(place), 10.0), np.full(len(place), 250.0))
    timing = LampTiming(PERIOD, 0.01, 0.0, PERIOD / 2, False, 0.0, edges)
    bounds = np.arange(STRIPS + 1) * 8
    spans = np.array([(8 * strip, 8 * strip + 8, left, right) for strip in range(first, last)])
    return without_halo(spans, timing, means, bounds)


def test_a_halo_is_cut_off_at_the_rim() -> None:
    spans = cut(seen(halo=0.35, hot=0.0), 10, 50, 160, 480)
    assert abs(spans[0, 0] - 8 * TOP) <= 16
    assert abs(spans[-1, 1] - 8 * BOTTOM) <= 16
    assert abs(spans[:, 2].min() - LEFT) <= 32
    assert abs(spans[:, 3].max() - RIGHT) <= 32


def test_a_hot_spot_is_not_cut_out_of_its_lamp() -> None:
    spans = cut(seen(halo=0.0, hot=1.2), TOP, BOTTOM, LEFT, RIGHT)
    assert spans[0, 0] == 8 * TOP
    assert spans[-1, 1] == 8 * BOTTOM
    assert np.mean(spans[:, 2] == LEFT) > 0.8
