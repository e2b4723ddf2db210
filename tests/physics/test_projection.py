"""Laws of the projection, and of the pixel value, equations (1) to (3) of the paper."""

import numpy as np
import pytest

from occ_model.camera.photometry import pixel_value
from occ_model.camera.projection import paint
from occ_model.scene.scene import Scene


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
