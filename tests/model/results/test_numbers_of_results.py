"""Numbers that a result works out of what it holds."""

import math
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matches import match_with

import occ_model as occ
from occ_model.results.accuracy import TimeShares
from occ_model.results.bench import DECIBELS, EXPOSURES
from occ_model.results.bit_errors import BitErrors
from occ_model.results.match import Match
from occ_model.results.photo_table import DOUBTFUL, SURE, PhotoRow
from occ_model.scene.scene import Scene


@pytest.mark.parametrize("frames_a_second", [1.0, 25.0, 240.0])
def test_net_bits_a_second_lie_within_their_interval(frames_a_second: float) -> None:
    errors = BitErrors("own", 1000, 30, 0.02, 0.05, 100, 90, 0.82, 0.95, 0.01, 0.02)
    low, high = errors.bits_a_second_interval(frames_a_second)
    assert low < errors.bits_a_second(frames_a_second) < high
    assert (low, high) == pytest.approx((8.2 * frames_a_second, 9.5 * frames_a_second))


@pytest.mark.parametrize("values", [EXPOSURES, DECIBELS])
def test_the_places_of_a_bench_rise(values: tuple[float, ...]) -> None:
    assert all(before < after for before, after in pairwise(values))


def test_the_root_mean_square_of_a_residual_is_in_its_levels() -> None:
    residual = np.array([3.0, -3.0, 3.0, -3.0])
    found = Match.rmse.fget(SimpleNamespace(residual=residual))  # type: ignore[attr-defined]
    assert found == pytest.approx(3.0)


def test_an_exposure_that_was_not_estimated_has_no_verdict() -> None:
    row = PhotoRow(Path("1.png"), SURE)
    assert row.exposure_verdict == ""
    of_one = PhotoRow(Path("1.png"), SURE, match=match_with())
    assert of_one.exposure_verdict == SURE
    doubted = PhotoRow(Path("1.png"), SURE, match=match_with(exposure_reasons=("Few edges.",)))
    assert doubted.exposure_verdict == DOUBTFUL


@pytest.mark.parametrize(("effect", "differ"), [("flicker", False), ("vignetting", True)])
def test_rows_differ_where_an_effect_is_on_more_than_columns(effect: str, differ: bool) -> None:
    scene = Scene().replace(rows=40, columns=200, flicker_depth=0.5, vignetting_exponent=4.0)
    off = {d.effect: False for d in occ.plan(scene).decisions}
    frame = occ.render(scene, tolerance=math.inf, force=off | {effect: True})
    assert TimeShares.of(frame).rows_differ is differ
    assert effect in frame.plan
    assert "jpeg" not in frame.plan
