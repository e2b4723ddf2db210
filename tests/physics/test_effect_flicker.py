"""Laws of lamps that flicker, against quadrature of the light itself."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.photometry import luminance_levels, pixel_value
from occ_model.camera.projection import row_spans
from occ_model.effects.flicker import Flicker, ambient_shares
from occ_model.scene.scene import Scene

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
ONLY_FLICKER = {"sensor-noise": False, "fixed-pattern": False, "flicker": True}


def flickering(**changes: float | str) -> Scene:
    """Deep flicker at 100 Hz, in a small picture whose panel has surroundings at all sides."""
    chosen: dict[str, float | str] = {
        "flicker_depth": 0.8,
        "flicker_frequency": 100.0,
        "illuminance": 3000.0,
        "rows": 90,
        "columns": 400,
        "readout_time": 50e-6,
        "distance": 2.0,
        "enhancement": "none",
    }
    return Scene().replace(**(chosen | changes))


def integrated_share(scene: Scene, column: int) -> float:
    """The mean of E_v (1 + m cos(2 pi F x + phi)) / E_v over one exposure, by Gauss's rule."""
    surroundings = scene.surroundings
    frequency = Fraction(surroundings.flicker_frequency)
    exposure = Fraction(scene.camera.exposure_time)
    start = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
    # Only whole cycles are left out, in exact arithmetic: no large number comes near a cosine.
    parts = max(1, math.ceil(4 * frequency * exposure))
    total = 0.0
    for part in range(parts):
        first = float((start + exposure * Fraction(part, parts)) * frequency % 1)
        cycles = first + float(exposure * frequency / parts) * (NODES + 1) / 2
        light = np.cos(2 * np.pi * cycles + surroundings.flicker_phase)
        total += 1.0 + surroundings.flicker_depth * float(WEIGHTS @ light) / 2
    return total / parts


@given(
    cycles=st.floats(1e-6, 30.0),
    frequency=st.floats(0.01, 1e6),
    depth=st.floats(0.0, 1.0),
    phase=st.floats(-math.pi, math.pi),
    start=st.floats(-1e9, 1e9),
)
def test_flicker_is_the_integral_of_its_light_wherever_it_starts(
    cycles: float, frequency: float, depth: float, phase: float, start: float
) -> None:
    scene = flickering(
        exposure_time=max(cycles / frequency, 1e-9),
        flicker_frequency=frequency,
        flicker_depth=depth,
        flicker_phase=phase,
        start_time=start,
        columns=3,
    )
    expected = [integrated_share(scene, column) for column in range(3)]
    np.testing.assert_allclose(ambient_shares(scene), expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("start", [0.0, 1.0, 12345.678, 1e6 + 0.1, 1e9 - 1 / 7, -1e9 + 1 / 7])
def test_no_start_time_loses_the_phase(start: float) -> None:
    scene = flickering(start_time=start, columns=400, flicker_frequency=120.0)
    shares = ambient_shares(scene)
    for column in (0, 57, 399):
        assert shares[column] == pytest.approx(integrated_share(scene, column), rel=0, abs=1e-13)


def test_the_crest_is_at_phase_0_and_the_trough_half_a_cycle_on() -> None:
    # 128 Hz: the columns, 1/32 of a cycle apart, start at exact binary times.
    scene = flickering(
        flicker_frequency=128.0, readout_time=2.0**-12, exposure_time=1e-9, columns=32
    )
    shares = ambient_shares(scene)
    assert (shares.argmax(), shares.argmin()) == (0, 16)
    assert shares.max() == pytest.approx(1.8)
    assert shares.min() == pytest.approx(0.2)


@pytest.mark.parametrize("cycles", [1, 2, 7, 128, 12800])
def test_whole_cycles_of_flicker_leave_nothing(cycles: int) -> None:
    scene = flickering(exposure_time=cycles / 128.0, flicker_frequency=128.0)
    np.testing.assert_allclose(ambient_shares(scene), 1.0, rtol=0, atol=1e-15)
    assert not Flicker().is_present(scene)


def test_flicker_fades_as_the_sinc_of_the_exposure() -> None:
    for cycles in (0.1, 0.5, 1.5, 2.5, 10.5):
        scene = flickering(exposure_time=cycles / 100.0, readout_time=1e-5, columns=2000)
        swing = np.ptp(ambient_shares(scene)) / 2
        assert swing == pytest.approx(0.8 * abs(np.sinc(cycles)), rel=1e-4)


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_no_depth_is_exactly_nothing(averaging: str) -> None:
    scene = flickering(flicker_depth=0.0, averaging=averaging)
    forced = occ.render(scene, tolerance=float("inf"), force={"flicker": True})
    without = occ.render(scene, tolerance=float("inf"))
    assert not Flicker().is_present(scene)
    np.testing.assert_array_equal(forced.profile, without.profile)
    np.testing.assert_array_equal(forced.image, without.image)


def test_the_surroundings_flicker_as_the_dark_panel_does() -> None:
    scene = flickering(pattern="0")
    frame = occ.render(scene, force=ONLY_FLICKER)
    dark = luminance_levels(scene)[0] * ambient_shares(scene)
    expected = np.rint(pixel_value(dark, scene.camera))
    assert np.ptp(expected) > 25
    np.testing.assert_array_equal(frame.image, np.tile(expected, (90, 1)))


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
def test_the_surroundings_flicker_beside_a_panel_that_blinks(enhancement: str) -> None:
    scene = flickering(enhancement=enhancement)
    frame = occ.render(scene, force=ONLY_FLICKER)
    first, last = row_spans(frame.corners, 90, 400)
    row = 45
    outside = np.r_[0 : first[row], last[row] : 400]
    dark = luminance_levels(scene)[0] * ambient_shares(scene)
    expected = np.rint(pixel_value(dark, scene.camera))
    assert 50 < len(outside) < 350
    np.testing.assert_array_equal(frame.image[row, outside], expected[outside])
    np.testing.assert_array_equal(frame.image[0], expected)


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_the_panel_flickers_by_the_light_that_it_reflects(averaging: str) -> None:
    scene = flickering(averaging=averaging, code=0, illuminance=1000.0)
    profile = occ.render(scene, force=ONLY_FLICKER).profile
    dark, bright = luminance_levels(scene)
    reflected = dark * ambient_shares(scene)
    lit = occ.on_time(scene) / scene.camera.exposure_time
    emitted = bright - dark
    if averaging == "light":
        expected = pixel_value(reflected + emitted * lit, scene.camera)
    else:
        low, high = pixel_value(np.array([reflected, reflected + emitted]), scene.camera)
        expected = high * lit + low * (1 - lit)
    np.testing.assert_allclose(profile, np.minimum(expected, 255.0), rtol=1e-12)
