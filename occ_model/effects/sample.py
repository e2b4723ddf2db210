"""A sample of a scene's pixels: where they are, and how the lens changes them.

The sample is small, so that a plan can compute it with and without each effect. Its rows are the
nodes of a quadrature, as the light changes smoothly between the panel's rims. Rims that an effect
moves or blurs have nodes of their own.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.camera.optics import Gain, Optics
from occ_model.effects.cover import (
    STEEP_SLOPE,
    Outlines,
    covers_of,
    exact_covers,
    pixel_boundary,
    spans_of,
)
from occ_model.results.decoding import Region

COLUMNS = 192  # largest number of columns in the sample of a wide picture
_ALL_COLUMNS = 288  # width of a region up to which all columns are sampled, since each can matter
_ALL_PIXELS = 2**14  # number of pixels of a region up to which all of them are sampled
_REACH = 3.5  # distance from a blurred rim, in standard deviations, that its nodes cover

_GAUSS, _GAUSS_WEIGHTS = (
    (np.polynomial.legendre.leggauss(4)[0] + 1.0) / 2.0,
    (np.polynomial.legendre.leggauss(4)[1] / 2.0),
)

_MOVED_NODES, _BLURRED_NODES = 2, 3
"""Nodes across a rim that moves, and on each side of a blurred rim."""

_BESIDE_NODES = 3  # nodes above and below the panel
_SIDE_NODES = 32  # columns across an upright rim
_RIM_COLUMNS = 33  # columns at which to check whether the panel reaches beyond the picture
_GAIN_ROWS = 9  # rows at which a gain is computed; it is interpolated between them


@dataclass(frozen=True, eq=False)
class PixelSample:
    """The pixels of a sample: rows in each of some columns."""

    columns: IndexArray
    weights: FloatArray  # Fraction of the region's columns that each represents; their sum is 1
    rows: FloatArray  # In each column; shape (columns, nodes) as of all arrays below

    row_weights: FloatArray
    """Fraction of the region's rows that each represents; their sum is 1 in each column."""

    covers: Mapping[frozenset[str], FloatArray | None]
    """The panel's fraction of each pixel's light, for each set of simulated effects on the outline.

    None where it is 1 everywhere."""

    emission: Mapping[str, FloatArray]  # Factors of the panel's light, by effect
    transmission: Mapping[str, FloatArray]  # Factors of all light, by effect
    inner: slice  # The nodes between the panel's rims

    is_covered: bool
    """Whether the panel covers the whole region with any of the effects, so that no rim is in
    it."""

    @cached_property
    def blocks(self) -> IndexArray:
        """Indices into ``columns`` of whole JPEG blocks, shape (blocks, 8)."""
        ordered = np.argsort(self.columns, kind="stable")
        column = self.columns[ordered]
        starts = np.flatnonzero(column[: max(len(column) - 7, 0)] % 8 == 0)
        starts = starts[column[starts + 7] - column[starts] == 7]
        return np.asarray(ordered[starts[:, None] + np.arange(8)])

    @cached_property
    def outline(self) -> frozenset[str]:
        """The effects that move or blur the panel's rims."""
        return max(self.covers, key=len)

    @property
    def arrays(self) -> tuple[FloatArray, ...]:
        covers = tuple(cover for cover in self.covers.values() if cover is not None)
        gains = (*self.emission.values(), *self.transmission.values())
        return (self.rows, self.row_weights, self.weights, *covers, *gains)

    @cached_property
    def pixel_weights(self) -> FloatArray:
        """Weight of each pixel, as a fraction of the region's pixels, shape as ``rows``."""
        return self.weights[:, None] * self.row_weights


