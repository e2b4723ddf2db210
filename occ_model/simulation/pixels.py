"""The pixels of a picture whose rows differ: exposed and stored some rows at a time, in threads."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import cv2
import numpy as np

from occ_model.arrays import ByteArray, Pixels
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import WHITE
from occ_model.camera.picture_rows import (
    JPEG_BLOCK,
    LitPanel,
    PictureRows,
    Rows,
    split_at,
    split_into_blocks,
)
from occ_model.effects.effect import FileEffect, OpticsEffect, PaperView, PixelEffect
from occ_model.effects.noise import noise_of
from occ_model.effects.registry import effects_planned
from occ_model.parallel.job import Heartbeat
from occ_model.results.frame import Plan
from occ_model.scene.scene import Observable
from occ_model.simulation.columns import ColumnMeans, Columns
from occ_model.simulation.picture_noise import PictureNoise
from occ_model.simulation.pictures import Pictures, ShownPanel
from occ_model.simulation.pixel_draw import PictureNumbers
from occ_model.simulation.stage_timer import StageTimer
from occ_model.simulation.threads import each_in_threads


@dataclass(frozen=True, eq=False, slots=True)
class ExposedRows:
    """Some rows of pixels before rounding."""

    place: slice  # Their place in the picture, in which the exposed rows are one below the other
    # Shape (rows, columns): pixel values from 0 to 255, whole ones if they are drawn
    values: Pixels | ByteArray
    mean: Rows  # The same without noise, and the place of the panel


@dataclass(frozen=True, eq=False, slots=True)
class _Band:
    """Rows to expose, and their place in the picture that is made."""

    place: slice
    rows: range


class PixelExposure:
    """The pixels of a picture.

    ``bands`` are the rows to expose, in order, all but the last of them whole blocks of a JPEG
    file; None exposes all. With ``panel_only`` the file has only the blocks that show the panel,
    which do not depend on others. ``mean`` are the mean pixel values, if they are not those of a
    single panel.
    """

    def __init__(
        self,
        view: PaperView,
        plan: Plan,
        columns: Columns,
        timer: StageTimer,
        bands: Sequence[range] | None = None,
        *,
        panel_only: bool = False,
        mean: PictureRows | None = None,
    ) -> None:
        self._panel_only = panel_only
        self._scene = scene = view.scene
        self._region = view.region
        self._timer = timer
        self._columns = columns
        self._limits = effects_planned(plan, PixelEffect)
        self._noise = noise_of(scene, plan.included)
        self._files = effects_planned(plan, FileEffect)
        self._bands = bands or split_into_blocks(range(scene.camera.rows), scene.camera.columns)
        height = sum(len(band) for band in self._bands)
        self._shape = (height, scene.camera.columns)
        for file in self._files:
            file.check_size(scene, self._shape)
        self._optics = Optics(view.corners)
        for effect in effects_planned(plan, OpticsEffect):
            self._optics = effect.apply(scene, self._optics)
            timer.end_stage(effect.name)
        if self._optics.is_plain and not self._files and view.sides:
            # Then all rows of a band are equal.
            ends = self._region.first_row, self._region.last_row
            self._bands = [part for band in self._bands for part in split_at(band, ends)]
        self._brightest = math.inf
        if mean is None:
            lit = LitPanel(self._optics, columns.panel)
            mean = PictureRows(scene.camera, [lit], columns.surroundings)
            self._brightest = max(float(columns.panel.max()), float(columns.surroundings.max()))
        self._mean = mean
        timer.end_stage(self._optics.cover_stage)

    def _prepare_noise(self, numbers: PictureNumbers) -> PictureNoise | None:
        if self._noise is None:
            return None
        return PictureNoise(self._noise, self._scene, self._brightest, numbers)

    def _split_bands(self, heartbeat: Heartbeat = lambda: None) -> Iterator[_Band]:
        place = 0
        for rows in self._bands:
            heartbeat()
            yield _Band(slice(place, place + len(rows)), rows)
            place += len(rows)

    def _expose(
        self,
        band: _Band,
        noise: PictureNoise | None,
        timer: StageTimer,
        out: ByteArray | None = None,
    ) -> ExposedRows:
        """Expose some rows; pixels that are drawn may have a place, ``out``."""
        mean = self._mean.of(band.rows, timer.end_stage)
        if noise is not None and noise.is_drawn:
            drawn = np.empty((len(band.rows), self._shape[1]), np.uint8) if out is None else out
            noise.draw(mean, drawn, timer.end_stage)
            return ExposedRows(band.place, drawn, mean)
        each_row = mean.expand_rows()
        if noise is None:
            return ExposedRows(band.place, self._limit_values(each_row, timer).values, mean)
        varied = noise.vary(each_row, timer.end_stage)
        held = self._limit_values(replace(each_row, nodes=varied, rims=()), timer)
        return ExposedRows(band.place, held.nodes, mean)

    def _limit_values(self, mean: Rows, timer: StageTimer) -> Rows:
        """Limit mean values to what a pixel can hold."""
        for limit in self._limits:
            mean = mean.change_nodes(partial(limit.apply, self._scene))
            timer.end_stage(limit.name)
        return mean.change_nodes(lambda values: np.minimum(values, np.float32(WHITE)))

    def pictures(
        self,
        enhancement: Enhancement,
        numbers: PictureNumbers,
        heartbeat: Heartbeat = lambda: None,
    ) -> Pictures:
        """Make the camera's and the receiver's picture of the exposed rows."""
        camera_image = np.empty(self._shape, dtype=np.uint8)
        noise = self._prepare_noise(numbers)

        def make(band: _Band) -> tuple[ShownPanel, ColumnMeans, StageTimer]:
            timer = StageTimer()
            camera = camera_image[band.place]
            exposed = self._expose(band, noise, timer, camera)
            means, panel = ColumnMeans(self._shape[1]), exposed.mean.panel
            if exposed.values is not camera:
                cv2.convertScaleAbs(exposed.values, dst=camera)
            timer.end_stage("image")
            stored = self._stored_columns(exposed.mean)
            for file in self._files if stored else ():
                camera[:, stored] = file.apply(self._scene, camera[:, stored])
                timer.end_stage(file.name)
            means.add(panel, camera if self._files else exposed.values)
            timer.end_stage("image")
            return ShownPanel(band.place, panel), means, timer

        means = ColumnMeans(self._shape[1])
        panels, timers = [], []
        for panel, of_band, timer in each_in_threads(make, self._split_bands(heartbeat)):
            means.include(of_band)
            panels.append(panel)
            timers.append(timer)
        self._timer.end_parallel_stages(timers)
        own = self._columns.profile
        return Pictures(
            camera_image, means.means(own), panels, enhancement, own, self._timer.timings
        )

    def _stored_columns(self, rows: Rows) -> slice | None:
        """Return the columns that are stored in the file; None if it has none of these rows."""
        if not self._panel_only:
            return slice(0, self._shape[1])
        shown = [*rows.inside, *(rim.columns for rim in rows.rims)]
        if not shown:
            return None
        first, last = min(part.start for part in shown), max(part.stop for part in shown)
        end = min(-(-last // JPEG_BLOCK) * JPEG_BLOCK, self._shape[1])
        return slice(first // JPEG_BLOCK * JPEG_BLOCK, end)

    def observe(self, observable: Observable, numbers: PictureNumbers) -> Pixels:
        """Simulate an observable before enhancement and rounding.

        ``"image"`` gives the pixels of the panel's bounding rectangle, ``"profile"`` the means of
        its columns.
        """
        image = np.empty(self._shape, dtype=np.float32)
        noise = self._prepare_noise(numbers)
        for band in self._split_bands():
            exposed = self._expose(band, noise, StageTimer())
            image[exposed.place] = exposed.values
            for file in self._files:
                whole = np.asarray(cv2.convertScaleAbs(exposed.values), dtype=np.uint8)
                image[exposed.place] = file.apply(self._scene, whole)
        region, above = self._region, self._bands[0].start
        rows = slice(region.first_row - above, region.last_row - above)
        seen = image[rows, region.first_column : region.last_column]
        if observable == "image":
            return seen
        return np.asarray(seen.mean(axis=0, dtype=np.float64), dtype=np.float32)
