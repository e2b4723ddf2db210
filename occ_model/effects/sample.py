"""A sample of a scene's pixels: where they lie, and what the lens makes of them.

The sample is small enough to be computed with each of the effects and without it, while a scene is
planned. Rows are taken by quadrature: the light changes smoothly between the panel's rims. The
rims, where an outline moves or is blurred, have nodes of their own.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.camera.optics import Gain, Optics
from occ_model.effects.normal import normal_share
from occ_model.results.decoding import Region

COLUMNS = 192
"""Most columns of a sample of a large picture."""

_ALL_COLUMNS = 288
"""Most columns that are sampled one and all: of so few, each can matter."""

_REACH = 3.5
"""Standard deviations from a blurred rim that its nodes cover."""

_GAUSS, _GAUSS_WEIGHTS = (
    (np.polynomial.legendre.leggauss(4)[0] + 1.0) / 2.0,
    (np.polynomial.legendre.leggauss(4)[1] / 2.0),
)

_MOVED_NODES, _BLURRED_NODES = 2, 3
"""Nodes where an outline moves, and on each side of it where it is blurred."""

_BESIDE_NODES = 3
"""Nodes above and below the panel."""

_SIDE_NODES = 10
"""Columns across an upright rim."""

_RIM_COLUMNS = 33
"""Columns in which a panel is to reach beyond the picture for no rim to be seen."""

_UNSEEN = 0.1
"""Blur in pixels below which a pixel receives nothing of its neighbours."""

_STEEP = 1.5
"""Slope from which a rim is steep."""

_FAR_RIM = 1e6
"""Pixels from a rim, where it does not matter."""

_GAIN_ROWS = 9
"""Rows in which a gain is computed; between them it is interpolated."""


@dataclass(frozen=True, eq=False)
class Sample:
    """The pixels of a sample: rows in each of some columns."""

    columns: IndexArray
    weights: FloatArray
    """Share of the region's columns that each stands for; their sum is 1."""

    rows: FloatArray
    """Those that are sampled in each column, (columns, nodes), as all that follows."""

    row_weights: FloatArray
    """Share of the region's rows that each stands for; their sum is 1 in each column."""

    covers: Mapping[frozenset[str], FloatArray | None]
    """The panel's share of each pixel's light, by the effects on the outline that are simulated.

    None where it is 1 everywhere."""

    emission: Mapping[str, FloatArray]
    """Factors of the panel's light, by the effect."""

    transmission: Mapping[str, FloatArray]
    """Factors of all light."""

    inner: slice
    """The nodes between the panel's rims."""

    is_covered: bool
    """Whether the panel covers all that is observed, with any of the effects: no rim is seen."""

    @cached_property
    def blocks(self) -> IndexArray:
        """The places in ``columns`` of whole blocks of a file, shape (blocks, 8)."""
        ordered = np.argsort(self.columns, kind="stable")
        column = self.columns[ordered]
        starts = np.flatnonzero(column[: max(len(column) - 7, 0)] % 8 == 0)
        starts = starts[column[starts + 7] - column[starts] == 7]
        return np.asarray(ordered[starts[:, None] + np.arange(8)])

    @cached_property
    def outline(self) -> frozenset[str]:
        """The effects that move or soften the rims of the panel."""
        return max(self.covers, key=len)

    @property
    def arrays(self) -> tuple[FloatArray, ...]:
        """All that it holds."""
        covers = tuple(cover for cover in self.covers.values() if cover is not None)
        gains = (*self.emission.values(), *self.transmission.values())
        return (self.rows, self.row_weights, self.weights, *covers, *gains)

    @cached_property
    def pixel_weights(self) -> FloatArray:
        """The share of the region's pixels that each stands for, shape as ``rows``."""
        return self.weights[:, None] * self.row_weights


@dataclass(frozen=True, eq=False, slots=True)
class _Spans:
    """Where an outline begins and ends along lines, with its slope there: shape (lines,).

    A line that it does not meet has the place where it comes nearest, and ``missed`` is True.
    """

    first: FloatArray
    last: FloatArray
    first_slope: FloatArray
    last_slope: FloatArray
    missed: BoolArray


