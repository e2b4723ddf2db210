"""The pixels of a picture whose rows differ: exposed, saturated and stored some rows at a time."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.enhancement import Enhancement, to_bytes
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import WHITE
from occ_model.camera.picture_rows import LitPanel, PictureRows, Rows, split_at, split_into_blocks
from occ_model.effects.effect import FileEffect, NoiseEffect, OpticsEffect, PixelEffect
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import effects_planned
from occ_model.parallel.job import Heartbeat
from occ_model.results.plan import Plan
from occ_model.scene.simulation_settings import NoiseSource, Observable
from occ_model.simulation.columns import ColumnMeans, Columns
from occ_model.simulation.draft_error import DraftedPanel
from occ_model.simulation.noise import NOISE_MAKERS, Drawn, NoiseMaker, NoiseSpread
from occ_model.simulation.stage_timer import StageTimer
from occ_model.simulation.threads import each_in_threads

_BLOCK = 8  # columns and rows of a block of a JPEG file


@dataclass(frozen=True, eq=False, slots=True)
class ExposedRows:
    """Some rows of pixels, before they are rounded."""

    place: slice  # The rows of the picture that is made: those exposed, one below the other
    values: Pixels  # Shape (rows, columns): pixel values from 0 to 255
    mean: Rows  # The same without noise, and where the panel is


@dataclass(frozen=True, eq=False, slots=True)
class Pictures:
    """The camera's picture and the receiver's, with their column means."""

    # Shape (rows, columns): the camera's, and enhanced within the panel
    camera_image: ByteArray
    image: ByteArray
    # Shape (columns,): mean of the panel's pixels in each column, before enhancement and after it;
    # the column's value where the picture does not show the panel
    profile: FloatArray
    signal: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class _Band:
    """Rows to expose: their place in the picture that is made, their own, and their noise."""

    place: slice
    rows: range
    drawn: Drawn | None
    timer: StageTimer


class PixelExposure:
    """The pixels of a picture.

    ``bands``: the rows exposed, in order and whole blocks of a JPEG file but the last; None for
    all. ``panel_only``: whether the file has only the blocks that show the panel, which do not
    depend on others. ``mean``: the mean pixel values, where they are not those of one panel.
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
        self._noises = effects_planned(plan, NoiseEffect)
        self._files = effects_planned(plan, FileEffect)
        self._bands = bands or split_into_blocks(range(scene.camera.rows))
        height = sum(len(band) for band in self._bands)
        self._shape = (height, scene.camera.columns)
        for file in self._files:
            file.check_size(scene, self._shape)
        self._optics = Optics(view.corners)
        for effect in effects_planned(plan, OpticsEffect):
            self._optics = effect.apply(scene, self._optics)
            timer.stage_ended(effect.name)
        if self._optics.is_plain and not self._files and view.sides:
            # All rows of a band are equal then.
            ends = self._region.first_row, self._region.last_row
            self._bands = [part for band in self._bands for part in split_at(band, ends)]
        self._mean = mean or PictureRows(
            scene.camera, [LitPanel(self._optics, columns.panel)], columns.surroundings
        )
        timer.stage_ended(self._optics.cover_stage)

    def drafted_panel(self, rows: range) -> DraftedPanel:
        columns = slice(self._region.first_column, self._region.last_column)
        size = (self._scene.camera.rows, self._scene.camera.columns)
        outline, blur = self._optics.outline, self._optics.blur
        rounding = sum(file.rounding_of_means(self._scene) for file in self._files)
        return DraftedPanel(rows, columns, outline, size, blur, rounding)

    def rows(self, seed: int, source: NoiseSource | NoiseMaker) -> Iterator[ExposedRows]:
        spreads: dict[Sequence[NoiseEffect], NoiseSpread] = {}
        for band in self._drawn(seed, source):
            yield self._exposed(band, spreads)

    def _drawn(
        self,
        seed: int,
        source: NoiseSource | NoiseMaker,
        heartbeat: Heartbeat = lambda: None,
    ) -> Iterator[_Band]:
        make = NOISE_MAKERS[source] if isinstance(source, str) else source
        noise = make(self._noises, self._scene, seed) if self._noises else None
        place = 0
        for rows in self._bands:
            heartbeat()
            timer = StageTimer()
            drawn = None
            if noise is not None:
                drawn = noise.draw(len(rows))
                timer.stage_ended(self._noises[-1].name)
            yield _Band(slice(place, place + len(rows)), rows, drawn, timer)
            place += len(rows)

    def _exposed(
        self, band: _Band, spreads: dict[Sequence[NoiseEffect], NoiseSpread]
    ) -> ExposedRows:
        timer = band.timer
        timer.begin()
        mean = self._mean.of(band.rows, timer.stage_ended)
        each_row = mean.expand_rows()
        values: Pixels | None = None
        for effects, normal in band.drawn() if band.drawn else ():
            if effects not in spreads:
                spreads[effects] = NoiseSpread(effects, self._scene)
            spreads[effects].scale(normal, mean, each_row)
            values = normal if values is None else np.add(values, normal, out=values)
            timer.stage_ended(effects[-1].name)
        held = self._held(each_row, timer)
        if values is None:
            return ExposedRows(band.place, held.values, mean)
        held.combine(np.add, values, held.nodes, [rim.values for rim in held.rims])
        np.clip(values, np.float32(0.0), np.float32(WHITE), out=values)
        return ExposedRows(band.place, values, mean)

    def _held(self, mean: Rows, timer: StageTimer) -> Rows:
        """Limit mean values to those that a pixel can hold."""
        for limit in self._limits:
            mean = mean.change_values(partial(limit.apply, self._scene))
            timer.stage_ended(limit.name)
        return mean.change_values(lambda values: np.minimum(values, np.float32(WHITE)))

    def pictures(
        self,
        enhancement: Enhancement,
        seed: int,
        source: NoiseSource | NoiseMaker,
        heartbeat: Heartbeat = lambda: None,
    ) -> Pictures:
        """Make the camera's picture and the receiver's, of the exposed rows."""
        camera_image = np.empty(self._shape, dtype=np.uint8)
        image = np.empty_like(camera_image)
        spreads: dict[Sequence[NoiseEffect], NoiseSpread] = {}

        def make(band: _Band) -> tuple[ColumnMeans, ColumnMeans, StageTimer]:
            exposed, timer = self._exposed(band, spreads), band.timer
            before, after = ColumnMeans(self._shape[1]), ColumnMeans(self._shape[1])
            camera, receiver = camera_image[band.place], image[band.place]
            cv2.convertScaleAbs(exposed.values, dst=camera)
            timer.stage_ended("image")
            stored = self._stored_columns(exposed.mean)
            for file in self._files if stored else ():
                camera[:, stored] = file.apply(self._scene, camera[:, stored])
                timer.stage_ended(file.name)
            before.add(exposed.mean, camera if self._files else exposed.values)
            _enhance(camera, enhancement, exposed.mean, out=receiver)
            after.add(exposed.mean, receiver)
            timer.stage_ended("image")
            return before, after, timer

        before, after = ColumnMeans(self._shape[1]), ColumnMeans(self._shape[1])
        timers = []
        for of_camera, of_receiver, timer in each_in_threads(
            make, self._drawn(seed, source, heartbeat)
        ):
            before.include(of_camera)
            after.include(of_receiver)
            timers.append(timer)
        self._timer.parallel_stages_ended(timers)
        profile = self._columns.profile
        enhanced = enhancement(profile).astype(np.float64)
        return Pictures(camera_image, image, before.means(profile), after.means(enhanced))

    def _stored_columns(self, rows: Rows) -> slice | None:
        """Return the columns that the file is made of, None for none of these rows."""
        if not self._panel_only:
            return slice(0, self._shape[1])
        shown = [*rows.inside, *(rim.columns for rim in rows.rims)]
        if not shown:
            return None
        first, last = min(part.start for part in shown), max(part.stop for part in shown)
        return slice(first // _BLOCK * _BLOCK, min(-(-last // _BLOCK) * _BLOCK, self._shape[1]))

    def observed(self, observable: Observable, seed: int, source: NoiseSource) -> Pixels:
        """Return pixel values before enhancement and rounding, of all bands or the panel's.

        ``"image"``: of the panel's bounding rectangle; ``"profile"``: the means of its columns.
        """
        image = np.empty(self._shape, dtype=np.float32)
        for exposed in self.rows(seed, source):
            values = exposed.values
            for file in self._files:
                read = file.apply(self._scene, to_bytes(values))
                values = read.astype(np.float32)
            image[exposed.place] = values
        region, above = self._region, self._bands[0].start
        rows = slice(region.first_row - above, region.last_row - above)
        seen = image[rows, region.first_column : region.last_column]
        if observable == "image":
            return seen
        return np.asarray(seen.mean(axis=0, dtype=np.float64), dtype=np.float32)


def _enhance(camera_image: ByteArray, enhancement: Enhancement, rows: Rows, out: ByteArray) -> None:
    """Enhance grey levels within the panel, and copy them beside it."""
    out[:] = camera_image
    for columns in rows.inside:
        enhancement.enhance_bytes(camera_image[:, columns], out[:, columns])
    for rim in rows.rims:
        enhanced = enhancement.enhance_bytes(camera_image[:, rim.columns])
        np.copyto(out[:, rim.columns], enhanced, where=rim.inside)
