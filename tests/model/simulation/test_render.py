"""Rendering: the content of a frame, the work that is done only once, and refusals."""

import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.exposure import lit_fraction, lit_fractions
from occ_model.camera.projection import panel_corners
from occ_model.commands.command_line import make_parser
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.render import plan_scene, render_with

COSTLY = {work.__code__: work.__name__ for work in (lit_fraction, lit_fractions, panel_corners)}


@contextmanager
def count_calls() -> Iterator[Counter[str]]:
    """Count all calls of the exposure and of the projection."""
    calls: Counter[str] = Counter()

    def count(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call" and frame.f_code in COSTLY:
            calls[COSTLY[frame.f_code]] += 1

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        yield calls
    finally:
        sys.setprofile(before)


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us").replace(rows=60)


def test_a_frame_has_everything_its_image_is_made_of(scene: Scene) -> None:
    frame = occ.render(scene, tolerance=np.inf)
    assert frame.scene == scene
    assert frame.image.shape == (60, scene.camera.columns)
    assert frame.image.dtype == np.uint8
    assert frame.plan == occ.plan(scene, tolerance=np.inf)
    np.testing.assert_array_equal(frame.profile, occ.column_profile(scene))
    np.testing.assert_array_equal(frame.corners, occ.panel_corners(scene))


@pytest.mark.parametrize("method", ["equalization", "stretch", "none"])
@pytest.mark.parametrize("tolerance", [0.0, np.inf])
@pytest.mark.parametrize("preset", ["phone-136us", "phone-136us-real"])
def test_the_receivers_picture_is_the_cameras_enhanced(
    preset: str, tolerance: float, method: str
) -> None:
    scene = occ.load_preset(preset).replace(rows=900, columns=900, enhancement=method, distance=2.2)
    frame = occ.render(scene, tolerance=tolerance)
    camera, image = frame.camera_image, frame.image
    assert camera.shape == image.shape
    assert camera.dtype == np.uint8
    outside = np.ones(image.shape, dtype=bool)
    (left, top), (right, bottom) = frame.corners.min(axis=0), frame.corners.max(axis=0)
    outside[int(top) - 9 : int(bottom) + 9, int(left) - 9 : int(right) + 9] = False
    np.testing.assert_array_equal(image[outside], camera[outside])
    rows = slice(int(top) + 20, int(bottom) - 20)
    inside = rows, slice(int(left) + 20, int(right) - 20)
    pairs = np.unique(np.stack([camera[inside].ravel(), image[inside].ravel()]), axis=1)
    assert len(np.unique(pairs[0])) == pairs.shape[1]  # one enhanced level for each level
    assert (np.diff(pairs[1].astype(int)) >= 0).all()
    assert np.array_equal(camera[inside], image[inside]) == (method == "none")
    # The profile is that of the camera's picture, up to rounding.
    means = camera[inside].mean(axis=0)
    assert np.abs(means - frame.profile[inside[1]]).max() <= 0.75


@pytest.mark.parametrize("preset", ["phone-136us", "phone-136us-real"])
@pytest.mark.parametrize("tolerance", [0.0, 0.5, np.inf])
def test_a_picture_takes_one_exposure_and_one_projection(preset: str, tolerance: float) -> None:
    scene = occ.load_preset(preset).replace(rows=60, code=5)
    with count_calls() as calls:
        occ.render(scene, tolerance=tolerance)
    assert calls == {"lit_fraction": 1, "panel_corners": 1}


def test_a_plan_takes_one_exposure_and_one_projection(scene: Scene) -> None:
    with count_calls() as calls:
        occ.plan(scene.replace(jpeg_quality=90, radial_k1=0.1), 0.5, "profile")
    assert calls == {"lit_fraction": 1, "panel_corners": 1}


def test_five_whole_pictures_take_five_exposures_and_a_plan(scene: Scene) -> None:
    with count_calls() as calls:
        occ.success_rate(scene, images=5, path="image")
    assert calls == {"lit_fraction": 6, "panel_corners": 6}


def test_five_pictures_of_a_batch_are_exposed_together(scene: Scene) -> None:
    with count_calls() as calls:
        occ.success_rate(scene, images=5, path="auto")
    assert calls["lit_fractions"] == 1
    assert calls["lit_fraction"] == 0
    assert calls["panel_corners"] <= 1  # kept from an earlier study of the same geometry


def test_settings_as_one_value_give_the_same_picture(scene: Scene) -> None:
    settings = SimulationSettings(2.0, "profile", {"fixed-pattern": True}, seed=7)
    one_by_one = occ.render(
        scene, tolerance=2.0, observable="profile", force={"fixed-pattern": True},
        seed=7,
    )  # fmt: skip
    as_a_value = render_with(scene, settings)
    assert as_a_value.plan == one_by_one.plan
    np.testing.assert_array_equal(as_a_value.image, one_by_one.image)


def test_a_source_of_noise_of_former_versions_is_ignored(scene: Scene) -> None:
    former = SimulationSettings(0.5, "image", {}, "reused", 7)
    assert former == SimulationSettings(seed=7)
    frames = (render_with(scene, former), occ.render(scene, noise="reused", seed=7))
    np.testing.assert_array_equal(frames[0].image, frames[1].image)
    command = ["render", "--noise", "reused", "-o", "picture.png"]
    assert make_parser("render").parse_args(command).command


def test_a_planned_scene_is_not_planned_again(scene: Scene) -> None:
    settings = SimulationSettings()
    planned = plan_scene(scene, settings)
    frame = render_with(scene, settings, planned=planned)
    for stage in ("projection", "plan"):
        assert frame.timings[stage] == planned.timings[stage]
    np.testing.assert_array_equal(frame.image, render_with(scene, settings).image)


@pytest.mark.parametrize("seed", [0, 7])
def test_the_bare_paper_model_does_not_depend_on_the_seed(scene: Scene, seed: int) -> None:
    frame = occ.render(scene, tolerance=np.inf, seed=seed)
    np.testing.assert_array_equal(frame.image, occ.render(scene, tolerance=np.inf).image)
