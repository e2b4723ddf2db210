"""Pixel values from no light to 1e16 cd/m2, compared with arithmetic of fifty digits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import decades, exact_column_value, exact_pixel_value, within
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.photometry import (
    WHITE,
    ColumnLight as Light,
    level_values,
    luminance_levels,
    luminance_of,
    panel_values,
    pixel_value,
)
from occ_model.scene.scene import Camera, Scene

CAMERAS = st.builds(
    Camera,
    iso=decades(1.0, 4e6),
    exposure_time=decades(1e-9, 1e6),
    f_number=decades(0.5, 128.0),
    gamma=st.floats(1.0, 4.0) | st.sampled_from([1.0, 2.2, 4.0]),
    meter_constant=decades(1.0, 100.0),
)
LUMINANCES = decades(1e-30, 1e16)
EVERY_CAMERA = "S 1 to 4e6, t 1 ns to 1e6 s, N 0.5 to 128, gamma 1 to 4"
RANGES = f"{EVERY_CAMERA}, L 1e-30 to 1e16"

EPS = float(np.finfo(np.float64).eps)


def one_value(luminance: float, camera: Camera) -> float:
    return float(pixel_value(np.array([luminance]), camera)[0])


def relative(found: float, expected: mpmath.mpf) -> float:
    return float(abs(mpmath.mpf(found) / expected - 1)) if expected else abs(found)


@cases(camera=CAMERAS, luminance=LUMINANCES)
def test_a_pixel_value_is_that_of_equation_1(camera: Camera, luminance: float) -> None:
    with mpmath.workdps(50):
        expected = exact_pixel_value(mpmath.mpf(luminance), camera)
        error = relative(one_value(luminance, camera), expected)
    record("PV of equation (1), relative", RANGES, error, 1e-14)


@cases(camera=CAMERAS, luminance=LUMINANCES)
def test_the_luminance_of_a_pixel_value_is_the_one_it_came_from(
    camera: Camera, luminance: float
) -> None:
    back = float(luminance_of(np.array([one_value(luminance, camera)]), camera)[0])
    error = abs(back / luminance - 1.0)
    record("luminance_of(PV(L)) = L, relative", RANGES, error, 1e-14)


@cases(
    camera=CAMERAS,
    luminance=LUMINANCES,
    name=st.sampled_from(["iso", "exposure_time", "luminance", "f_number"]),
    factor=st.just(1.0 + EPS) | decades(1.0 + 1e-12, 1e3),
)
def test_more_light_is_never_darker_even_by_one_ulp(
    camera: Camera, luminance: float, name: str, factor: float
) -> None:
    scene = Scene(camera=camera).replace(
        pattern="1", columns=1, luminance=luminance, illuminance=0.0, start_time=0.0
    )
    before = float(scene.value(name))
    after = before / factor if name == "f_number" else before * factor
    more = scene.replace(**{name: within(name, after)})
    lost = float(level_values(scene)[1] - level_values(more)[1]) / float(level_values(scene)[1])
    record(
        "PV grows with S, t, L and 1/N: what it falls by", f"{RANGES}, from an ulp on", lost, 0.0
    )
    assert occ.column_profile(more)[0] >= occ.column_profile(scene)[0]


@st.composite
def lit_scenes(draw: st.DrawFn) -> Scene:
    """Draw scenes of a few columns, with all ratios of exposure to period, in any light."""
    dark = st.just(0.0)
    scene = Scene(camera=draw(CAMERAS)).replace(
        columns=7,
        luminance=draw(dark | decades(1e-30, 1e16)),
        illuminance=draw(dark | decades(1e-30, 1e16)),
        reflectance=draw(dark | decades(1e-6, 1.0)),
        averaging=draw(st.sampled_from(["pixel-value", "light"])),
        start_time=draw(st.floats(0.0, 0.01)),
        readout_time=draw(decades(1e-9, 10.0)),
    )
    return scene.replace(switching_frequency=draw(decades(1.0, 1e9)))


@cases(scene=lit_scenes())
def test_a_profile_is_finite_and_between_its_two_levels(scene: Scene) -> None:
    values = panel_values(scene, Light.of(scene))
    low, high = level_values(scene)
    beyond = max(float((values - high).max()), float((low - values).max()), 0.0)
    error = beyond / float(high) if high else beyond
    ranges = f"{EVERY_CAMERA}, L and E_v 0 to 1e16"
    record("PV_min <= PV_sim <= PV_max, beyond by", ranges, error, 4 * EPS)
    assert np.isfinite(values).all()
    profile = occ.column_profile(scene)
    assert ((profile >= 0.0) & (profile <= WHITE)).all()
    # A full pixel has exactly the largest value, and none next to it.
    assert (profile[values >= WHITE] == WHITE).all()
    assert (profile[values < WHITE] < WHITE).all()


@cases(scene=lit_scenes())
def test_a_profile_is_that_of_equations_1_to_3(scene: Scene) -> None:
    found = panel_values(scene, Light.of(scene))
    fractions = lit_fraction(scene)
    with mpmath.workdps(50):
        worst = max(
            relative(value, exact_column_value(scene, mpmath.mpf(fraction)))
            for value, fraction in zip(found.tolist(), fractions.tolist(), strict=True)
        )
    record("PV_sim of equation (3), relative", f"{EVERY_CAMERA}, L and E_v 0 to 1e16", worst, 1e-14)


@cases(camera=CAMERAS, by=st.sampled_from([-1e-9, -1e-12, 0.0, 1e-12, 1e-9]))
def test_a_pixel_is_full_from_where_the_equation_says(camera: Camera, by: float) -> None:
    luminance = float(luminance_of(np.array([WHITE]), camera)[0]) * (1.0 + by)
    assume(0.0 < luminance == within("luminance", luminance))
    scene = Scene(camera=camera).replace(
        pattern="1", columns=1, luminance=luminance, illuminance=0.0
    )
    shown = float(occ.column_profile(scene)[0])
    error = abs(shown / WHITE - min(1.0, (1.0 + by) ** (1.0 / camera.gamma)))
    record("255 from where equation (1) says, of 255", EVERY_CAMERA, error, 1e-14)
    assert shown == WHITE or by <= 0.0
    assert shown < WHITE or by >= 0.0


BRIGHT = 3600.0 * 1e12

NAMED: dict[str, dict[str, float | str]] = {
    # 0 to the power of 1/gamma and back, where a logarithm would fail.
    "no light at all": {"luminance": 0.0, "illuminance": 0.0},
    # PV_max and PV_min are equal, so that there is no swing to divide by.
    "a panel that gives no light": {"luminance": 0.0},
    # At 1e16 everything saturates, by a factor that overflows a byte and an integer.
    "light 1e12 times over": {"luminance": BRIGHT, "illuminance": 290e12},
    # The same in the dark, so that the profile is either 0 or 255.
    "light 1e12 times over in the dark": {"luminance": BRIGHT, "illuminance": 0.0},
}  # fmt: skip


@pytest.mark.parametrize("name", ["no light at all", "a panel that gives no light"])
def test_equal_levels_make_no_stripes(name: str) -> None:
    for averaging in ("pixel-value", "light"):
        scene = Scene().replace(columns=500, averaging=averaging, **NAMED[name])
        low, high = level_values(scene)
        assert low == high
        # Not even one ulp of difference may be stretched to stripes.
        assert np.ptp(occ.column_profile(scene)) == 0.0
        frame = occ.render(scene.replace(rows=20, enhancement="stretch"), tolerance=math.inf)
        assert np.ptp(frame.image) == 0


def test_no_light_is_exactly_black_and_too_much_exactly_white() -> None:
    dark = Scene().replace(columns=50, **NAMED["no light at all"])
    assert (occ.column_profile(dark) == 0.0).all()
    assert luminance_levels(dark).tolist() == [0.0, 0.0]
    assert float(luminance_of(np.zeros(1), dark.camera)[0]) == 0.0
    white = Scene().replace(columns=50, **NAMED["light 1e12 times over"])
    assert (occ.column_profile(white) == WHITE).all()


def test_1e12_times_the_light_in_the_dark_leaves_black_and_white() -> None:
    scene = Scene().replace(columns=3456, readout_time=1e-6, exposure_time=5e-6)
    scene = scene.replace(**NAMED["light 1e12 times over in the dark"])
    lit = lit_fraction(scene)
    profile = occ.column_profile(scene)
    np.testing.assert_array_equal(profile[lit == 0.0], 0.0)
    np.testing.assert_array_equal(profile[lit > 1e-3], WHITE)
    assert (lit == 0.0).any()
