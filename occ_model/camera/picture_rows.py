"""The mean pixel values of a picture, computed some rows at a time.

Thus rows stay in the processor's cache, and the largest picture needs little more memory than its
own bytes. Only the rims of panels are computed pixel by pixel; elsewhere the light changes smoothly
from row to row, so that a band of rows can be interpolated from a few. The light of several panels
in the same columns of a band is added before the gamma encoding.
"""

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.coverage import Coverage, CoveredPart
from occ_model.camera.optics import STAGE, Gain, Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.row_interpolation import (
    apply_weights,
    find_smooth_columns,
    node_rows,
    row_weights,
)
from occ_model.scene.scene import Camera

JPEG_BLOCK = 8  # rows and columns of a block of a JPEG file
BLOCK_ROWS = 16 * JPEG_BLOCK  # rows that are computed at once
_BLOCK_PIXELS = 2**22  # most pixels that are computed at once, where rows are very long


def split_into_blocks(rows: range, columns: int) -> list[range]:
    """Split rows, or every k-th row, of a picture into blocks that are computed at once."""
    fitting = _BLOCK_PIXELS // columns // JPEG_BLOCK * JPEG_BLOCK
    height = min(max(fitting, JPEG_BLOCK), BLOCK_ROWS)
    return [rows[start : start + height] for start in range(0, len(rows), height)]


def split_at(band: range, rows: Sequence[int]) -> list[range]:
    ends = {bisect_left(band, row) for row in rows} | {0, len(band)}
    return [band[start:stop] for start, stop in pairwise(sorted(ends))]


@dataclass(frozen=True, eq=False, slots=True)
class Rim:
    columns: slice
    values: Pixels  # Shape (rows, columns): mean pixel values before saturation
    inside: NDArray[np.bool_]  # Shape (rows, columns): whether a pixel shows the panel


@dataclass(frozen=True, eq=False, slots=True)
class PanelPart:
    """Which pixels of some rows show a panel."""

    inside: tuple[slice, ...]  # Columns in which all rows do
    # Other columns, and which pixels of them do, shape (rows, columns)
    rims: tuple[tuple[slice, NDArray[np.bool_]], ...]


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    rows: range
    # Shape (nodes, columns): mean pixel values before saturation at the nodes; one row if all rows
    # are equal
    nodes: Pixels
    # Shape (rows, nodes): weights of the nodes in each row; None if the nodes are the rows
    # themselves, or one row for all
    weights: Pixels | None
    rims: tuple[Rim, ...]
    inside: tuple[slice, ...]  # Columns in which all rows show the panel

    @property
    def panel(self) -> PanelPart:
        return PanelPart(self.inside, tuple((rim.columns, rim.inside) for rim in self.rims))

    @property
    def values(self) -> Pixels:
        """Mean pixel values before saturation, shape (rows, columns)."""
        shape = (len(self.rows), self.nodes.shape[1])
        values = np.broadcast_to(self._expand(self.nodes), shape).copy()
        for rim in self.rims:
            values[:, rim.columns] = rim.values
        return values

    def expand_rows(self) -> "Rows":
        """Return the rows without weights: each row becomes a node, unless all are equal."""
        if self.weights is None:
            return self
        return replace(self, nodes=self._expand(self.nodes), weights=None)

    def columns_of(self, part: slice) -> Iterator[tuple[slice, Pixels]]:
        """Yield values in a part of the rows: all columns as if there were no rims, then rims.

        The first have one row if all rows are equal.
        """
        if self.weights is not None:
            yield slice(None), apply_weights(self.weights[part], self.nodes)
        else:
            yield slice(None), self.nodes[part] if len(self.nodes) > 1 else self.nodes
        for rim in self.rims:
            yield rim.columns, rim.values[part]

    def change_nodes(self, change: Callable[[Pixels], Pixels]) -> "Rows":
        """Apply a change to nodes and rims; it must be smooth where rows are interpolated."""
        rims = tuple(replace(rim, values=change(rim.values)) for rim in self.rims)
        return replace(self, nodes=change(self.nodes), rims=rims)

    def _expand(self, nodes: Pixels) -> Pixels:
        return nodes if self.weights is None else apply_weights(self.weights, nodes)


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

    def emitted_light(
        self, line: FloatArray, columns: slice, end_stage: Callable[[str], object]
    ) -> Pixels:
        """Return the light that the panel itself emits, shape (rows, columns) or (columns,)."""
        light = self._light[columns]
        for gain in self._emission:
            light = light * gain.at(line, columns)
            end_stage(gain.stage)
        return light


_LitPart: TypeAlias = tuple[_Panel, CoveredPart]  # columns of some rows with a panel's light


