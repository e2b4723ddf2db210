"""Find a lamp's light in the columns of a picture, from its packet and from its inside."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.photometry import ColumnLight, luminance_levels, luminance_of, panel_values
from occ_model.effects.light_effects import LedEdges
from occ_model.room.room import RoomLamp
from occ_model.room.seen_light import ApparentLight
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

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
    """The light of a lamp's packet above the dark, for equally spaced starts of the exposure."""

    light: FloatArray  # Shape (steps,)
    a_column: float  # steps from one column's exposure to the next one's

    @classmethod
    def of(cls, lamp: RoomLamp, scene: Scene) -> Self:
        period = len(sent_chips(lamp.transmitter)) * lamp.transmitter.switching_period
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
