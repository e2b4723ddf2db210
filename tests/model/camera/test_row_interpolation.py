"""Rows of a band from a few nodes: as exact as computed one by one."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.picture_rows import BLOCK_ROWS
from occ_model.camera.row_interpolation import (
    NODES,
    TOLERANCE,
    node_rows,
    row_weights,
    smooth_columns,
)
from occ_model.simulation.render import observe

STILL = {"sensor-noise": False, "fixed-pattern": False, "jpeg": False}


@pytest.mark.parametrize("rows", [range(64), range(128, 192), range(5, 581, 9), range(100, 110)])
@pytest.mark.parametrize("degree", range(NODES))
def test_a_polynomial_of_few_terms_is_exact(rows: range, degree: int) -> None:
    def curve(row: np.ndarray) -> np.ndarray:
        return 100.0 * ((row - rows[0]) / (rows[-1] - rows[0])) ** degree

    nodes = curve(node_rows(rows)).astype(np.float32)[:, None]
    found = row_weights(len(rows)) @ nodes
    np.testing.assert_allclose(found[:, 0], curve(np.array(rows)), rtol=0, atol=1e-4)


def test_a_curve_with_a_bend_is_not_taken_for_smooth() -> None:
    rows = range(BLOCK_ROWS)
    place = node_rows(rows)
    bends = np.linspace(2.0, 61.0, 200)
    bent = np.maximum(place[:, None] - bends, 0.0).astype(np.float32)
    assert not smooth_columns(bent).any()


@pytest.mark.parametrize("length", [40.0, 120.0, 400.0, 3000.0])
def test_what_counts_as_smooth_is_exact_to_the_tolerance(length: float) -> None:
    rows = range(BLOCK_ROWS)
    phase = np.linspace(0.0, 2.0 * math.pi, 97)

    def curve(row: np.ndarray) -> np.ndarray:
        return 100.0 * np.sin(row[:, None] / length + phase)

    nodes = curve(node_rows(rows)).astype(np.float32)
    smooth = smooth_columns(nodes)
    off = np.abs(row_weights(BLOCK_ROWS) @ nodes - curve(np.arange(float(BLOCK_ROWS))))
    assert (off.max(axis=0)[smooth] <= TOLERANCE).all()
    assert smooth.all() == (length > 200.0)


@pytest.mark.parametrize(
    "changes", [{}, {"vignetting_exponent": 20.0, "roll": 0.4}, {"lambertian_order": 30.0}]
)
def test_a_picture_is_the_same_by_single_rows(
    changes: dict[str, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(columns=400, rows=1200, **changes)
    plan = occ.plan(scene, 0.0, force=STILL)
    interpolated = observe(scene, plan)
    monkeypatch.setattr(
        "occ_model.camera.picture_rows.smooth_columns", lambda values: np.zeros(1, dtype=bool)
    )
    np.testing.assert_allclose(interpolated, observe(scene, plan), rtol=0, atol=2.0 * TOLERANCE)
