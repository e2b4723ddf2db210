"""A picture's signal from a sample of its rows: the same rows, the same means, noise included."""

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.effects.effect import paper_view_of
from occ_model.receiver.signal import column_means, locate
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene
from occ_model.simulation.render import render_plan
from occ_model.simulation.row_sample import BAND, BANDS, SystematicNumbers, sample_picture

NOISE_OFF = {"sensor-noise": False, "fixed-pattern": False}


def real_scene(number: int) -> Scene:
    """A real camera's picture of fewer pixels, every second one tilted."""
    random = np.random.default_rng(number)
    names = [name for name in occ.presets() if name.endswith("-real")]
    scene = occ.load_preset(names[number % len(names)])
    scene = scene.replace(
        columns=scene.camera.columns // 8,
        rows=scene.camera.rows // 2,
        readout_time=scene.camera.readout_time * 8,
        switching_frequency=float(random.uniform(0.2, 2.5)) / scene.camera.exposure_time,
        distance=float(random.uniform(0.5, 1.4)),
        enhancement=("equalization", "stretch", "none")[number % 3],
    )
    if number % 2:
        angles = dict(zip(("yaw", "pitch", "roll"), random.normal(size=3) * 0.2, strict=True))
        scene = scene.replace(**{name: float(angle) for name, angle in angles.items()})
    return scene


@pytest.mark.parametrize("number", range(amount(2, 4)))
def test_sampled_rows_are_rows_of_the_picture(number: int) -> None:
    scene = real_scene(number)
    view = paper_view_of(scene)
    plan = occ.plan(scene, 0.0, "signal", NOISE_OFF)
    assert "jpeg" in plan  # a block of the file depends on nothing beyond it
    sample = sample_picture(view, plan, 1)
    whole = render_plan(view, plan, seed=1).image
    bands = whole[: len(whole) // BAND * BAND].reshape(-1, BAND, whole.shape[1])
    sampled = sample.image.reshape(-1, BAND, whole.shape[1])
    for band in sampled:  # interpolated from other rows, a pixel may round to the next level
        assert (bands == band).mean(axis=(1, 2)).max() > 0.999
    assert len({band.tobytes() for band in sampled}) > BANDS / 2


@pytest.mark.parametrize("number", range(amount(4, 8)))
def test_the_samples_column_means_are_those_of_the_picture(number: int) -> None:
    scene = real_scene(number)
    view, plan = paper_view_of(scene), occ.plan(scene, 0.0, "signal")
    sample = sample_picture(view, plan, 1)
    whole = render_plan(view, plan, seed=1).image
    found, seen = locate(whole, 0.05), locate(sample.image, 0.05)
    a, b = seen.region, found.region
    assert a.rows * sample.rows_each == pytest.approx(b.rows, rel=0.06)
    first, last = max(a.first_column, b.first_column), min(a.last_column, b.last_column)
    assert last - first > 0.95 * max(a.columns, b.columns)
    by_sample = column_means(sample.image, Region(a.first_row, a.last_row, first, last))
    by_picture = column_means(whole, Region(b.first_row, b.last_row, first, last))
    noise = np.diff(b.crop(whole).astype(float), axis=0)[::2]
    sampling_error = np.sqrt(np.mean(noise**2) / 2.0 / b.rows)
    off = np.sqrt(np.mean((by_sample - by_picture) ** 2))
    # A tilted panel's edge lies within the bands, up to a hundredth of its height beside them.
    fraction = 0.02 if number % 2 else 0.005
    assert off <= 2.0 * sampling_error + fraction * np.ptp(by_picture)


def test_numbers_spread_over_the_bands_leave_their_mean() -> None:
    numbers = _numbers_of_bands(600)
    assert numbers.mean() == pytest.approx(0.5, abs=1e-3)
    # Drawn numbers would leave 0.29 / sqrt(BANDS * BAND) = 0.02.
    assert numbers.mean(axis=(0, 1)).std() < 1e-6
    # Within a band neither rows nor columns are alike.
    assert abs(np.corrcoef(numbers[0, 0], numbers[0, 1])[0, 1]) < 0.15
    assert abs(np.corrcoef(numbers[0, 0, :-1], numbers[0, 0, 1:])[0, 1]) < 0.15


def _numbers_of_bands(columns: int) -> np.ndarray:
    """Return the numbers of all bands, from 0 to 1: shape (bands, rows, columns)."""
    source = SystematicNumbers(columns, 3)
    places = [slice(BAND * band, BAND * (band + 1)) for band in range(BANDS)]
    return np.stack([next(source.of(range(BAND), at, BAND)) for at in places]) / 2.0**32


def test_a_small_picture_is_not_sampled() -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=300)
    view = paper_view_of(scene)
    assert sample_picture(view, occ.plan(scene, observable="signal"), 1) is None


@pytest.mark.parametrize("changes", [{"distance": 50.0}, {"offset_x": 40.0}, {"offset_y": 1.0}])
def test_a_panel_hardly_seen_is_sampled_or_not_without_fault(changes: dict[str, float]) -> None:
    scene = occ.load_preset("phone-136us-real").replace(columns=432, **changes)
    assert occ.success_rate(scene, images=2, path="rows") in np.linspace(0.0, 100.0, 21)


def test_bands_use_each_quantile_once_and_its_complement() -> None:
    bands = _numbers_of_bands(50)
    np.testing.assert_allclose(bands[0::2] + bands[1::2], 1.0, atol=1e-6)
    # From a random first one in equal steps, round and round.
    steps = np.diff(np.sort(bands[0::2], axis=0), axis=0)
    np.testing.assert_allclose(steps, 2.0 / BANDS, atol=1e-6)
