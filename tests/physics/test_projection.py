"""Laws of the projection, and of the pixel value, equations (1) to (3) of the paper."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.photometry import level_values, pixel_value
from occ_model.camera.projection import paint
from occ_model.scene.scene import Scene


def test_a_yawed_panel_has_the_perspective_of_its_edges() -> None:
    yaw, distance, width = math.radians(30), 1.5, 0.6
    scene = Scene().replace(yaw=yaw, distance=distance, panel_width=width)
    focal = scene.camera.focal_length_pixels
    x = occ.panel_corners(scene)[:, 0] - (scene.camera.columns - 1) / 2
    # A point at s along the turned edge is at (s cos yaw, distance - s sin yaw).
    s = np.array([-1, 1, 1, -1]) * width / 2
    expected = focal * s * math.cos(yaw) / (distance - s * math.sin(yaw))
    np.testing.assert_allclose(x, expected)


def test_a_panel_that_fills_the_picture_leaves_no_surroundings() -> None:
    corners = np.array([[-9, -9], [99, -9], [99, 99], [-9, 99]])
    image = paint(np.arange(50, dtype=np.uint8), corners, range(20), np.full(50, 200, np.uint8))
    np.testing.assert_array_equal(image, np.tile(np.arange(50), (20, 1)))


@pytest.mark.parametrize(
    ("iso", "exposure", "luminance", "f_number", "at_2_2", "at_2_22"),
    [
        (100, 1 / 100, 100, 2.0, 161.70, 161.24),
        (100, 1 / 8000, 5000, 2.0, 130.60, 130.48),
        (400, 1 / 4000, 2000, 2.48, 182.23, 181.52),
        (100, 60e-6, 10000, 2.2, 117.56, 117.56),
    ],
)
def test_pixel_values_are_the_published_ones(
    iso: float, exposure: float, luminance: float, f_number: float, at_2_2: float, at_2_22: float
) -> None:
    scene = Scene().replace(iso=iso, exposure_time=exposure, f_number=f_number)
    for gamma, expected in ((2.2, at_2_2), (2.22, at_2_22)):
        camera = scene.replace(gamma=gamma).camera
        assert pixel_value(np.array(luminance), camera) == pytest.approx(expected, abs=0.005)


@pytest.mark.parametrize(("gamma", "ratio"), [(2.2, 5.448), (2.22, 5.533)])
def test_a_pixel_is_white_at_the_published_exposure(gamma: float, ratio: float) -> None:
    camera = Scene().replace(gamma=gamma, iso=100, exposure_time=0.125, f_number=1.0).camera
    # S t / (K N^2) is 1 here, so that the luminance equals the ratio.
    assert pixel_value(np.array(ratio), camera) == pytest.approx(255.0, abs=0.02)


@pytest.mark.parametrize(("gamma", "factor"), [(2.2, 0.7297), (2.22, 0.7318)])
def test_half_the_exposure_time_dims_by_the_published_factor(gamma: float, factor: float) -> None:
    scene = Scene().replace(gamma=gamma, exposure_time=100e-6)
    half = scene.replace(exposure_time=50e-6)
    np.testing.assert_allclose(level_values(half) / level_values(scene), factor, atol=5e-5)


@given(gamma=st.floats(1.0, 4.0), code=st.integers(0, 1023))
def test_averaging_light_is_never_darker_than_averaging_values(gamma: float, code: int) -> None:
    scene = Scene().replace(gamma=gamma, code=code, columns=200)
    by_light = occ.column_profile(scene.replace(averaging="light"))
    by_value = occ.column_profile(scene.replace(averaging="pixel-value"))
    # Gamma encoding is concave (Jensen's inequality); at gamma 1 the two are the same.
    assert (by_light >= by_value - 1e-9).all()
    if gamma == 1.0:
        np.testing.assert_allclose(by_light, by_value, rtol=1e-12)
