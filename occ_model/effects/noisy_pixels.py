"""Mean and spread of a scene's pixels with some of its effects, by the law of their noise."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.grey_law import GreyLaw, grey_law, law_of_known_gains
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.effects.noise import noise_of
from occ_model.effects.normal_noise import mean_after_clipping, unclipped_fraction
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell
from occ_model.effects.simulated_columns import Names
from occ_model.scene.scene import Scene

_GREYS: FloatArray = np.arange(256.0)
_LEAST_STEP = 0.01  # grey levels over which the slope of the mean is taken


class NoisyPixels:
    """The law of a scene's pixels for sets of effects.

    Where the gains alone vary, pixels are not drawn, and their values are not rounded.
    """

    brightest = 2.0 * WHITE  # largest mean value before saturation

    def __init__(self, scene: Scene, names: Names) -> None:
        """Prepare the pixels of a scene; ``names`` are all of its effects."""
        self._scene, self._names = scene, names
        self._noises: dict[Names, PixelNoise | None] = {}

    def noise(self, included: Names) -> PixelNoise | None:
        """Return the noise with some effects."""
        if included not in self._noises:
            self._noises[included] = noise_of(self._scene, included)
        return self._noises[included]

    def is_drawn(self, included: Names) -> bool:
        """Return whether pixels are drawn, as whole grey levels."""
        noise = self.noise(included)
        return noise is not None and noise.is_drawn

    def law(self, included: Names) -> GreyLaw | None:
        """Return the law of grey levels; None without noise."""
        noise = self.noise(included)
        return None if noise is None else grey_law(noise, self.brightest)

    def _drawn_law(self, included: Names) -> GreyLaw | None:
        return self.law(included) if self.is_drawn(included) else None

    def means(self, included: Names, values: FloatArray) -> FloatArray:
        """Return the pixels' means for values before saturation."""
        law = self._drawn_law(included)
        if law is not None:
            return law.interpolate(law.means, values)
        noise = self.noise(included)
        if noise is not None:
            full = self._limit(included, np.array([WHITE]))[0]
            spread = values * (noise.gain_variation / noise.gamma)
            return mean_after_clipping(values, spread, float(full))
        return self._limit(included, values)

    def _limit(self, included: Names, values: FloatArray) -> FloatArray:
        for limit in effects_named(included & self._names, FullWell):
            values = limit.apply(self._scene, values)
        return np.minimum(values, WHITE)

    def values_of(self, included: Names, means: FloatArray) -> FloatArray:
        """Return the values before saturation of pixels with some means."""
        law = self._drawn_law(included)
        return np.maximum(means, 0.0) if law is None else law.values_of(means)

    def variance_by(self, name: str, levels: FloatArray) -> FloatArray:
        """Return what one noise adds to the variance of pixels of some means."""
        values = self.values_of(self._names, levels)
        whole, rest = self.noise(self._names), self.noise(self._names - {name})
        if whole is None:
            return np.zeros(len(levels))
        drawn = self._drawn_variance(whole, values) - self._drawn_variance(rest, values)
        gain = whole.gain_variation**2 - (rest.gain_variation**2 if rest else 0.0)
        return np.maximum(drawn, 0.0) + gain * (self._gain_slope(values) / whole.gamma) ** 2

    def _drawn_variance(self, noise: PixelNoise | None, values: FloatArray) -> FloatArray:
        if noise is None or not noise.is_drawn:
            return np.zeros(len(values))
        whole = self.noise(self._names) or noise
        # One law for the pixels with and without gains that vary.
        noise = replace(noise, gain_variation=whole.gain_variation)
        law = law_of_known_gains(noise, self.brightest)
        return law.moments(values, _GREYS)[1] ** 2

    def _gain_slope(self, values: FloatArray) -> FloatArray:
        """Return the change of a pixel's mean for a relative change of its value."""
        if self.is_drawn(self._names):
            step = np.maximum(values * 0.01, _LEAST_STEP)
            above, below = (
                self.means(self._names, np.maximum(values + sign * step, 0.0))
                for sign in (1.0, -1.0)
            )
            return values * (above - below) / (2.0 * step)
        noise = self.noise(self._names)
        spread = values * (noise.gain_variation / noise.gamma if noise else 0.0)
        full = float(self._limit(self._names, np.array([WHITE]))[0])
        return values * np.sqrt(unclipped_fraction(values, spread, full))

    def gaps(self, levels: FloatArray) -> FloatArray:
        """Return by how much pixels of some means move that change by drawing; 0 without it."""
        law = self._drawn_law(self._names)
        if law is None:
            return np.zeros(len(levels))
        return law.gaps(law.values_of(levels))

    def end_fractions(self, included: Names, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the fractions of black pixels and of white ones, for some means."""
        law = self._drawn_law(included)
        if law is not None:
            values = law.values_of(levels)
            return law.fraction_below(1, values), 1.0 - law.fraction_below(255, values)
        return (levels <= 0.0).astype(np.float64), (levels >= WHITE).astype(np.float64)
