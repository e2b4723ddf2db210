"""The mean pixel values of a picture, some rows at a time.

Rows are computed while they are in the processor's cache, and the largest picture needs little more
memory than its own bytes. Only the rims of panels are computed pixel by pixel: beside and within
them the light changes smoothly from row to row, and a band of rows follows from a few. Where the
light of more panels falls on the same columns of a band, it is added before the tone curve.
"""

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.coverage import Coverage
from occ_model.camera.optics import STAGE, Gain, Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.row_interpolation import node_rows, row_weights, smooth_columns, weighted
from occ_model.scene.scene import Camera

BLOCK_ROWS = 64  # rows that are computed at once: a whole number of blocks of a JPEG file


def in_blocks(rows: range) -> list[range]:
    """Divide rows, or every k-th row, of a picture into blocks that are computed at once."""
    return [rows[start : start + BLOCK_ROWS] for start in range(0, len(rows), BLOCK_ROWS)]


def split_at(band: range, rows: Sequence[int]) -> list[range]:
    ends = {bisect_left(band, row) for row in rows} | {0, len(band)}
    return [band[start:stop] for start, stop in pairwise(sorted(ends))]


@dataclass(frozen=True, eq=False, slots=True)
class Rim:
    columns: slice
    values: Pixels  # Shape (rows, columns): mean pixel values before saturation
    inside: NDArray[np.bool_]  # Shape (rows, columns): where the panel is


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    place: range
    # Shape (nodes, columns): mean pixel values before saturation at the nodes; one row where all
    # rows are alike
    nodes: Pixels
    # Shape (rows, nodes), or None: what makes the rows of the nodes; None where these are the rows
    # themselves, or one
    weights: Pixels | None
    rims: tuple[Rim, ...]
    inside: tuple[slice, ...]  # The columns in which all rows show the panel

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
        """Combine pixels with those of the nodes and of the rims, in place."""
        places = [rim.columns for rim in self.rims]
        own = [operation(target[:, at], rim) for at, rim in zip(places, rims, strict=True)]
        operation(target, self._rows_of(nodes), out=target)
        for at, values in zip(places, own, strict=True):
            target[:, at] = values

    def each_row(self) -> "Rows":
        """Return the rows without weights: each row as a node, or one that all equal."""
        if self.weights is None:
            return self
        return replace(self, nodes=self._rows_of(self.nodes), weights=None)

    def changed(self, change: Callable[[Pixels], Pixels]) -> "Rows":
        """Return the rows with other values, which need not be smooth; only without weights."""
        rims = tuple(replace(rim, values=change(rim.values)) for rim in self.rims)
        return replace(self, nodes=change(self.nodes), rims=rims)

    def _rows_of(self, nodes: Pixels) -> Pixels:
        return nodes if self.weights is None else weighted(self.weights, nodes)


@dataclass(frozen=True, eq=False, slots=True)
class LitPanel:
    optics: Optics
    values: FloatArray  # Shape (columns,): its pixel value in each column before saturation


class _Panel:
    def __init__(self, panel: LitPanel, camera: Camera, dark: FloatArray) -> None:
        optics = panel.optics
        self.coverage = Coverage(optics.outline, camera.rows, camera.columns, optics.blur)
        self.values = panel.values.astype(np.float32)[None, :]
        self._light = (luminance_of(panel.values, camera) - dark).astype(np.float32)
        self._emission = optics.emission

    def emitted(
        self, line: FloatArray, columns: slice, stage_ended: Callable[[str], object]
    ) -> Pixels:
        """Return the panel's own light, shape (rows, columns) or (columns,)."""
        own = self._light[columns]
        for gain in self._emission:
            own = own * gain.at(line, columns)
            stage_ended(gain.stage)
        return own


@dataclass(frozen=True, eq=False, slots=True)
class _Lit:
    """Columns of some rows that a panel lights: a fraction of each pixel, or all of them."""

    panel: _Panel
    columns: slice
    fraction: Pixels | None

    def within(self, columns: slice) -> "_Lit":
        part = slice(max(self.columns.start, columns.start), min(self.columns.stop, columns.stop))
        first = self.columns.start
        fraction = (
            None
            if self.fraction is None
            else self.fraction[:, part.start - first : part.stop - first]
        )
        return _Lit(self.panel, part, fraction)


