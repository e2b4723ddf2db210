"""Laws of an LED that takes time to switch, against exact arithmetic and dense sampling."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.led_edges import LedEdges, edged_lit_fraction
from occ_model.scene.scene import Scene

FREQUENCY = 8192.0
"""Chips and packets of it last binary fractions of a second, so that edges of them are exact."""

EDGES = [1e-6, 0.01, 0.5, math.nextafter(1.0, 0.0), 1.0, 1.5, 2.0, 7.3, 24.0, 48.0, 333.3, 1000.0]
EXPOSURES = [0.01, 0.3, 1.0, 1.7, 2.0, 24.0, 31.4, 100.0]


def edged_scene(edge: float, exposure: float, **changes: float | str) -> Scene:
    """A scene with times in chips, small enough to be checked column by column."""
    chips: dict[str, float | str] = {
        "edge_time": edge / FREQUENCY,
        "exposure_time": exposure / FREQUENCY,
        "switching_frequency": FREQUENCY,
        "readout_time": 0.0813 / FREQUENCY,
        "start_time": 0.4567,
        "columns": 500,
    }
    return Scene().replace(**(chips | changes))


def exact_share(scene: Scene, column: int) -> Fraction:
    """The mean light of one column: every lit chip's part in it, summed in exact arithmetic.

    A flash at the time y lights the instants y ... y + tau, and counts as much as the exposure
    x ... x + t holds of them: a trapezium over y, which has a closed integral over a chip.
    """
    chips = [int(chip) for chip in occ.packet(scene)]
    frequency = Fraction(scene.transmitter.switching_frequency)
    x = Fraction(scene.model.start_time) + column * Fraction(scene.camera.readout_time)
    x *= frequency
    t = Fraction(scene.camera.exposure_time) * frequency
    tau = Fraction(scene.transmitter.edge_time) * frequency

    def ramp_integral(y: Fraction) -> Fraction:
        return max(y, Fraction(0)) ** 2 / 2

    def until(y: Fraction) -> Fraction:
        up = ramp_integral(y - (x - tau)) - ramp_integral(y - (x - tau) - min(tau, t))
        down = ramp_integral(y - (x + t) + min(tau, t)) - ramp_integral(y - (x + t))
        return up - down

    first, last = math.floor(x - tau), math.ceil(x + t)
    lit = (y for y in range(first, last) if chips[y % len(chips)])
    return sum((until(Fraction(y + 1)) - until(Fraction(y)) for y in lit), Fraction(0)) / (tau * t)


@pytest.mark.parametrize("exposure", EXPOSURES)
@pytest.mark.parametrize("edge", EDGES)
def test_edged_light_is_that_of_exact_arithmetic(edge: float, exposure: float) -> None:
    scene = edged_scene(edge, exposure)
    found = edged_lit_fraction(scene)
    columns = (0, 311) if edge + exposure > 100 else (0, 1, 17, 200, 311, 499)
    for column in columns:
        assert found[column] == pytest.approx(float(exact_share(scene, column)), rel=0, abs=2e-12)


@pytest.mark.parametrize("exposure", [0.01, 1.0, 3.3, 100.0])
@pytest.mark.parametrize("edge", [0.05, 1.0, 1.9, 31.0])
def test_edged_light_is_sharp_light_averaged_over_the_edge(edge: float, exposure: float) -> None:
    scene = edged_scene(edge, exposure, columns=20)
    samples = round(400 + 20 * edge)
    before = (np.arange(samples) + 0.5) / samples * scene.transmitter.edge_time
    sampled = [
        lit_fraction(scene.replace(start_time=scene.model.start_time - float(shift)))
        for shift in before
    ]
    # The midpoint rule's error: each change of chip lies within a sample of where it is taken.
    largest = 2.0 * math.sqrt(1.0 + edge) / samples
    np.testing.assert_allclose(
        edged_lit_fraction(scene), np.mean(sampled, axis=0), rtol=0, atol=largest
    )


@given(
    pattern=st.text(alphabet="01", min_size=1, max_size=30),
    edge=st.floats(1e-6, 100.0),
    exposure=st.floats(0.01, 100.0),
    start=st.floats(-1e3, 1e3),
)
def test_edged_light_of_any_pattern_is_that_of_exact_arithmetic(
    pattern: str, edge: float, exposure: float, start: float
) -> None:
    scene = edged_scene(edge, exposure, pattern=pattern, start_time=start, columns=3)
    expected = [float(exact_share(scene, column)) for column in range(3)]
    np.testing.assert_allclose(edged_lit_fraction(scene), expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("edge", [1.0, 1.5, 100.0, 3000.0])
def test_the_longest_patterns_lose_no_digits(edge: float) -> None:
    slow = "1" * 2048 + "0" * 2048
    scene = edged_scene(edge, 0.01, pattern=slow, readout_time=8.3 / FREQUENCY)
    found = edged_lit_fraction(scene)
    for column in (0, 17, 499):
        assert found[column] == pytest.approx(float(exact_share(scene, column)), rel=0, abs=1e-8)


@pytest.mark.parametrize("exposure", EXPOSURES)
def test_an_edge_towards_nothing_is_sharp(exposure: float) -> None:
    scene = edged_scene(0.0, exposure)
    for edge in (1e-3, 1e-6, 1e-9, 1e-300):
        edged = edged_lit_fraction(scene.replace(edge_time=edge / FREQUENCY))
        # tau / 2 is what one ramp keeps back, a rise at one end and a fall at the other add up.
        largest = edge / exposure + 1e-15
        assert np.abs(edged - lit_fraction(scene)).max() <= largest


def test_no_edge_at_all_is_sharp() -> None:
    scene = edged_scene(0.0, 1.7)
    light = LedEdges().apply(scene, ColumnLight.of(scene))
    np.testing.assert_array_equal(light.lit, lit_fraction(scene))


def test_edges_below_and_above_one_chip_meet() -> None:
    below, above = (
        edged_lit_fraction(edged_scene(edge, 1.7))
        for edge in (math.nextafter(1.0, 0.0), math.nextafter(1.0, 2.0))
    )
    np.testing.assert_allclose(below, above, rtol=0, atol=1e-14)


@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("exposure", [0.01, 1.0, 31.4])
def test_edges_leave_the_mean_light_of_a_packet(edge: float, exposure: float) -> None:
    # The columns start at all of a packet's 24 chips, 32 times within each.
    scene = edged_scene(edge, exposure, readout_time=1 / 32 / FREQUENCY, columns=24 * 32)
    mean = occ.packet(scene).mean()
    assert edged_lit_fraction(scene).mean() == pytest.approx(mean, rel=1e-3)
    assert lit_fraction(scene).mean() == pytest.approx(mean, rel=1e-3)


@pytest.mark.parametrize("edge", [24.0, 48.0, 960.0])
def test_edges_of_whole_packets_leave_no_stripes(edge: float) -> None:
    edged = edged_lit_fraction(edged_scene(edge, 1.7))
    np.testing.assert_allclose(edged, occ.packet(Scene()).mean(), rtol=0, atol=1e-13)


@given(edge=st.floats(1e-9, 1e3), exposure=st.floats(0.01, 100.0), start=st.floats(-1e9, 1e9))
def test_edged_light_is_between_none_and_all(edge: float, exposure: float, start: float) -> None:
    edged = edged_lit_fraction(edged_scene(edge, exposure, start_time=start, columns=100))
    assert edged.min() >= 0.0
    assert edged.max() <= 1.0


@given(edge=st.floats(0.0, 50.0), exposure=st.floats(0.01, 50.0), start=st.floats(0.0, 1.0))
def test_an_edge_and_an_exposure_are_the_same_average(
    edge: float, exposure: float, start: float
) -> None:
    """Both are moving averages, and so exchange: only the window's end stays where it is."""
    edge = max(edge, 0.01)
    scene = edged_scene(edge, exposure, start_time=start, columns=50)
    other = edged_scene(exposure, edge, columns=50)
    moved = scene.model.start_time + scene.camera.exposure_time - other.camera.exposure_time
    other = other.replace(start_time=moved)
    # The start is rounded, and the light's slope is at most one over the shorter of the two.
    largest = 1e-12 / min(edge, exposure)
    np.testing.assert_allclose(
        edged_lit_fraction(scene), edged_lit_fraction(other), rtol=0, atol=largest
    )
