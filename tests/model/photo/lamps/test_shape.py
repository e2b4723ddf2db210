"""The shape of a lamp: without the light around it, and put together of the parts of its code."""

from dataclasses import replace

import numpy as np
import pytest

from occ_model.photo.lamps.blinking import Blinking, with_codes_joined
from occ_model.photo.lamps.edges import Edges
from occ_model.photo.lamps.shape import around, without_halo
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.lamp import Lamp

_PERIOD, _DARK, _BRIGHT = 20.0, 20.0, 200.0
_BOUNDS = np.arange(0, 101, 10)


def part(first_column: int, last_column: int, rows: tuple[int, int] = (20, 80)) -> Blinking:
    """Return a pulse that repeats, in step with all others."""
    place = np.arange(first_column, last_column, _PERIOD / 2, dtype=np.float64)
    count = len(place)
    rises = np.arange(count) % 2 == 0
    edges = Edges(place, rises, np.full(count, _DARK), np.full(count, _BRIGHT))
    timing = LampTiming(_PERIOD, 0.01, 0.0, _PERIOD / 2, False, 0.01, edges)
    spans = np.array([[row, row + 10, first_column, last_column] for row in range(*rows, 10)])
    lamp = Lamp(around(spans), spans, _BRIGHT, True, _PERIOD, 0.01, 2.0 / _PERIOD, 1e-4, 5.0)
    return Blinking(lamp, timing, 0.5, 0.01)


def means(between: float) -> np.ndarray:
    """Return strips whose columns from 200 to 260 have a level, beside two lit parts."""
    found = np.full((10, 500), _BRIGHT)
    found[:, 200:260] = between
    return found


LEFT, RIGHT = part(100, 200), part(260, 400)


def test_parts_between_which_the_lamp_is_lit_are_one_lamp_without_a_period() -> None:
    (one,) = with_codes_joined([RIGHT, LEFT], means(_BRIGHT), _BOUNDS)
    assert (one.lamp.region.first_column, one.lamp.region.last_column) == (100, 400)
    assert (one.lamp.region.first_row, one.lamp.region.last_row) == (20, 80)
    assert (one.lamp.period, one.lamp.periods) == (None, None)
    assert one.lamp.switching_frequency_times_readout == 2.0 / _PERIOD
    assert one.timing is RIGHT.timing  # which has more edges


@pytest.mark.parametrize(
    ("right", "between"),
    [
        (RIGHT, _DARK),
        (part(270, 400), _BRIGHT),  # out of step by half a period
        (part(260, 400, (70, 100)), _BRIGHT),
        (replace(RIGHT, light=0.2), _BRIGHT),
        (replace(RIGHT, timing=replace(RIGHT.timing, is_code=True)), _BRIGHT),
    ],
    ids=["dark between", "out of step", "not in line", "fainter", "a code"],
)
def test_other_lamps_are_kept_apart(right: Blinking, between: float) -> None:
    assert with_codes_joined([LEFT, right], means(between), _BOUNDS) == [LEFT, right]


STRIPS, COLUMNS, PERIOD = 60, 640, 20.0
TOP, BOTTOM, BEGIN, END = 20, 40, 240, 400
"""Strips and columns of the lamp."""


def seen(halo: float, hot: float) -> np.ndarray:
    """Strips of a lamp that is hot in its middle, in a halo as large as the picture."""
    down, across = np.mgrid[0:STRIPS, 0:COLUMNS].astype(float)
    far = np.hypot((down - 30) / 10, (across - 320) / 80)
    inside = (down >= TOP) & (down < BOTTOM) & (across >= BEGIN) & (across < END)
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
    assert abs(spans[:, 2].min() - BEGIN) <= 32
    assert abs(spans[:, 3].max() - END) <= 32


def test_a_hot_spot_is_not_cut_out_of_its_lamp() -> None:
    spans = cut(seen(halo=0.0, hot=1.2), TOP, BOTTOM, BEGIN, END)
    assert spans[0, 0] == 8 * TOP
    assert spans[-1, 1] == 8 * BOTTOM
    assert np.mean(spans[:, 2] == BEGIN) > 0.8
