"""Optics: the panel as the lens pictures it, and the mean pixel values, some rows at a time.

Rows are computed while they are in the processor's cache, and the largest picture needs little more
memory than its own bytes.
"""

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.coverage import Coverage
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.projection import row_spans
from occ_model.scene.scene import Camera, Scene


@dataclass(frozen=True, eq=False, slots=True)
class Gain:
    """A factor of each pixel's light.

    Parameters
    ----------
    stage
        The stage that its time is counted under.
    rows
        Gives the factors of some rows.
    """

    stage: str
    rows: Callable[[range], Pixels]


STAGE = "optics"
"""The stage that the time of no effect in particular is counted under."""

BLOCK_ROWS = 64
"""Rows that are computed at once."""


@dataclass(frozen=True, eq=False, slots=True)
class Optics:
    """The imaging of the panel: outline, blur and gains.

    Parameters
    ----------
    outline : ndarray of float64, shape (corners, 2)
        The panel's outline in the picture, (column, row) of each corner; four for a lens without
        distortion.
    blur
        Standard deviation of the lens's blur in pixels.
    emission
        Factors of the panel's own light.
    transmission
        Factors of all light.
    cover_stage
        The stage that the time to compute the panel's coverage is counted under.
    """

    outline: FloatArray
    blur: float = 0.0
    emission: tuple[Gain, ...] = field(default=())
    transmission: tuple[Gain, ...] = field(default=())
    cover_stage: str = STAGE

    @property
    def is_plain(self) -> bool:
        """Whether every pixel shows either the panel or its surroundings, just as bright."""
        plain_outline = len(self.outline) == 4
        return plain_outline and not (self.blur or self.emission or self.transmission)


Panel: TypeAlias = slice | NDArray[np.bool_]
"""Where the panel is in some rows: the same columns of each, or an array of them all."""


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    """Some rows of a picture.

    Parameters
    ----------
    place
        Which rows of the picture they are.
    values : ndarray of float32, shape (rows, columns), or (1, columns) where all are alike
        Mean pixel values before saturation.
    panel : slice, or ndarray of bool, shape (rows, columns)
        Where the panel is.
    """

    place: range
    values: Pixels
    panel: Panel


def picture_rows(
    scene: Scene,
    optics: Optics,
    panel: FloatArray,
    surroundings: FloatArray,
    stage_ended: Callable[[str], object],
    bands: Sequence[range] | None = None,
) -> Iterator[Rows]:
    """Compute the picture's mean pixel values, from the first rows to the last.

    Parameters
    ----------
    scene
        The scene.
    optics
        The imaging of the panel.
    panel, surroundings : ndarray of float64, shape (columns,)
        Pixel values of each column before saturation.
    stage_ended
        Called with the name of each stage that has just ended.
    bands
        The rows that are computed, in order; None for the whole picture.
    """
    bands = bands or in_blocks(range(scene.camera.rows))
    if optics.is_plain:
        parts = _plain_rows(scene.camera, optics.outline, panel, surroundings, bands)
    else:
        parts = _mixed_rows(scene.camera, optics, panel, surroundings, bands, stage_ended)
    for rows in parts:
        stage_ended(STAGE)
        yield rows


def in_blocks(rows: range) -> list[range]:
    """Divide rows, or every k-th row, of a picture into those that are computed at once."""
    return [rows[start : start + BLOCK_ROWS] for start in range(0, len(rows), BLOCK_ROWS)]


def _plain_rows(
    camera: Camera,
    corners: FloatArray,
    panel: FloatArray,
    surroundings: FloatArray,
    bands: Sequence[range],
) -> Iterator[Rows]:
    first, last = row_spans(corners, camera.rows, camera.columns)
    panel_row = panel.astype(np.float32)[None, :]
    dark_row = surroundings.astype(np.float32)[None, :]
    changed = (first[1:] != first[:-1]) | (last[1:] != last[:-1])
    # Where the span changes every row or two, blocks of different rows are faster.
    level = np.count_nonzero(changed) <= camera.rows / BLOCK_ROWS
    breaks = (np.flatnonzero(changed) + 1).tolist() if level else []
    column = np.arange(camera.columns)
    shown, row = None, dark_row
    for band in bands:
        if not level:
            place = slice(band.start, band.stop, band.step)
            inside = (column >= first[place, None]) & (column < last[place, None])
            yield Rows(band, np.where(inside, panel_row, dark_row), inside)
            continue
        within = (bisect_left(band, at) for at in breaks if band.start < at <= band[-1])
        for start, stop in pairwise([0, *dict.fromkeys(within), len(band)]):
            alike = band[start:stop]
            span = slice(int(first[alike.start]), int(last[alike.start]))
            if span != shown:  # the same array again is known to have the same noise
                shown, row = span, dark_row.copy()
                row[:, span] = panel_row[:, span]
            yield Rows(alike, row, span)


def _mixed_rows(
    camera: Camera,
    optics: Optics,
    panel: FloatArray,
    surroundings: FloatArray,
    bands: Sequence[range],
    stage_ended: Callable[[str], object],
) -> Iterator[Rows]:
    coverage = Coverage(optics.outline, camera.rows, camera.columns, optics.blur)
    dark = luminance_of(surroundings, camera)
    own = (luminance_of(panel, camera) - dark).astype(np.float32)
    around = dark.astype(np.float32)
    unit = float(pixel_value(np.ones(1), camera)[0])
    for band in bands:
        light = coverage.rows(band)
        inside = light >= np.float32(0.5)
        stage_ended(optics.cover_stage)
        for gain in optics.emission:
            light *= gain.rows(band)
            stage_ended(gain.stage)
        light *= own
        light += around
        stage_ended(STAGE)
        for gain in optics.transmission:
            light *= gain.rows(band)
            stage_ended(gain.stage)
        values = np.asarray(cv2.pow(light, 1.0 / camera.gamma), dtype=np.float32)
        values *= np.float32(unit)
        yield Rows(band, values, inside)
