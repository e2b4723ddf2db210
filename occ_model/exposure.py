"""A picture whose rows are not alike: pixels exposed, read out and written, some rows at a time."""

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.optics import Optics, Rows, picture_rows
from occ_model.camera.photometry import WHITE, saturate
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import FileEffect, NoiseEffect, Observable, OpticsEffect, PixelEffect
from occ_model.effects.noise import ExactNoise, Noise, NoiseSource, ReusedNoise
from occ_model.effects.registry import planned
from occ_model.effects.sight import sight_of
from occ_model.results import Plan
from occ_model.scene import Scene
from occ_model.stage_clock import StageClock


@dataclass(frozen=True, eq=False, slots=True)
class ExposedRows:
    """Some rows of pixels, before they are rounded.

    Parameters
    ----------
    rows
        Which rows, and where the panel is in them.
    mean : ndarray of float32, shape (rows, columns) or (1, columns)
        Saturated.
    deviation : ndarray of float32, shape (rows, columns), or None
        What noise adds to it.
    """

    rows: Rows
    mean: Pixels
    deviation: Pixels | None

    @property
    def height(self) -> int:
        """How many rows."""
        return self.rows.last - self.rows.first

    def values(self) -> Pixels:
        """Give the pixel values, shape (rows, columns)."""
        if self.deviation is not None:
            return self.mean + self.deviation
        return np.ascontiguousarray(np.broadcast_to(self.mean, (self.height, self.mean.shape[1])))

    def to_bytes(self) -> ByteArray:
        """Round them to the nearest of 0 to 255, shape (rows, columns)."""
        if self.deviation is None:
            rounded = cv2.convertScaleAbs(self.mean)  # no value is below 0
            return np.broadcast_to(rounded, (self.height, self.mean.shape[1]))
        # As one operation, which adds, rounds and saturates at once.
        mean = np.broadcast_to(self.mean, self.deviation.shape)
        added = cv2.add(np.ascontiguousarray(mean), self.deviation, dtype=cv2.CV_8U)
        return np.asarray(added, dtype=np.uint8)


class PixelExposure:
    """The pixels of a picture.

    Parameters
    ----------
    scene
        The scene.
    plan
        Its effects are simulated.
    panel, surroundings : ndarray of float64, shape (columns,)
        Pixel values of each column before saturation.
    clock
        Is told of each stage.
    """

    def __init__(
        self,
        scene: Scene,
        plan: Plan,
        panel: FloatArray,
        surroundings: FloatArray,
        clock: StageClock,
    ) -> None:
        self._scene = scene
        self._clock = clock
        self._panel = panel
        self._surroundings = surroundings
        self._limits = planned(plan, PixelEffect)
        self._noises = planned(plan, NoiseEffect)
        self._files = planned(plan, FileEffect)
        self._optics = Optics(panel_corners(scene))
        for effect in planned(plan, OpticsEffect):
            self._optics = effect.apply(scene, self._optics)
            clock.done(effect.name)

    def rows(self, seed: int, source: NoiseSource) -> Iterator[ExposedRows]:
        """Expose the rows from first to last."""
        make = ExactNoise if source == "exact" else ReusedNoise
        noise: Noise | None = None
        if self._noises:
            noise = make(self._noises, self._scene, seed, self._clock.done)
        columns = (self._panel, self._surroundings)
        for rows in picture_rows(self._scene, self._optics, *columns, self._clock.done):
            mean = rows.values
            for limit in self._limits:
                mean = limit.apply(self._scene, mean)
                self._clock.done(limit.name)
            deviation = None if noise is None else noise.deviation(mean, rows.last - rows.first)
            yield ExposedRows(rows, np.minimum(mean, np.float32(WHITE)), deviation)

    def picture(
        self, enhancement: Enhancement, seed: int, source: NoiseSource
    ) -> tuple[ByteArray, FloatArray]:
        """Make the picture.

        Returns
        -------
        image : ndarray of uint8, shape (rows, columns)
            Enhanced within the panel.
        profile : ndarray of float64, shape (columns,)
            Mean of the panel's pixels in each column before that; the column's value where the
            picture does not show the panel.
        """
        camera = self._scene.camera
        image = np.empty((camera.rows, camera.columns), dtype=np.uint8)
        tally = _ColumnTally(camera.columns)
        kept: list[Rows] = []
        for exposed in self.rows(seed, source):
            rows = exposed.rows
            block = image[rows.first : rows.last]
            if self._files:
                block[:] = exposed.to_bytes()
                kept.append(rows)
            else:
                _enhance(exposed, enhancement, block)
                tally.add(rows, exposed.mean, exposed.deviation)
            self._clock.done("image")
        if self._files:
            image = self._through_files(image)
            for rows in kept:
                block = image[rows.first : rows.last]
                tally.add(rows, block.astype(np.float32), None)
                _overlay(block, enhancement.of_bytes(block), rows.panel)
            self._clock.done("image")
        return image, tally.means(saturate(self._panel))

    def observed(self, observable: Observable, seed: int, source: NoiseSource) -> Pixels:
        """Give what the tolerance is of: pixel values before enhancement and rounding.

        Returns
        -------
        ndarray of float32
            ``"image"``: the panel's bounding rectangle, shape (rows, columns) of it; ``"profile"``:
            the means of its columns.
        """
        region = sight_of(self._scene).region
        camera = self._scene.camera
        image = np.empty((camera.rows, camera.columns), dtype=np.float32)
        for exposed in self.rows(seed, source):
            image[exposed.rows.first : exposed.rows.last] = exposed.values()
        if self._files:
            image = self._through_files(to_bytes(image)).astype(np.float32)
        seen = image[region.first_row : region.last_row, region.first_column : region.last_column]
        if observable == "image":
            return seen
        return np.asarray(seen.mean(axis=0, dtype=np.float64), dtype=np.float32)

    def _through_files(self, image: ByteArray) -> ByteArray:
        for file in self._files:
            image = file.apply(self._scene, image)
            self._clock.done(file.name)
        return image


