"""Laws of an LED with rise and fall times, and of lamps that flicker."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.photometry import luminance_levels, pixel_value
from occ_model.camera.projection import row_spans
from occ_model.effects.light_effects import ambient_fractions, lit_fraction_with_edges
from occ_model.scene.scene import Scene

FREQUENCY = 8192.0
"""Its chips and packets last binary fractions of a second, so that their edges are exact."""


def edged_scene(edge: float, exposure: float, **changes: float | str) -> Scene:
    """Make a scene with times in chips, small enough to check every column."""
    return Scene().replace(
        edge_time=edge / FREQUENCY, exposure_time=exposure / FREQUENCY,
        switching_frequency=FREQUENCY, readout_time=0.0813 / FREQUENCY, start_time=0.4567,
        columns=500,
    ).replace(**changes)  # fmt: skip


@given(edge=st.floats(0.0, 50.0), exposure=st.floats(0.01, 50.0), start=st.floats(0.0, 1.0))
def test_an_edge_and_an_exposure_are_the_same_average(
    edge: float, exposure: float, start: float
) -> None:
    """Both are moving averages and can be exchanged; only the window's end stays the same."""
    edge = max(edge, 0.01)
    scene = edged_scene(edge, exposure, start_time=start, columns=50)
    other = edged_scene(exposure, edge, columns=50)
    moved = scene.model.start_time + scene.camera.exposure_time - other.camera.exposure_time
    other = other.replace(start_time=moved)
    # The start is rounded, and the light's slope is at most one over the shorter of the two.
    largest = 1e-12 / min(edge, exposure)
    np.testing.assert_allclose(
        lit_fraction_with_edges(scene), lit_fraction_with_edges(other), rtol=0, atol=largest
    )


ONLY_FLICKER = {"sensor-noise": False, "fixed-pattern": False, "flicker": True}


def flickering_scene(**changes: float | str) -> Scene:
    """Make deep flicker at 100 Hz in a small picture with surroundings on all sides of the
    panel."""
    return Scene().replace(
        flicker_depth=0.8, flicker_frequency=100.0, illuminance=3000.0, rows=90, columns=400,
        readout_time=50e-6, distance=2.0, enhancement="none",
    ).replace(**changes)  # fmt: skip


def test_the_crest_is_at_phase_0_and_the_trough_half_a_cycle_on() -> None:
    # At 128 Hz the columns are 1/32 of a cycle apart and start at exact binary times.
    scene = flickering_scene(
        flicker_frequency=128.0, readout_time=2.0**-12, exposure_time=1e-9, columns=32
    )
    fractions = ambient_fractions(scene)
    assert (fractions.argmax(), fractions.argmin()) == (0, 16)
    assert fractions.max() == pytest.approx(1.8)
    assert fractions.min() == pytest.approx(0.2)


def test_the_surroundings_flicker_as_the_dark_panel_does() -> None:
    scene = flickering_scene(pattern="0")
    frame = occ.render(scene, force=ONLY_FLICKER)
    dark = luminance_levels(scene)[0] * ambient_fractions(scene)
    expected = np.rint(pixel_value(dark, scene.camera))
    assert np.ptp(expected) > 25
    np.testing.assert_array_equal(frame.image, np.tile(expected, (90, 1)))


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
def test_the_surroundings_flicker_beside_a_panel_that_blinks(enhancement: str) -> None:
    scene = flickering_scene(enhancement=enhancement)
    frame = occ.render(scene, force=ONLY_FLICKER)
    first, last = row_spans(frame.corners, 90, 400)
    row = 45
    outside = np.r_[0 : first[row], last[row] : 400]
    dark = luminance_levels(scene)[0] * ambient_fractions(scene)
    expected = np.rint(pixel_value(dark, scene.camera))
    assert 50 < len(outside) < 350
    np.testing.assert_array_equal(frame.image[row, outside], expected[outside])
    np.testing.assert_array_equal(frame.image[0], expected)


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_the_panel_flickers_by_the_light_that_it_reflects(averaging: str) -> None:
    scene = flickering_scene(averaging=averaging, code=0, illuminance=1000.0)
    profile = occ.render(scene, force=ONLY_FLICKER).profile
    dark, bright = luminance_levels(scene)
    reflected = dark * ambient_fractions(scene)
    lit = occ.on_time(scene) / scene.camera.exposure_time
    emitted = bright - dark
    if averaging == "light":
        expected = pixel_value(reflected + emitted * lit, scene.camera)
    else:
        low, high = pixel_value(np.array([reflected, reflected + emitted]), scene.camera)
        expected = high * lit + low * (1 - lit)
    np.testing.assert_allclose(profile, np.minimum(expected, 255.0), rtol=1e-12)
