"""The fraction of each pixel's light that comes from the panel, bent and blurred by the lens."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.camera.coverage import Coverage
from occ_model.camera.normal import normal_fraction
from occ_model.camera.optics import Optics
from occ_model.results.decoding import Region

NEGLIGIBLE_BLUR = 0.1  # blur in pixels below which no light of a neighbour reaches a pixel
STEEP_SLOPE = 1.5  # slope, in pixels a pixel, above which a rim counts as steep
_FAR_RIM = 1e6  # distance in pixels at which a rim no longer matters


@dataclass(frozen=True, eq=False, slots=True)
class Outlines:
    """The panel's outline in the picture, as the lens's effects move or blur it."""

    plain: FloatArray  # Without any effect
    moved: Mapping[str, FloatArray]  # With each effect alone that moves it
    blurs: Mapping[str, float]  # Standard deviation in pixels of each effect that blurs it

    @classmethod
    def of(cls, optics: Mapping[str, Optics], plain: Optics) -> Self:
        """Compare the optics with each effect alone with those without any."""
        return cls(
            plain.outline,
            {n: lens.outline for n, lens in optics.items() if lens.outline is not plain.outline},
            {n: lens.blur for n, lens in optics.items() if lens.blur > NEGLIGIBLE_BLUR},
        )

    @property
    def each(self) -> list[FloatArray]:
        """The outline without effects, then with each that moves it."""
        return [self.plain, *self.moved.values()]

    @property
    def blur(self) -> float:
        """The largest blur."""
        return max(self.blurs.values(), default=0.0)

    @property
    def are_changed(self) -> bool:
        """Whether any effect moves or blurs the outline."""
        return bool(self.moved or self.blurs)

    @property
    def sets_of_effects(self) -> list[frozenset[str]]:
        """All sets of the effects that move or blur the outline."""
        names = [*self.moved, *self.blurs]
        numbers = range(2 ** len(names))
        return [frozenset(n for place, n in enumerate(names) if k >> place & 1) for k in numbers]

    def moving_effect(self, names: Collection[str]) -> str:
        """Return the effect of some that moves the outline; empty if none does."""
        return next((name for name in self.moved if name in names), "")

    def blur_of(self, names: Collection[str]) -> float:
        """Return the largest blur of some effects."""
        return max((blur for name, blur in self.blurs.items() if name in names), default=0.0)


@dataclass(frozen=True, eq=False, slots=True)
class Spans:
    """Where each line enters and leaves an outline, and the outline's slope there: shape (lines,).

    For a line that misses the outline, ``missed`` is True, and both places are the nearest point.
    """

    first: FloatArray
    last: FloatArray
    first_slope: FloatArray
    last_slope: FloatArray
    missed: BoolArray


def spans_of(outline: FloatArray, lines: FloatArray, axis: int) -> Spans:
    """Intersect an outline with lines along which the coordinate ``axis`` is constant."""
    along = np.roll(outline[:, axis], -int(np.argmin(outline[:, axis])))
    across = np.roll(outline[:, 1 - axis], -int(np.argmin(outline[:, axis])))
    turn = int(np.argmax(along))
    # The outline's two sides between its ends, each in rising order, as interpolation needs it.
    there = along[: turn + 1], across[: turn + 1]
    back = np.append(along[turn:], along[0])[::-1], np.append(across[turn:], across[0])[::-1]
    chains = [(np.maximum.accumulate(rising), places) for rising, places in (there, back)]
    ends = [[np.interp(lines + step, *chain) for step in (0.0, -0.5, 0.5)] for chain in chains]
    if ends[0][0].sum() > ends[1][0].sum():
        ends.reverse()
    # The smaller slope of the two sides, since another edge begins at a corner.
    slopes = [2.0 * np.minimum(abs(at - before), abs(after - at)) for at, before, after in ends]
    misses = (lines < along[0]) | (lines > along[turn])
    return Spans(ends[0][0], ends[1][0], slopes[0], slopes[1], misses)


def covers_of(
    columns: FloatArray, rows: FloatArray, outlines: Outlines
) -> dict[frozenset[str], FloatArray | None]:
    """Return the panel's fraction of each pixel, for every set of the effects on the outline."""
    covers: dict[frozenset[str], FloatArray | None] = {}
    distances: dict[str, tuple[FloatArray, ...]] = {}
    for names in outlines.sets_of_effects:
        moving, blur = outlines.moving_effect(names), outlines.blur_of(names)
        if moving not in distances:
            outline = outlines.moved.get(moving, outlines.plain)
            distances[moving] = _distances(outline, columns, rows, outlines.blur)
        top, bottom, left, right = distances[moving]
        if blur:
            down = _light_fraction(top, blur) + _light_fraction(bottom, blur) - 1.0
            along = _light_fraction(left, blur) + _light_fraction(right, blur) - 1.0
            covers[names] = np.maximum(np.minimum(down, along), 0.0)
        else:
            inside = (top > 0.0) & (bottom > 0.0) & (left > 0.0) & (right > 0.0)
            covers[names] = inside.astype(np.float64)
    return covers


