"""Plans must agree with common sense."""

import pytest

import occ_model as occ
from occ_model.effects.effect import paper_view_of
from occ_model.effects.registry import EFFECTS
from occ_model.scene.scene import Scene


def close_up() -> Scene:
    """Make a bright panel that fills more than 3,000 rows, whose pixels all hold many electrons."""
    scene = occ.load_preset("phone-68us").replace(
        distance=0.6, illuminance=10_000.0, pixel_pitch=3e-6, full_well=1e5, adc_bits=14
    )
    assert paper_view_of(scene).region.rows > 3000
    return scene


def noises(scene: Scene, tolerance: float = 0.5) -> set[str]:
    plan = occ.plan(scene, tolerance, "profile")
    return {d.effect for d in plan.decisions if d.kind == "noise" and d.included}


def test_a_bright_close_panel_needs_no_noise_for_its_profile() -> None:
    assert noises(close_up()) == set()
    assert {"sensor-noise", "fixed-pattern"} <= set(occ.plan(close_up()).included)  # its picture


def test_a_far_panel_of_twenty_rows_needs_noise() -> None:
    far = close_up().replace(panel_height=0.02, distance=3.4, pixel_pitch=1e-6)
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
    still = {"sensor-noise": False, "fixed-pattern": False}
    for frequency, counts in ((2e3, False), (100e3, True)):
        plan = occ.plan(scene.replace(switching_frequency=frequency), 0.6, force=still)
        assert ("led-edges" in plan) is counts, str(plan)


_PAPERS_PRESETS = ("phone-68us", "phone-136us", "tablet-61us", "tablet-122us")


@pytest.mark.parametrize("preset", _PAPERS_PRESETS)
def test_the_papers_scenes_need_sensor_noise_alone(preset: str) -> None:
    included = occ.plan(occ.load_preset(preset), 0.0).included
    assert set(included) == {"fixed-pattern", "sensor-noise"}


@pytest.mark.parametrize("preset", _PAPERS_PRESETS)
def test_the_profile_of_the_papers_scenes_needs_the_noise_that_darkens_their_dark_stripes(
    preset: str,
) -> None:
    assert occ.plan(occ.load_preset(preset), 0.5, "profile").included == ("sensor-noise",)
