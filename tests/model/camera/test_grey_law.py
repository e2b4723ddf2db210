"""A pixel's grey level follows its law, which is enumerated for comparison."""

import math

import numpy as np
import pytest
from amount import amount
from model.camera.grey_enumeration import enumerate_greys, greys_of

import occ_model as occ
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.photometry import white_electrons
from occ_model.effects.noise import law_of
from occ_model.scene.scene import Scene

GREYS = np.arange(256.0)
SENSOR = ("sensor-noise",)
BOTH = ("fixed-pattern", "sensor-noise")

SENSORS: tuple[dict[str, float], ...] = (
    {},
    {"adc_bits": 4},
    {"adc_bits": 8, "read_noise": 0.0},
    {"read_noise": 0.4, "adc_bits": 12},
    {"read_noise": 20.0},
    {"gamma": 1.0},
    {"gamma": 4.0, "iso": 800.0},
    {"iso": 6400.0},
    {"iso": 25.0, "full_well": 3000.0},
)


def scene_of(changes: dict[str, float]) -> Scene:
    return occ.load_preset("phone-68us").replace(**changes)


def law(scene: Scene, names: tuple[str, ...] = SENSOR) -> GreyLaw:
    found = law_of(scene, names, np.array([600.0]))
    assert found is not None
    return found


@pytest.mark.parametrize("changes", SENSORS, ids=str)
@pytest.mark.parametrize("gain", [0.0, 0.05])
def test_the_law_is_the_enumerated_one(changes: dict[str, float], gain: float) -> None:
    scene = scene_of(changes | {"gain_variation": gain})
    table = law(scene, BOTH if gain else SENSOR)
    values = np.concatenate([np.linspace(0.0, 40.0, 5), np.linspace(50.0, 262.0, amount(4, 30))])
    for value in values.tolist():
        exact = enumerate_greys(scene, value, gain)
        found = table.histogram(np.array([value]), np.ones(1))
        # Between levels the table is sharpened: right on average, and nearly so at each value.
        assert np.abs(np.cumsum(found - exact)).max() < 3e-4
    at = np.array([5.0, 20.0, 100.0, 240.0])
    mean, deviation = (table.interpolate(each, at) for each in (table.means, table.deviations))
    for value, own_mean, own_deviation in zip(at.tolist(), mean, deviation, strict=True):
        exact = enumerate_greys(scene, value, gain)
        true = exact @ GREYS
        sigma = math.sqrt(exact @ (GREYS - true) ** 2)
        assert own_mean == pytest.approx(true, abs=2e-3 * sigma + 1e-3)
        assert own_deviation == pytest.approx(sigma, rel=3e-3, abs=2e-3)


@pytest.mark.parametrize("bits", [4, 6])
def test_a_converter_of_few_bits_leaves_as_few_levels(bits: int) -> None:
    scene = scene_of({"adc_bits": bits, "illuminance": 5e4})
    image = occ.render(scene.replace(rows=300, columns=300), tolerance=0.0).camera_image
    assert set(np.unique(image)) <= set(greys_of(scene).tolist())
    assert greys_of(scene).max() == 255


@pytest.mark.parametrize("changes", SENSORS, ids=str)
def test_a_quantity_at_a_mean_is_that_at_its_value(changes: dict[str, float]) -> None:
    table = law(scene_of(changes))
    values = np.linspace(8.0, 0.9 * 255.0 * min(1.0, _full(scene_of(changes))), 40)
    means = table.interpolate(table.means, values)
    np.testing.assert_allclose(table.at_means(table.means, means), means, atol=1e-6)
    squares = table.mean_of(GREYS**2)
    np.testing.assert_allclose(
        table.at_means(squares, means), table.interpolate(squares, values), rtol=1e-4, atol=1e-6
    )


def _full(scene: Scene) -> float:
    return (scene.sensor.full_well / white_electrons(scene)) ** (1.0 / scene.camera.gamma)


def test_a_full_well_that_is_left_out_limits_nothing() -> None:
    scene = scene_of({"iso": 25.0, "full_well": 3000.0, "luminance": 1e5})
    bright = np.array([240.0])
    laws = (law(scene, names) for names in ((*SENSOR, "full-well"), SENSOR))
    limited, free = (each.interpolate(each.means, bright)[0] for each in laws)
    assert limited == pytest.approx(255.0 * _full(scene), abs=0.5)
    assert free == pytest.approx(240.0, abs=1.0)
