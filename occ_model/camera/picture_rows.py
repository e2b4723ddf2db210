"""The mean pixel values of a picture, some rows at a time.

Rows are computed while they are in the processor's cache, and the largest picture needs little more
memory than its own bytes. Only the rims of the panel are computed pixel by pixel: beside and within
them the light changes smoothly from row to row, and a band of rows follows from a few.
"""

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.coverage import Coverage
from occ_model.camera.optics import STAGE, Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.row_interpolation import node_rows, row_weights, smooth_columns, weighted
from occ_model.scene.scene import Scene

BLOCK_ROWS = 64
"""Rows that are computed at once: a whole number of blocks of a JPEG file."""


def in_blocks(rows: range) -> list[range]:
    """Divide rows, or every k-th row, of a picture into those that are computed at once."""
    return [rows[start : start + BLOCK_ROWS] for start in range(0, len(rows), BLOCK_ROWS)]


def split_at(band: range, rows: Sequence[int]) -> list[range]:
    """Divide a band before some rows."""
    ends = {bisect_left(band, row) for row in rows} | {0, len(band)}
    return [band[start:stop] for start, stop in pairwise(sorted(ends))]


@dataclass(frozen=True, eq=False, slots=True)
class Rim:
    """Columns near a rim of the panel.

    Parameters
    ----------
    values : ndarray of float32, shape (rows, columns)
        Mean pixel values before saturation.
    inside : ndarray of bool, shape (rows, columns)
        Where the panel is.
    """

    columns: slice
    values: Pixels
    inside: NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    """Some rows of a picture.

    Parameters
    ----------
    nodes : ndarray of float32, shape (nodes, columns)
        Mean pixel values before saturation at the nodes; one row where all rows are alike.
    weights : ndarray of float32, shape (rows, nodes), or None
        What makes the rows of the nodes; None where these are the rows themselves, or one.
    inside
        The columns in which all rows show the panel.
    """

    place: range
    nodes: Pixels
    weights: Pixels | None
    rims: tuple[Rim, ...]
    inside: tuple[slice, ...]

    @property
    def values(self) -> Pixels:
        """Mean pixel values before saturation, shape (rows, columns)."""
        shape = (len(self.place), self.nodes.shape[1])
        values = np.broadcast_to(self._rows_of(self.nodes), shape).copy()
        for rim in self.rims:
            values[:, rim.columns] = rim.values
        return values

    def combine(
        self, operation: np.ufunc, target: Pixels, nodes: Pixels, rims: Sequence[Pixels]
    ) -> None:
        """Combine pixels with what is known at the nodes and of the rims, in place.

        Parameters
        ----------
        nodes, rims
            Values in place of those of ``nodes`` and ``rims``, of the same shapes.
        """
        places = [rim.columns for rim in self.rims]
        own = [operation(target[:, at], rim) for at, rim in zip(places, rims, strict=True)]
        operation(target, self._rows_of(nodes), out=target)
        for at, values in zip(places, own, strict=True):
            target[:, at] = values

    def each_row(self) -> "Rows":
        """Return the same without weights: each row as a node, or one that all are like."""
        if self.weights is None:
            return self
        return replace(self, nodes=self._rows_of(self.nodes), weights=None)

    def changed(self, change: Callable[[Pixels], Pixels]) -> "Rows":
        """Return the same with other values, which are not smooth: of rows without weights."""
        rims = tuple(replace(rim, values=change(rim.values)) for rim in self.rims)
        return replace(self, nodes=change(self.nodes), rims=rims)

    def _rows_of(self, nodes: Pixels) -> Pixels:
        return nodes if self.weights is None else weighted(self.weights, nodes)