class PictureRows:
    """The mean pixel values of a picture, of any rows in any order.

    One lens darkens all ``panels`` alike. ``surroundings``: the columns' values beside them.
    """

    def __init__(
        self, camera: Camera, panels: Sequence[LitPanel], surroundings: FloatArray
    ) -> None:
        optics = [panel.optics for panel in panels]
        self._power = 1.0 / camera.gamma
        self._unit = float(pixel_value(np.ones(1), camera)[0])
        self._columns = camera.columns
        self._surroundings = surroundings.astype(np.float32)[None, :]
        dark = luminance_of(surroundings, camera)
        self._around = dark.astype(np.float32)
        self._panels = [_Panel(panel, camera, dark) for panel in panels]
        self._cover_stage = optics[0].cover_stage
        self._transmission: tuple[Gain, ...] = optics[0].transmission
        self._is_plain = all(own.is_plain for own in optics)
        self._is_even = not (self._transmission or any(own.emission for own in optics))
        self._plain: tuple[list[tuple[_Panel, slice]], Pixels] = ([], self._surroundings)

    def of(self, place: range, stage_ended: Callable[[str], object] = lambda _stage: None) -> Rows:
        """Compute some rows; ``stage_ended`` is called with the name of each stage."""
        lit = [
            _Lit(panel, part.columns, None if isinstance(part.fraction, float) else part.fraction)
            for panel in self._panels
            if panel.coverage.reaches(place)
            for part in panel.coverage.parts(place)
            if isinstance(part.fraction, np.ndarray) or part.fraction
        ]
        stage_ended(self._cover_stage)
        shared = self._shared(lit)
        alone = [piece for one in lit for piece in _without(one, shared)] if shared else lit
        inside = [(one.panel, one.columns) for one in alone if one.fraction is None]
        rims = [
            self._rim(place, one.columns, [one], stage_ended)
            for one in alone
            if one.fraction is not None
        ]
        rims += [
            self._rim(place, columns, [one.within(columns) for one in lit], stage_ended)
            for columns in shared
        ]
        nodes, weights = self._between_rims(place, inside, stage_ended)
        stage_ended(STAGE)
        return Rows(place, nodes, weights, tuple(rims), tuple(columns for _, columns in inside))

    def _shared(self, lit: Sequence[_Lit]) -> list[slice]:
        if len(self._panels) == 1:
            return []
        steps = np.zeros(self._columns + 1, dtype=np.int64)
        for one in lit:
            steps[one.columns.start] += 1
            steps[one.columns.stop] -= 1
        several = (np.cumsum(steps) > 1).astype(np.int8)
        ends: IndexArray = np.flatnonzero(np.diff(several, prepend=0))
        return [slice(start, stop) for start, stop in ends.reshape(-1, 2).tolist()]

    def _rim(
        self,
        place: range,
        columns: slice,
        lit: Sequence[_Lit],
        stage_ended: Callable[[str], object],
    ) -> Rim:
        if self._is_plain and len(lit) == 1 and lit[0].fraction is not None:
            shown = lit[0].fraction >= np.float32(0.5)
            panel, around = lit[0].panel.values[:, columns], self._surroundings[:, columns]
            return Rim(columns, np.where(shown, panel, around), shown)
        line = np.asarray(place, dtype=np.float64)
        shape = len(place), columns.stop - columns.start
        light, shown = np.zeros(shape, dtype=np.float32), np.zeros(shape, dtype=np.bool_)
        for one in lit:
            if one.columns.stop <= one.columns.start:
                continue
            fraction = np.ones(1, dtype=np.float32) if one.fraction is None else one.fraction
            own = np.s_[:, one.columns.start - columns.start : one.columns.stop - columns.start]
            light[own] += fraction * one.panel.emitted(line, one.columns, stage_ended)
            shown[own] |= fraction >= np.float32(0.5)
        light += self._around[columns]
        return Rim(columns, self._encoded(light, line, columns, stage_ended), shown)

    def _between_rims(
        self,
        place: range,
        inside: list[tuple[_Panel, slice]],
        stage_ended: Callable[[str], object],
    ) -> tuple[Pixels, Pixels | None]:
        """Return the nodes and the weights of the rows, without the rims."""
        if self._is_even:
            return self._common_row(inside), None
        line = node_rows(place)
        nodes = self._even(line, inside, stage_ended)
        if len(place) > len(line) and smooth_columns(nodes).all():
            return nodes, row_weights(len(place))
        return self._even(np.asarray(place, np.float64), inside, stage_ended), None

    def _common_row(self, inside: list[tuple[_Panel, slice]]) -> Pixels:
        """Return the row that all rows equal between the rims."""
        shown, row = self._plain
        if inside != shown:  # the same array again is known to have the same noise
            row = self._surroundings.copy()
            for panel, columns in inside:
                row[:, columns] = panel.values[:, columns]
            self._plain = (inside, row)
        return row

    def _even(
        self,
        line: FloatArray,
        inside: list[tuple[_Panel, slice]],
        stage_ended: Callable[[str], object],
    ) -> Pixels:
        """Return pixel values of some rows, as if there were no rims."""
        light = np.repeat(self._around[None, :], len(line), axis=0)
        for panel, columns in inside:
            light[:, columns] += panel.emitted(line, columns, stage_ended)
        return self._encoded(light, line, slice(None), stage_ended)

    def _encoded(
        self,
        light: Pixels,
        line: FloatArray,
        columns: slice,
        stage_ended: Callable[[str], object],
    ) -> Pixels:
        """Return the pixel values of light behind the lens, which is overwritten."""
        for gain in self._transmission:
            light *= gain.at(line, columns)
            stage_ended(gain.stage)
        values = np.asarray(cv2.pow(light, self._power), dtype=np.float32)
        values *= np.float32(self._unit)
        stage_ended(STAGE)
        return values


def _without(lit: _Lit, shared: Sequence[slice]) -> list[_Lit]:
    pieces, start = [], lit.columns.start
    for columns in shared:
        if columns.stop <= start or columns.start >= lit.columns.stop:
            continue
        if columns.start > start:
            pieces.append(lit.within(slice(start, columns.start)))
        start = columns.stop
    if start < lit.columns.stop:
        pieces.append(lit.within(slice(start, lit.columns.stop)))
    return pieces
