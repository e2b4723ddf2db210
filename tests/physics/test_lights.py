"""Pictures of lamps, levels, mains and flashes, against exact light and samples dense in time."""

import math

import numpy as np
import pytest
from exact_light import OTHER_LIGHTS, ExactLight
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.scene.scene import Observable, Scene
from occ_model.study.effect_differences import CompleteSimulation

SMALL = occ.load_preset("phone-136us").replace(
    rows=30, columns=240, panel_width=9.0, panel_height=9.0, start_time=0.3
)
SAMPLES = 20_000  # of an exposure
OBSERVED: tuple[Observable, ...] = ("image", "profile", "signal")


def starts_of(scene: Scene) -> FloatArray:
    camera = scene.camera
    return np.asarray(scene.model.start_time + np.arange(camera.columns) * camera.readout_time)


def pixel_values(scene: Scene, light: FloatArray) -> FloatArray:
    """Apply equations (1) to (3) of the paper for a mean light of each column."""
    camera, around = scene.camera, scene.surroundings

    def value(luminance: float) -> float:
        exposure = camera.iso * camera.exposure_time * luminance
        light_meter = camera.meter_constant * camera.f_number**2
        return 118.0 * float((exposure / light_meter) ** (1.0 / camera.gamma))

    dark = around.illuminance * around.reflectance / math.pi
    low, high = value(dark), value(dark + scene.transmitter.luminance)
    return np.minimum(low + (high - low) * light, 255.0)


@pytest.mark.parametrize("exposure", [3e-6, 136e-6, 1 / 239, 5e-3])
@pytest.mark.parametrize("name", [name for name in OTHER_LIGHTS if name != "mains"])
def test_the_profile_of_any_light_is_that_of_its_mean_in_each_exposure(
    name: str, exposure: float
) -> None:
    scene = SMALL.replace(**OTHER_LIGHTS[name], exposure_time=exposure, iso=2.0)
    light = ExactLight(scene).of_columns()
    np.testing.assert_allclose(occ.on_time(scene), light * exposure, atol=1e-13)
    frame = occ.render(scene, tolerance=math.inf)
    np.testing.assert_allclose(frame.profile, pixel_values(scene, light), atol=1e-7)
    image = frame.camera_image.astype(float)
    assert np.abs(image.mean(axis=0) - frame.profile).max() <= 0.5 + 1e-9


@pytest.mark.parametrize("exposure", [1e-6, 2e-3, 1 / 100, 0.123])
def test_light_of_the_mains_is_that_of_dense_samples_also_around_it(exposure: float) -> None:
    scene = SMALL.replace(
        light="mains", mains_frequency=50.0, mains_depth=0.4, exposure_time=exposure, iso=1.0,
        readout_time=1e-4, averaging="light", luminance=50.0,
    )  # fmt: skip
    within = (np.arange(SAMPLES) + 0.5) / SAMPLES * exposure
    times = starts_of(scene)[:, None] + within
    sampled = 1.0 + 0.4 * np.cos(4.0 * math.pi * 50.0 * times).mean(axis=1)
    # The rule of middles errs by up to (2 pi F h)^2 / 24 of the depth.
    bound = 0.4 * (2.0 * math.pi * 100.0 * exposure / SAMPLES) ** 2 / 24.0 + 1e-12
    np.testing.assert_allclose(lit_fraction(scene), sampled, atol=bound)
    np.testing.assert_allclose(lit_fraction(scene), ExactLight(scene).of_columns(), atol=2e-15)
    force = {"sensor-noise": False, "fixed-pattern": False, "full-well": False}
    frame = occ.render(scene, tolerance=0.0, force=force)
    camera, around = scene.camera, scene.surroundings
    mean = 50.0 + around.illuminance * around.reflectance / math.pi
    light_meter = camera.meter_constant * camera.f_number**2
    light = camera.iso * exposure * mean * sampled / light_meter
    expected = np.minimum(118.0 * light ** (1.0 / camera.gamma), 255.0)
    np.testing.assert_allclose(frame.profile, expected, atol=0.51)