def exact_covers(
    region: Region, rows: FloatArray, outlines: Outlines
) -> dict[frozenset[str], FloatArray | None]:
    """Return what :func:`covers_of` does for rows in each column of a region, pixel by pixel."""
    corner = np.array([region.first_column, region.first_row])
    row = np.clip(np.rint(rows) - region.first_row, 0, region.rows - 1).astype(int)
    places = row, np.arange(region.columns)[:, None]
    covers: dict[frozenset[str], FloatArray | None] = {}
    for names in outlines.sets_of_effects:
        outline = outlines.moved.get(outlines.moving_effect(names), outlines.plain)
        blur = outlines.blur_of(names)
        coverage = Coverage(outline - corner, region.rows, region.columns, blur)
        covers[names] = coverage.rows(range(region.rows))[places].astype(np.float64)
    return covers


def _light_fraction(distance: FloatArray, blur: float) -> FloatArray:
    """Return the fraction of the panel's light at some distance inside a blurred rim.

    A narrow blur is a sum over pixels with the weights of a sampled Gaussian.
    """
    if blur >= 1.0:
        return normal_fraction(distance / blur)
    weights = np.exp(-0.5 * (np.arange(-6.0, 7.0) / blur) ** 2)
    fractions = np.concatenate([[0.0], np.cumsum(weights)]) / weights.sum()
    return np.asarray(np.interp(distance, np.arange(-6.5, 7.0), fractions))


def _distances(
    outline: FloatArray, columns: FloatArray, rows: FloatArray, blur: float
) -> tuple[FloatArray, ...]:
    """Return how far each pixel lies inside the top, the bottom, the left and the right rim."""
    down = spans_of(outline, columns, 0)
    along = spans_of(outline, rows.ravel(), 1)
    lines = np.broadcast_to(columns[:, None], rows.shape)
    top, bottom = _distances_from_rims(down, rows.T, blur)
    left, right = (
        distance.reshape(rows.shape)
        for distance in _distances_from_rims(along, lines.ravel(), blur)
    )
    outside = down.missed[:, None] & along.missed.reshape(rows.shape)
    return np.where(outside, -_FAR_RIM, top.T), bottom.T, left, right


def _distances_from_rims(
    spans: Spans, places: FloatArray, blur: float
) -> tuple[FloatArray, FloatArray]:
    """Return how far places on lines lie inside the first and the last rim on their line.

    The distance to a slanting rim is shorter than along the line, except for a narrow blur, which
    acts along the axes. Inside a steep rim only the distance along the other axis counts.
    """
    distances = []
    for sign, rim, slope in (
        (1.0, spans.first, spans.first_slope),
        (-1.0, spans.last, spans.last_slope),
    ):
        slant = 1.0 / np.sqrt(1.0 + slope * slope)
        if blur < 1.0:
            slant = np.where(slope < STEEP_SLOPE, 1.0, slant)
        distance = sign * (places - pixel_boundary(rim)) * slant
        is_far = spans.missed | ((slope > STEEP_SLOPE) & (distance > 0.0))
        distances.append(np.where(is_far, _FAR_RIM, distance))
    return distances[0], distances[1]


def pixel_boundary(places: FloatArray) -> FloatArray:
    """Return the boundary between the two pixels whose centres a rim at each place separates."""
    return np.asarray(np.ceil(places) - 0.5)
