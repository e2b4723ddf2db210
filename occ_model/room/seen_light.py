"""Relate true light to that of pixels, and find a lamp's light in the columns of a picture."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.enhancement import Enhancement, LevelSteps, byte_fractions
from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    luminance_levels,
    luminance_of,
    panel_values,
    saturate,
)
from occ_model.effects.effect import LightEffect, NoiseEffect, PixelEffect
from occ_model.effects.light_effects import LedEdges
from occ_model.effects.registry import NAMES, effects_named
from occ_model.light.sent import light_period
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


_MIN_ROWS = 16  # minimum rows that determine the lamp's light in a column
_MIN_COLUMNS = 16  # minimum columns that determine brightness and start of the packet
_STEPS_A_COLUMN = 8  # steps per column of the packet's light
_MOST_STEPS = 2**16
_ROUNDS = 4  # refinements of brightness and start


@dataclass(frozen=True, eq=False, slots=True)
class LampLight:
    """A lamp's light in every column at its middle row, and its change from row to row."""

    light: FloatArray  # Shape (columns,): light above the dark in cd/m2; 0 where it is unknown
    fall: float
    middle: float

    def at(self, rows: IndexArray, columns: IndexArray) -> FloatArray:
        """Return the light in some columns of each row, with the shape of ``columns``."""
        return np.asarray(self.light[columns] * (1.0 + self.fall * (rows - self.middle))[:, None])

    @classmethod
    def of(
        cls, image: ByteArray, outline: FloatArray, lamp: RoomLamp, seen: ApparentLight, margin: int
    ) -> Self:
        """Measure the light within an outline, except for a margin in pixels.

        Columns that do not show the lamp's inside, or show it white, get the light of its packet.
        """
        middle = float(outline[:, 1].mean())
        dark = float(np.median(seen.of(image[::16, ::16])))
        columns, mean, fall = _inner_light(image, outline, seen, margin)
        light = np.zeros(image.shape[1])
        is_known = ~seen.is_white(mean)
        if is_known.sum() >= _MIN_COLUMNS:
            columns = columns[is_known]
            own = seen.true_inside(mean[is_known]) - seen.true_outside(dark)
            light = _Packet.of(lamp, seen.scene).fit(columns, own, len(light))
            light[columns] = own
        return cls(light, fall, middle)


def _inner_light(
    image: ByteArray, outline: FloatArray, seen: ApparentLight, margin: int
) -> tuple[IndexArray, FloatArray, float]:
    """Return the columns that show enough of an outline's inside, their mean light, and its slope.

    The light is as it appears at the middle row; the slope is its relative change per row.
    """
    nothing = np.empty(0, dtype=np.int64), np.empty(0), 0.0
    first, last = column_spans(outline, *image.shape)
    left, right = column_spans(outline[:, ::-1], *image.shape[::-1])
    columns = np.flatnonzero(last - first >= _MIN_ROWS + 2 * margin)
    if not len(columns):
        return nothing
    top, bottom = int(first[columns].min()) + margin, int(last[columns].max()) - margin
    row = np.arange(top, bottom)[:, None]
    within = (row >= first[columns] + margin) & (row < last[columns] - margin)
    within &= (columns >= left[row] + margin) & (columns < right[row] - margin)
    enough = within.sum(axis=0) >= _MIN_ROWS
    columns, within = columns[enough], within[:, enough]
    if not len(columns):
        return nothing
    rows = within.sum(axis=0)
    light = np.where(within, seen.of(image[top:bottom][:, columns]), 0.0)
    mean, middle = light.sum(axis=0) / rows, (within * row).sum(axis=0) / rows
    apart = np.where(within, row - middle, 0.0)
    fall = float((apart * light).sum(axis=0) @ mean)
    fall /= max(float(np.square(apart).sum(axis=0) @ np.square(mean)), 1e-12)
    return columns, mean / (1.0 + fall * (middle - outline[:, 1].mean())), fall


@dataclass(frozen=True, eq=False, slots=True)
class _Packet:
    """The light of a lamp's period above the dark, for equally spaced starts of the exposure."""

    light: FloatArray  # Shape (steps,)
    a_column: float  # steps from one column's exposure to the next one's

    @classmethod
    def of(cls, lamp: RoomLamp, scene: Scene) -> Self:
        period = float(light_period(lamp.transmitter))
        columns = period / scene.camera.readout_time
        steps = min(math.ceil(_STEPS_A_COLUMN * columns), _MOST_STEPS)
        scene = dataclasses.replace(scene, transmitter=lamp.transmitter).replace(
            columns=steps, readout_time=period / steps, start_time=0.0
        )
        values = panel_values(scene, LedEdges().apply(scene, ColumnLight.of(scene)))
        light = luminance_of(values, scene.camera) - luminance_levels(scene)[0]
        return cls(light, steps / columns)

    def at(self, start: FloatArray | float, columns: IndexArray) -> FloatArray:
        """Return the light in columns if the packet starts ``start`` steps before column 0."""
        steps = np.arange(len(self.light))
        place = start + columns * self.a_column
        return np.asarray(np.interp(place, steps, self.light, period=len(steps)))

    def fit(self, columns: IndexArray, own: FloatArray, count: int) -> FloatArray:
        """Return the light in columns from 0 on, fitted in brightness and start to known columns.

        The brightness may change linearly from column to column.
        """
        start = self._search_start(columns, own)

        def parts(start: float, places: IndexArray) -> FloatArray:
            one = self.at(start, places)
            return np.stack([one, one * (places - columns.mean())], axis=1)

        for _ in range(_ROUNDS):
            gain = np.linalg.lstsq(parts(start, columns), own, rcond=None)[0]
            slope = (parts(start + 0.5, columns) - parts(start - 0.5, columns)) @ gain
            free = np.column_stack([parts(start, columns), slope])
            change = float(np.linalg.lstsq(free, own, rcond=None)[0][2])
            start += min(max(change, -_STEPS_A_COLUMN), _STEPS_A_COLUMN)
        gain = np.linalg.lstsq(parts(start, columns), own, rcond=None)[0]
        return np.maximum(parts(start, np.arange(count)) @ gain, 0.0)

    def _search_start(self, columns: IndexArray, own: FloatArray) -> float:
        """Return the start, to a step, with which the packet is most like some columns' light."""
        size = len(self.light)
        step = np.rint(columns * self.a_column).astype(np.int64) % size
        sums, counts = (np.bincount(step, one, minlength=size) for one in (own, np.ones(len(own))))
        # The sums over columns of the packet's light times their own, and squared, by its start.
        products, squares = (
            np.fft.irfft(np.fft.rfft(light) * np.conj(np.fft.rfft(seen)), size)
            for light, seen in ((self.light, sums), (np.square(self.light), counts))
        )
        likeness = np.maximum(products, 0.0) / np.sqrt(np.maximum(squares, squares.max() * 1e-6))
        return float(likeness.argmax())
