"""Plans must agree with common sense."""

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.registry import EFFECTS
from occ_model.receiver.decoders import QUICK_DECODERS
from occ_model.scene.scene import Scene
from occ_model.study.observation import observe_profile, panel_span
from occ_model.study.paper_grid import DISTANCES, FREQUENCIES

COLUMNS_ONLY = {"sensor-noise": False, "fixed-pattern": False}


def close_up() -> Scene:
    """Make a bright panel that fills more than 3,000 rows."""
    scene = occ.load_preset("phone-68us").replace(distance=0.6)
    assert paper_view_of(scene).region.rows > 3000
    return scene


def noises(scene: Scene, tolerance: float = 0.5) -> set[str]:
    plan = occ.plan(scene, tolerance, "profile")
    return {d.effect for d in plan.decisions if d.kind == "noise" and d.included}


def test_a_bright_close_panel_needs_no_noise_for_its_profile() -> None:
    assert noises(close_up()) == set()
    assert {"sensor-noise", "fixed-pattern"} <= set(occ.plan(close_up()).included)  # its picture


def test_a_far_panel_of_twenty_rows_needs_noise() -> None:
    far = close_up().replace(panel_height=0.02, distance=3.4)
    assert paper_view_of(far).region.rows == 20
    assert "sensor-noise" in noises(far)


@pytest.mark.parametrize("pattern", ["01", ""])
def test_near_the_null_the_same_scene_needs_noise(pattern: str) -> None:
    scene = close_up().replace(pattern=pattern)
    null = scene.replace(switching_frequency=2.0 / scene.camera.exposure_time * (1 + 1e-4))
    assert noises(scene) == set()
    if pattern == "01":  # in packets only the single chips vanish there
        assert "sensor-noise" in noises(null)
    assert occ.plan(null, 0.5, "profile").stretch > occ.plan(scene, 0.5, "profile").stretch


def test_a_camera_without_distortion_never_runs_that_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise AssertionError

    for effect in EFFECTS:
        if effect.name == "distortion":
            monkeypatch.setattr(type(effect), "apply", fail)
    scene = occ.load_preset("phone-136us-real").replace(radial_k1=0, radial_k2=0, rows=50)
    timings = occ.render(scene, tolerance=0.0).timings
    assert "distortion" not in timings
    assert "defocus" in timings


def test_an_edge_of_1_us_counts_at_100_khz_and_not_at_2_khz() -> None:
    # The same ramp affects one column in six at 2 kHz, and all of them at 100 kHz, where the
    # stripes are also fainter: by 0.5 and 5 levels.
    scene = occ.load_preset("phone-136us").replace(edge_time=1e-6, distance=0.6)
    for frequency, counts in ((2e3, False), (100e3, True)):
        plan = occ.plan(scene.replace(switching_frequency=frequency), 0.6)
        assert ("led-edges" in plan) is counts, str(plan)


_PAPERS_PRESETS = ("phone-68us", "phone-136us", "tablet-61us", "tablet-122us")


@pytest.mark.parametrize("preset", _PAPERS_PRESETS)
def test_the_papers_scenes_need_sensor_noise_alone(preset: str) -> None:
    included = occ.plan(occ.load_preset(preset), 0.0).included
    assert set(included) == {"fixed-pattern", "sensor-noise"}


@pytest.mark.parametrize("preset", _PAPERS_PRESETS)
def test_the_profile_of_the_papers_scenes_needs_nothing(preset: str) -> None:
    assert occ.plan(occ.load_preset(preset), 0.5, "profile").included == ()


REAL = {"edge_time": 2e-6, "flicker_depth": 0.3}


@pytest.mark.parametrize(
    ("exposure", "light"),
    [
        ("phone-68us", {}),
        ("phone-136us", REAL),
        pytest.param("phone-68us", REAL, marks=pytest.mark.whole),
        pytest.param("phone-136us", {}, marks=pytest.mark.whole),
    ],
)
def test_profile_and_image_paths_decode_alike_on_the_papers_grid(
    exposure: str, light: dict[str, float]
) -> None:
    random = np.random.default_rng(1)
    for frequency in FREQUENCIES[:: amount(2, 1)]:
        for distance in DISTANCES[:: amount(3, 1)]:
            scene = occ.load_preset(exposure)
            scene = scene.replace(switching_frequency=frequency, distance=distance)
            start = float(random.uniform(0.0, 24.0 / frequency))
            # All rows of an upright panel are alike, so that a few are as good as 4,608.
            scene = scene.replace(start_time=start, **few_rows(scene), **light)
            plan = occ.plan(scene, 0.0, "profile", COLUMNS_ONLY)
            assert plan.kinds == ({"column"} if light else set())
            image = occ.render(scene, tolerance=0.0, force=COLUMNS_ONLY).image
            seen = observe_profile(paper_view_of(scene), panel_span(scene), plan, random)
            for decoder in QUICK_DECODERS:
                by_profile = seen.read(scene, decoder)
                by_image = occ.decode(image, scene, decoder)
                assert by_profile.region == by_image.region
                assert (by_profile.code, by_profile.failure) == (by_image.code, by_image.failure)
                np.testing.assert_array_equal(by_profile.bits, by_image.bits)


def few_rows(scene: Scene) -> dict[str, float | int]:
    """Return parameters for fewer rows, with the same columns and fraction of rows on the panel."""
    camera, rows = scene.camera, 96
    diagonal = np.hypot(camera.rows, camera.columns) / np.hypot(rows, camera.columns)
    return {
        "rows": rows,
        "equivalent_focal_length": float(camera.equivalent_focal_length * diagonal),
        "panel_height": scene.transmitter.panel_height * rows / camera.rows,
    }
