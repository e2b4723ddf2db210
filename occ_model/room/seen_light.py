"""Relate true light to pixel values, and find a lamp's light in the columns of a picture."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.photometry import (
    WHITE,
    ColumnLight,
    level_values,
    luminance_levels,
    luminance_of,
    panel_values,
    saturate,
)
from occ_model.effects.effect import LightEffect
from occ_model.effects.light_effects import LedEdges
from occ_model.effects.noise import enhancement_of, law_of
from occ_model.effects.registry import NAMES, effects_named
from occ_model.effects.sensor_effects import FullWell
from occ_model.light.sent import light_period
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import scene_with_lamp
from occ_model.scene.scene import Scene

_LEVELS = np.linspace(0.0, 2.0 * WHITE, 600)  # pixel values for which means are tabulated
_MIN_SLOPE = 0.25  # minimum slope of apparent over true light for the true light to be known
_NEGLIGIBLE = 1e-6  # fraction of pixels too small to determine a value's light
_OUTLIER_FRACTION = 1e-4  # fraction of pixels that may have any value

_IDENTITY: ByteArray = np.arange(256, dtype=np.uint8)


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
        self._of_byte = luminance_of(_IDENTITY.astype(np.float64), scene.camera)
        curve = _IDENTITY
        if enhancement is not None:
            curve, values = enhancement
            self._of_byte = self._mean_light(curve, values)
        law = _law_of(scene, _LEVELS)
        self._outside, self._inside = (
            np.maximum.accumulate(law.interpolate(law.mean_of(self._of_byte[tone_curve]), _LEVELS))
            for tone_curve in (_IDENTITY, curve)
        )
        slope = np.diff(self._inside) / np.diff(self._true)
        self._white = float(self._inside[:-1].max(where=slope >= _MIN_SLOPE, initial=0.0))

    def _mean_light(self, curve: ByteArray, values: FloatArray) -> FloatArray:
        """Return the mean light of the pixels of each value, in a lamp's columns and beside it."""
        dark = level_values(self.scene)[:1]
        law = _law_of(self.scene, np.append(values, dark))
        sums = np.zeros((2, 256))
        for levels, tone_curve in ((values, curve), (dark, _IDENTITY)):
            light = luminance_of(levels, self.scene.camera)
            for total, weights in zip(sums, (np.ones(len(levels)), light), strict=True):
                fractions = law.histogram(levels, weights / len(levels))
                total += np.bincount(tone_curve, fractions, minlength=256)
        is_frequent = sums[0] > _NEGLIGIBLE
        mean = np.interp(
            _IDENTITY, _IDENTITY[is_frequent], sums[1, is_frequent] / sums[0, is_frequent]
        )
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

    def true_inside(self, apparent: FloatArray) -> FloatArray:
        """Return the true light of a lamp's pixels, the inverse of :meth:`inside`."""
        return np.asarray(np.interp(apparent, self._inside, self._true))

    def true_outside(self, apparent: float) -> float:
        return float(np.interp(apparent, self._outside, self._true))

    def is_white(self, apparent: FloatArray) -> BoolArray:
        """Return whether a lamp appears too bright for its true light to be known."""
        return np.asarray(apparent >= self._white)


def find_enhancement(
    lamp: RoomLamp, room: Room, pixels: ByteArray
) -> tuple[ByteArray, FloatArray] | None:
    """Return the curve that enhanced a lamp's pixels, and its columns' values before that.

    Returns None if the pixel values are more likely without an enhancement.
    """
    scene = scene_with_lamp(room, lamp)
    column_light = ColumnLight.of(scene)
    edge_light = column_light
    for effect in effects_named(NAMES, LightEffect):
        edge_light = effect.apply(scene, edge_light)
    counts = np.bincount(pixels, minlength=256)
    best_curve, best_gain = None, 0.0
    # A picture may be simulated without the lamp's edges.
    for variant in (edge_light, column_light):
        values = panel_values(scene, variant)
        law = _law_of(scene, values)
        curve = enhancement_of(scene, _limit(values, scene), values, law).curve
        plain = law.histogram(values, np.full(len(values), 1.0 / len(values)))
        enhanced = np.bincount(curve, plain, minlength=256)
        gain = float(counts @ np.log((enhanced + _OUTLIER_FRACTION) / (plain + _OUTLIER_FRACTION)))
        if gain > best_gain:
            best_curve, best_gain = (curve, values), gain
    return best_curve


def _law_of(scene: Scene, values: FloatArray) -> GreyLaw:
    """Return the law of the grey levels of a scene's pixels, with all of the sensor's noise."""
    law = law_of(scene, NAMES, values)
    assert law is not None  # noqa: S101 - all light has shot noise
    return law


def _limit(levels: FloatArray, scene: Scene) -> FloatArray:
    """Return mean pixel values as limited by the sensor."""
    for limit in effects_named(NAMES, FullWell):
        levels = limit.apply(scene, levels)
    return saturate(levels)


_DARK_STEP, _DARK_CELL = 4, 8  # step of the pixels that tell the dark, and of these a cell's side
_MIN_ROWS = 16  # minimum rows that determine the lamp's light in a column
_MIN_COLUMNS = 16  # minimum columns that determine brightness and start of the packet
_STEPS_A_COLUMN = 8  # steps per column of the packet's light
_MOST_STEPS = 2**16
_ROUNDS = 4  # refinements of brightness and start