def choose_sample(
    region: Region, fills_region: bool, optics: Mapping[str, Optics], plain: Optics, in_blocks: bool
) -> PixelSample:
    """Sample the pixels of the observed region.

    ``optics`` holds the optics with each effect alone, ``plain`` those without any; with these, the
    panel ``fills_region`` if it is an upright rectangle. With ``in_blocks``, the columns are whole
    JPEG blocks.
    """
    outlines = Outlines.of(optics, plain)
    few = region.columns <= _ALL_COLUMNS
    step = 1 if few else -(-region.columns // COLUMNS)
    main = np.arange(region.first_column + step // 2, region.last_column, step)
    if not len(main):
        main = np.array([region.first_column])
    columns = _columns_of_blocks(region) if in_blocks and step > 1 else main.astype(np.float64)
    weights = np.full(len(columns), 1.0 / len(columns))
    if outlines.are_changed and not few:
        columns, weights = _add_side_columns(columns, region, outlines)
    is_covered = _is_covered(region, outlines)
    if is_covered or (fills_region and not outlines.are_changed):
        low, high = np.full(len(columns), region.first_row - 0.5), region.last_row - 0.5
        rows = low[:, None] + (high - low)[:, None] * _GAUSS
        row_weights = np.broadcast_to(_GAUSS_WEIGHTS, rows.shape).copy()
        first, covers = 0, dict.fromkeys(outlines.sets_of_effects)
    else:
        rows, row_weights, first = _choose_rows(region, columns, outlines)
        if few and region.rows * region.columns <= _ALL_PIXELS:
            rows, row_weights, first = _take_all_rows(region, rows[:, first : first + len(_GAUSS)])
            covers = exact_covers(region, rows, outlines)
        else:
            covers = covers_of(columns, rows, outlines)
    places = np.clip(np.rint(columns), region.first_column, region.last_column - 1).astype(np.int64)
    along = slice(int(main[0]), int(main[-1]) + 1, step)
    nearest = np.clip((places - along.start + step // 2) // step, 0, len(main) - 1)

    def gains_of(factors: Mapping[str, tuple[Gain, ...]]) -> dict[str, FloatArray]:
        return {
            name: _gain_at_sample(each, rows, along, nearest, region)
            for name, each in factors.items()
            if each
        }

    return PixelSample(
        columns=places,
        weights=weights,
        rows=rows,
        row_weights=row_weights,
        covers=covers,
        emission=gains_of({name: lens.emission for name, lens in optics.items()}),
        transmission=gains_of({name: lens.transmission for name, lens in optics.items()}),
        inner=slice(first, first + len(_GAUSS)),
        is_covered=is_covered,
    )


def _columns_of_blocks(region: Region) -> FloatArray:
    """Return the columns of blocks that are evenly distributed over a wide region."""
    count = COLUMNS // 8
    middles = region.first_column + (np.arange(count) + 0.5) * (region.columns / count)
    starts = np.maximum(middles.astype(np.int64) // 8 * 8, -(-region.first_column // 8) * 8)
    return np.asarray((starts[:, None] + np.arange(8.0)).ravel())


def _is_covered(region: Region, outlines: Outlines) -> bool:
    """Return whether each outline encloses the region and a margin for the blur."""
    reach = _REACH * outlines.blur + 1.0
    low, high = region.first_row - reach, region.last_row + reach
    lines = np.linspace(region.first_column - reach, region.last_column + reach, _RIM_COLUMNS)
    for outline in outlines.each:
        spans = spans_of(outline, lines, 0)
        if spans.missed.any() or (spans.first > low).any() or (spans.last < high).any():
            return False
    return True


def _add_side_columns(
    columns: FloatArray, region: Region, outlines: Outlines
) -> tuple[FloatArray, FloatArray]:
    """Add columns across the left and the right rim if these are upright."""
    row = np.linspace(region.first_row, region.last_row - 1, 9)
    spans = [spans_of(outline, row, 1) for outline in outlines.each]
    low, high = region.first_column - 0.5, region.last_column - 0.5
    is_kept, parts = np.ones(len(columns), dtype=bool), []
    for side in ("first", "last"):
        upright = [getattr(span, side + "_slope") < STEEP_SLOPE for span in spans]
        ends = [getattr(span, side)[own] for span, own in zip(spans, upright, strict=True)]
        places = pixel_boundary(np.concatenate(ends))
        if not len(places):
            continue
        reach = math.ceil(_REACH * outlines.blur)
        left = min(max(float(places.min()) - reach, low), high)
        right = min(max(float(places.max()) + reach, low), high)
        if not 0.0 < right - left < region.columns / 4.0:
            continue
        is_kept &= (columns < left) | (columns > right)
        nodes = np.rint(left + (right - left) * _even_nodes(_SIDE_NODES)[0])
        parts.append((nodes, (right - left) / (high - low)))
    fractions = sum(fraction for _, fraction in parts)
    remaining = int(np.count_nonzero(is_kept))
    if not remaining:
        return columns, np.full(len(columns), 1.0 / len(columns))
    weights = [np.full(remaining, (1.0 - fractions) / remaining)]
    weights += [np.full(_SIDE_NODES, fraction / _SIDE_NODES) for _, fraction in parts]
    return np.concatenate([columns[is_kept], *(nodes for nodes, _ in parts)]), np.concatenate(
        weights
    )


def _choose_rows(
    region: Region, columns: FloatArray, outlines: Outlines
) -> tuple[FloatArray, FloatArray, int]:
    """Choose each column's rows beside the panel, across its rims, and, from an index on, inside.

    Nodes of zero weight in all columns are dropped, except one at each end, where a rim may lie.
    """
    spans, blur = [spans_of(outline, columns, 0) for outline in outlines.each], outlines.blur
    low, high = region.first_row - 0.5, region.last_row - 0.5
    edges: list[FloatArray] = []
    for side in ("first", "last"):
        places = pixel_boundary(np.stack([getattr(span, side) for span in spans]))
        slopes = np.stack([getattr(span, side + "_slope") for span in spans]).max(axis=0)
        reach = np.ceil(_REACH * blur * np.sqrt(1.0 + np.minimum(slopes, 1e3) ** 2))
        upper, lower = places.min(axis=0), places.max(axis=0)
        edges += [upper - reach, upper, lower, lower + reach] if blur else [upper, lower]
    half = len(edges) // 2
    middle = np.clip(np.floor((edges[0] + edges[-1]) / 2.0) + 0.5, low, high)
    ends = [np.full(len(middle), low)]
    ends += [np.clip(edge, low, middle) for edge in edges[:half]]
    ends += [np.clip(edge, middle, high) for edge in edges[half:]]
    ends += [np.full(len(middle), high)]
    rim = _even_nodes(_MOVED_NODES if outlines.are_changed else 0)
    across = [_even_nodes(_BLURRED_NODES), rim, _even_nodes(_BLURRED_NODES)] if blur else [rim]
    outer_nodes = _even_nodes(_BESIDE_NODES)
    parts = [outer_nodes, *across, (_GAUSS, _GAUSS_WEIGHTS), *across, outer_nodes]
    rows, weights = [], []
    for (nodes, fractions), start, end in zip(parts, ends[:-1], ends[1:], strict=True):
        length = (end - start)[:, None]
        places = start[:, None] + length * nodes
        rows.append(places if nodes is _GAUSS else np.rint(places))
        weights.append(length / (high - low) * fractions)
    places, fractions = np.hstack(rows), np.hstack(weights)
    first = (places.shape[1] - len(_GAUSS)) // 2
    needed: BoolArray = np.asarray(fractions.any(axis=0))
    needed[first : first + len(_GAUSS)] = True
    needed[1:-1] |= needed[2:] | needed[:-2]
    return places[:, needed], fractions[:, needed], int(np.count_nonzero(needed[:first]))


def _take_all_rows(region: Region, inner: FloatArray) -> tuple[FloatArray, FloatArray, int]:
    """Take all rows, and amid them, without a weight, the rows between the rims."""
    each = np.arange(region.first_row, region.last_row, dtype=np.float64)
    middle = len(each) // 2
    above, below = (np.tile(part, (len(inner), 1)) for part in (each[:middle], each[middle:]))
    weights = np.insert(np.full(len(each), 1.0 / len(each)), [middle] * inner.shape[1], 0.0)
    return np.hstack([above, inner, below]), np.tile(weights, (len(inner), 1)), middle


def _even_nodes(count: int) -> tuple[FloatArray, FloatArray]:
    """Return evenly spaced places between 0 and 1, and their weights."""
    return (np.arange(count) + 0.5) / max(count, 1), np.full(count, 1.0 / max(count, 1))


def _gain_at_sample(
    gains: tuple[Gain, ...],
    rows: FloatArray,
    along: slice,
    nearest: IndexArray,
    region: Region,
) -> FloatArray:
    """Return the product of gains at the sample's pixels."""
    first, last = float(region.first_row), float(max(region.last_row - 1, region.first_row + 1))
    lines = np.linspace(first, last, _GAIN_ROWS)
    place = np.clip((rows - first) * ((_GAIN_ROWS - 1) / (last - first)), 0.0, _GAIN_ROWS - 1.001)
    below = place.astype(np.int64)
    fraction = place - below
    product: FloatArray = np.ones(rows.shape)
    for gain in gains:
        sampled_gain = np.asarray(gain.at(lines, along), dtype=np.float64)[:, nearest]
        column = np.arange(len(nearest))[:, None]
        product = product * (
            sampled_gain[below, column] * (1.0 - fraction)
            + sampled_gain[below + 1, column] * fraction
        )
    return product