class PictureRows:
    """The mean pixel values of a picture, of any rows in any order.

    Parameters
    ----------
    panel, surroundings : ndarray of float64, shape (columns,)
        Pixel values of each column before saturation.
    """

    def __init__(
        self, scene: Scene, optics: Optics, panel: FloatArray, surroundings: FloatArray
    ) -> None:
        camera = scene.camera
        self._optics = optics
        self._power = 1.0 / camera.gamma
        self._unit = float(pixel_value(np.ones(1), camera)[0])
        self._coverage = Coverage(optics.outline, camera.rows, camera.columns, optics.blur)
        self._panel = panel.astype(np.float32)[None, :]
        self._surroundings = surroundings.astype(np.float32)[None, :]
        dark = luminance_of(surroundings, camera)
        self._own = (luminance_of(panel, camera) - dark).astype(np.float32)
        self._around = dark.astype(np.float32)
        self._plain: tuple[tuple[slice, ...], Pixels] = ((), self._surroundings)

    def of(self, place: range, stage_ended: Callable[[str], object] = lambda _stage: None) -> Rows:
        """Compute some rows.

        Parameters
        ----------
        stage_ended
            Called with the name of each stage that has just ended.
        """
        inside, covered = [], []
        for part in self._coverage.parts(place):
            if isinstance(part.share, np.ndarray):
                covered.append((part.columns, part.share))
            elif part.share:
                inside.append(part.columns)
        stage_ended(self._optics.cover_stage)
        rims = tuple(self._rim(place, *part, stage_ended) for part in covered)
        nodes, weights = self._between_rims(place, tuple(inside), stage_ended)
        stage_ended(STAGE)
        return Rows(place, nodes, weights, rims, tuple(inside))

    def _rim(
        self, place: range, columns: slice, share: Pixels, stage_ended: Callable[[str], object]
    ) -> Rim:
        shown = share >= np.float32(0.5)
        if self._optics.is_plain:
            values = np.where(shown, self._panel[:, columns], self._surroundings[:, columns])
        else:
            line = np.asarray(place, dtype=np.float64)
            light = share * self._emitted(line, columns, stage_ended)
            light += self._around[columns]
            values = self._encoded(light, line, columns, stage_ended)
        return Rim(columns, values, shown)

    def _between_rims(
        self,
        place: range,
        inside: tuple[slice, ...],
        stage_ended: Callable[[str], object],
    ) -> tuple[Pixels, Pixels | None]:
        """Return the nodes and the weights of the rows, without the rims."""
        if not (self._optics.emission or self._optics.transmission):
            return self._alike(inside), None
        line = node_rows(place)
        nodes = self._even(line, inside, stage_ended)
        if len(place) > len(line) and smooth_columns(nodes).all():
            return nodes, row_weights(len(place))
        return self._even(np.asarray(place, np.float64), inside, stage_ended), None

    def _alike(self, inside: tuple[slice, ...]) -> Pixels:
        """Return the row that all rows are like between the rims."""
        shown, row = self._plain
        if inside != shown:  # the same array again is known to have the same noise
            row = self._surroundings.copy()
            for columns in inside:
                row[:, columns] = self._panel[:, columns]
            self._plain = (inside, row)
        return row

    def _even(
        self,
        line: FloatArray,
        inside: tuple[slice, ...],
        stage_ended: Callable[[str], object],
    ) -> Pixels:
        """Return pixel values of some rows, as if there were no rims."""
        light = np.repeat(self._around[None, :], len(line), axis=0)
        for columns in inside:
            light[:, columns] += self._emitted(line, columns, stage_ended)
        return self._encoded(light, line, slice(None), stage_ended)

    def _emitted(
        self, line: FloatArray, columns: slice, stage_ended: Callable[[str], object]
    ) -> Pixels:
        """Return the panel's own light, shape (rows, columns) or (columns,)."""
        own = self._own[columns]
        for gain in self._optics.emission:
            own = own * gain.at(line, columns)
            stage_ended(gain.stage)
        return own

    def _encoded(
        self,
        light: Pixels,
        line: FloatArray,
        columns: slice,
        stage_ended: Callable[[str], object],
    ) -> Pixels:
        """Return the pixel values of light behind the lens, which is overwritten."""
        for gain in self._optics.transmission:
            light *= gain.at(line, columns)
            stage_ended(gain.stage)
        values = np.asarray(cv2.pow(light, self._power), dtype=np.float32)
        values *= np.float32(self._unit)
        stage_ended(STAGE)
        return values
