"""Groups of pixels that are lit alike are ordered by how much they tell."""

import numpy as np

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
    # The rim's rows see all columns; what they tell is still less. Of the others each dark stripe
    # has twelve, without three beside a bright one.
    assert {int(profile.kept.sum()) for profile in profiles} == {len(STRIPES), 9 * 6 + 9}
