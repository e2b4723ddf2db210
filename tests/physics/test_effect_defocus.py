"""Laws of a lens that images a point as a spot."""

import math

import numpy as np
import pytest
from physics.pictured_luminance import pictured_luminance

import occ_model as occ
from occ_model.camera.photometry import luminance_levels
from occ_model.effects.optics_effects import Defocus, blur_of
from occ_model.scene.scene import Scene

ROWS, COLUMNS = 201, 401
WIDTH, HEIGHT = 151, 81
"""Pixels of the panel, with its rim between pixels, as the optical axis meets a pixel's centre."""

ONLY = {"sensor-noise": False, "fixed-pattern": False, "full-well": False, "defocus": True}


def unsharp_scene(blur: float, **changes: float | str) -> Scene:
    focal = Scene().replace(rows=ROWS, columns=COLUMNS).camera.focal_length_pixels
    return Scene().replace(
        rows=ROWS, columns=COLUMNS, point_spread=blur, distance=1.0, panel_width=WIDTH / focal,
        panel_height=HEIGHT / focal, pattern="1", enhancement="none",
    ).replace(**changes)  # fmt: skip


def panel_fraction(scene: Scene) -> np.ndarray:
    """Return the fraction of the lit panel's own light in each pixel."""
    dark, bright = luminance_levels(scene)
    return (pictured_luminance(scene, Defocus()) - dark) / (bright - dark)


def soft_step(size: int, width: int, blur: float) -> np.ndarray:
    """Return the light across a slit in the middle, through a Gaussian point spread."""
    place = np.arange(size) - (size - 1) / 2
    ends = [(place - sign * width / 2) / (blur * math.sqrt(2)) for sign in (-1, 1)]
    rise, fall = ([math.erf(x) for x in end] for end in ends)
    return (np.array(rise) - np.array(fall)) / 2


@pytest.mark.parametrize("gamma", [1.0, 2.22])
@pytest.mark.parametrize("blur", [1.0, 2.5, 6.0, 8.0, 15.0])
def test_the_rim_of_a_level_panel_is_the_error_function_in_light(blur: float, gamma: float) -> None:
    scene = unsharp_scene(blur, gamma=gamma, luminance=1500.0)
    expected = np.outer(soft_step(ROWS, HEIGHT, blur), soft_step(COLUMNS, WIDTH, blur))
    # A kernel of whole pixels deviates from the curve, the more the narrower it is.
    largest = 0.02 / blur**2 if blur < 8.0 else 5e-3
    np.testing.assert_allclose(panel_fraction(scene), expected, rtol=0, atol=largest)


@pytest.mark.parametrize("blur", [0.3, 1.0, 5.0, 9.0])
def test_light_is_conserved_where_the_panel_lies_well_inside(blur: float) -> None:
    assert panel_fraction(unsharp_scene(blur)).sum() == pytest.approx(WIDTH * HEIGHT, rel=1e-3)


@pytest.mark.parametrize(
    ("focus", "distance"), [(0.3, 1.2), (1.2, 0.5), (0.1, 5.0), (1e6, 1.0), (0.8, 0.9)]
)
@pytest.mark.parametrize("f_number", [1.8, 8.0])
def test_the_blur_out_of_focus_is_that_of_a_thin_lens(
    focus: float, distance: float, f_number: float
) -> None:
    scene = occ.load_preset("phone-136us").replace(
        focus_distance=focus, distance=distance, f_number=f_number
    )
    focal = scene.camera.focal_length_pixels * 1e-6  # pixels of a micrometre
    image_of_panel, sensor = (1 / (1 / focal - 1 / d) for d in (distance, focus))
    # Similar triangles behind an aperture that is focal / f_number wide.
    circle = focal / f_number * abs(sensor - image_of_panel) / image_of_panel
    # The lens's formula is for distances far beyond its focal length, of 3.5 mm here.
    assert blur_of(scene) == pytest.approx(circle / 1e-6 / 4, rel=2 * focal / min(focus, distance))


def test_focus_is_sharp_and_both_blurs_add_their_variances() -> None:
    focused = Scene().replace(focus_distance=1.2, distance=1.2)
    assert blur_of(focused) == 0.0
    assert not Defocus().is_present(focused)
    away = Scene().replace(focus_distance=0.6, distance=1.2)
    both = away.replace(point_spread=3.0)
    assert blur_of(both) == pytest.approx(math.hypot(3.0, blur_of(away)))


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
@pytest.mark.parametrize("blur", [2.0, 9.0])
def test_stripes_keep_their_full_contrast(blur: float, averaging: str) -> None:
    # Chips that last one column give the finest possible stripes.
    scene = unsharp_scene(
        blur,
        pattern="01",
        switching_frequency=125e3,
        exposure_time=8e-6,
        iso=1600.0,
        averaging=averaging,
    )
    profile = occ.column_profile(scene)
    assert np.ptp(profile) > 50
    frame = occ.render(scene, force=ONLY)
    reach = math.ceil(4 * blur)
    middle = slice((COLUMNS - WIDTH) // 2 + reach, (COLUMNS + WIDTH) // 2 - reach)
    row = frame.image[ROWS // 2, middle].astype(float)
    assert len(row) > 70
    np.testing.assert_allclose(row, profile[middle], rtol=0, atol=0.51)
