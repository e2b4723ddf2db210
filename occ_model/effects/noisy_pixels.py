"""Mean and spread of a scene's pixels with some of its effects, by the law of their noise."""

from collections.abc import Iterable, Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.grey_law import GreyLaw, grey_law
from occ_model.camera.interpolation import Places, interpolate_at
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_noise import GREY_LEVELS, PixelNoise
from occ_model.effects.drawn_pixels import DrawnPixels, drawn_pixels, growth_by_steps, step_of
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.noise import noise_of
from occ_model.effects.normal_noise import mean_after_clipping, unclipped_fraction
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell
from occ_model.effects.simulated_columns import Names
from occ_model.scene.scene import Scene


class NoisyPixels:
    """The law of a scene's pixels for sets of effects.

    Where the gains alone vary, pixels are not drawn, and their values are not rounded.
    """

    brightest = 2.0 * WHITE  # largest mean value before saturation

    def __init__(self, scene: Scene, names: Names) -> None:
        """Prepare the pixels of a scene; ``names`` are all of its effects."""
        self._scene, self._names = scene, names
        noisy = (*effects_named(names, NoiseEffect), *effects_named(names, FullWell))
        self._of_noise = frozenset(effect.name for effect in noisy)
        self._noises: dict[Names, PixelNoise | None] = {}
        self._laws: dict[tuple[Names, float], GreyLaw | None] = {}

    def noise(self, included: Names) -> PixelNoise | None:
        """Return the noise with some effects."""
        key = included & self._of_noise
        if key not in self._noises:
            self._noises[key] = noise_of(self._scene, key)
        return self._noises[key]

    def is_drawn(self, included: Names) -> bool:
        """Return whether pixels are drawn, as whole grey levels."""
        noise = self.noise(included)
        return noise is not None and noise.is_drawn

    def law(self, included: Names) -> GreyLaw | None:
        """Return the law of grey levels; None without noise."""
        key = included & self._of_noise, self.brightest
        if key not in self._laws:
            noise = self.noise(included)
            self._laws[key] = None if noise is None else grey_law(noise, self.brightest)
        return self._laws[key]

    def drawn_law(self, included: Names) -> GreyLaw | None:
        """Return the law of grey levels that are drawn; None if none are."""
        return self.law(included) if self.is_drawn(included) else None

    def drawn(
        self, included: Names, curve: FloatArray = GREY_LEVELS, *, is_rounded: bool = False
    ) -> DrawnPixels | None:
        """Return drawn pixels after a curve of the grey levels; None if none are drawn."""
        law = self.drawn_law(included)
        return None if law is None else drawn_pixels(law, curve.tobytes(), is_rounded=is_rounded)

    def means(self, included: Names, values: FloatArray) -> FloatArray:
        """Return the pixels' means for values before saturation."""
        law = self.drawn_law(included)
        if law is not None:
            return law.interpolate(law.means, values)
        noise = self.noise(included)
        if noise is not None:
            spread = values * (noise.gain_variation / noise.gamma)
            return mean_after_clipping(values, spread, self._full(included))
        return self._limit(included, values)

    def _full(self, included: Names) -> float:
        return float(self._limit(included, np.array([WHITE]))[0])

    def _limit(self, included: Names, values: FloatArray) -> FloatArray:
        for limit in effects_named(included & self._names, FullWell):
            values = limit.apply(self._scene, values)
        return np.minimum(values, WHITE)

    def _index_of(self, name: str) -> int:
        """Return the index of a noise in the pairs of :class:`DrawnPixels`.

        Without the noise of the gains, which has the index 1, pixels are still drawn.
        """
        return int(self.is_drawn(self._names - {name}))

    def variance_at(self, name: str, places: Places) -> FloatArray:
        """Return what one noise adds to the variance of drawn pixels."""
        drawn = self.drawn(self._names)
        if drawn is None:
            return np.zeros(1)
        return interpolate_at(drawn.variances[self._index_of(name)], places)

    def places(self, sets: Sequence[Names], exposed: FloatArray) -> list[Places]:
        """Return the places of drawn pixels in the laws of some sets, from their exposed values."""
        laws = [self.drawn_law(included) for included in sets]
        return [law.places(own) for law, own in zip(laws, exposed, strict=True) if law is not None]

    def drawn_squares(
        self,
        sets: Sequence[Names],
        places: Sequence[Places],
        noises: Iterable[str],
        curve: FloatArray,
        *,
        is_rounded: bool,
    ) -> tuple[FloatArray, FloatArray]:
        """Return the mean square of changes about the mean, and the step of pixels that change.

        The changes are those from the first set to each other, and those without each noise, shape
        (changes, ...).
        """
        each = [self.drawn(included, curve, is_rounded=is_rounded) for included in sets]
        tables = [drawn for drawn in each if drawn is not None]
        at = [
            [interpolate_at(table, own) for table in (one.mean, one.squared_steps, one.spread)]
            for one, own in zip(tables, places, strict=True)
        ]
        mean, squared_steps, spread = np.moveaxis(np.array(at) - at[0], 1, 0)[:, 1:]
        squares = [*(growth_by_steps(mean, squared_steps) + spread**2)]
        steps = [*step_of(mean, squared_steps)]
        for name in noises:
            squares.append(interpolate_at(tables[0].changes[self._index_of(name)], places[0]))
            steps.append(np.maximum(interpolate_at(tables[0].step, places[0]), 1.0))
        return np.array(squares), np.array(steps)

    def variance_by(self, name: str, levels: FloatArray) -> FloatArray:
        """Return what one noise adds to the variance of pixels of some means."""
        noise, law = self.noise(self._names), self.drawn_law(self._names)
        drawn = self.drawn(self._names)
        if law is not None and drawn is not None:
            return law.at_means(drawn.variances[self._index_of(name)], levels)
        if noise is None:
            return np.zeros(len(levels))
        values = np.maximum(levels, 0.0)
        spread = values * (noise.gain_variation / noise.gamma)
        return spread**2 * unclipped_fraction(values, spread, self._full(self._names))

    def end_fractions(self, included: Names, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the fractions of black pixels and of white ones, for some means."""
        law = self.drawn_law(included)
        if law is not None:
            black, white = law.fraction_below(1), 1.0 - law.fraction_below(255)
            return law.at_means(black, levels), law.at_means(white, levels)
        return (levels <= 0.0).astype(np.float64), (levels >= WHITE).astype(np.float64)
