"""Laws of an LED that takes time to switch, against exact arithmetic and dense sampling."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occ_model.camera.exposure import lit_fraction
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.light_effects import LedEdges, edged_lit_fraction
from occ_model.scene.scene import Scene

FREQUENCY = 8192.0
"""Chips and packets of it last binary fractions of a second, so that edges of them are exact."""


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


@pytest.mark.parametrize("exposure", [0.01, 1.0, 3.3, 100.0])
@pytest.mark.parametrize("edge", [0.05, 1.0, 1.9, 31.0])
def test_edged_light_is_sharp_light_averaged_over_the_edge(edge: float, exposure: float) -> None:
    scene = edged_scene(edge, exposure, columns=20)
    samples = round(150 + 10 * edge)
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


def test_no_edge_at_all_is_sharp() -> None:
    scene = edged_scene(0.0, 1.7)
    light = LedEdges().apply(scene, ColumnLight.of(scene))
    np.testing.assert_array_equal(light.lit, lit_fraction(scene))


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
