"""When a draft comes before a picture, and the smaller copies that a picture is drawn from."""

from collections.abc import Callable

import numpy as np
import pytest

import occ_model as occ
from occ_gui.simulation import jobs
from occ_gui.simulation.preview import Picture, halved
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.scene import Scene
from occ_model.simulation.render import plan_scene


def test_a_picture_of_few_pixels_needs_no_draft(
    snapshot_of: Callable[..., Snapshot], monkeypatch: pytest.MonkeyPatch
) -> None:
    request = snapshot_of().request
    planned = plan_scene(request.scene, request.settings)
    assert not jobs.is_soon(planned), "it has an effect that differs by pixel"
    pixels = request.scene.camera.rows * request.scene.camera.columns
    monkeypatch.setattr(jobs, "SMALL", pixels)
    assert jobs.draft_of(request, planned) is None
    monkeypatch.setattr(jobs, "SMALL", pixels - 1)
    draft = jobs.draft_of(request, planned)
    assert draft is not None
    assert draft.rows_step == request.draft_step


def test_a_picture_has_copies_of_half_the_size_down_to_what_is_drawn_fast(
    small_scene: Scene,
) -> None:
    frame = occ.render(small_scene.replace(rows=521, columns=601))
    (half,) = Picture.of(frame, "camera").halves
    assert half.shape == (260, 300)
    assert Picture.of(occ.render(small_scene.replace(rows=511)), "camera").halves == ()


@pytest.mark.parametrize(("rows", "columns"), [(4, 6), (5, 7)])
def test_a_pixel_of_a_copy_is_the_mean_of_four(rows: int, columns: int) -> None:
    pixels = np.arange(rows * columns, dtype=np.uint8).reshape(rows, columns) * 5
    even = pixels[: rows // 2 * 2, : columns // 2 * 2].astype(float)
    means = even.reshape(rows // 2, 2, columns // 2, 2).mean(axis=(1, 3))
    assert np.abs(halved(pixels) - means).max() <= 0.5
