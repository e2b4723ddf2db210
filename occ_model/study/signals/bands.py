"""The rows of a picture, as a few bands that stand for all of them.

Stripes run along the rows; all else varies slowly from row to row. Where pixels show either the
panel or its surroundings, one band stands for all rows, with the fraction of each column that shows
the panel. Behind a lens, or in a file whose blocks have eight rows, some bands of eight rows do.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.coverage import Coverage, column_spans, rows_inside
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.picture_rows import JPEG_BLOCK
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import OpticsEffect, region_of
from occ_model.effects.registry import effects_named
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.decoding import Region
from occ_model.scene.scene import Camera, Model, Scene, Transmitter
from occ_model.simulation.pixel_draw import GainPattern

BANDS = 12


@dataclass(frozen=True, eq=False, slots=True)
class Bands:
    """Bands of rows, as far as they do not depend on the light that is sent."""

    size: tuple[int, int]  # Rows and columns of the picture
    # The rectangle round the panel's image, all of whose rows the bands stand for; None if no panel
    # is in view
    span: Region | None
    # The columns of the bands, beyond which no pixel has light of the panel: ``seen`` below
    columns: slice
    # Shape (bands, seen): the fraction of the pixels that show the panel and are enhanced
    panel: Pixels
    # Shape (bands, seen): the panel's light in each pixel as a fraction; None if all pixels show
    # either the panel or the surroundings
    light: Pixels | None
    # Shape (bands, seen): the weights of the bands in a column's mean, to which the surroundings
    # add what is missing; None if all are equal
    weights: Pixels | None
    # Shape (bands, seen) and (columns,): factors of pixel values by the lens, in the bands and
    # beside them
    dimming: Pixels | None
    dimming_beside: Pixels | None

    def expose(self, panel: FloatArray, around: FloatArray, camera: Camera) -> Pixels:
        """Return the mean pixel values of the bands before saturation, (images, bands, seen).

        ``panel`` and ``around``, (images, seen), are values on the panel and beside it.
        """
        assert self.light is not None  # noqa: S101 - only called where light is mixed
        low, high = around[:, None].astype(np.float32), panel[:, None].astype(np.float32)
        values = np.where(self.light == 1.0, high, low)
        mixed = np.nonzero((self.light != 0.0) & (self.light != 1.0))
        if len(mixed[0]):
            dark = np.broadcast_to(luminance_of(around, camera), panel.shape)[:, mixed[1]]
            lit = luminance_of(panel[:, mixed[1]], camera)
            light = dark + np.asarray(self.light[mixed], dtype=np.float64) * (lit - dark)
            values[:, mixed[0], mixed[1]] = pixel_value(light, camera)
        if self.dimming is not None:
            values *= self.dimming
        return np.asarray(values)


def without_light(scene: Scene) -> Scene:
    """Return a scene of which only what bands, noise and receiver depend on is kept."""
    sent = scene.transmitter
    transmitter = Transmitter(
        panel_width=sent.panel_width, panel_height=sent.panel_height,
        lambertian_order=sent.lambertian_order,
    )  # fmt: skip
    camera = replace(scene.camera, exposure_time=Camera().exposure_time)
    model = Model(enhancement=scene.model.enhancement)
    return replace(scene, transmitter=transmitter, camera=camera, model=model)


@lru_cache(maxsize=32)
def bands_of(scene: Scene, included: frozenset[str]) -> Bands:
    """Return the bands of a scene :func:`without_light`, with effects of some names."""
    rows, columns = size = scene.camera.rows, scene.camera.columns
    optics = Optics(panel_corners(scene))
    for effect in effects_named(included, OpticsEffect):
        optics = effect.apply(scene, optics)
    span = region_of(optics.outline, rows, columns)
    if span is None:
        return _without_panel(size)
    has_file = any(each.is_present(scene) for each in effects_named(included, Jpeg))
    if optics.is_plain and not has_file:
        first, last = column_spans(optics.outline, rows, columns)
        seen = np.flatnonzero(last > first)
        if not len(seen):
            return _without_panel(size)
        span = Region(
            int(first[seen].min()), int(last[seen].max()), int(seen[0]), int(seen[-1]) + 1
        )
        seen_columns = slice(span.first_column, span.last_column)
        part = ((last - first) / span.rows).astype(np.float32)[None, seen_columns]
        return Bands(size, span, seen_columns, part, None, None, None, None)
    return _sample_rows(scene, optics, span)


def _without_panel(size: tuple[int, int]) -> Bands:
    return Bands(size, None, slice(0), np.zeros((1, 0), np.float32), None, None, None, None)


def _sample_rows(scene: Scene, optics: Optics, span: Region) -> Bands:
    rows, columns = size = scene.camera.rows, scene.camera.columns
    starts = _first_rows(span)
    coverage = Coverage(optics.outline, rows, columns, optics.blur)
    covered = np.array(
        [
            coverage.rows(range(at, min(at + JPEG_BLOCK, rows))).mean(axis=0)
            for at in starts.tolist()
        ]
    )
    lit = np.flatnonzero(covered.any(axis=0))
    if not len(lit):
        return _without_panel(size)
    first = int(lit[0]) // JPEG_BLOCK * JPEG_BLOCK
    last = (int(lit[-1]) // JPEG_BLOCK + 1) * JPEG_BLOCK
    seen = slice(first, min(last, columns))
    light: Pixels = covered[:, seen].astype(np.float32)
    panel = (light >= 0.5).astype(np.float32)
    weights = _weights(panel, optics.outline, span, columns, seen)
    middle = np.asarray(starts + 0.5 * (JPEG_BLOCK - 1), dtype=np.float64)
    for gain in optics.emission:
        light = np.multiply(light, gain.at(middle, seen))
    if not optics.transmission:
        return Bands(size, span, seen, panel, light, weights, None, None)
    beside = np.array([0.5 * span.first_row, 0.5 * (span.last_row + rows - 1)])
    dimming, dimming_beside = np.ones_like(light), np.ones((2, columns), dtype=np.float32)
    for gain in optics.transmission:
        dimming = np.multiply(dimming, gain.at(middle, seen))
        dimming_beside = np.multiply(dimming_beside, gain.at(beside, slice(0, columns)))
    power = np.float32(1.0 / scene.camera.gamma)
    beside_bands = dimming_beside.mean(axis=0) ** power
    return Bands(size, span, seen, panel, light, weights, dimming**power, beside_bands)


def _weights(panel: Pixels, outline: FloatArray, span: Region, columns: int, seen: slice) -> Pixels:
    """Return the bands' weights: the fraction of a column's rows that each stands for.

    A band that shows the panel stands only for rows inside the panel; the surroundings stand for
    the other rows of its part.
    """
    count = len(panel)
    ends = np.linspace(span.first_row, span.last_row, count + 1)
    crossed = rows_inside(outline, ends, columns)[:, seen] / span.rows
    shown = (panel * crossed).sum(axis=0)
    own = crossed * (crossed.sum(axis=0) / np.where(shown > 0.0, shown, np.inf))
    return np.asarray(np.where(panel == 1.0, own, 1.0 / count - crossed), dtype=np.float32)


def _first_rows(span: Region) -> IndexArray:
    """Return the first rows of the bands, blocks in the middles of equal parts of the span."""
    first, last = span.first_row // JPEG_BLOCK, -(-span.last_row // JPEG_BLOCK)
    count = min(BANDS, last - first)
    blocks = first + ((np.arange(count) + 0.5) * ((last - first) / count)).astype(int)
    return np.asarray(blocks * JPEG_BLOCK)


@lru_cache(maxsize=64)
def column_gains(variation: float, seed: int, size: tuple[int, int], span: Region) -> Pixels:
    """Return the mean difference from 1 of a sensor's gains in each column of the span's rows."""
    pattern = GainPattern(variation, 1.0, seed, size)
    return np.asarray(pattern.column_means(span.first_row, span.last_row) - 1.0, dtype=np.float32)
