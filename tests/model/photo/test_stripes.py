"""Stripes are found where the panel is, or within a rectangle; a photo without any is refused."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from amount import amount
from hypothesis import given, settings, strategies as st
from simulated_photos import photo_of, random_scene, take

import occ_model as occ
from occ_model.camera.projection import panel_corners
from occ_model.errors import ParameterError
from occ_model.photo.stripes.find import lamp_profile
from occ_model.photo.stripes.period import autocorrelation, repeat_period, unrepeated_fraction
from occ_model.results.decoding import Region
from occ_model.results.match import Stripes


@cache
def found_in(seed: int) -> Stripes:
    return occ.find_stripes(take(random_scene(seed), seed))


@pytest.mark.parametrize("seed", range(5))
def test_the_region_is_the_panels(seed: int) -> None:
    scene = random_scene(seed)
    corners = panel_corners(scene)
    columns, rows = scene.camera.columns, scene.camera.rows
    region = found_in(seed).region
    # JPEG rings for a block beyond the rim; a dark chip at the rim is as dark as what is beside it.
    chip = 1.0 / (scene.camera.readout_time * scene.transmitter.switching_frequency)
    assert region.first_column == pytest.approx(max(corners[:, 0].min(), 0), abs=16 + 5 * chip)
    assert region.last_column == pytest.approx(min(corners[:, 0].max(), columns), abs=16 + 5 * chip)
    assert region.first_row == pytest.approx(max(corners[:, 1].min(), 0), abs=16)
    assert region.last_row == pytest.approx(min(corners[:, 1].max(), rows), abs=16)


def test_the_period_is_that_of_the_packet_within_its_uncertainty() -> None:
    off = []
    photos = amount(5, 25)
    for seed in range(photos):
        scene = random_scene(seed)
        stripes = found_in(seed)
        packet = 24.0 / (scene.camera.readout_time * scene.transmitter.switching_frequency)
        if stripes.period is not None:
            assert stripes.period == pytest.approx(packet, rel=0.02)
            off.append(abs(stripes.period - packet) / stripes.period_uncertainty)
        else:
            assert len(stripes.profile) < 2.0 * packet
    assert len(off) > photos // 2
    assert np.mean(np.array(off) < 3.0) > 0.85


def _lamp(columns_a_chip: float, covered: np.ndarray) -> occ.Photo:
    """A lamp of alternating chips on a dark background; ``covered`` are its columns and rows."""
    columns = np.arange(covered.shape[1])
    light = np.where((columns // columns_a_chip) % 2 == 0, 200.0, 60.0)
    noise = np.random.default_rng(5).normal(10.0, 1.0, covered.shape)
    return photo_of(np.clip(noise + covered * light, 0, 255).astype(np.uint8))


def test_stripes_as_narrow_as_edges_are_found() -> None:
    covered = np.zeros((90, 700))
    covered[10:80, 50:650] = 1.0
    region = occ.find_stripes(_lamp(2.0, covered)).region
    assert region.first_column == pytest.approx(50, abs=6)
    assert region.last_column == pytest.approx(650, abs=6)


@pytest.mark.parametrize("type_", [">u2", "f4", ">f8"])
def test_a_photo_of_an_array_has_the_stripes_of_its_bytes(type_: str) -> None:
    photo = _lamp(12.0, np.ones((60, 400)))
    scale = 257.0 if type_ == ">u2" else 1.0 / 255.0
    other = replace(photo, samples=(photo.samples * scale).astype(type_), white=65535)
    assert (other.samples.dtype, other.white) == (np.uint16, 65535)
    found, expected = occ.find_stripes(other), occ.find_stripes(photo)
    assert found.region == expected.region
    np.testing.assert_allclose(found.profile, expected.profile, atol=1e-9)


def test_the_faint_outer_stripes_of_a_round_lamp_belong_to_it() -> None:
    rows, columns = np.mgrid[:200, :1400]
    off = np.hypot((rows - 100) / 90, (columns - 700) / 600)
    glow = np.clip(1.0 - off, 0.0, 1.0)  # fades from its middle to its rim
    region = occ.find_stripes(_lamp(12.0, glow)).region
    # Edges of a third of the steepest one's slope are found up to 0.7 of the way to the rim.
    assert region.first_column < 700 - 0.8 * 600
    assert region.last_column > 700 + 0.8 * 600
    assert region.first_column > 700 - 600 - 24
    assert region.last_column < 700 + 600 + 24


@settings(max_examples=15)
@given(period=st.floats(6.0, 120.0), phase=st.floats(0.0, 1.0), seed=st.integers(0, 999))
def test_a_noisy_waves_period_is_found(period: float, phase: float, seed: int) -> None:
    columns = np.arange(900)
    noise = 0.05 * np.random.default_rng(seed).standard_normal(900)
    found = repeat_period(0.5 + 0.5 * np.sin(2 * np.pi * (columns / period + phase)) + noise)
    assert found[0] == pytest.approx(period, rel=2e-3)
    assert abs(found[0] - period) < 6.0 * found[1]


def test_noise_has_no_period() -> None:
    noise = np.random.default_rng(1).standard_normal(2000)
    assert repeat_period(noise) is None


@given(st.lists(st.floats(0.0, 255.0), min_size=2, max_size=50))
def test_likeness_with_itself_is_at_most_one_and_one_at_no_lag(values: list[float]) -> None:
    alike = autocorrelation(np.array(values))
    assert np.all(np.abs(alike) <= 1.0 + 1e-6)
    if np.ptp(values) > 1e-3:
        assert alike[0] == pytest.approx(1.0)


def test_deep_pictures_give_the_same_stripes_as_shallow_ones() -> None:
    shallow = take(random_scene(3), 3)
    deep = replace(shallow, samples=shallow.samples.astype(np.uint16) * 257, white=65535)
    one, other = occ.find_stripes(shallow), occ.find_stripes(deep)
    assert one.region == other.region
    assert np.allclose(one.profile, other.profile, atol=1e-6)


def test_the_fraction_of_white_pixels_is_shown() -> None:
    image = np.tile(np.repeat([20, 255, 20, 255, 255], 12).astype(np.uint8), (50, 8))
    assert occ.find_stripes(photo_of(image)).saturated == pytest.approx(0.6, abs=0.05)


def test_lone_edges_to_either_side_are_no_part_of_the_stripes() -> None:
    covered = np.zeros((90, 900))
    covered[10:80, 300:600] = 1.0
    samples = np.array(_lamp(8.0, covered).samples)
    alone = find_stripes_of(samples)
    for place in (60, 840):
        spotted = samples.copy()
        spotted[:, place : place + 2] = 200
        assert find_stripes_of(spotted) == alone


def find_stripes_of(samples: np.ndarray) -> tuple[int, int]:
    region = occ.find_stripes(photo_of(samples)).region
    return region.first_column, region.last_column


@pytest.mark.parametrize("beyond", [(1, 0), (0, 1), (0, 0)])
def test_a_lamp_may_reach_the_rim_of_its_photo_and_no_farther(beyond: tuple[int, int]) -> None:
    photo = photo_of(np.arange(60, dtype=np.uint8).reshape(6, 10))
    rows, columns = 6 + beyond[0], 10 + beyond[1]
    lamp = occ.Lamp(Region(0, rows, 0, columns), np.array([[0, 6, 0, 10]]), 60.0, True)
    if any(beyond):
        with pytest.raises(ParameterError, match="which has 6 rows and 10 columns"):
            lamp_profile(photo, lamp)
    else:
        np.testing.assert_allclose(lamp_profile(photo, lamp), 25.0 + np.arange(10.0))


@pytest.mark.parametrize("seed", [92, 102, 111, 337])
def test_no_period_nearby_explains_more_than_the_one_found(seed: int) -> None:
    # Waves whose fit, gone on with, moves away from the best period again.
    random = np.random.default_rng(seed)
    count, chips = random.integers(80, 400), random.integers(6, 30)
    levels, width = random.integers(0, 2, chips).astype(np.float64), random.uniform(2, 8)
    wave = levels[(np.arange(count) / width).astype(int) % chips]
    wave = wave + random.normal(0.0, random.uniform(0.01, 0.6), count)
    found = repeat_period(wave)
    period, uncertainty = found
    fraction = unrepeated_fraction(wave, period)
    for off in (-1.0, -0.3, -0.2, 0.2, 0.3, 1.0):
        assert fraction <= unrepeated_fraction(wave, period + off * uncertainty)


SCENE = random_scene(3)


def beside_a_fence() -> tuple[occ.Photo, tuple[int, int, int, int]]:
    """A photo with stripes of another period below it, and the rectangle without those."""
    lamp = take(SCENE).samples
    rows, columns = lamp.shape
    fence = np.where(np.arange(columns) // 7 % 2, 20, 230).astype(np.uint8)
    return photo_of(np.vstack([lamp, np.tile(fence, (2 * rows, 1))])), (0, rows, 0, columns)


def test_a_region_hides_what_lies_outside_it() -> None:
    photo, region = beside_a_fence()
    found, alone = occ.find_stripes(photo, region), occ.find_stripes(take(SCENE))
    assert found.region == alone.region
    np.testing.assert_array_equal(found.profile, alone.profile)


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
