"""Rows of a picture: interpolated in a band, divided into bands, and cached."""

import math
from itertools import product

import numpy as np
import pytest
from amount import amount
from each_case import each_case
from physics.pictured_luminance import picture_rows

import occ_model as occ
from occ_model.camera.picture_rows import BLOCK_ROWS, split_at
from occ_model.camera.row_interpolation import (
    NODES,
    TOLERANCE,
    find_smooth_columns,
    node_rows,
    row_weights,
)
from occ_model.camera.row_memory import CAPACITY, MEMORY, RowMemory
from occ_model.effects.effect import OpticsEffect
from occ_model.effects.optics_effects import Emission, Vignetting


@each_case(product((range(64), range(128, 192), range(5, 581, 9), range(100, 110)), range(NODES)))
def test_a_polynomial_of_few_terms_is_exact(rows: range, degree: int) -> None:
    def curve(row: np.ndarray) -> np.ndarray:
        return 100.0 * ((row - rows[0]) / (rows[-1] - rows[0])) ** degree

    nodes = curve(node_rows(rows)).astype(np.float32)[:, None]
    found = row_weights(len(rows)) @ nodes
    np.testing.assert_allclose(found[:, 0], curve(np.array(rows)), rtol=0, atol=1e-4)


def test_a_curve_with_a_bend_is_not_smooth() -> None:
    rows = range(BLOCK_ROWS)
    place = node_rows(rows)
    bends = np.linspace(0.03, 0.95, 200) * BLOCK_ROWS
    bent = np.maximum(place[:, None] - bends, 0.0).astype(np.float32)
    assert not find_smooth_columns(bent).any()


@pytest.mark.parametrize("length", [40.0, 120.0, 400.0, 3000.0])
def test_smooth_columns_are_exact_to_the_tolerance(length: float) -> None:
    rows = range(BLOCK_ROWS)
    phase = np.linspace(0.0, 2.0 * math.pi, 97)

    def curve(row: np.ndarray) -> np.ndarray:
        return 100.0 * np.sin(row[:, None] / length + phase)

    nodes = curve(node_rows(rows)).astype(np.float32)
    smooth = find_smooth_columns(nodes)
    off = np.abs(row_weights(BLOCK_ROWS) @ nodes - curve(np.arange(float(BLOCK_ROWS))))
    assert (off.max(axis=0)[smooth] <= TOLERANCE).all()
    assert smooth.all() == (length > 200.0)


@pytest.mark.parametrize(("strength", "is_smooth"), [(8.0, True), (20.0, False)])
@pytest.mark.parametrize(
    ("effect", "name"), [(Vignetting(), "vignetting_exponent"), (Emission(), "lambertian_order")]
)
def test_a_band_is_the_same_by_single_rows_and_interpolated_where_it_is_smooth(
    effect: OpticsEffect, name: str, strength: float, is_smooth: bool
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(
        columns=400, rows=1200, roll=0.4, yaw=0.3, **{name: strength}
    )
    rows, band = picture_rows(scene, effect), range(512, 512 + BLOCK_ROWS)
    at_once = rows.of(band)
    assert (at_once.weights is not None) == is_smooth
    assert at_once.rims
    singly = np.concatenate([rows.of(range(row, row + 1)).values for row in band])
    np.testing.assert_allclose(at_once.values, singly, rtol=0, atol=2.0 * TOLERANCE)


def kilobyte() -> tuple[np.ndarray, ...]:
    return (np.zeros(256, dtype=np.float32),)


def test_the_least_recently_used_is_dropped_first() -> None:
    memory = RowMemory(3 * 1024)
    kept = memory.recall("kept", kilobyte, tuple)
    for key in range(10):
        memory.recall(key, kilobyte, tuple)
        assert memory.recall("kept", kilobyte, tuple) is kept
        assert memory.size <= 3 * 1024
    assert memory.recall(0, kilobyte, tuple) is not memory.recall("other", kilobyte, tuple)


def test_no_more_small_objects_are_cached_than_entries() -> None:
    memory = RowMemory(10**6, entries=5)
    for key in range(100):
        memory.recall(key, kilobyte, tuple)
    assert memory.size == 5 * 1024
    kept = memory.recall(99, kilobyte, tuple)
    assert memory.recall(99, kilobyte, tuple) is kept


def test_an_object_larger_than_the_cache_is_not_cached() -> None:
    memory = RowMemory(1000)
    assert memory.recall("a", kilobyte, tuple) is not memory.recall("a", kilobyte, tuple)
    assert memory.size == 0


def test_no_number_of_moves_fills_more_than_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    limit = CAPACITY // amount(4, 1)  # a smaller one is full sooner
    monkeypatch.setattr(MEMORY, "limit", limit)
    scene = occ.load_preset("phone-136us-real").replace(rows=1152, jpeg_quality=0)
    for move in range(amount(8, 60)):
        moved = scene.replace(distance=1.0 + 0.01 * move)
        occ.render(moved, tolerance=0.0, rows_step=1 + 8 * (move % 5 > 0))
        assert MEMORY.size <= limit
    held = sum(size for _, size in MEMORY.entries.values())
    assert held == MEMORY.size > limit / 2


def test_a_cached_picture_is_the_same_as_a_new_one() -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=400, columns=500, roll=0.1)
    first = occ.render(scene, tolerance=0.0).image
    for changes in ({"roll": 0.0}, {"vignetting_exponent": 1.0}, {"lambertian_order": 3.0}):
        other = occ.render(scene.replace(**changes), tolerance=0.0).image
        assert (other != first).any()
    np.testing.assert_array_equal(occ.render(scene, tolerance=0.0).image, first)


@pytest.mark.parametrize("step", [1, 3])
@pytest.mark.parametrize("places", [(), (20,), (25, 31), (0, 20, 64, 99), (70, 40)])
def test_a_band_is_divided_before_the_rows_named_and_nowhere_else(
    places: tuple[int, ...], step: int
) -> None:
    band = range(20, 64, step)
    parts = [part for part in split_at(band, places) if part]
    assert [row for part in parts for row in part] == list(band)
    after = {next((row for row in band if row >= place), None) for place in places}
    assert {part[0] for part in parts} == {20} | (after - {None})
