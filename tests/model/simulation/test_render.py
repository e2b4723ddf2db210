"""The door of the simulation."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.scene.scene import Scene


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us").replace(rows=60)


def test_a_frame_holds_what_its_image_is_made_of(scene: Scene) -> None:
    frame = occ.render(scene, tolerance=np.inf)
    assert frame.scene == scene
    assert frame.image.shape == (60, scene.camera.columns)
    assert frame.image.dtype == np.uint8
    assert frame.plan == occ.plan(scene, tolerance=np.inf)
    np.testing.assert_array_equal(frame.profile, occ.column_profile(scene))
    np.testing.assert_array_equal(frame.corners, occ.panel_corners(scene))


def test_every_stage_is_timed_in_the_order_it_ran(scene: Scene) -> None:
    timings = occ.render(scene, tolerance=np.inf).timings
    assert list(timings) == ["projection", "plan", "exposure", "enhancement", "image"]
    assert all(seconds >= 0.0 for seconds in timings.values())


@pytest.mark.parametrize("seed", [0, 7])
def test_the_papers_model_alone_leaves_nothing_to_chance(scene: Scene, seed: int) -> None:
    frame = occ.render(scene, tolerance=np.inf, seed=seed)
    np.testing.assert_array_equal(frame.image, occ.render(scene, tolerance=np.inf).image)


@pytest.mark.parametrize("noise", ["exact", "reused"])
def test_the_same_seed_gives_the_same_picture_and_another_another(scene: Scene, noise: str) -> None:
    def picture(seed: int) -> np.ndarray:
        return occ.render(scene, seed=seed, noise=noise).image  # type: ignore[arg-type]

    np.testing.assert_array_equal(picture(1), picture(1))
    assert (picture(1) != picture(2)).any()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"tolerance": -0.1}, "tolerance is -0.1"),
        ({"tolerance": float("nan")}, "tolerance is nan"),
        ({"tolerance": "small"}, "tolerance is 'small'"),
        ({"tolerance": True}, "tolerance is True"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": 1.5}, "seed is 1.5"),
        ({"noise": "white"}, "noise is 'white'; allowed: exact, reused"),
        ({"observable": "pixel"}, "observable is 'pixel'; allowed: profile, image"),
    ],
)
def test_what_is_no_tolerance_or_seed_is_refused(
    scene: Scene, arguments: dict[str, object], words: str
) -> None:
    with pytest.raises(occ.ParameterError, match=words):
        occ.render(scene, **arguments)  # type: ignore[arg-type]
