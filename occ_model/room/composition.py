"""The mean pixel values of a picture of many lamps: their light adds before the tone curve."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import luminance_of, pixel_value
from occ_model.camera.picture_rows import PictureRows, Rim, Rows
from occ_model.scene.scene import Camera

_REACH = 6.0
"""Standard deviations of the blur beyond which a lamp lights no row."""


@dataclass(frozen=True, eq=False, slots=True)
class LampRows:
    """The rows of a picture that one lamp alone would make, and those that it lights."""

    rows: PictureRows
    first: float
    last: float

    @classmethod
    def of(cls, rows: PictureRows, optics: Optics) -> "LampRows":
        """Return the rows of a lamp with some optics."""
        reach = _REACH * optics.blur + 2.0
        line = optics.outline[:, 1]
        return cls(rows, float(line.min()) - reach, float(line.max()) + reach)


class RoomRows:
    """The mean pixel values of a picture of some lamps.

    Where one lamp is alone, rows are those of its own scene. Where the light of more falls on the
    same columns of a band, what each adds to the surroundings' light is summed.

    Parameters
    ----------
    dark
        The rows of a picture without a lamp.
    """

    def __init__(self, lamps: Sequence[LampRows], dark: PictureRows, camera: Camera) -> None:
        self._lamps = lamps
        self._dark = dark
        self._camera = camera

    def of(self, place: range, stage_ended: Callable[[str], object]) -> Rows:
        """Compute some rows."""
        near = [one for one in self._lamps if one.first <= place[-1] and one.last >= place[0]]
        if not near:
            return self._dark.of(place, stage_ended)
        alone = [one.rows.of(place, stage_ended) for one in near]
        lit = [rows for rows in alone if _columns(rows)] or alone[:1]
        return lit[0] if len(lit) == 1 else self._composed(lit, stage_ended)

    def _composed(self, alone: list[Rows], stage_ended: Callable[[str], object]) -> Rows:
        place, width = alone[0].place, alone[0].nodes.shape[1]
        if any(rows.weights is None for rows in alone):
            alone = [rows.each_row() for rows in alone]
        height = max(len(rows.nodes) for rows in alone)
        nodes = np.broadcast_to(alone[0].nodes, (height, width)).copy()
        lamps = np.zeros(width, dtype=np.int64)
        for rows in alone:
            for columns in _columns(rows):
                lamps[columns] += 1
                nodes[:, columns] = rows.nodes[:, columns]
        shared = lamps > 1
        rims, inside = [], []
        for rows in alone:
            rims += [part for rim in rows.rims for part in _without(rim, shared)]
            inside += [part for columns in rows.inside for part in _runs(~shared, columns)]
        for columns in _runs(shared, slice(0, width)):
            rims.append(self._sum(alone, columns, stage_ended))
        return Rows(place, nodes, alone[0].weights, tuple(rims), tuple(inside))

    def _sum(self, alone: list[Rows], columns: slice, stage_ended: Callable[[str], object]) -> Rim:
        """Add the light of all lamps in some columns."""
        dark = self._light(self._dark.of(alone[0].place, stage_ended), columns)
        light = dark.copy()
        inside = np.zeros(dark.shape, dtype=np.bool_)
        for rows in alone:
            light += self._light(rows, columns) - dark
            for own in rows.inside:
                inside[:, _within(own, columns)] = True
            for rim in rows.rims:
                inside[:, _within(rim.columns, columns)] |= rim.inside[
                    :, _within(columns, rim.columns)
                ]
        values = pixel_value(light, self._camera).astype(np.float32)
        return Rim(columns, values, inside)

    def _light(self, rows: Rows, columns: slice) -> FloatArray:
        return luminance_of(rows.values[:, columns].astype(np.float64), self._camera)


def _columns(rows: Rows) -> list[slice]:
    return [*rows.inside, *(rim.columns for rim in rows.rims)]


def _within(columns: slice, frame: slice) -> slice:
    """Return the part of some columns that lies in a frame, counted from the frame's first."""
    start = min(max(columns.start, frame.start), frame.stop)
    stop = max(min(columns.stop, frame.stop), start)
    return slice(start - frame.start, stop - frame.start)


def _runs(chosen: "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]", columns: slice) -> list[slice]:
    """Return the runs of chosen columns among some."""
    own = chosen[columns].astype(np.int8)
    ends: IndexArray = np.flatnonzero(np.diff(own, prepend=0, append=0)) + columns.start
    return [slice(int(a), int(b)) for a, b in list(pairwise(ends.tolist()))[::2]]


def _without(rim: Rim, shared: "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]") -> list[Rim]:
    """Return the parts of a rim whose columns are not shared."""
    parts = _runs(~shared, rim.columns)
    if parts == [rim.columns]:
        return [rim]
    cut: list[Rim] = []
    for part in parts:
        own = _within(part, rim.columns)
        values: Pixels = rim.values[:, own]
        cut.append(replace(rim, columns=part, values=values, inside=rim.inside[:, own]))
    return cut
