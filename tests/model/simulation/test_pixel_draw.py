"""Pixels are drawn by their law, each by its own number, whatever is drawn around it."""

import math

import numpy as np
import pytest
from amount import amount
from model.camera.grey_enumeration import enumerate_greys
from scipy.stats import chi2

import occ_model as occ
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.photometry import level_values
from occ_model.effects.noise import law_of
from occ_model.scene.scene import Scene
from occ_model.simulation.grey_table import GreyTable
from occ_model.simulation.pixel_draw import PictureNumbers, dither
from occ_model.simulation.render import observe

ROWS, COLUMNS = 200, 300
ON = {"sensor-noise": True, "fixed-pattern": True}
OFF = {"sensor-noise": False, "fixed-pattern": False}


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A panel that blinks, its middle half bright enough not to reach black."""
    return Scene().replace(rows=ROWS, columns=COLUMNS, distance=0.6, illuminance=3000.0)


def values_of(scene: Scene, force: dict[str, bool], seed: int = 5) -> np.ndarray:
    return observe(scene, occ.plan(scene, math.inf, force=force), seed=seed).astype(float)


def law(scene: Scene) -> GreyLaw:
    found = law_of(scene, ("sensor-noise",), np.array([300.0]))
    assert found is not None
    return found


def draw(scene: Scene, value: float, pixels: int) -> np.ndarray:
    """Return how many of the pixels of a mean value have each grey level."""
    table, counts = GreyTable(law(scene)), np.zeros(256)
    numbers, rows = PictureNumbers(3, 2**12), 2**8
    level = law(scene).levels_of(np.full((1, 1), value, dtype=np.float32))
    for start in range(0, pixels // 2**12, rows):
        block = range(start, start + rows)
        (own,) = numbers.of(block, rows)
        greys = np.empty((rows, 2**12), dtype=np.uint8)
        table.draw(dither(block, 2**12) + level, own, greys)
        counts += np.bincount(greys.ravel(), minlength=256)
    return counts


def chance_of(counts: np.ndarray, fractions: np.ndarray) -> float:
    """Return the chance of a larger chi-square, with rare grey levels counted together."""
    expected = fractions * counts.sum()
    is_common = expected > 20.0
    pairs = [
        *zip(counts[is_common], expected[is_common], strict=True),
        (counts[~is_common].sum(), expected[~is_common].sum()),
    ]
    square = sum((seen - mean) ** 2 / mean for seen, mean in pairs if mean > 5.0)
    return float(chi2.sf(square, max(sum(mean > 5.0 for _, mean in pairs) - 1, 1)))


@pytest.mark.parametrize("number", range(amount(4, 200)))
def test_drawn_pixels_have_the_enumerated_distribution(number: int) -> None:
    random = np.random.default_rng([31, number])
    scene = occ.load_preset("phone-68us").replace(
        iso=float(100.0 * 2.0 ** random.uniform(-1.0, 5.0)), gamma=float(random.uniform(1.0, 3.0)),
        read_noise=float(random.choice([0.3, 1.0, 2.0, 5.0])),
        adc_bits=int(random.choice([6, 8, 10, 12])),
        pixel_pitch=float(1e-6 * 2.0 ** random.uniform(-0.5, 1.5)), full_well=1e5,
    )  # fmt: skip
    value = float(random.uniform(1.0, 250.0))
    counts = draw(scene, value, amount(2**20, 10**7))
    assert chance_of(counts, enumerate_greys(scene, value)) > 1e-5


def test_a_picture_of_the_phone_has_the_enumerated_dark_and_lit_pixels() -> None:
    scene = occ.load_preset("phone-68us").replace(distance=0.05, enhancement="none", rows=2000)
    for pattern, value in zip(("0", "1"), level_values(scene).tolist(), strict=True):
        still = scene.replace(pattern=pattern, columns=600)
        image = occ.render(still, force=ON | {"fixed-pattern": False}).camera_image
        counts = np.bincount(image.ravel(), minlength=256).astype(float)
        assert chance_of(counts, enumerate_greys(scene, value)) > 1e-4


def test_the_pattern_shows_in_the_mean_of_pictures_alone(scene: Scene) -> None:
    noisy = scene.replace(gain_variation=0.1, pattern="1", luminance=800.0)
    pictures = np.mean([values_of(noisy, ON, seed) for seed in range(40)], axis=0)
    gains = values_of(noisy, OFF | {"fixed-pattern": True})
    assert np.corrcoef(pictures.ravel(), gains.ravel())[0, 1] > 0.98
    other = values_of(noisy.replace(sensor_seed=2), OFF | {"fixed-pattern": True})
    assert abs(np.corrcoef(other.ravel(), gains.ravel())[0, 1]) < 5.0 / math.sqrt(gains.size)
    assert other.std() == pytest.approx(gains.std(), rel=0.03)


def test_a_pixel_far_above_white_is_white_whatever_its_gain(scene: Scene) -> None:
    bright = scene.replace(gain_variation=0.1, pattern="1", luminance=1e5)
    for force in (ON, {**OFF, "fixed-pattern": True}):
        frame = occ.render(bright, tolerance=math.inf, force=force)
        assert (frame.profile.max(), frame.camera_image.max()) == (255.0, 255)


@pytest.mark.parametrize("effect", ["vignetting", "defocus", "distortion", "emission"])
def test_pixels_are_drawn_alike_whichever_absent_effects_are_on(scene: Scene, effect: str) -> None:
    """Other effects draw the picture by other blocks of rows."""
    without = values_of(scene, ON)
    around = values_of(scene, ON | {effect: True})
    assert (around != without).mean() < 1e-3


def test_a_pixel_changes_no_more_than_its_mean_does(scene: Scene) -> None:
    """Else each small change of the light would draw a picture's noise anew."""
    one, other = (values_of(scene.replace(luminance=light), ON) for light in (2000.0, 2010.0))
    change = other - one
    assert (change >= 0.0).all()
    assert (change <= 2.0).all()
    assert 0.0 < change.mean() < 0.5


def test_a_seed_gives_its_picture_again_and_another_seed_another(scene: Scene) -> None:
    first, again, other = (occ.render(scene, seed=seed).image for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert (first != other).mean() > 0.3


@pytest.mark.parametrize("step", [2, 9])
def test_a_drafts_rows_are_the_pictures(step: int) -> None:
    for name in ("phone-136us", "phone-136us-real"):
        scene = occ.load_preset(name).replace(columns=500, jpeg_quality=0)
        whole = occ.render(scene, tolerance=0.0)
        draft = occ.render(scene, tolerance=0.0, rows_step=step)
        same = draft.camera_image == whole.camera_image[draft.rows]
        # Rows behind a lens are interpolated between others.
        assert same.mean() >= (1.0 if name == "phone-136us" else 0.9995)
        assert (draft.image == whole.image[draft.rows]).mean() >= same.mean() - 1e-4


@pytest.mark.parametrize("shift", [(0, 1), (1, 0), (1, 1), (32, 0)])
def test_pixels_are_uncorrelated_with_their_neighbours(shift: tuple[int, int]) -> None:
    (numbers,) = PictureNumbers(4, 500).of(range(1000), 1000)
    greys = np.empty((1000, 500), dtype=np.uint8)
    GreyTable(law(Scene())).draw(dither(range(1000), 500) + np.float32(100.0), numbers, greys)
    deviation = greys - greys.mean()
    moved = np.roll(deviation, shift, axis=(0, 1))
    correlation = np.corrcoef(deviation.ravel(), moved.ravel())[0, 1]
    assert correlation == pytest.approx(0.0, abs=5 / math.sqrt(deviation.size))
