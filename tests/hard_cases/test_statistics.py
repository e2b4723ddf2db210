"""Sums over millions of pixels and rates of millions of trials lose no digit."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import strategies as st

from hard_cases.laws import cases, record
from hard_cases.references import decades
from occ_model.camera.picture_rows import Rim, Rows
from occ_model.receiver.signal import column_means, locate
from occ_model.results.decoding import Region
from occ_model.simulation.columns import ColumnMeans
from occ_model.study.confidence import wilson_interval


def whole(image: np.ndarray) -> Region:
    return Region(0, image.shape[0], 0, image.shape[1])


@st.composite
def byte_images(draw: st.DrawFn) -> tuple[np.ndarray, Region]:
    """Draw tall, wide and small images, of all levels or only the largest, and a part of each."""
    rows, columns = draw(
        st.sampled_from([(1, 3000), (3000, 1), (70, 60), (2, 2), (1, 1), (20_000, 3)])
    )
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    image = random.integers(draw(st.sampled_from([0, 250, 255])), 256, (rows, columns), np.uint8)
    top, left = draw(st.integers(0, rows - 1)), draw(st.integers(0, columns - 1))
    bottom, right = draw(st.integers(top + 1, rows)), draw(st.integers(left + 1, columns))
    return image, Region(top, bottom, left, right)


@cases(image=byte_images())
def test_column_means_are_integer_sums_over_integers(image: tuple[np.ndarray, Region]) -> None:
    pixels, region = image
    part = pixels[region.first_row : region.last_row, region.first_column : region.last_column]
    exact = part.sum(axis=0, dtype=np.int64) / region.rows
    error = float(np.abs(column_means(pixels, region) - exact).max())
    record("column means of bytes, grey levels", "1 to 20,000 rows", error, 0.0)


SIXTEEN_MILLION: dict[str, tuple[tuple[int, int], int]] = {
    # A camera's picture, all white, with the largest sum of each column.
    "a white picture": ((4608, 3472), 255),
    # One column, whose sum 4e9 does not fit into 32 bits.
    "a single column": ((16_000_000, 1), 255),
    # Two columns with sums next to that limit, one below and one above.
    "two columns at the limit": ((8_421_505, 2), 254),
    # One row: a million sums of one.
    "a single row": ((1, 1_000_000), 0),
}  # fmt: skip


@pytest.mark.parametrize("name", SIXTEEN_MILLION)
def test_column_means_of_sixteen_million_pixels_lose_nothing(name: str) -> None:
    shape, least = SIXTEEN_MILLION[name]
    some = np.random.default_rng(1).integers(least, 256, 999_983, dtype=np.uint8)
    image = np.resize(some, shape)
    exact = image.sum(axis=0, dtype=np.int64) / shape[0]
    error = float(np.abs(column_means(image, whole(image)) - exact).max())
    record("column means of 16 MP, grey levels", "1 to 16e6 rows", error, 0.0)


def test_half_of_thirty_million_pixels_is_counted_to_the_pixel() -> None:
    # OpenCV counts in single precision, in which 2^24 + 1 is 2^24, one short of the half.
    half = 2**24 + 1
    image = np.zeros(2 * half, dtype=np.uint8)
    image[:half] = 200
    image[half : half + 5] = 190
    found = locate(image.reshape(-1, 673), 0.5)
    assert found.bright_level == 200


@st.composite
def panels_of_rows(draw: st.DrawFn) -> list[tuple[np.ndarray, np.ndarray | slice]]:
    """Draw pixel values block by block, with the panel's place in each."""
    columns = draw(st.integers(1, 40))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    size = draw(decades(1e-30, 1e30))
    blocks: list[tuple[np.ndarray, np.ndarray | slice]] = []
    for _ in range(draw(st.integers(1, 12))):
        shape = (draw(st.integers(1, 64)), columns)
        # Values of all sizes; a sum in single precision would lose the small ones.
        values = (size * 10.0 ** random.uniform(-6, 0, shape)).astype(np.float32)
        ends = sorted(draw(st.tuples(st.integers(0, columns), st.integers(0, columns))))
        mask = random.random(shape) < draw(st.floats(0, 1))
        places: list[np.ndarray | slice] = [slice(*ends), mask]
        blocks.append((values, draw(st.sampled_from(places))))
    return blocks


def rows_with(panel: np.ndarray | slice, values: np.ndarray) -> Rows:
    """Make rows that show the panel at a place."""
    if isinstance(panel, slice):
        inside = (panel,) if panel.stop > panel.start else ()
        return Rows(range(len(values)), values, None, (), inside)
    rim = Rim(slice(0, values.shape[1]), values, panel)
    return Rows(range(len(values)), values, None, (rim,), ())


@cases(blocks=panels_of_rows())
def test_profile_means_are_those_of_exact_sums(
    blocks: list[tuple[np.ndarray, np.ndarray | slice]],
) -> None:
    columns = blocks[0][0].shape[1]
    tally = ColumnMeans(columns)
    seen: list[list[float]] = [[] for _ in range(columns)]
    for values, panel in blocks:
        tally.add(rows_with(panel, values).panel, values)
        mask = np.zeros(values.shape, dtype=bool)
        mask[(slice(None), panel) if isinstance(panel, slice) else panel] = True
        for column, kept in enumerate(seen):
            kept.extend(values[mask[:, column], column].tolist())
    means = tally.means(np.full(columns, -1.0))
    worst = 0.0
    for kept, mean in zip(seen, means.tolist(), strict=True):
        exact = math.fsum(kept) / len(kept) if kept else -1.0
        worst = max(worst, abs(mean / exact - 1.0))
    record("means of the panel's pixels, relative", "values 1e-36 to 1e30", worst, 1e-13)


@st.composite
def counts(draw: st.DrawFn) -> tuple[int, int]:
    trials = draw(decades(1, 2**53).map(int))
    few = st.integers(0, min(trials, 9))
    return draw(few | few.map(lambda lost: trials - lost) | st.integers(0, trials)), trials


@cases(count=counts(), tail=decades(1e-15, 0.9))
def test_wilsons_interval_is_that_of_fifty_digits(count: tuple[int, int], tail: float) -> None:
    successes, trials = count
    level = 1.0 - tail
    low, high = wilson_interval(successes, trials, level)
    with mpmath.workdps(50):
        z = mpmath.sqrt(2) * mpmath.erfinv(mpmath.mpf(level))
        s, n = mpmath.mpf(successes), mpmath.mpf(trials)
        root = z * mpmath.sqrt(z**2 + 4 * s * (n - s) / n)
        ends = ((2 * s + z**2 + sign * root) / (2 * (n + z**2)) for sign in (-1, 1))
        exact = [float(end) for end in ends]
    errors = [
        abs(found - end) / end if end > 1e-40 else found
        for found, end in zip((low, high), exact, strict=True)
    ]
    ranges = "1 to 9e15 trials, tails 1e-15 to 0.9"
    record("Wilson's interval, relative", ranges, max(errors), 1e-11)
    assert (low == 0.0) == (successes == 0)
    assert high == 1.0 or successes < trials