def _spans(outline: FloatArray, lines: FloatArray, axis: int) -> _Spans:
    """Find the spans of an outline along lines of constant coordinate ``axis``."""
    along = np.roll(outline[:, axis], -int(np.argmin(outline[:, axis])))
    across = np.roll(outline[:, 1 - axis], -int(np.argmin(outline[:, axis])))
    turn = int(np.argmax(along))
    near = np.maximum.accumulate(along[: turn + 1]), across[: turn + 1]
    far_along, far = np.append(along[turn:], along[0])[::-1], np.append(across[turn:], across[0])
    chains = (near, (np.maximum.accumulate(far_along), far[::-1]))
    ends = [[np.interp(lines + step, *chain) for step in (0.0, -0.5, 0.5)] for chain in chains]
    if ends[0][0].sum() > ends[1][0].sum():
        ends.reverse()
    # The smaller slope of either side: beyond a corner begins another edge.
    slopes = [2.0 * np.minimum(abs(at - before), abs(after - at)) for at, before, after in ends]
    missed = (lines < along[0]) | (lines > along[turn])
    return _Spans(ends[0][0], ends[1][0], slopes[0], slopes[1], missed)


def sample_of(
    region: Region, level: bool, optics: Mapping[str, Optics], plain: Optics, in_blocks: bool
) -> Sample:
    """Choose the pixels of a sample in the region that is observed, which a level panel fills.

    The optics are what each effect makes of the plain ones by itself. In blocks, columns are taken
    by whole blocks of a file.
    """
    moved = {name: own.outline for name, own in optics.items() if own.outline is not plain.outline}
    blurs = {name: own.blur for name, own in optics.items() if own.blur > _UNSEEN}
    few = region.columns <= _ALL_COLUMNS
    step = 1 if few else -(-region.columns // COLUMNS)
    main = np.arange(region.first_column + step // 2, region.last_column, step)
    if not len(main):
        main = np.array([region.first_column])
    columns = main.astype(np.float64)
    if in_blocks and step > 1:
        count = COLUMNS // 8
        middles = region.first_column + (np.arange(count) + 0.5) * (region.columns / count)
        starts = np.maximum(middles.astype(np.int64) // 8 * 8, -(-region.first_column // 8) * 8)
        columns = (starts[:, None] + np.arange(8.0)).ravel()
    covers: dict[frozenset[str], FloatArray | None]
    weights = np.full(len(columns), 1.0 / len(columns))
    outlines = [plain.outline, *moved.values()]
    blur = max(blurs.values(), default=0.0)
    if (outlines[1:] or blur) and not few:
        columns, weights = _with_side_rims(columns, region, outlines, blur)
    covered = _is_covered(region, outlines, blur)
    if covered or (level and not (moved or blur)):
        low, high = np.full(len(columns), region.first_row - 0.5), region.last_row - 0.5
        rows = low[:, None] + (high - low)[:, None] * _GAUSS
        row_weights = np.broadcast_to(_GAUSS_WEIGHTS, rows.shape).copy()
        first = 0
        covers = dict.fromkeys(_sets_of([*moved, *blurs]))
    else:
        spans = [_spans(outline, columns, 0) for outline in outlines]
        rows, row_weights, first = _row_nodes(region, spans, bool(moved or blur), blur)
        covers = _covers(columns, rows, moved, blurs, plain)
    places = np.clip(np.rint(columns), region.first_column, region.last_column - 1).astype(np.int64)
    along = slice(int(main[0]), int(main[-1]) + 1, step)
    nearest = np.clip((places - along.start + step // 2) // step, 0, len(main) - 1)
    gains = {
        name: _gain(own.emission or own.transmission, rows, along, nearest, region)
        for name, own in optics.items()
        if own.emission or own.transmission
    }
    return Sample(
        columns=places,
        weights=weights,
        rows=rows,
        row_weights=row_weights,
        covers=covers,
        emission={name: gain for name, gain in gains.items() if optics[name].emission},
        transmission={name: gain for name, gain in gains.items() if optics[name].transmission},
        inner=slice(first, first + len(_GAUSS)),
        is_covered=covered,
    )


def _is_covered(region: Region, outlines: list[FloatArray], blur: float) -> bool:
    """Return whether each outline encloses a rectangle with all that a blur carries into it."""
    reach = _REACH * blur + 1.0
    low, high = region.first_row - reach, region.last_row + reach
    lines = np.linspace(region.first_column - reach, region.last_column + reach, _RIM_COLUMNS)
    for outline in outlines:
        found = _spans(outline, lines, 0)
        if found.missed.any() or (found.first > low).any() or (found.last < high).any():
            return False
    return True


def _with_side_rims(
    columns: FloatArray, region: Region, outlines: list[FloatArray], blur: float
) -> tuple[FloatArray, FloatArray]:
    """Add columns across the left and the right rim, where these are upright."""
    row = np.linspace(region.first_row, region.last_row - 1, 9)
    spans = [_spans(outline, row, 1) for outline in outlines]
    low, high = region.first_column - 0.5, region.last_column - 0.5
    kept, parts = np.ones(len(columns), dtype=bool), []
    for side in ("first", "last"):
        places = np.concatenate([getattr(span, side) for span in spans])
        places = _between(places)
        reach = math.ceil(_REACH * blur)
        left = min(max(float(places.min()) - reach, low), high)
        right = min(max(float(places.max()) + reach, low), high)
        if not 0.0 < right - left < region.columns / 4.0:
            continue
        kept &= (columns < left) | (columns > right)
        nodes = np.rint(left + (right - left) * _evenly(_SIDE_NODES)[0])
        parts.append((nodes, (right - left) / (high - low)))
    shares = sum(share for _, share in parts)
    left_over = int(np.count_nonzero(kept))
    if not left_over:
        return columns, np.full(len(columns), 1.0 / len(columns))
    weights = [np.full(left_over, (1.0 - shares) / left_over)]
    weights += [np.full(_SIDE_NODES, share / _SIDE_NODES) for _, share in parts]
    return np.concatenate([columns[kept], *(nodes for nodes, _ in parts)]), np.concatenate(weights)


def _row_nodes(
    region: Region, spans: list[_Spans], rims: bool, blur: float
) -> tuple[FloatArray, FloatArray, int]:
    """Choose the rows in each column: beside the panel, across its rims and, from a place, within.

    Of those that stand for nothing in any column one is kept at each end, as a rim may lie there.
    """
    low, high = region.first_row - 0.5, region.last_row - 0.5
    edges: list[FloatArray] = []
    for side in ("first", "last"):
        places = _between(np.stack([getattr(span, side) for span in spans]))
        slopes = np.stack([getattr(span, side + "_slope") for span in spans]).max(axis=0)
        reach = np.ceil(_REACH * blur * np.sqrt(1.0 + np.minimum(slopes, 1e3) ** 2))
        least, most = places.min(axis=0), places.max(axis=0)
        edges += [least - reach, least, most, most + reach] if blur else [least, most]
    half = len(edges) // 2
    middle = np.clip(np.floor((edges[0] + edges[-1]) / 2.0) + 0.5, low, high)
    ends = [np.full(len(middle), low)]
    ends += [np.clip(edge, low, middle) for edge in edges[:half]]
    ends += [np.clip(edge, middle, high) for edge in edges[half:]]
    ends += [np.full(len(middle), high)]
    moved = _evenly(_MOVED_NODES if rims else 0)
    across = [_evenly(_BLURRED_NODES), moved, _evenly(_BLURRED_NODES)] if blur else [moved]
    beside = _evenly(_BESIDE_NODES)
    parts = [beside, *across, (_GAUSS, _GAUSS_WEIGHTS), *across, beside]
    rows, weights = [], []
    for (nodes, shares), start, end in zip(parts, ends[:-1], ends[1:], strict=True):
        length = (end - start)[:, None]
        places = start[:, None] + length * nodes
        rows.append(places if nodes is _GAUSS else np.rint(places))
        weights.append(length / (high - low) * shares)
    places, shares = np.hstack(rows), np.hstack(weights)
    first = (places.shape[1] - len(_GAUSS)) // 2
    needed: BoolArray = np.asarray(shares.any(axis=0))
    needed[first : first + len(_GAUSS)] = True
    needed[1:-1] |= needed[2:] | needed[:-2]
    return places[:, needed], shares[:, needed], int(np.count_nonzero(needed[:first]))


def _evenly(count: int) -> tuple[FloatArray, FloatArray]:
    """Return places from 0 to 1 and their weights."""
    return (np.arange(count) + 0.5) / max(count, 1), np.full(count, 1.0 / max(count, 1))


def _covers(
    columns: FloatArray,
    rows: FloatArray,
    moved: Mapping[str, FloatArray],
    blurs: Mapping[str, float],
    plain: Optics,
) -> dict[frozenset[str], FloatArray | None]:
    """Return the panel's share of each pixel, with each set of effects on the outline."""
    found: dict[frozenset[str], FloatArray | None] = {}
    distances: dict[str, tuple[FloatArray, ...]] = {}
    for chosen in _sets_of([*moved, *blurs]):
        bend = next((name for name in moved if name in chosen), "")
        blur = max((blurs[name] for name in blurs if name in chosen), default=0.0)
        if bend not in distances:
            outline = moved.get(bend, plain.outline)
            distances[bend] = _distances(outline, columns, rows, max(blurs.values(), default=0.0))
        top, bottom, left, right = distances[bend]
        if blur:
            down = _blurred(top, blur) + _blurred(bottom, blur) - 1.0
            along = _blurred(left, blur) + _blurred(right, blur) - 1.0
            found[chosen] = np.maximum(np.minimum(down, along), 0.0)
        else:
            inside = (top > 0.0) & (bottom > 0.0) & (left > 0.0) & (right > 0.0)
            found[chosen] = inside.astype(np.float64)
    return found


def _sets_of(names: list[str]) -> list[frozenset[str]]:
    numbers = range(2 ** len(names))
    return [frozenset(n for place, n in enumerate(names) if k >> place & 1) for k in numbers]


def _blurred(distance: FloatArray, blur: float) -> FloatArray:
    """Return the share of the light at some distance within a blurred rim.

    A narrow blur is one of whole pixels, whose weights are those of a Gaussian at whole distances.
    """
    if blur >= 1.0:
        return normal_share(distance / blur)
    weights = np.exp(-0.5 * (np.arange(-6.0, 7.0) / blur) ** 2)
    shares = np.concatenate([[0.0], np.cumsum(weights)]) / weights.sum()
    return np.asarray(np.interp(distance, np.arange(-6.5, 7.0), shares))


def _distances(
    outline: FloatArray, columns: FloatArray, rows: FloatArray, blur: float
) -> tuple[FloatArray, ...]:
    """Return how far pixels lie within the outline's top, bottom, left and right rim."""
    down = _spans(outline, columns, 0)
    along = _spans(outline, rows.ravel(), 1)
    lines = np.broadcast_to(columns[:, None], rows.shape)
    top, bottom = _within(down, rows.T, blur)
    left, right = (distance.reshape(rows.shape) for distance in _within(along, lines.ravel(), blur))
    lost = down.missed[:, None] & along.missed.reshape(rows.shape)
    return np.where(lost, -_FAR_RIM, top.T), bottom.T, left, right


def _within(spans: _Spans, places: FloatArray, blur: float) -> tuple[FloatArray, FloatArray]:
    """Return how far places on lines lie within the first and the last rim that these meet.

    From a slanting rim it is shorter than along the line; a narrow blur goes along the axes.
    Within a steep rim the distance along the other axis counts.
    """
    found = []
    for sign, rim, slope in (
        (1.0, spans.first, spans.first_slope),
        (-1.0, spans.last, spans.last_slope),
    ):
        slant = 1.0 / np.sqrt(1.0 + slope * slope)
        if blur < 1.0:
            slant = np.where(slope < _STEEP, 1.0, slant)
        distance = sign * (places - _between(rim)) * slant
        beside = spans.missed | ((slope > _STEEP) & (distance > 0.0))
        found.append(np.where(beside, _FAR_RIM, distance))
    return found[0], found[1]


def _between(places: FloatArray) -> FloatArray:
    """Return the place between two pixels where a rim separates their centres."""
    return np.asarray(np.ceil(places) - 0.5)


def _gain(
    gains: tuple[Gain, ...],
    rows: FloatArray,
    along: slice,
    nearest: IndexArray,
    region: Region,
) -> FloatArray:
    """Return the product of gains at the pixels of a sample."""
    first, last = float(region.first_row), float(max(region.last_row - 1, region.first_row + 1))
    lines = np.linspace(first, last, _GAIN_ROWS)
    place = np.clip((rows - first) * ((_GAIN_ROWS - 1) / (last - first)), 0.0, _GAIN_ROWS - 1.001)
    below = place.astype(np.int64)
    share = place - below
    product: FloatArray = np.ones(rows.shape)
    for gain in gains:
        at = np.asarray(gain.at(lines, along), dtype=np.float64)[:, nearest]
        column = np.arange(len(nearest))[:, None]
        product = product * (at[below, column] * (1.0 - share) + at[below + 1, column] * share)
    return product
