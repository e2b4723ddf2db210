"""The pixels of a picture whose rows differ: exposed and stored some rows at a time, in threads."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
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
    PanelPart,
    PictureRows,
    Rows,
    split_at,
)
from occ_model.effects.effect import OpticsEffect, PaperView
from occ_model.effects.noise import noise_of
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import FullWell, Jpeg
from occ_model.parallel.job import Heartbeat
from occ_model.results.frame import Plan
from occ_model.scene.scene import Observable
from occ_model.simulation.columns import ColumnMeans, Columns
from occ_model.simulation.picture_noise import PictureNoise
from occ_model.simulation.pictures import Pictures
from occ_model.simulation.pixel_draw import PictureNumbers
from occ_model.simulation.stage_timer import StageTimer
from occ_model.simulation.threads import each_in_threads


@dataclass(frozen=True, eq=False, slots=True)
class _Band:
    """Rows to expose, and their place in the picture that is made."""

    place: slice
    rows: range


class PixelExposure:
    """The pixels of a picture.

    ``bands`` are the rows to expose, in order, all but the last of them whole blocks of a JPEG
    file. With ``panel_only`` the file has only the blocks that show the panel, which do not depend
    on others. Without ``mean``, the mean pixel values are those of the view's single panel.
    """

    def __init__(
        self,
        view: PaperView,
        plan: Plan,
        columns: Columns,
        timer: StageTimer,
        bands: Sequence[range],
        *,
        panel_only: bool = False,
        mean: PictureRows | None = None,
    ) -> None:
        self._panel_only = panel_only
        self._scene = scene = view.scene
        self._region = view.region
        self._timer = timer
        self._columns = columns
        self._limits = effects_named(plan.included, FullWell)
        self._noise = noise_of(scene, plan.included)
        self._files = effects_named(plan.included, Jpeg)
        self._bands = bands
        self._shape = (sum(len(band) for band in bands), scene.camera.columns)
        for file in self._files:
            file.check_size(scene, self._shape)
        self._optics = Optics(view.corners)
        for effect in effects_named(plan.included, OpticsEffect):
            self._optics = effect.apply(scene, self._optics)
            timer.end_stage(effect.name)
        if self._optics.is_plain and not self._files and view.sides:
            # Then all rows of a band are equal.
            ends = self._region.first_row, self._region.last_row
            self._bands = [part for band in bands for part in split_at(band, ends)]
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

    def _split_bands(self) -> Iterator[_Band]:
        place = 0
        for rows in self._bands:
            yield _Band(slice(place, place + len(rows)), rows)
            place += len(rows)

    def _split_panel(self) -> tuple[list[_Band], list[_Band]]:
        """Return the bands that show the panel, if these are few, and all others."""
        bands = list(self._split_bands())
        shows = [self._mean.may_show_panel(band.rows) for band in bands]
        first = [band for band, is_seen in zip(bands, shows, strict=True) if is_seen]
        if 2 * sum(len(band.rows) for band in first) > self._shape[0]:
            return [], bands
        return first, [band for band, is_seen in zip(bands, shows, strict=True) if not is_seen]

    def _expose(
        self, mean: Rows, noise: PictureNoise | None, timer: StageTimer, out: ByteArray
    ) -> Pixels | ByteArray:
        """Return the pixel values of some rows: unrounded, or ``out`` with drawn grey levels."""
        if noise is not None and noise.is_drawn:
            noise.draw(mean, out, timer.end_stage)
            return out
        values = mean.values if noise is None else noise.vary(mean, timer.end_stage)
        for limit in self._limits:
            values = limit.apply(self._scene, values)
            timer.end_stage(limit.name)
        return np.minimum(values, np.float32(WHITE))

    def _expose_band(
        self, camera_image: ByteArray, noise: PictureNoise | None, band: _Band
    ) -> tuple[tuple[slice, PanelPart], ColumnMeans, StageTimer]:
        """Expose and store a band; return where it shows the panel, its means and its times."""
        timer = StageTimer()
        camera, means = camera_image[band.place], ColumnMeans(self._shape[1])
        mean = self._mean.of(band.rows, timer.end_stage)
        values = self._expose(mean, noise, timer, camera)
        if values is not camera:
            cv2.convertScaleAbs(values, dst=camera)
        timer.end_stage("image")
        stored = self._stored_columns(mean)
        for file in self._files if stored else ():
            camera[:, stored] = file.apply(self._scene, camera[:, stored])
            timer.end_stage(file.name)
        means.add(mean.panel, camera if self._files else values)
        timer.end_stage("image")
        return (band.place, mean.panel), means, timer

    def pictures(
        self,
        enhancement: Enhancement,
        numbers: PictureNumbers,
        heartbeat: Heartbeat = lambda: None,
        show_panel: Callable[[slice, Pictures], object] | None = None,
    ) -> Pictures:
        """Make the camera's and the receiver's picture of the exposed rows.

        ``show_panel`` is called with the place of the rows that show the panel, and with their
        picture, where they are so few that it is worth while to make them first.
        """
        camera_image = np.empty(self._shape, dtype=np.uint8)
        expose = partial(self._expose_band, camera_image, self._prepare_noise(numbers))
        means = ColumnMeans(self._shape[1])
        panels: list[tuple[slice, PanelPart]] = []

        def pictures_in(place: slice) -> Pictures:
            values, timings, top = self._columns.profile, self._timer.timings, place.start
            shown = [(slice(at.start - top, at.stop - top), panel) for at, panel in panels]
            return Pictures(
                camera_image[place], means.means(values), shown, enhancement, values, timings
            )

        def beat_for_each(bands: Sequence[_Band]) -> Iterator[_Band]:
            for band in bands:
                heartbeat()
                yield band

        first, others = self._split_panel() if show_panel else ([], self._split_bands())
        timers: list[StageTimer] = []
        for panel, of_band, timer in each_in_threads(expose, beat_for_each([*first, *others])):
            means.include(of_band)
            panels.append(panel)
            timers.append(timer)
            if show_panel is not None and len(panels) == len(first):  # threads go on meanwhile
                self._timer.end_parallel_stages(timers)
                timers.clear()
                place = slice(first[0].place.start, first[-1].place.stop)
                show_panel(place, pictures_in(place))
                self._timer.skip()
        self._timer.end_parallel_stages(timers)
        return pictures_in(slice(0, self._shape[0]))

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
            drawn = np.empty((len(band.rows), self._shape[1]), dtype=np.uint8)
            values = self._expose(self._mean.of(band.rows), noise, StageTimer(), drawn)
            for file in self._files:
                values = file.apply(self._scene, np.asarray(cv2.convertScaleAbs(values), np.uint8))
            image[band.place] = values
        region, above = self._region, self._bands[0].start
        rows = slice(region.first_row - above, region.last_row - above)
        seen = image[rows, region.first_column : region.last_column]
        if observable == "image":
            return seen
        return np.asarray(seen.mean(axis=0, dtype=np.float64), dtype=np.float32)
