"""Pixels that are lit alike are fitted together, and may contradict the exposure."""

import math

import numpy as np
import pytest
from photo_world.photograph import random_world
from photo_world.trials import trial

from occ_model.photo.stripes.evenly_lit import Cells

ROWS_A_BAND = 4.0
STRIPES = np.tile(np.repeat([0.1, 1.0], 12), 10).astype(np.float32)


def cells_of(brightness: np.ndarray) -> Cells:
    """Return bands of rows that see the same stripes, each as bright as is said; 255 is white."""
    means = np.minimum(brightness[:, None] * STRIPES, 255.0).astype(np.float32)
    return Cells(means, (means >= 255.0).astype(np.float32), ROWS_A_BAND)


def test_many_rows_are_fitted_before_few_whose_noise_is_not_averaged_out() -> None:
    """A lamp of which most rows are partly white, with a rim that fades within five bands."""
    rim = np.array([60.0, 100.0, 150.0, 190.0, 220.0])
    lamp = np.linspace(300.0, 500.0, 59)
    profiles = cells_of(np.concatenate([rim, lamp])).profiles(24)
    assert sum(profile.rows >= 25 * ROWS_A_BAND for profile in profiles) == 2
    # The rim's rows see all columns; what they tell is still less.
    assert max(profile.kept.sum() for profile in profiles) == len(STRIPES)


@pytest.mark.whole
@pytest.mark.parametrize(("seed", "holds_both"), [(121020, True), (130011, False)])
def test_an_exposure_that_looks_like_a_box_of_blur_is_within_its_stated_error(
    seed: int, holds_both: bool
) -> None:
    """Exposed for a column behind a box of three or five: exchanged, they make the same edges.

    Of the second one the fit by the exchanged ones is worse, and only the right one is stated.
    """
    world = random_world(seed)
    found = trial(world)
    assert not found.failure
    assert abs(found.exposure) < 2.0 * found.exposure_deviation
    columns, box = world.exposure_time / world.readout_time, math.sqrt(12.0) * world.blur
    off_box = found.exposure - (box / columns - 1.0)
    assert (abs(off_box) < 2.0 * found.exposure_deviation) == holds_both
    # An edge's variance is that of the exposure, t^2/12, and the blur's, known to 2 % at best.
    assert found.exposure_deviation > 6.0 * 0.02 * world.blur**2 / columns**2


def test_what_pixels_that_are_lit_alike_contradict_is_the_exposure_alone() -> None:
    """Twice as long as the right one, at the right readout time."""
    found = trial(random_world(93017))
    assert found.is_sure
    assert abs(found.readout) < 2.0 * found.readout_deviation
    assert any("lit equally give another exposure" in why for why in found.exposure_doubts)
    assert not found.is_sure_of("exposure")
