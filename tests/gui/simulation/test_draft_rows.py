"""Rows of a draft follow the screen, and the time that drafts take."""

import numpy as np
import pytest
from gui.kinds import SnapshotOf, not_none

import occ_model as occ
from occ_gui.simulation import jobs
from occ_gui.simulation.jobs import LEAST_ROWS, LONGEST_DRAFT, THINNEST_ROW, DraftRows
from occ_gui.simulation.snapshot import Picture, halved
from occ_gui.values.simulated import LEAST_DRAFT_STEP
from occ_model.scene.scene import Scene
from occ_model.simulation.render import plan_scene

ROWS = 4608


def step_after(*seconds: float, rows: int = ROWS, shown: float = 11.3) -> int:
    chosen = DraftRows()
    for each in seconds:
        chosen.record_time(each)
    return chosen.step(rows, shown)


@pytest.mark.parametrize(
    ("shown", "step"), [(11.9, 11), (0.5, LEAST_DRAFT_STEP), (4.0, 4), (1e9, ROWS)]
)
def test_a_draft_in_time_has_the_rows_that_the_screen_shows(shown: float, step: int) -> None:
    assert step_after(shown=shown) == step
    assert step_after(*9 * [0.9 * LONGEST_DRAFT], shown=shown) == step


def test_of_late_drafts_the_next_has_half_of_the_rows() -> None:
    late = 1.1 * LONGEST_DRAFT
    assert step_after(late, late) == 22
    assert step_after(*4 * [late]) == 11 * THINNEST_ROW
    assert step_after(*99 * [late]) == 11 * THINNEST_ROW


def test_a_single_late_draft_changes_nothing() -> None:
    late, in_time = 9.0 * LONGEST_DRAFT, 0.9 * LONGEST_DRAFT
    assert step_after(*9 * [late, in_time]) == 11


def test_a_draft_that_is_ample_in_time_gets_its_rows_back() -> None:
    late, soon = 1.1 * LONGEST_DRAFT, 0.3 * LONGEST_DRAFT
    assert step_after(*4 * [late], *2 * [soon]) == 22
    assert step_after(*4 * [late], *4 * [soon]) == 11


@pytest.mark.parametrize("fraction_of_rows", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("whole", [0.5, 0.99, 1.01, 1.9, 2.1, 3.9, 4.1, 50.0])
def test_the_rows_settle(whole: float, fraction_of_rows: float) -> None:
    """Whatever part of a draft's time goes with its rows, their number soon stays the same."""
    chosen, steps = DraftRows(), []
    for _ in range(30):
        steps.append(chosen.step(ROWS, 11.0))
        thinned = steps[-1] / 11
        fraction = 1.0 - fraction_of_rows + fraction_of_rows / thinned
        chosen.record_time(whole * LONGEST_DRAFT * fraction)
    assert len(set(steps[10:])) == 1


def test_no_draft_is_thinned_below_what_shows_a_picture() -> None:
    late = 4 * [9.0 * LONGEST_DRAFT]
    assert step_after(*late, rows=LEAST_ROWS * 15) == 15
    assert step_after(*late, rows=LEAST_ROWS * 2) == 11


def test_a_picture_of_few_pixels_needs_no_draft(
    snapshot_of: SnapshotOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    request = snapshot_of().request
    planned = plan_scene(request.scene, request.settings)
    assert not jobs.is_soon(planned), "it has an effect that differs by pixel"
    pixels = request.scene.camera.rows * request.scene.camera.columns
    monkeypatch.setattr(jobs, "SMALL_PICTURE", pixels)
    assert jobs.draft_of(request, planned) is None
    monkeypatch.setattr(jobs, "SMALL_PICTURE", pixels - 1)
    draft = not_none(jobs.draft_of(request, planned))
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
