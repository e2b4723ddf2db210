"""Laws of a lens that bends straight lines, against OpenCV's model of one."""

import dataclasses
from functools import lru_cache

import numpy as np
import pytest
from hard_cases.test_lenses import opencv_places

import occ_model as occ
from occ_model.camera.projection import image_rays
from occ_model.scene.scene import Lens, Scene

ROWS, COLUMNS = 100, 200
LENSES = [
    {"radial_k1": 0.2},
    {"radial_k1": -0.1, "radial_k2": 0.02},
    {"tangential_p1": 0.02},
    {"tangential_p2": -0.03},
    {"radial_k1": -0.12, "radial_k2": 0.03, "tangential_p1": 0.01, "tangential_p2": -0.015},
]
ONLY = {"sensor-noise": False, "fixed-pattern": False, "distortion": True}


def bent_scene(**changes: float | str) -> Scene:
    return Scene().replace(rows=ROWS, columns=COLUMNS, enhancement="none").replace(**changes)


@lru_cache
def rays_of_pixels(lens: Lens) -> np.ndarray:
    """Find the ray to each pixel by iteratively inverting OpenCV's projection."""
    scene = dataclasses.replace(bent_scene(), lens=lens)
    row, column = np.mgrid[0:ROWS, 0:COLUMNS].astype(float)
    pixels = np.column_stack([column.ravel(), row.ravel()])
    rays = image_rays(pixels, scene.camera)
    for _ in range(15):
        missed = pixels - opencv_places(rays, scene)
        rays = rays + missed / scene.camera.focal_length_pixels
    assert np.abs(missed).max() < 1e-3
    return rays


def find_panel_pixels(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Find the pixels whose rays meet the panel, and those whose rays meet its rim."""
    rays = rays_of_pixels(scene.lens)
    corners = image_rays(occ.panel_corners(scene), scene.camera)
    inside, margin = np.ones(len(rays), dtype=bool), np.full(len(rays), np.inf)
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge = (end - start) / np.hypot(*(end - start))
        side = edge[0] * (rays[:, 1] - start[1]) - edge[1] * (rays[:, 0] - start[0])
        inside &= side >= 0
        margin = np.minimum(margin, np.abs(side))
    at_rim = margin * scene.camera.focal_length_pixels < 0.02
    return inside.reshape(ROWS, COLUMNS), at_rim.reshape(ROWS, COLUMNS)


@pytest.mark.parametrize("lens", LENSES)
def test_stripes_stay_columns(lens: dict[str, float]) -> None:
    scene = bent_scene(**lens, distance=0.9, roll=0.2, enhancement="equalization")
    frame = occ.render(scene, force=ONLY)
    inside, at_rim = find_panel_pixels(scene)
    columns = np.broadcast_to(occ.render(scene, tolerance=float("inf")).signal, inside.shape)
    shown = inside & ~at_rim
    assert shown.mean() > 0.3
    np.testing.assert_array_equal(frame.image[shown], columns[shown])
    outside = frame.image[~inside & ~at_rim]
    assert outside.min() == outside.max()


def test_a_minimal_distortion_gives_the_straight_panel() -> None:
    scene = bent_scene(radial_k1=1e-12, roll=0.4, distance=0.9)
    bare = occ.render(scene, tolerance=float("inf"))
    np.testing.assert_array_equal(occ.render(scene, force=ONLY).image, bare.image)


@pytest.mark.parametrize("blur", [0.0, 5.0, 30.0, 200.0])
@pytest.mark.parametrize(
    ("k1", "distance"), [(-0.1, 0.05), (-0.15, 1e-3), (0.5, 1e-3), (10.0, 1e-3)]
)
def test_no_blur_folds_a_lens_that_does_not_fold(k1: float, distance: float, blur: float) -> None:
    """Such a lens folds only beyond the corners, 0.83 focal lengths from the middle."""
    scene = bent_scene(radial_k1=k1, point_spread=blur, distance=distance)
    frame = occ.render(scene, tolerance=0, force=ONLY)
    largest = 1.0 if blur else 0.0
    columns = occ.render(scene, tolerance=float("inf")).signal
    np.testing.assert_allclose(
        frame.image.astype(float), np.tile(columns, (ROWS, 1)), rtol=0, atol=largest
    )


def test_a_panel_out_of_sight_leaves_the_picture_dark() -> None:
    for offset in (3.0, 40.0, 5000.0):
        scene = bent_scene(radial_k1=-0.1, offset_x=offset)
        frame = occ.render(scene, tolerance=0, force=ONLY)
        assert frame.image.min() == frame.image.max()
