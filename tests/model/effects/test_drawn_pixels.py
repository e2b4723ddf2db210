"""How drawn pixels change, to within a tenth of pixels that are drawn one by one."""

from dataclasses import replace

import numpy as np
import pytest

from occ_model.camera.grey_law import GreyLaw, grey_law, law_of_known_gains
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.effects.drawn_pixels import drawn_pixels, growth_by_steps

GREYS = np.arange(256.0)
STRETCH = np.clip(3.0 * GREYS - 60.0, 0.0, 255.0)

FINE = PixelNoise(white=2176.0, gamma=2.2, is_counted=True, read_noise=2.0, step=2.0)
COARSE = PixelNoise(white=5e4, gamma=2.2, is_counted=True, read_noise=9.0, step=800.0)
FEW = PixelNoise(white=80.0, gamma=1.8, is_counted=True, read_noise=0.3, step=0.1)


def draw(law: GreyLaw, values: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    """Return the quantile of each value's law at its number, as pictures have it."""
    level, part = law.places(values)
    below = law.below[level] + part[:, None] * (law.below[level + 1] - law.below[level])
    return law.greys[(below <= numbers[:, None]).sum(axis=1)]


@pytest.mark.parametrize("curve", [GREYS, STRETCH], ids=["pixels", "enhanced"])
@pytest.mark.parametrize("noise", [FINE, COARSE, FEW], ids=["fine", "few bits", "few electrons"])
@pytest.mark.parametrize("share", [0.02, 0.3])
def test_pixels_of_another_mean_change_as_drawn_ones_do(
    noise: PixelNoise, curve: np.ndarray, share: float
) -> None:
    law, numbers = grey_law(noise, 250.0), np.random.default_rng(1).random(1000)
    pixels = drawn_pixels(law, curve.tobytes(), is_rounded=False)
    found, stated = 0.0, 0.0
    for level in np.linspace(0.3, 0.7, 30) * len(law.below):
        ends = np.rint([level, level * (1.0 + share)]).astype(int)
        one, other = (curve[draw(law, np.repeat(law.values[end], 1000), numbers)] for end in ends)
        found += float(np.mean((other - one) ** 2))
        tables = (pixels.mean, pixels.squared_steps, pixels.spread)
        mean, steps, spread = (np.diff(table[ends]) for table in tables)
        stated += float((mean**2 + spread**2 + growth_by_steps(mean, steps))[0])
    assert np.sqrt(stated) == pytest.approx(np.sqrt(found), rel=0.1)


@pytest.mark.parametrize("noise", [FINE, COARSE, FEW], ids=["fine", "few bits", "few electrons"])
@pytest.mark.parametrize("variation", [0.005, 0.05])
def test_pixels_change_without_a_noise_as_drawn_ones_do(
    noise: PixelNoise, variation: float
) -> None:
    random, noise = np.random.default_rng(2), replace(noise, gain_variation=variation)
    law, known = grey_law(noise, 200.0), law_of_known_gains(noise, 200.0)
    pixels = drawn_pixels(law, GREYS.tobytes(), is_rounded=False)
    found, stated = np.zeros(2), np.zeros(2)
    for value in np.linspace(60.0, 150.0, 30):
        gain = np.maximum(1.0 + variation * random.normal(size=1000), 0.0) ** (1.0 / noise.gamma)
        numbers = random.random(1000)
        complete = draw(known, value * gain, numbers)
        changes = complete - value * gain, complete - draw(known, np.repeat(value, 1000), numbers)
        found += np.var(changes, axis=1)
        stated += [law.interpolate(each, np.array([value]))[0] for each in pixels.changes]
    np.testing.assert_allclose(np.sqrt(stated), np.sqrt(found), rtol=0.1)
