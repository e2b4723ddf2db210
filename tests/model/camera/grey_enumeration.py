"""The law of a noisy pixel's grey level, slowly, one number of electrons after another."""

import numpy as np
from scipy.stats import norm, poisson

from occ_model.camera.photometry import white_electrons
from occ_model.scene.scene import Scene

_GAINS = np.linspace(-5.0, 5.0, 21)  # in standard deviations


def codes_of(scene: Scene) -> np.ndarray:
    """Return the electrons at each code of the converter."""
    top = min(white_electrons(scene), scene.sensor.full_well)
    return np.linspace(0.0, top, 2**scene.sensor.adc_bits)


def greys_of(scene: Scene) -> np.ndarray:
    """Return the grey level of each code."""
    relative = codes_of(scene) / white_electrons(scene)
    return np.rint(255.0 * relative ** (1.0 / scene.camera.gamma)).astype(int)


def enumerate_greys(scene: Scene, value: float, gain_variation: float = 0.0) -> np.ndarray:
    """Return the probability of each of 256 grey levels for a pixel's mean value."""
    mean = white_electrons(scene) * (value / 255.0) ** scene.camera.gamma
    gains = np.maximum(1.0 + gain_variation * _GAINS, 0.0) if gain_variation else np.ones(1)
    weights = np.exp(-0.5 * _GAINS**2) if gain_variation else np.ones(1)
    codes, greys = codes_of(scene), greys_of(scene)
    last = np.append(np.flatnonzero(np.diff(greys)), len(codes) - 1)  # code of each grey level
    ends = np.append((codes[last[:-1]] + codes[last[:-1] + 1]) / 2.0, np.inf)
    found = np.zeros(256)
    for gain, weight in zip(gains, weights / weights.sum(), strict=True):
        low, high = poisson.ppf((1e-14, 1.0 - 1e-14), mean * gain)
        number = np.arange(max(low, 0.0), high + 2.0)
        chance = poisson.pmf(number, mean * gain)
        below = chance @ norm.cdf((ends - number[:, None]) / max(scene.sensor.read_noise, 1e-9))
        found[greys[last]] += weight * np.diff(below, prepend=0.0)
    return found
