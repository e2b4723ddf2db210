"""The rows of a draft depend on the screen, and on the time that drafts take."""

import numpy as np
import pytest
from gui.kinds import SnapshotOf

from occ_gui.simulation import jobs
from occ_gui.simulation.jobs import LEAST_ROWS, LONGEST_DRAFT, MOST_THINNING, DraftRows
from occ_gui.simulation.snapshot import halve
from occ_gui.values.simulated import LEAST_DRAFT_STEP
from occ_model.simulation.render import plan_scene

ROWS = 4608


def step_after(*seconds: float, rows: int = ROWS, rows_per_pixel: float = 11.3) -> int:
    draft_rows = DraftRows()
    for each in seconds:
        draft_rows.record_time(each)
    return draft_rows.choose_step(rows, rows_per_pixel)


@pytest.mark.parametrize(
    ("ratio", "step"), [(11.9, 11), (0.5, LEAST_DRAFT_STEP), (4.0, 4), (1e9, ROWS)]
)
def test_a_draft_in_time_has_the_rows_that_the_screen_shows(ratio: float, step: int) -> None:
    assert step_after(rows_per_pixel=ratio) == step
    assert step_after(*9 * [0.9 * LONGEST_DRAFT], rows_per_pixel=ratio) == step


def test_late_drafts_halve_the_rows_of_the_next() -> None:
    late = 1.1 * LONGEST_DRAFT
    assert step_after(late, late) == 22
    assert step_after(*4 * [late]) == 11 * MOST_THINNING
    assert step_after(*99 * [late]) == 11 * MOST_THINNING


def test_a_single_late_draft_changes_nothing() -> None:
    late, in_time = 9.0 * LONGEST_DRAFT, 0.9 * LONGEST_DRAFT
    assert step_after(*9 * [late, in_time]) == 11


def test_drafts_that_are_very_fast_get_their_rows_back() -> None:
    late, fast = 1.1 * LONGEST_DRAFT, 0.3 * LONGEST_DRAFT
    assert step_after(*4 * [late], *2 * [fast]) == 22
    assert step_after(*4 * [late], *4 * [fast]) == 11


@pytest.mark.parametrize("fraction_of_rows", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("whole", [0.5, 0.99, 1.01, 1.9, 2.1, 3.9, 4.1, 50.0])
def test_the_number_of_rows_converges(whole: float, fraction_of_rows: float) -> None:
    """Check this for any fraction of a draft's time that is proportional to its rows."""
    draft_rows, steps = DraftRows(), []
    for _ in range(30):
        steps.append(draft_rows.choose_step(ROWS, 11.0))
        thinning = steps[-1] / 11
        fraction = 1.0 - fraction_of_rows + fraction_of_rows / thinning
        draft_rows.record_time(whole * LONGEST_DRAFT * fraction)
    assert len(set(steps[10:])) == 1


def test_no_draft_is_thinned_below_the_fewest_rows() -> None:
    late = 4 * [9.0 * LONGEST_DRAFT]
    assert step_after(*late, rows=LEAST_ROWS * 15) == 15
    assert step_after(*late, rows=LEAST_ROWS * 2) == 11


def test_a_picture_of_few_pixels_needs_no_draft(
    snapshot_of: SnapshotOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    request = snapshot_of().request
    planned = plan_scene(request.scene, request.settings)
    assert not jobs.is_fast(planned), "it has an effect that differs by pixel"
    pixels = request.scene.camera.rows * request.scene.camera.columns
    monkeypatch.setattr(jobs, "SMALL_PICTURE", pixels)
    assert jobs.draft_of(request, planned) is None
    monkeypatch.setattr(jobs, "SMALL_PICTURE", pixels - 1)
    draft = jobs.draft_of(request, planned)
    assert draft.rows_step == request.draft_step


@pytest.mark.parametrize(("rows", "columns"), [(4, 6), (5, 7)])
def test_a_pixel_of_a_copy_is_the_mean_of_four(rows: int, columns: int) -> None:
    pixels = np.arange(rows * columns, dtype=np.uint8).reshape(rows, columns) * 5
    even = pixels[: rows // 2 * 2, : columns // 2 * 2].astype(float)
    means = even.reshape(rows // 2, 2, columns // 2, 2).mean(axis=(1, 3))
    assert np.abs(halve(pixels) - means).max() <= 0.5
