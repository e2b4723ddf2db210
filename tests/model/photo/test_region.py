"""A photo is matched within a rectangle given by hand, as if it were a photo of its own."""

from functools import cache

import numpy as np
import pytest
from simulated_photos import photo_of, random_scene, take

import occ_model as occ
from occ_model.results.decoding import Region

SCENE = random_scene(3)
KNOWN = SCENE.replace(readout_time=1e-6)


@cache
def matched() -> occ.Match:
    """Match the whole photo, to which those of regions are compared."""
    return occ.match_photo(take(SCENE), KNOWN)


def beside_a_fence() -> tuple[occ.Photo, tuple[int, int, int, int]]:
    """A photo with stripes of another period below it, and the rectangle without those."""
    lamp = take(SCENE).samples
    rows, columns = lamp.shape
    fence = np.where(np.arange(columns) // 7 % 2, 20, 230).astype(np.uint8)
    return photo_of(np.vstack([lamp, np.tile(fence, (2 * rows, 1))])), (0, rows, 0, columns)


def test_a_region_hides_what_lies_outside_it() -> None:
    photo, region = beside_a_fence()
    found = occ.match_photo(photo, KNOWN, region=region)
    alone = matched()
    assert found.readout_time == pytest.approx(alone.readout_time, rel=1e-9)
    assert found.region == alone.region


def test_a_region_counts_in_the_photos_own_rows_and_columns() -> None:
    photo = take(SCENE)
    whole = occ.find_stripes(photo).region
    part = (
        whole.first_row + 20, whole.last_row - 10, whole.first_column + 100, whole.last_column - 150
    )  # fmt: skip
    found = occ.find_stripes(photo, part)
    assert part[0] <= found.region.first_row < found.region.last_row <= part[1]
    assert part[2] <= found.region.first_column < found.region.last_column <= part[3]
    rows = slice(found.region.first_row, found.region.last_row)
    columns = slice(found.region.first_column, found.region.last_column)
    np.testing.assert_allclose(found.profile, photo.samples[rows, columns].mean(axis=0))


def test_the_start_time_is_that_of_the_photo_not_of_the_region() -> None:
    photo = take(SCENE)
    whole = matched()
    inner = whole.region
    part = (0, photo.samples.shape[0], inner.first_column + 130, inner.last_column)
    late = occ.match_photo(photo, KNOWN, region=part).start_time - whole.start_time
    period = 24.0 / SCENE.transmitter.switching_frequency
    assert abs((late + period / 2) % period - period / 2) < 0.01 * period


def test_a_region_that_is_none_is_quoted_by_its_four_numbers() -> None:
    with pytest.raises(occ.ParameterError, match=r"^region is \(5, 1, 0, 10\); allowed: first row"):
        occ.find_stripes(take(SCENE), Region(5, 1, 0, 10))
