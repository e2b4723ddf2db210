"""Contrast enhancement of a profile, and rounding."""

import cv2
import numpy as np
import pytest
from amount import amount
from hypothesis import given, settings, strategies as st
from hypothesis.extra import numpy as arrays

from occ_model.camera.enhancement import Enhancement, enhance, equalizing_curve, to_bytes

METHODS = ("equalization", "stretch", "none")

profiles = arrays.arrays(np.float64, st.integers(1, 60), elements=st.floats(0.0, 255.0))
wide = profiles.filter(lambda profile: np.ptp(profile) >= 1.0)
methods = st.sampled_from(METHODS)


@given(profile=profiles)
def test_none_rounds_to_the_nearest_level(profile: np.ndarray) -> None:
    assert np.abs(enhance(profile, "none") - profile).max() <= 0.5


@given(profile=wide)
def test_stretch_maps_the_smallest_to_0_and_the_largest_to_255(profile: np.ndarray) -> None:
    enhanced = enhance(profile, "stretch")
    rounded = np.rint(profile)
    low, high = rounded.min(), rounded.max()
    if low == high:  # one level after rounding: nothing to stretch
        return
    assert (enhanced[rounded == low] == 0).all()
    assert (enhanced[rounded == high] == 255).all()
    line = (rounded - low) / (high - low) * 255
    assert np.abs(enhanced - line).max() <= 0.5 + 1e-9


@given(profile=wide)
def test_equalization_maps_each_level_to_its_fraction_of_columns(profile: np.ndarray) -> None:
    rounded = np.rint(profile)
    at_most = np.array([(rounded <= value).sum() for value in rounded])
    darkest = at_most.min()
    if darkest == len(profile):  # one level after rounding: nothing to spread
        return
    fraction = (at_most - darkest) / (len(profile) - darkest)
    enhanced = enhance(profile, "equalization")
    assert np.abs(enhanced - 255 * fraction).max() <= 0.5 + 1e-4
    assert (enhanced.min(), enhanced.max()) == (0, 255)


@given(profile=profiles, method=methods)
def test_a_receiver_has_only_the_cameras_bytes(profile: np.ndarray, method: str) -> None:
    if 0.0 < np.ptp(profile) < 1e-9:  # truly one level, whichever way each value was rounded
        return
    curve = Enhancement(profile, method)
    taken = np.rint(profile).astype(np.uint8)
    np.testing.assert_array_equal(curve(profile), curve.enhance_bytes(taken[None, :])[0])


@given(profile=profiles, others=profiles, method=methods)
def test_an_images_enhancement_keeps_the_profiles_order(
    profile: np.ndarray, others: np.ndarray, method: str
) -> None:
    curve = Enhancement(profile, method)
    np.testing.assert_array_equal(curve(profile), enhance(profile, method))
    both = np.concatenate([profile, others])
    assert (np.diff(curve(both)[np.argsort(both)].astype(int)) >= 0).all()
    np.testing.assert_array_equal(curve(both[None, :]), curve(both)[None, :])


@pytest.mark.parametrize(
    ("values", "levels"),
    [
        ([-1e9, -0.6, -0.4, 0.4, 0.6], [0, 0, 0, 0, 1]),
        ([254.4, 254.6, 255.4, 256.0, 1e9], [254, 255, 255, 255, 255]),
        ([0.5, 1.5, 2.5, 127.5], [0, 2, 2, 128]),
    ],
)
def test_rounding_stays_within_the_range_of_a_byte(values: list[float], levels: list[int]) -> None:
    assert to_bytes(np.array(values)).tolist() == levels


@pytest.mark.parametrize("lowest", [126.5, 127.5])
def test_values_that_differ_by_rounding_errors_become_one_level(lowest: float) -> None:
    values = np.array([lowest, lowest + 3e-10, lowest + 6e-10])
    assert len(set(enhance(values, "none").tolist())) == 1


@settings(max_examples=amount(30, 100))
@given(st.lists(st.integers(0, 40), min_size=2, max_size=256), st.integers(0, 255))
def test_a_histogram_is_equalized_as_the_library_does(counts: list[int], start: int) -> None:
    histogram = np.roll(np.pad(np.array(counts), (0, 256 - len(counts))), start)
    levels = np.flatnonzero(histogram)
    if len(levels) < 2:
        return
    image = np.repeat(np.arange(256), histogram).astype(np.uint8)[None, :]
    curve = equalizing_curve(histogram.astype(np.float64))
    np.testing.assert_array_equal(curve[image], cv2.equalizeHist(image))
    assert (np.diff(curve.astype(int)) >= 0).all()


def test_a_level_of_which_hardly_a_pixel_is_expected_does_not_become_black() -> None:
    counts = np.zeros(256)
    counts[[3, 5, 9]] = 1e-3, 400.0, 600.0
    assert equalizing_curve(counts)[[5, 9]].tolist() == [0, 255]


def test_levels_of_few_pixels_are_equalized_as_those_of_many() -> None:
    counts = np.zeros(256)
    counts[40:60] = 0.1
    np.testing.assert_array_equal(equalizing_curve(counts), equalizing_curve(1e3 * counts))
