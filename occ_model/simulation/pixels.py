"""The pixels of a picture whose rows differ: exposed, saturated and stored some rows at a time."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.optics import Optics, Panel, in_blocks, picture_rows
from occ_model.camera.photometry import WHITE
from occ_model.effects.effect import FileEffect, NoiseEffect, OpticsEffect, PixelEffect
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import planned
from occ_model.results import Plan
from occ_model.scene.simulation_settings import NoiseSource, Observable
from occ_model.simulation.columns import Columns
from occ_model.simulation.draft_error import DraftedPanel
from occ_model.simulation.noise_source import NOISE_MAKERS, Noise, NoiseMaker
from occ_model.simulation.stage_timer import StageTimer


@dataclass(frozen=True, eq=False, slots=True)
class ExposedRows:
    """Some rows of pixels, before they are rounded.

    Parameters
    ----------
    place
        The rows of the picture that is made: those exposed, one below the other.
    values : ndarray of float32, shape (rows, columns)
        Pixel values from 0 to 255.
    panel
        Where the panel is.
    """

    place: slice
    values: Pixels
    panel: Panel

    def to_bytes(self, out: ByteArray) -> None:
        """Round the values to bytes."""
        cv2.convertScaleAbs(self.values, dst=out)


@dataclass(frozen=True, eq=False, slots=True)
class Pictures:
    """The camera's picture and the receiver's, with their column means.

    Parameters
    ----------
    camera_image, image : ndarray of uint8, shape (rows, columns)
        As the camera gives it, and enhanced within the panel.
    profile, signal : ndarray of float64, shape (columns,)
        Mean of the panel's pixels in each column, before enhancement and after it; the column's
        value where the picture does not show the panel.
    """

    camera_image: ByteArray
    image: ByteArray
    profile: FloatArray
    signal: FloatArray


class PixelExposure:
    """The pixels of a picture.

    Parameters
    ----------
    view
        The paper's view of the scene.
    plan
        Its effects are simulated.
    columns
        The pixel values of each column.
    timer
        Times each stage.
    bands
        The rows that are exposed, in order; None for the whole picture.
    """

    def __init__(
        self,
        view: PaperView,
        plan: Plan,
        columns: Columns,
        timer: StageTimer,
        bands: Sequence[range] | None = None,
    ) -> None:
        self._scene = scene = view.scene
        self._region = view.region
        self._timer = timer
        self._columns = columns
        self._limits = planned(plan, PixelEffect)
        self._noises = planned(plan, NoiseEffect)
        self._files = planned(plan, FileEffect)
        self._bands = bands or in_blocks(range(scene.camera.rows))
        height = sum(len(band) for band in self._bands)
        self._shape = (height, scene.camera.columns)
        self._optics = Optics(view.corners)
        for effect in planned(plan, OpticsEffect):
            self._optics = effect.apply(scene, self._optics)
            timer.stage_ended(effect.name)

    def drafted_panel(self, rows: range) -> DraftedPanel:
        """Return where a draft with these rows shows the panel."""
        columns = slice(self._region.first_column, self._region.last_column)
        size = (self._scene.camera.rows, self._scene.camera.columns)
        outline, blur = self._optics.outline, self._optics.blur
        found = [file.rounding_of_means(self._scene) for file in self._files]
        usual, most = (sum(sizes) for sizes in zip((0.0, 0.0), *found, strict=True))
        return DraftedPanel(rows, columns, outline, size, blur, usual, most)

    def rows(self, seed: int, source: NoiseSource | NoiseMaker) -> Iterator[ExposedRows]:
        """Expose the rows from first to last."""
        make = NOISE_MAKERS[source] if isinstance(source, str) else source
        noise: Noise | None = None
        place = 0
        if self._noises:
            noise = make(self._noises, self._scene, seed, self._timer.stage_ended)
        light = (self._columns.panel, self._columns.surroundings)
        ended = self._timer.stage_ended
        for rows in picture_rows(self._scene, self._optics, *light, ended, self._bands):
            mean = self._saturated(rows.values)
            height = len(rows.place)
            if noise is None:
                values = np.ascontiguousarray(np.broadcast_to(mean, (height, mean.shape[1])))
            else:
                values = noise.deviation(rows.values, height)
                values += mean
                np.clip(values, np.float32(0.0), np.float32(WHITE), out=values)
            yield ExposedRows(slice(place, place + height), values, rows.panel)
            place += height

    def _saturated(self, mean: Pixels) -> Pixels:
        """Limit mean values to those that a pixel can hold."""
        for limit in self._limits:
            mean = limit.apply(self._scene, mean)
            self._timer.stage_ended(limit.name)
        return np.minimum(mean, np.float32(WHITE))

    def pictures(
        self, enhancement: Enhancement, seed: int, source: NoiseSource | NoiseMaker
    ) -> Pictures:
        """Make the camera's picture and the receiver's, of the exposed rows."""
        camera_image = np.empty(self._shape, dtype=np.uint8)
        image = np.empty_like(camera_image)
        before, after = _ColumnMeans(self._shape[1]), _ColumnMeans(self._shape[1])
        panels: list[tuple[slice, Panel]] = []
        for exposed in self.rows(seed, source):
            rows, panel = exposed.place, exposed.panel
            exposed.to_bytes(out=camera_image[rows])
            if self._files:
                panels.append((rows, panel))
            else:
                before.add(panel, exposed.values)
                _enhance(camera_image[rows], enhancement, panel, out=image[rows])
                after.add(panel, image[rows])
            self._timer.stage_ended("image")
        if self._files:
            camera_image = self._through_files(camera_image)
            for rows, panel in panels:
                before.add(panel, camera_image[rows])
                _enhance(camera_image[rows], enhancement, panel, out=image[rows])
                after.add(panel, image[rows])
            self._timer.stage_ended("image")
        profile = self._columns.profile
        enhanced = enhancement(profile).astype(np.float64)
        return Pictures(camera_image, image, before.means(profile), after.means(enhanced))

    def observed(self, observable: Observable, seed: int, source: NoiseSource) -> Pixels:
        """Return the observable: pixel values before enhancement and rounding.

        Returns
        -------
        ndarray of float32
            ``"image"``: the panel's bounding rectangle, shape (rows, columns) of it; ``"profile"``:
            the means of its columns.
        """
        image = np.empty(self._shape, dtype=np.float32)
        for exposed in self.rows(seed, source):
            image[exposed.place] = exposed.values
        if self._files:
            image = self._through_files(to_bytes(image)).astype(np.float32)
        seen = self._region.crop(image)
        if observable == "image":
            return seen
        return np.asarray(seen.mean(axis=0, dtype=np.float64), dtype=np.float32)

    def _through_files(self, image: ByteArray) -> ByteArray:
        for file in self._files:
            image = file.apply(self._scene, image)
            self._timer.stage_ended(file.name)
        return image


def _enhance(
    camera_image: ByteArray, enhancement: Enhancement, panel: Panel, out: ByteArray
) -> None:
    """Enhance grey levels within the panel, and copy them beside it."""
    out[:] = camera_image
    if not isinstance(panel, slice):
        np.copyto(out, enhancement.of_bytes(camera_image), where=panel)
    elif panel.stop > panel.start:  # OpenCV has no pictures without columns
        out[:, panel] = enhancement.of_bytes(camera_image[:, panel])


class _ColumnMeans:
    """The mean of the panel's pixels in each column, from some rows at a time."""

    def __init__(self, columns: int) -> None:
        self._sums = np.zeros(columns)
        self._counts = np.zeros(columns, dtype=np.int64)

    def add(self, panel: Panel, values: Pixels | ByteArray) -> None:
        """Add some rows."""
        if not isinstance(panel, slice):
            self._sums += _column_sums(np.where(panel, values, values.dtype.type(0)))
            self._counts += np.count_nonzero(panel, axis=0)
        elif panel.stop > panel.start:
            self._sums[panel] += _column_sums(values[:, panel])
            self._counts[panel] += len(values)

    def means(self, otherwise: FloatArray) -> FloatArray:
        """Return the means, and ``otherwise`` in columns without pixels."""
        means = self._sums / np.maximum(self._counts, 1)
        return np.asarray(np.where(self._counts > 0, means, otherwise))


def _column_sums(values: Pixels | ByteArray) -> FloatArray:
    # Bytes are summed as integers, many times faster; a picture has too few rows to exceed 32 bits.
    exact = cv2.CV_32S if values.dtype == np.uint8 else cv2.CV_64F
    sums = cv2.reduce(values, 0, cv2.REDUCE_SUM, dtype=exact)
    return np.asarray(sums[0], dtype=np.float64)
