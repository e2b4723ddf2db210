"""Relate true light to the apparent light of pixels, which noise and enhancement alter."""

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.camera.enhancement import Enhancement, LevelSteps, byte_fractions
from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    luminance_of,
    panel_values,
    saturate,
)
from occ_model.effects.effect import LightEffect, NoiseEffect, PixelEffect
from occ_model.effects.registry import NAMES, effects_named
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import scene_with_lamp
from occ_model.scene.scene import Scene

_LEVELS = np.linspace(0.0, 2.0 * WHITE, 600)  # pixel values for which means are tabulated
_MIN_SLOPE = 0.25  # minimum slope of apparent over true light for the true light to be known
_NEGLIGIBLE = 1e-6  # fraction of pixels too small to determine a value's light
_UNEXPLAINED = 1e-4  # fraction of pixels that may have any value

_PLAIN: ByteArray = np.arange(256, dtype=np.uint8)


class ApparentLight:
    """The mean relation between the light of pixels in a picture and the light that reached them.

    Black and white clip the noise, so dark pixels appear brighter and bright ones darker. If the
    receiver enhanced a lamp's pixels but not those beside it, a pixel value counts as the mean
    light of all pixels that have it, half of which are taken to be the lamp's.
    """

    def __init__(
        self, scene: Scene, enhancement: tuple[ByteArray, FloatArray] | None = None
    ) -> None:
        self.scene = scene
        self._true = luminance_of(_LEVELS, scene.camera)
        self._of_byte = luminance_of(_PLAIN.astype(np.float64), scene.camera)
        curve = _PLAIN
        if enhancement is not None:
            curve, values = enhancement
            self._of_byte = self._mean_light(curve, values)
        passed = LevelSteps.of(_limit(_LEVELS, scene), _noise_of(_LEVELS, scene))
        self._outside, self._inside = (
            np.maximum.accumulate(passed.mean_of(self._of_byte[own])) for own in (_PLAIN, curve)
        )
        slope = np.diff(self._inside) / np.diff(self._true)
        self._white = float(self._inside[:-1].max(where=slope >= _MIN_SLOPE, initial=0.0))

    def _mean_light(self, curve: ByteArray, values: FloatArray) -> FloatArray:
        """Return the mean light of the pixels of each value, in a lamp's columns and beside it."""
        dark = level_values(self.scene)[:1]
        sums = np.zeros((2, 256))
        for levels, own in ((values, curve), (dark, _PLAIN)):
            light = luminance_of(levels, self.scene.camera)
            for total, weights in zip(sums, (np.ones(len(levels)), light), strict=True):
                found = _fractions_of_bytes(levels, weights, self.scene)
                total += np.bincount(own, found, minlength=256)
        there = sums[0] > _NEGLIGIBLE
        mean = np.interp(_PLAIN, _PLAIN[there], sums[1, there] / sums[0, there])
        return np.maximum.accumulate(mean)

    def of(self, image: ByteArray) -> FloatArray:
        """Return the apparent light of pixels in cd/m2, with the shape of ``image``."""
        return self._of_byte[image]

    def inside(self, true: FloatArray) -> FloatArray:
        """Return the apparent light of a lamp's pixels of a true light."""
        return np.asarray(np.interp(true, self._true, self._inside))

    def outside(self, true: FloatArray) -> FloatArray:
        """Return the apparent light of pixels beside a lamp."""
        return np.asarray(np.interp(true, self._true, self._outside))

    def true_inside(self, seen: FloatArray) -> FloatArray:
        """Return the true light of a lamp's pixels, the inverse of :meth:`inside`."""
        return np.asarray(np.interp(seen, self._inside, self._true))

    def true_outside(self, seen: float) -> float:
        return float(np.interp(seen, self._outside, self._true))

    def is_white(self, seen: FloatArray) -> BoolArray:
        """Return whether a lamp appears too bright for its true light to be known."""
        return np.asarray(seen >= self._white)


def find_enhancement(
    lamp: RoomLamp, room: Room, pixels: ByteArray
) -> tuple[ByteArray, FloatArray] | None:
    """Return the curve that enhanced a lamp's pixels, and the values of its columns before.

    Returns None if their values are more likely without an enhancement.
    """
    scene = scene_with_lamp(room, lamp)
    bare = ColumnLight.of(scene)
    light = bare
    for effect in effects_named(NAMES, LightEffect):
        light = effect.apply(scene, light)
    counts = np.bincount(pixels, minlength=256)
    found, best = None, 0.0
    for own in (light, bare):  # a picture may be simulated without the lamp's edges
        values = panel_values(scene, own)
        curve = Enhancement(_limit(values, scene), scene.model.enhancement).curve
        plain = _fractions_of_bytes(values, np.ones(len(values)), scene)
        enhanced = np.bincount(curve, plain, minlength=256)
        likelier = float(counts @ np.log((enhanced + _UNEXPLAINED) / (plain + _UNEXPLAINED)))
        if likelier > best:
            found, best = (curve, values), likelier
    return found


def _fractions_of_bytes(levels: FloatArray, weights: FloatArray, scene: Scene) -> FloatArray:
    """Return the total weight of the pixels that become each byte, from their mean values."""
    spread = _noise_of(levels, scene)
    return byte_fractions(_limit(levels, scene), spread, weights / len(levels))


def _noise_of(levels: FloatArray, scene: Scene) -> FloatArray:
    noises = [one for one in effects_named(NAMES, NoiseEffect) if one.is_present(scene)]
    return np.asarray(np.sqrt(sum(one.spread(scene, levels) ** 2 for one in noises)))


def _limit(levels: FloatArray, scene: Scene) -> FloatArray:
    """Return mean pixel values as limited by the sensor."""
    for limit in effects_named(NAMES, PixelEffect):
        levels = limit.apply(scene, levels)
    return saturate(levels)
