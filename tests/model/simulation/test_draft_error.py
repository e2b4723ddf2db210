"""The error stated of a draft of nothing but noise: its standard deviation with its margin."""

import math

import numpy as np
import pytest

from occ_model.simulation.draft_error import DraftedMeans, DraftedPanel, draft_errors

ROWS, STEP = 64, 4


@pytest.mark.parametrize("columns", [32, 128, 2048])
def test_of_independent_noise_it_is_that_of_the_means_with_a_margin_of_five_deviations(
    columns: int,
) -> None:
    random = np.random.default_rng(columns)
    stated = []
    for _ in range(40):
        image = np.rint(random.normal(120.0, 12.0, (ROWS, columns))).astype(np.uint8)
        high = ROWS * STEP
        outline = np.array([[0.0, 0.0], [columns, 0.0], [columns, high], [0.0, high]]) - 0.5
        panel = DraftedPanel(
            range(0, high, STEP), slice(0, columns), outline, (high, columns), 0.0, 0.0, 0.0
        )
        means = DraftedMeans(image, image.mean(axis=0), np.array([120.0]), 1.0)
        stated.append(draft_errors(panel, {"profile": means})["profile"])
    # The whole picture's mean has noise of its own, of as many more rows.
    deviation = 12.0 / math.sqrt(ROWS) * math.sqrt(1.0 + 1.0 / STEP)
    # Eight neighbouring columns count as one independent estimate of a variance.
    margin = 1.0 + 5.0 / math.sqrt(2.0 * columns / 8)
    assert np.mean(stated) == pytest.approx(deviation * margin, rel=0.06)


@pytest.mark.parametrize("rounding", [0.02, 0.1, 0.5])
def test_the_rounding_of_a_file_counts_by_its_deviation_a_block(rounding: float) -> None:
    columns, high = 80, ROWS * STEP
    image = np.full((ROWS, columns), 120, dtype=np.uint8)
    outline = np.array([[0.0, 0.0], [columns, 0.0], [columns, high], [0.0, high]]) - 0.5
    means = DraftedMeans(image, image.mean(axis=0), np.array([120.0]), 1.0)

    def stated(of_a_block: float) -> float:
        panel = DraftedPanel(
            range(0, high, STEP), slice(0, columns), outline, (high, columns), 0.0, of_a_block, 0.0
        )
        return draft_errors(panel, {"profile": means})["profile"]

    assert stated(0.0) == 0.0
    # Of as many blocks as the draft has, twice the deviation is twice the error.
    assert stated(2.0 * rounding) == pytest.approx(2.0 * stated(rounding))
    assert stated(rounding) >= rounding / math.sqrt(ROWS / 8)