class PictureRows:
    """Computes the mean pixel values of any rows of a picture, in any order.

    The lens dims all ``panels`` alike; ``surroundings`` are the columns' values beside them.
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
        self._is_plain = all(each.is_plain for each in optics)
        self._is_even = not (self._transmission or any(each.emission for each in optics))
        self._last_common_row: tuple[list[tuple[_Panel, slice]], Pixels] = ([], self._surroundings)

    def may_show_panel(self, rows: range) -> bool:
        return any(panel.coverage.reaches(rows) for panel in self._panels)

    def of(self, rows: range, end_stage: Callable[[str], object] = lambda _stage: None) -> Rows:
        """Compute some rows; ``end_stage`` is called with the name of each stage at its end."""
        lit = [
            (panel, part)
            for panel in self._panels
            if panel.coverage.reaches(rows)
            for part in panel.coverage.parts(rows)
        ]
        end_stage(self._cover_stage)
        shared = self._find_shared_columns([part.columns for _, part in lit])
        unshared = [(panel, cut) for panel, part in lit for cut in part.cut_out(shared)]
        inside = [(panel, part.columns) for panel, part in unshared if part.fraction is None]
        rims = [
            self._compute_rim(rows, part.columns, [(panel, part)], end_stage)
            for panel, part in unshared
            if part.fraction is not None
        ]
        rims += [
            self._compute_rim(
                rows, columns, [(panel, part.crop(columns)) for panel, part in lit], end_stage
            )
            for columns in shared
        ]
        nodes, weights = self._compute_nodes(rows, inside, end_stage)
        end_stage(STAGE)
        return Rows(rows, nodes, weights, tuple(rims), tuple(columns for _, columns in inside))

    def _find_shared_columns(self, lit: Sequence[slice]) -> list[slice]:
        if len(self._panels) == 1:
            return []
        steps = np.zeros(self._columns + 1, dtype=np.int64)
        for columns in lit:
            steps[columns.start] += 1
            steps[columns.stop] -= 1
        is_shared = (np.cumsum(steps) > 1).astype(np.int8)
        ends: IndexArray = np.flatnonzero(np.diff(is_shared, prepend=0))
        return [slice(start, stop) for start, stop in ends.reshape(-1, 2).tolist()]

    def _compute_rim(
        self,
        rows: range,
        columns: slice,
        lit: Sequence[_LitPart],
        end_stage: Callable[[str], object],
    ) -> Rim:
        (panel, part), *others = lit
        if self._is_plain and not others and part.fraction is not None:
            is_panel = part.fraction >= np.float32(0.5)
            values, around = panel.values[:, columns], self._surroundings[:, columns]
            return Rim(columns, np.where(is_panel, values, around), is_panel)
        line = np.asarray(rows, dtype=np.float64)
        shape = len(rows), columns.stop - columns.start
        light, is_panel = np.zeros(shape, dtype=np.float32), np.zeros(shape, dtype=np.bool_)
        for panel, part in lit:
            if part.columns.stop <= part.columns.start:
                continue
            fraction = np.ones(1, dtype=np.float32) if part.fraction is None else part.fraction
            start, stop = part.columns.start - columns.start, part.columns.stop - columns.start
            place = np.s_[:, start:stop]
            light[place] += fraction * panel.emitted_light(line, part.columns, end_stage)
            is_panel[place] |= fraction >= np.float32(0.5)
        light += self._around[columns]
        return Rim(columns, self._encode(light, line, columns, end_stage), is_panel)

    def _compute_nodes(
        self,
        rows: range,
        inside: list[tuple[_Panel, slice]],
        end_stage: Callable[[str], object],
    ) -> tuple[Pixels, Pixels | None]:
        """Compute the nodes and weights of the rows, as if there were no rims."""
        if self._is_even:
            return self._common_row(inside), None
        line = node_rows(rows)
        nodes = self._expose_rows(line, inside, end_stage)
        if len(rows) > len(line) and find_smooth_columns(nodes).all():
            return nodes, row_weights(len(rows))
        return self._expose_rows(np.asarray(rows, np.float64), inside, end_stage), None

    def _common_row(self, inside: list[tuple[_Panel, slice]]) -> Pixels:
        """Return the row to which all rows are equal between the rims."""
        last_inside, row = self._last_common_row
        if inside != last_inside:
            row = self._surroundings.copy()
            for panel, columns in inside:
                row[:, columns] = panel.values[:, columns]
            self._last_common_row = (inside, row)
        return row

    def _expose_rows(
        self,
        line: FloatArray,
        inside: list[tuple[_Panel, slice]],
        end_stage: Callable[[str], object],
    ) -> Pixels:
        """Return the pixel values of some rows, as if there were no rims."""
        light = np.repeat(self._around[None, :], len(line), axis=0)
        for panel, columns in inside:
            light[:, columns] += panel.emitted_light(line, columns, end_stage)
        return self._encode(light, line, slice(None), end_stage)

    def _encode(
        self,
        light: Pixels,
        line: FloatArray,
        columns: slice,
        end_stage: Callable[[str], object],
    ) -> Pixels:
        """Dim light by the lens and encode it as pixel values; ``light`` is overwritten."""
        for gain in self._transmission:
            light *= gain.at(line, columns)
            end_stage(gain.stage)
        values = np.asarray(cv2.pow(light, self._power), dtype=np.float32)
        values *= np.float32(self._unit)
        end_stage(STAGE)
        return values
