"""The rectangle that is drawn from probabilities is the one that is found among the pixels."""

import numpy as np
import pytest
from numpy.typing import NDArray

import occ_model as occ
from occ_model.receiver.signal import locate
from occ_model.results.decoding import Region
from occ_model.study.drawn_region import BrightShares

ROWS, COLUMNS = 400, 1100
SPAN = Region(60, 320, 303, 800)
TRIALS = 40


def of_pixels(panel: float, around: float, random: np.random.Generator) -> Region:
    """Draw pixels of two levels, bright with these probabilities, and locate the panel in them."""
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
def test_the_drawn_rectangle_is_the_one_found_among_pixels(panel: float, around: float) -> None:
    shares = BrightShares(ROWS, SPAN, np.full(COLUMNS, panel), np.full(COLUMNS, around))
    drawn, found = (
        np.array([edges(make(np.random.default_rng([start, trial]))) for trial in range(TRIALS)])
        for start, make in (
            (1, shares.draw_region),
            (2, lambda random: of_pixels(panel, around, random)),
        )
    )
    error = np.sqrt((drawn.var(axis=0) + found.var(axis=0)) / TRIALS)
    # A cell, of 3 pixels, holds more bright pixels at its end than chance alone puts there.
    assert np.all(np.abs(drawn.mean(axis=0) - found.mean(axis=0)) <= 4.0 * error + 1.5)


def test_a_dark_noisy_picture_is_read_by_a_study_as_by_its_pictures() -> None:
    # Its brightest 5 % of pixels lie everywhere, and so does the region.
    scene = occ.load_preset("phone-136us").replace(
        line_code="manchester", framing="preamble", payload="hex:5a5a5a5a5a5a5a5a",
        switching_frequency=15e3, enhancement="none", distance=1.0, rows=400, luminance=150.0,
        illuminance=290.0,
    )  # fmt: skip
    study, pictures = (
        occ.bit_error_rate(scene, "sequence", bits=4 * 64, path=path) for path in ("auto", "image")
    )
    assert study.pictures_right == pictures.pictures_right == 0
