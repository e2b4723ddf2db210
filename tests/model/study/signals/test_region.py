"""The rectangles that are drawn have the distribution of those found in pixels."""

import numpy as np
import pytest
from amount import amount
from numpy.typing import NDArray

from occ_model.receiver.signal import locate
from occ_model.results.decoding import Region
from occ_model.study.signals.region import BrightPixels, chance_of_more_than

ROWS, COLUMNS = 400, 1100
SPAN = Region(60, 320, 303, 800)
TRIALS = amount(8, 25)


def locate_in_pixels(panel: float, around: float, random: np.random.Generator) -> Region:
    """Draw random pixels of two levels with these probabilities, and locate the panel in them."""
    image = (random.random((ROWS, COLUMNS)) < around).astype(np.uint8)
    seen = image[SPAN.first_row : SPAN.last_row, SPAN.first_column : SPAN.last_column]
    seen[:] = random.random(seen.shape) < panel
    found = locate(image, bright_fraction=0.05)
    return found.region


def edges(region: Region) -> NDArray[np.float64]:
    return np.array(
        [region.first_row, region.last_row, region.first_column, region.last_column], float
    )


@pytest.mark.parametrize(
    ("panel", "around"),
    [(1.0, 0.0), (0.5, 1e-4), (0.3, 0.003), (0.3, 0.01), (0.02, 0.02), (0.05, 0.0), (1e-3, 1e-6)],
)
def test_the_drawn_rectangle_has_the_distribution_of_the_one_found_in_pixels(
    panel: float, around: float
) -> None:
    beside = np.full((TRIALS, COLUMNS), around, dtype=np.float32)
    inside = beside[:, None].copy()
    inside[:, :, SPAN.first_column : SPAN.last_column] = panel
    first, second = (
        [np.random.default_rng([start, trial]) for trial in range(TRIALS)] for start in (1, 2)
    )
    regions = BrightPixels((ROWS, COLUMNS), SPAN, inside, beside).draw_regions(first)
    drawn = np.array([edges(region) for region in regions])
    found = np.array([edges(locate_in_pixels(panel, around, random)) for random in second])
    error = np.sqrt((drawn.var(axis=0) + found.var(axis=0)) / TRIALS)
    # A cell of 3 pixels has more bright pixels at its end than chance alone would give.
    assert np.all(np.abs(drawn.mean(axis=0) - found.mean(axis=0)) <= 4.0 * error + 1.5)


@pytest.mark.parametrize("pixels", [1, 9, 400, 170_000])
def test_bright_pixels_in_a_cell_of_any_size_follow_the_binomial_law(pixels: int) -> None:
    fraction = np.array([0.0, 0.1, 0.3, 1.0])
    found = chance_of_more_than(0.2, fraction, pixels)
    drawn = np.random.default_rng(1).binomial(pixels, fraction, (20_000, 4)) > 0.2 * pixels
    assert found == pytest.approx(drawn.mean(axis=0), abs=0.015)