LENGTHS = st.floats(-9.0, 9.0).map(lambda power: 10.0**power)  # exposures in periods


@settings(max_examples=60)
@pytest.mark.parametrize("name", OTHER_LIGHTS)
@given(periods=LENGTHS, period=st.sampled_from([1e-9, 1e-6, 1e-3, 1.0]), start=st.floats(-1e3, 1e3))
def test_exposures_of_any_length_hold_the_exact_light(
    name: str, periods: float, period: float, start: float
) -> None:
    sent: dict[str, dict[str, float | str]] = {
        "lamp": {"lamp_frequency": 1 / period, "duty": 0.3, "depth": 0.9},
        "pulses": {"pulse_frequency": 1 / period, "pulse_length": max(period / 7.0, 1e-9)},
        "mains": {"mains_frequency": min(max(0.5 / period, 1.0), 1e3)},
        "levels": {"levels": "0 1 2 3 / 3", "switching_frequency": min(max(4 / period, 1), 1e9)},
        "recorded": {"waveform_file": f"0,0.2\n{period / 9!r},1\n{period / 2!r},0\n{period!r}\n"},
    }
    exposure = min(max(periods * period, 1e-9), 1e6)
    scene = Scene().replace(
        light=OTHER_LIGHTS[name]["light"], **sent[name], start_time=start, exposure_time=exposure,
        columns=20, readout_time=min(max(0.37 * period, 1e-9), 10.0),
    )  # fmt: skip
    found = lit_fraction(scene)
    assert np.isfinite(found).all()
    np.testing.assert_allclose(found, ExactLight(scene).of_columns(), atol=2e-12)


@pytest.mark.parametrize(
    ("sent", "mean"),
    [
        ({"light": "lamp", "duty": 0.0}, 0.0),
        ({"light": "lamp", "duty": 0.0, "depth": 0.25}, 0.75),
        ({"light": "lamp", "duty": 1.0}, 1.0),
        ({"light": "lamp", "depth": 0.0, "duty": 0.3}, 1.0),
        ({"light": "mains", "mains_depth": 0.0}, 1.0),
        ({"light": "pulses", "pulse_frequency": 60.0, "pulse_length": 1.0}, 1.0),
        ({"light": "pulses", "pulse_frequency": 50.0, "pulse_length": 0.02}, 1.0),
        ({"light": "waveform", "levels": "1 1 1 1 / 4"}, 0.25),
        ({"light": "waveform", "waveform_file": "0,0.5\n1e-3,0.5\n4e-3\n"}, 0.5),
    ],
)
def test_light_without_a_swing_is_steady_in_every_exposure(
    sent: dict[str, float | str], mean: float
) -> None:
    for exposure in (1e-9, 136e-6, 1.0, 1e6):
        scene = SMALL.replace(**sent, exposure_time=exposure)
        np.testing.assert_allclose(lit_fraction(scene), mean, rtol=1e-15)
        assert np.ptp(occ.column_profile(scene)) <= 1e-12


@pytest.mark.parametrize("name", OTHER_LIGHTS)
def test_plans_of_any_light_keep_their_promise(name: str) -> None:
    random = np.random.default_rng(sorted(OTHER_LIGHTS).index(name))
    real = occ.load_preset("phone-136us-real").replace(
        rows=100, columns=240, readout_time=60e-6, **OTHER_LIGHTS[name]
    )
    for number in range(6):
        scene = real.replace(
            distance=float(random.uniform(0.3, 1.2)), iso=float(10 ** random.uniform(0.5, 2.0)),
            exposure_time=float(10 ** random.uniform(-4.5, -2.5)),
            edge_time=float(10 ** random.uniform(-7.0, -4.0)), jpeg_quality=(0, 95)[number % 2],
            enhancement=("none", "stretch", "equalization")[number % 3],
        )  # fmt: skip
        for observable in OBSERVED:
            complete = CompleteSimulation(scene, observable, 1)
            for tolerance in (0.5, 5.0):
                chosen = occ.plan(scene, tolerance, observable)
                assert complete.error_of(chosen.included) <= tolerance * (1.0 + 1e-9)
