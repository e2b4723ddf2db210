"""Parts of a lamp that blink in time are joined, and other lamps are not."""

from dataclasses import replace

import numpy as np
import pytest

from occ_model.photo.lamps.blinking import Blinking, join_parts
from occ_model.photo.lamps.edges import LampEdges
from occ_model.photo.lamps.shape import region_around
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.lamp import Lamp

_PERIOD, _DARK, _BRIGHT = 20.0, 20.0, 200.0
_BOUNDS = np.arange(0, 101, 10)


def part(first_column: int, last_column: int, rows: tuple[int, int] = (20, 80)) -> Blinking:
    """Return a pulse that repeats, in step with all others."""
    place = np.arange(first_column, last_column, _PERIOD / 2, dtype=np.float64)
    count = len(place)
    rises = np.arange(count) % 2 == 0
    edges = LampEdges(place, rises, np.full(count, _DARK), np.full(count, _BRIGHT))
    timing = LampTiming(_PERIOD, 0.01, 0.0, _PERIOD / 2, False, 0.01, edges)
    spans = np.array([[row, row + 10, first_column, last_column] for row in range(*rows, 10)])
    lamp = Lamp(region_around(spans), spans, _BRIGHT, True, _PERIOD, 0.01, 2.0 / _PERIOD, 1e-4, 5.0)
    return Blinking(lamp, timing, 0.5, 0.01)


def means(between: float) -> np.ndarray:
    """Return strips whose columns from 200 to 260 have a level, beside two lit parts."""
    found = np.full((10, 500), _BRIGHT)
    found[:, 200:260] = between
    return found


LEFT, RIGHT = part(100, 200), part(260, 400)


def test_parts_between_which_the_lamp_is_lit_are_one_lamp_without_a_period() -> None:
    (one,) = join_parts([RIGHT, LEFT], means(_BRIGHT), _BOUNDS)
    assert (one.lamp.region.first_column, one.lamp.region.last_column) == (100, 400)
    assert (one.lamp.region.first_row, one.lamp.region.last_row) == (20, 80)
    assert (one.lamp.period, one.lamp.periods) == (None, None)
    assert one.lamp.switching_frequency_times_readout == pytest.approx(2.0 / _PERIOD)
    assert "can have another chip than their code" in " ".join(one.lamp.doubts)


def test_a_lamp_is_blurred_as_its_part_of_most_edges() -> None:
    for is_blurred in (True, False):
        right = replace(RIGHT, lamp=replace(RIGHT.lamp, is_blurred=is_blurred))
        (one,) = join_parts([right, LEFT], means(_BRIGHT), _BOUNDS)
        assert one.lamp.is_blurred is is_blurred


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
    assert set(join_parts([LEFT, right], means(between), _BOUNDS)) == {LEFT, right}