def _enhance(exposed: ExposedRows, enhancement: Enhancement, out: ByteArray) -> None:
    """Round pixel values, enhanced within the panel."""
    rounded = exposed.to_bytes()
    if enhancement.needs_fractions:
        enhanced = enhancement(exposed.values())
    else:
        enhanced = enhancement.of_bytes(rounded)
    out[:] = rounded
    _overlay(out, enhanced, exposed.rows.panel)


def _overlay(image: ByteArray, enhanced: ByteArray, panel: slice | NDArray[np.bool_]) -> None:
    if isinstance(panel, slice):
        image[:, panel] = enhanced[:, panel]
    else:
        np.copyto(image, enhanced, where=panel)


class _ColumnTally:
    """The mean of the panel's pixels in each column."""

    def __init__(self, columns: int) -> None:
        self._sums = np.zeros(columns)
        self._counts = np.zeros(columns, dtype=np.int64)

    def add(self, rows: Rows, mean: Pixels, deviation: Pixels | None) -> None:
        """Count some rows in."""
        height = rows.last - rows.first
        if isinstance(rows.panel, slice):
            panel = rows.panel
            if panel.stop <= panel.start:
                return
            repeats = height if len(mean) == 1 else 1
            self._sums[panel] += repeats * _column_sums(mean[:, panel])
            if deviation is not None:
                self._sums[panel] += _column_sums(deviation[:, panel])
            self._counts[panel] += height
            return
        values = mean if deviation is None else mean + deviation
        self._sums += _column_sums(np.where(rows.panel, values, np.float32(0.0)))
        self._counts += np.count_nonzero(rows.panel, axis=0)

    def means(self, otherwise: FloatArray) -> FloatArray:
        """Give the means, and ``otherwise`` in columns without pixels."""
        means = self._sums / np.maximum(self._counts, 1)
        return np.asarray(np.where(self._counts > 0, means, otherwise))


def _column_sums(values: Pixels) -> FloatArray:
    sums = cv2.reduce(np.ascontiguousarray(values), 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
    return np.asarray(sums[0], dtype=np.float64)
