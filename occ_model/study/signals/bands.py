"""The rows of a picture, as a few bands that stand for all of them.

Stripes run along the rows; all else varies slowly from row to row. Where pixels show either the
panel or its surroundings, one band stands for all rows, with the fraction of each column that shows
the panel. Behind a lens, or in a file whose blocks have eight rows, some bands of eight rows do.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.coverage import Coverage, column_spans
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import FileEffect, OpticsEffect, region_of
from occ_model.effects.registry import effects_named
from occ_model.results.decoding import Region
from occ_model.scene.scene import Camera, Model, Scene, Transmitter

BLOCK = 8  # rows of a band, those of a block of a JPEG file
BANDS = 12


@dataclass(frozen=True, eq=False, slots=True)
class Bands:
    """What of a picture's rows does not depend on the light that is sent."""

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
    # Shape (bands, seen) and (columns,): factors of pixel values by the lens, in the bands and
    # beside them
    dimming: Pixels | None
    dimming_beside: Pixels | None

    @property
    def rows_each(self) -> float:
        """Rows of the picture for which a band stands."""
        return (self.span.rows if self.span else 0) / len(self.panel)

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
            values[:, mixed[0], mixed[1]] = pixel_value(
                dark + self.light[mixed] * (lit - dark), camera
            )
        if self.dimming is not None:
            values *= self.dimming
        return np.asarray(values)


def bands_of(scene: Scene, included: frozenset[str]) -> Bands:
    """Return the bands of a scene with effects of some names, cached."""
    return _bands_of(without_light(scene), included)


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
def _bands_of(scene: Scene, included: frozenset[str]) -> Bands:
    rows, columns = size = scene.camera.rows, scene.camera.columns
    optics = Optics(panel_corners(scene))
    for effect in effects_named(included, OpticsEffect):
        optics = effect.apply(scene, optics)
    span = region_of(optics.outline, rows, columns)
    if span is None:
        return Bands(size, None, slice(0), np.zeros((1, 0)), None, None, None)
    has_file = any(each.is_present(scene) for each in effects_named(included, FileEffect))
    if optics.is_plain and not has_file:
        first, last = column_spans(optics.outline, rows, columns)
        seen = np.flatnonzero(last > first)
        if not len(seen):
            return Bands(size, None, slice(0), np.zeros((1, 0)), None, None, None)
        span = Region(
            int(first[seen].min()), int(last[seen].max()), int(seen[0]), int(seen[-1]) + 1
        )
        seen_columns = slice(span.first_column, span.last_column)
        part = ((last - first) / span.rows).astype(np.float32)[None, seen_columns]
        return Bands(size, span, seen_columns, part, None, None, None)
    starts = _first_rows(span)
    coverage = Coverage(optics.outline, rows, columns, optics.blur)
    light = np.array(
        [coverage.rows(range(at, min(at + BLOCK, rows))).mean(axis=0) for at in starts]
    )
    lit = np.flatnonzero(light.any(axis=0))
    if not len(lit):
        return Bands(size, None, slice(0), np.zeros((1, 0)), None, None, None)
    first_block, last_block = int(lit[0]) // BLOCK, int(lit[-1]) // BLOCK + 1
    seen_columns = slice(first_block * BLOCK, min(last_block * BLOCK, columns))
    light = light[:, seen_columns]
    panel = (light >= 0.5).astype(np.float32)
    middle, everywhere = starts + 0.5 * (BLOCK - 1), slice(0, columns)
    for gain in optics.emission:
        light = light * gain.at(middle, seen_columns)
    beside = np.array([0.5 * span.first_row, 0.5 * (span.last_row + rows - 1)])
    dimming = dimming_beside = None
    if optics.transmission:
        dimming, at_ends = np.ones_like(light), np.ones((2, columns), dtype=np.float32)
        for gain in optics.transmission:
            dimming *= gain.at(middle, seen_columns)
            at_ends *= gain.at(beside, everywhere)
        power = 1.0 / scene.camera.gamma
        dimming, dimming_beside = dimming**power, at_ends.mean(axis=0) ** power
    return Bands(size, span, seen_columns, panel, light, dimming, dimming_beside)


def _first_rows(span: Region) -> FloatArray:
    """Return the first rows of the bands, blocks in the middles of equal parts of the span."""
    first, last = span.first_row // BLOCK, -(-span.last_row // BLOCK)
    count = min(BANDS, last - first)
    blocks = first + ((np.arange(count) + 0.5) * ((last - first) / count)).astype(int)
    return blocks * BLOCK
