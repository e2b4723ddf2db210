"""A draft has every k-th row of the picture, and the rows of the panel may come first."""

import math
from time import perf_counter, sleep

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.frame import Frame
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.render import render_with

NOISELESS = {"sensor-noise": False, "fixed-pattern": False, "jpeg": False}


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A real camera's picture, a twelfth of its size in each direction."""
    scene = occ.load_preset("phone-136us-real")
    return scene.replace(rows=385, columns=288, readout_time=12 * scene.camera.readout_time)


@pytest.mark.parametrize("step", [1, 2, 7, 64, 100, 384, 385])
@pytest.mark.parametrize("tolerance", [0.0, math.inf])
@pytest.mark.parametrize("turn", [{}, {"roll": 0.3, "yaw": 0.2}, {"radial_k1": 0.0}])
def test_the_rows_of_a_draft_are_rows_of_the_picture(
    scene: Scene, step: int, tolerance: float, turn: dict[str, float]
) -> None:
    turned = scene.replace(**turn)
    draft, whole = (
        occ.render(turned, tolerance=tolerance, force=NOISELESS, rows_step=k) for k in (step, 1)
    )
    assert len(draft.image) == len(draft.rows) == math.ceil(385 / step)
    assert draft.rows_step == step
    # Values are interpolated from other rows, and may round to the next level.
    off = np.abs(draft.camera_image.astype(int) - whole.camera_image[draft.rows])
    assert off.max() <= 1
    assert np.count_nonzero(off) <= 2e-4 * off.size
    assert np.count_nonzero(draft.image != whole.image[draft.rows]) <= np.count_nonzero(off)


@pytest.mark.parametrize("turn", [{}, {"roll": 0.3, "yaw": 0.2}, {"offset_y": 5.0}])
def test_the_file_of_a_draft_is_made_of_its_rows_where_the_panel_is(
    scene: Scene, turn: dict[str, float]
) -> None:
    turned = scene.replace(jpeg_quality=60, columns=291, **turn)
    kept, bare = (
        occ.render(turned, tolerance=0.0, force={"jpeg": on}, rows_step=3).camera_image
        for on in (True, False)
    )
    whole = Jpeg().apply(turned, bare)
    left, right = (int(end) for end in np.clip(occ.panel_corners(turned)[:, 0], 0, 291)[[0, 2]])
    if "offset_y" in turn:
        np.testing.assert_array_equal(kept, bare)
    else:
        assert (kept != bare).any()
        shown = slice(min(left, right), max(left, right))
        rows = np.clip(occ.panel_corners(turned)[:, 1].astype(int) // 3, 0, 128)
        seen = slice(rows.min() + 1, rows.max())
        np.testing.assert_array_equal(kept[seen, shown], whole[seen, shown])
    assert ((kept == whole) | (kept == bare)).all()


@pytest.mark.parametrize(
    "turn", [{}, {"roll": 0.3, "yaw": 0.2, "distance": 2.0}, {"jpeg_quality": 0}]
)
def test_rows_of_the_panel_that_are_made_first_are_the_pictures(
    scene: Scene, turn: dict[str, float]
) -> None:
    turned, settings = scene.replace(rows=1200, **turn), SimulationSettings(tolerance=0.0)
    parts: list[Frame] = []
    whole = render_with(turned, settings, show_panel=parts.append)
    (part,) = parts
    assert part.rows.start <= part.corners[:, 1].min()
    assert part.rows.stop > part.corners[:, 1].max()
    assert 2 * len(part.rows) <= len(whole.rows)
    plain = render_with(turned, settings)
    for name in ("camera_image", "image", "profile", "signal"):
        of_whole = getattr(whole, name)
        of_part = of_whole[part.rows] if of_whole.ndim == 2 else of_whole
        np.testing.assert_array_equal(getattr(part, name), of_part)
        np.testing.assert_array_equal(getattr(plain, name), of_whole)


def test_the_time_of_showing_rows_counts_for_no_stage(scene: Scene) -> None:
    shown = 0.3
    start = perf_counter()
    frame = render_with(
        scene.replace(rows=1200), SimulationSettings(), show_panel=lambda _part: sleep(shown)
    )
    assert sum(frame.timings.values()) <= perf_counter() - start - shown


def test_drafts_of_two_seeds_have_noise_of_their_own(scene: Scene) -> None:
    first, second, again = (
        occ.render(scene, rows_step=3, seed=seed).camera_image for seed in (1, 2, 1)
    )
    np.testing.assert_array_equal(first, again)
    assert (first != second).mean() > 0.5


@pytest.mark.parametrize("place", [{"distance": 0.5}, {"offset_y": 5.0}])
def test_no_rows_are_made_first_if_most_show_the_panel_or_none_does(
    scene: Scene, place: dict[str, float]
) -> None:
    parts: list[Frame] = []
    render_with(scene.replace(**place), SimulationSettings(), show_panel=parts.append)
    assert not parts


@pytest.mark.parametrize("rows", [1, 2, 3, 10, 385])
@pytest.mark.parametrize("step", [1, 2, 3, 4, 10])
def test_each_row_stands_for_rows_around_it(scene: Scene, rows: int, step: int) -> None:
    if step > rows:
        return
    shown = occ.render(scene.replace(rows=rows), tolerance=math.inf, rows_step=step).rows
    middle = np.arange(len(shown)) * step + (step - 1) / 2
    assert np.abs(np.array(shown) - middle).max() <= step / 2
    assert shown[-1] < rows


@pytest.mark.parametrize("preset", ["phone-136us", "phone-136us-real"])
def test_a_draft_is_decoded_as_its_picture_is(preset: str) -> None:
    scene = occ.load_preset(preset).replace(rows=1152, columns=1728)
    scene = scene.replace(readout_time=2 * scene.camera.readout_time)
    for step in (1, 3):
        frame = occ.render(scene, rows_step=step)
        assert occ.decode(frame.image, scene).code == scene.transmitter.code


def test_an_error_of_the_heartbeat_ends_a_picture() -> None:
    scene = occ.load_preset("phone-68us").replace(rows=640, columns=500)
    beats: list[int] = []
    render_with(scene, SimulationSettings(), heartbeat=lambda: beats.append(1))
    # Once for each band of up to 128 rows; bands also begin at the panel and below it.
    bands = len(beats)
    assert bands == 7

    def stop() -> None:
        beats.append(1)
        if len(beats) > bands + 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        render_with(scene, SimulationSettings(), heartbeat=stop)
    assert len(beats) == bands + 3
