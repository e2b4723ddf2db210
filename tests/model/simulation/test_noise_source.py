"""Where the noise's numbers come from, and that they stay each effect's own."""

import math
from itertools import pairwise

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.sensor_effects import FixedPattern, SensorNoise
from occ_model.scene.scene import Scene
from occ_model.simulation.noise import ExactNoise, Noise, NoiseSpread, ReusedNoise, stream
from occ_model.simulation.render import observe

ROWS, COLUMNS = 200, 300
ON = {"sensor-noise": True, "fixed-pattern": True}
OFF = {"sensor-noise": False, "fixed-pattern": False}
SHOT: tuple[NoiseEffect, ...] = (SensorNoise(),)


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A panel that blinks, its middle half bright enough not to reach black."""
    return Scene().replace(rows=ROWS, columns=COLUMNS, distance=0.6, illuminance=3000.0)


def values_of(scene: Scene, force: dict[str, bool], source: str = "exact") -> np.ndarray:
    """The panel's pixel values before rounding, shape (rows, columns)."""
    return observe(scene, occ.plan(scene, math.inf, force=force), seed=5, noise=source)  # type: ignore[arg-type]


def reused(scene: Scene, seed: int, rows: int, level: float = 80.0) -> np.ndarray:
    """Deviations over an even grey, shape (rows, columns)."""
    noise: Noise = ReusedNoise(SHOT, scene, seed)
    values = np.full((1, scene.camera.columns), level, dtype=np.float32)
    parts = [drawn(noise, end - start) for start, end in blocks(rows)]
    return np.concatenate(parts).astype(float) * NoiseSpread(SHOT, scene)(values)


def drawn(noise: Noise, rows: int) -> np.ndarray:
    """The next rows of a source with one effect."""
    ((_, numbers),) = noise.draw(rows)()
    return numbers


def blocks(rows: int) -> list[tuple[int, int]]:
    return list(pairwise([*range(0, rows, 128), rows]))


def test_one_noise_is_the_same_with_and_without_the_other(scene: Scene) -> None:
    none = values_of(scene, OFF)
    shot, pattern = (values_of(scene, OFF | {name: True}) - none for name in ON)
    both = values_of(scene, ON) - none
    assert min(shot.std(), pattern.std()) > 0.1
    np.testing.assert_allclose(both, shot + pattern, rtol=0, atol=1e-4)


@pytest.mark.parametrize("effect", ["vignetting", "defocus", "distortion", "emission"])
def test_noise_is_the_same_whichever_other_effects_there_are(scene: Scene, effect: str) -> None:
    without = values_of(scene, ON) - values_of(scene, OFF)
    force = {effect: True}
    around = values_of(scene, ON | force) - values_of(scene, OFF | force)
    # Other effects draw the picture in other blocks of rows, and read the spread from a table.
    np.testing.assert_allclose(around, without, rtol=2e-3, atol=5e-3)


def test_streams_of_effects_and_seeds_are_independent() -> None:
    drawn = [
        stream(effect, seed).standard_normal(20_000)
        for effect, seed in ((SensorNoise(), 1), (SensorNoise(), 2), (FixedPattern(), 1))
    ]
    correlation = np.corrcoef(drawn) - np.eye(3)
    assert np.abs(correlation).max() < 5 / math.sqrt(20_000)


@pytest.mark.parametrize("source", [ExactNoise, ReusedNoise])
def test_noise_does_not_depend_on_the_blocks_that_it_is_drawn_in(
    scene: Scene, source: type[ExactNoise] | type[ReusedNoise]
) -> None:
    whole = drawn(source(SHOT, scene, 3), 37)
    parts = source(SHOT, scene, 3)
    pieces = [drawn(parts, rows) for rows in (1, 20, 3, 13)]
    np.testing.assert_array_equal(np.concatenate(pieces), whole)


@pytest.mark.parametrize("iso", [50.0, 400.0, 6400.0])
@pytest.mark.parametrize("gamma", [1.0, 2.22, 4.0])
def test_deviations_from_the_table_are_those_of_the_formula(gamma: float, iso: float) -> None:
    scene = Scene().replace(gamma=gamma, iso=iso)
    effects = (SensorNoise(), FixedPattern())
    values = np.linspace(0.0, 260.0, 5201, dtype=np.float32)[None, :]
    exact = NoiseSpread(effects, scene)(values)
    tabulated = NoiseSpread(effects, scene)(np.concatenate([values, values]))
    np.testing.assert_allclose(tabulated[0], exact[0], rtol=0, atol=0.06)


def test_reused_noise_has_the_mean_and_variance_of_the_exact(scene: Scene) -> None:
    sigma = float(NoiseSpread(SHOT, scene)(np.full((1, 1), 80.0, dtype=np.float32))[0, 0])
    rows = 3000
    deviation = reused(scene, 1, rows)
    samples = rows * COLUMNS
    assert deviation.mean() == pytest.approx(0.0, abs=5 * sigma / math.sqrt(samples))
    assert deviation.std() == pytest.approx(sigma, rel=5 / math.sqrt(2 * samples))


def test_means_of_columns_vary_by_the_variance_over_the_rows() -> None:
    scene = Scene().replace(columns=4000)
    sigma = float(NoiseSpread(SHOT, scene)(np.full((1, 1), 80.0, dtype=np.float32))[0, 0])
    for seed in (1, 2, 3):
        rows = 500
        means = reused(scene, seed, rows).mean(axis=0)
        assert means.var() == pytest.approx(sigma**2 / rows, rel=5 * math.sqrt(2 / 4000))
        neighbours = np.corrcoef(means[1:], means[:-1])[0, 1]
        assert neighbours == pytest.approx(0.0, abs=5 / math.sqrt(4000))


@pytest.mark.parametrize("shift", [(0, 1), (0, 2), (1, 0), (1, 1), (1, -1), (2, 0)])
def test_reused_pixels_are_uncorrelated_with_their_neighbours(
    scene: Scene, shift: tuple[int, int]
) -> None:
    deviation = reused(scene, 4, 1000)
    moved = np.roll(deviation, shift, axis=(0, 1))
    correlation = np.corrcoef(deviation.ravel(), moved.ravel())[0, 1]
    assert correlation == pytest.approx(0.0, abs=5 / math.sqrt(deviation.size))


def test_reused_noise_is_normal(scene: Scene) -> None:
    deviation = reused(scene, 6, 2000)
    scaled = deviation / deviation.std()
    for limit, fraction in ((1.0, 0.317311), (2.0, 0.045500), (3.0, 0.002700)):
        found = (np.abs(scaled) > limit).mean()
        assert found == pytest.approx(fraction, abs=5 * math.sqrt(fraction / scaled.size))


@pytest.mark.parametrize("source", ["exact", "reused"])
def test_a_seed_gives_its_picture_again_and_another_seed_another(scene: Scene, source: str) -> None:
    first, again, other = (
        occ.render(scene, seed=seed, noise=source).image  # type: ignore[arg-type]
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert (first != other).mean() > 0.3


def test_reused_noise_is_scaled_to_all_noise_together(scene: Scene) -> None:
    noisy = scene.replace(gain_variation=0.2, pattern="1")
    exact, again = (
        values_of(noisy, ON, source) - values_of(noisy, OFF) for source in ("exact", "reused")
    )
    assert again.std() == pytest.approx(exact.std(), rel=0.03)