@dataclass(frozen=True, eq=False, slots=True)
class LampLight:
    """A lamp's light in every column at its middle row, and its change from row to row."""

    light: FloatArray  # Shape (columns,): light above the dark in cd/m2; 0 where it is unknown
    fall: float  # Relative change of the light per row
    middle: float  # The middle row

    def at(self, rows: IndexArray, columns: IndexArray) -> FloatArray:
        """Return the light in some columns of each row, with the shape of ``columns``."""
        return np.asarray(self.light[columns] * (1.0 + self.fall * (rows - self.middle))[:, None])

    @classmethod
    def of(
        cls,
        image: ByteArray,
        outline: FloatArray,
        lamp: RoomLamp,
        apparent: ApparentLight,
        margin: int,
    ) -> Self:
        """Measure the light within an outline, except for a margin in pixels.

        Columns in which the lamp's inside is not visible, or white, get the light of its packet.
        """
        middle = float(outline[:, 1].mean())
        dark = _dark_light(apparent.of(image[::_DARK_STEP, ::_DARK_STEP]))
        columns, mean, fall = _inner_light(image, outline, apparent, margin)
        light = np.zeros(image.shape[1])
        is_known = ~apparent.is_white(mean)
        if is_known.sum() >= _MIN_COLUMNS:
            columns = columns[is_known]
            lamp_light = apparent.true_inside(mean[is_known]) - apparent.true_outside(dark)
            light = _Packet.of(lamp, apparent.scene).fit(columns, lamp_light, len(light))
            light[columns] = lamp_light
        return cls(light, fall, middle)


def _dark_light(light: FloatArray) -> float:
    """Return the light of most of a picture, the median of the means of cells.

    Single pixels are often black where the mean is not.
    """
    rows, columns = (max(size // _DARK_CELL, 1) for size in light.shape)
    cells = light[: rows * _DARK_CELL, : columns * _DARK_CELL]
    cells = cells.reshape(rows, len(cells) // rows, columns, -1).mean(axis=(1, 3))
    return float(np.median(cells))


def _inner_light(
    image: ByteArray, outline: FloatArray, apparent: ApparentLight, margin: int
) -> tuple[IndexArray, FloatArray, float]:
    """Return the columns that show enough of an outline's inside, their mean light, and its slope.

    The light is as it appears at the middle row; the slope is its relative change per row.
    """
    no_columns = np.empty(0, dtype=np.int64), np.empty(0), 0.0
    first, last = column_spans(outline, *image.shape)
    left, right = column_spans(outline[:, ::-1], *image.shape[::-1])
    columns = np.flatnonzero(last - first >= _MIN_ROWS + 2 * margin)
    if not len(columns):
        return no_columns
    top, bottom = int(first[columns].min()) + margin, int(last[columns].max()) - margin
    row = np.arange(top, bottom)[:, None]
    is_inside = (row >= first[columns] + margin) & (row < last[columns] - margin)
    is_inside &= (columns >= left[row] + margin) & (columns < right[row] - margin)
    has_enough_rows = is_inside.sum(axis=0) >= _MIN_ROWS
    columns, is_inside = columns[has_enough_rows], is_inside[:, has_enough_rows]
    if not len(columns):
        return no_columns
    rows = is_inside.sum(axis=0)
    light = np.where(is_inside, apparent.of(image[top:bottom][:, columns]), 0.0)
    mean, middle = light.sum(axis=0) / rows, (is_inside * row).sum(axis=0) / rows
    centred = np.where(is_inside, row - middle, 0.0)
    fall = float((centred * light).sum(axis=0) @ mean)
    fall /= max(float(np.square(centred).sum(axis=0) @ np.square(mean)), 1e-12)
    return columns, mean / (1.0 + fall * (middle - outline[:, 1].mean())), fall


@dataclass(frozen=True, eq=False, slots=True)
class _Packet:
    """The light of a lamp's period above the dark, for equally spaced starts of the exposure."""

    light: FloatArray  # Shape (steps,)
    steps_per_column: float  # from one column's exposure to the next one's

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
        place = start + columns * self.steps_per_column
        return np.asarray(np.interp(place, steps, self.light, period=len(steps)))

    def fit(self, columns: IndexArray, known_light: FloatArray, count: int) -> FloatArray:
        """Return the light in columns from 0 on, fitted in brightness and start to known columns.

        The brightness may change linearly from column to column.
        """
        start = self._search_start(columns, known_light)

        def parts(start: float, positions: IndexArray) -> FloatArray:
            light = self.at(start, positions)
            return np.stack([light, light * (positions - columns.mean())], axis=1)

        for _ in range(_ROUNDS):
            gain = np.linalg.lstsq(parts(start, columns), known_light, rcond=None)[0]
            slope = (parts(start + 0.5, columns) - parts(start - 0.5, columns)) @ gain
            terms = np.column_stack([parts(start, columns), slope])
            change = float(np.linalg.lstsq(terms, known_light, rcond=None)[0][2])
            start += min(max(change, -_STEPS_A_COLUMN), _STEPS_A_COLUMN)
        gain = np.linalg.lstsq(parts(start, columns), known_light, rcond=None)[0]
        return np.maximum(parts(start, np.arange(count)) @ gain, 0.0)

    def _search_start(self, columns: IndexArray, known_light: FloatArray) -> float:
        """Return the start, to a step, at which the packet is most similar to the known light."""
        size = len(self.light)
        step = np.rint(columns * self.steps_per_column).astype(np.int64) % size
        sums, counts = (
            np.bincount(step, weights, minlength=size)
            for weights in (known_light, np.ones(len(known_light)))
        )
        # For each start, sums over columns: of the packet's light times theirs, and of its square.
        products, squares = (
            np.fft.irfft(np.fft.rfft(light) * np.conj(np.fft.rfft(column_sums)), size)
            for light, column_sums in ((self.light, sums), (np.square(self.light), counts))
        )
        similarity = np.maximum(products, 0.0) / np.sqrt(np.maximum(squares, squares.max() * 1e-6))
        return float(similarity.argmax())
