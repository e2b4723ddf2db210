"""Find the stripes in a photo: their region, their two levels, and their period.

A rolling shutter makes the same stripes in every row that shows the panel. The panel's rows are
those that vary together, and its columns lie between the first and the last stripe's edge.
"""

from dataclasses import replace

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import FLAT_SPAN, WHITE
from occ_model.errors import MatchError, ParameterError, distinct_texts, inflect
from occ_model.photo.reading.load import Corners, Photo, column_means, part_of, region_within
from occ_model.photo.stripes.envelope import envelope
from occ_model.photo.stripes.period import repeat_period
from occ_model.products import combine, leading_direction, row_products
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import Stripes

BANDS = 64  # maximum number of bands into which rows are gathered

_LEAST_STRENGTH = 0.25  # minimum strength of the common stripes in a row relative to the median
_LEAST_SLOPE = 0.3  # minimum slope of an edge relative to a steep one, as lenses darken the rim
_LEAST_NEIGHBOUR_RATIO = 0.6  # minimum slope of an outer edge relative to its neighbours
_NOISE_SLOPE = 0.08  # slope relative to a steep edge below which it is noise or compression
_SLOPE_COLUMNS = 4  # number of columns over which a slope is measured
_MOST_GAP_RATIO = 1.6  # ratio to the widest gap between edges above which a gap ends the panel
_STEEP_QUANTILE = 0.98  # quantile of the slopes that counts as a steep edge; rims are steeper

_LEAST_COLUMNS = 16
_LEAST_EDGES = 3

_LEAST_COHERENCE = 0.2  # minimum fraction of the variation that all bands have in common
SATURATED_LEVEL = 0.996  # fraction of white above which a sample is saturated
_MOST_SATURATED = 0.8  # saturated fraction of the columns above which no stripes are visible

_LEAST_STRIPS = 3  # number of strips above which the outermost ones, cut by the rim, are left out


def find_stripes(photo: Photo, region: Corners | Lamp | None = None) -> Stripes:
    """Find the stripes in a photo, in a rectangle of it, or in a lamp of any shape.

    Parameters
    ----------
    photo
        The photo, columns being the scan axis.
    region
        First row, row after the last, first column and column after the last of the rectangle in
        which stripes are searched; or a lamp; None for the whole photo.

    Returns
    -------
    Stripes

    Raises
    ------
    MatchError
        There are no stripes: the photo is flat or too narrow, or its rows do not change alike from
        column to column. The message mentions stripes along the other axis.
    ParameterError
        ``region`` is not a rectangle of the photo.
    """
    if isinstance(region, Lamp):
        return _stripes_between(photo, region.region, lamp_profile(photo, region))
    rectangle = region_within(photo, region)
    part = photo if region is None else part_of(photo, rectangle)
    try:
        stripes = _stripes_of(part)
    except MatchError as error:
        raise MatchError(*error.reasons, *_explain_other_axis(part)) from None
    return replace(stripes, region=stripes.region.within(rectangle))


def _explain_other_axis(photo: Photo) -> list[str]:
    """State that a photo has stripes along the other axis; empty if it has none."""
    samples = np.ascontiguousarray(photo.samples.T)
    try:
        stripes = _stripes_of(replace(photo, samples=samples))
    except MatchError:
        return []
    if stripes.period is None:
        return []
    axis = "columns" if photo.turned else "lines"
    return [
        f"There are stripes along the other axis, which repeat after {stripes.period:.1f} rows: if "
        f"they are the shutter's, read the photo with {axis} as the scan axis."
    ]


def _stripes_of(photo: Photo) -> Stripes:
    columns = photo.samples.shape[1]
    if columns < _LEAST_COLUMNS:
        raise MatchError(
            f"No stripes: the photo has {inflect(columns, 'column')}; "
            f"at least {_LEAST_COLUMNS} are needed."
        )
    first_row, last_row = _find_striped_rows(photo)
    rows = Region(first_row, last_row, 0, columns)
    return _stripes_between(photo, rows, column_means(photo, first_row, last_row))


def _stripes_between(photo: Photo, rows: Region, profile: FloatArray) -> Stripes:
    first, last, gap = _find_striped_columns(profile)
    profile = profile[first:last]
    low, high = envelope(profile, 2 * gap)
    swing = float(np.median(high - low))
    _check_white(profile)
    if swing < FLAT_SPAN:
        raise MatchError(_explain_flat(profile, swing, 2 * gap))
    high = np.maximum(high, low + FLAT_SPAN)
    repetition = repeat_period((profile - low) / (high - low))
    period, uncertainty = repetition if repetition is not None else (None, None)
    region = Region(0, rows.rows, first, last).within(rows)
    part = region.crop(photo.samples)
    saturated = np.count_nonzero(part >= SATURATED_LEVEL * photo.white) / part.size
    return Stripes(region, profile, low, high, period, uncertainty, saturated)


def _check_white(profile: FloatArray) -> None:
    white = float(np.mean(profile >= SATURATED_LEVEL * WHITE))
    if white > _MOST_SATURATED:
        percent, limit = distinct_texts(100.0 * white, 100.0 * _MOST_SATURATED, 0)
        raise MatchError(
            f"No stripes: {percent} % of the panel's columns are saturated; at most {limit} % are "
            "allowed; expose less, or choose another channel."
        )


def _explain_flat(profile: FloatArray, swing: float, width: int) -> str:
    """Explain why a profile with this median swing within ``width`` columns has no stripes."""
    span = float(np.ptp(profile))
    if span < FLAT_SPAN:
        return f"No stripes: the columns differ by {span:.2g} grey levels only."
    return (
        f"No stripes with edges: the columns differ by {span:.2g} grey levels in all, but within "
        f"{width} columns usually by only {swing:.2g}; at least {FLAT_SPAN:g} is needed."
    )


def _find_striped_rows(photo: Photo) -> tuple[int, int]:
    """Find the rows that vary together, by the strength of the common stripes in each band."""
    rows, columns = photo.samples.shape
    bands = min(BANDS, rows)
    means = cv2.resize(photo.samples, (columns, bands), interpolation=cv2.INTER_AREA)
    slopes = np.diff(means.astype(np.float64) * (WHITE / photo.white), axis=1)
    if not slopes.any():
        profile = column_means(photo, 0, rows)
        _check_white(profile)
        raise MatchError(_explain_flat(profile, 0.0, columns))
    common, strengths = _common_slopes(slopes)
    coherence = float(strengths @ strengths) / float((slopes**2).sum())
    if bands > 1 and coherence < _LEAST_COHERENCE:
        percent, limit = distinct_texts(100.0 * coherence, 100.0 * _LEAST_COHERENCE, 0)
        raise MatchError(
            f"No stripes: only {percent} % of the changes from column to column, by their squares, "
            f"are common to all rows; at least {limit} % are needed."
        )
    has_stripes = strengths > _LEAST_STRENGTH * np.median(np.sort(strengths)[-(bands // 2 + 1) :])
    best = int(strengths.argmax())
    first, last = best, best + 1
    while first > 0 and has_stripes[first - 1]:
        first -= 1
    while last < bands and has_stripes[last]:
        last += 1
    if bands == rows:
        return first, last
    typical = float(np.median(strengths[first:last]))
    return (
        _edge_row(photo, first * rows // bands, common, typical, -1),
        _edge_row(photo, -(-last * rows // bands), common, typical, +1),
    )


def _common_slopes(slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the slopes that the bands share, of norm one, and their strength in each band."""
    # The leading pair of singular vectors, from the small matrix of the bands' products.
    common = combine(leading_direction(row_products(slopes, slopes)), slopes)
    common /= np.linalg.norm(common)
    strengths = row_products(common, slopes)
    return (-common, -strengths) if strengths.sum() < 0.0 else (common, strengths)


def _edge_row(photo: Photo, row: int, common: FloatArray, typical: float, outward: int) -> int:
    """Find the first or last row with stripes, within a band to either side of a row."""
    rows = len(photo.samples)
    height = -(-rows // BANDS)
    first, last = max(0, row - height), min(rows, row + height)
    part = photo.samples[first:last].astype(np.float64) * (WHITE / photo.white)
    strengths = row_products(common, np.diff(part, axis=1))
    striped: list[int] = np.flatnonzero(strengths > 0.5 * typical).tolist()
    if not striped:
        return row
    return first + striped[0] if outward < 0 else first + striped[-1] + 1


def _find_striped_columns(profile: FloatArray) -> tuple[int, int, int]:
    """Find the columns from the first edge to the last, and the widest gap between two edges."""
    slopes = _local_range(profile)
    # Without noise and with few edges, the quantile may be zero.
    steep = float(np.quantile(slopes, _STEEP_QUANTILE)) or float(slopes.max())
    edges = np.flatnonzero(slopes > _LEAST_SLOPE * steep)
    gaps = np.diff(edges)
    # Noise outside the panel is farther from its edges than these are from each other.
    inner = gaps[len(gaps) // 4 : len(gaps) - len(gaps) // 4]
    longest = int(_MOST_GAP_RATIO * inner.max()) if inner.size else 0
    wide_gaps = np.flatnonzero(gaps > max(longest, _SLOPE_COLUMNS))
    before, after = (
        wide_gaps[wide_gaps < len(gaps) // 4],
        wide_gaps[wide_gaps >= len(gaps) - len(gaps) // 4],
    )
    edges = edges[
        int(before[-1]) + 1 if before.size else 0 : int(after[0]) + 1 if after.size else None
    ]
    separate_edges = int(np.count_nonzero(np.diff(edges) > 1)) + 1 if edges.size else 0
    count = max(separate_edges, _count_reversals(profile, edges))
    if count < _LEAST_EDGES:
        raise MatchError(
            f"No stripes: {inflect(count, 'steep edge')} between bright and dark columns; at least "
            f"{_LEAST_EDGES} are needed; come closer to the panel, or raise its frequency."
        )
    gap = int(np.diff(edges).max())
    start = _follow_faint_edges(slopes, int(edges[0]), gap, steep)
    end = len(slopes) - _follow_faint_edges(
        slopes[::-1], len(slopes) - 1 - int(edges[-1]), gap, steep
    )
    return start, end, gap


def _count_reversals(profile: FloatArray, edges: IndexArray) -> int:
    """Count edges by sign changes of the slope, as narrow stripes have no gaps between edges."""
    if edges.size == 0:
        return 0
    slopes = np.diff(profile[edges[0] : edges[-1] + 2])
    steep = slopes[
        np.abs(slopes) > _LEAST_SLOPE * float(np.quantile(np.abs(slopes), _STEEP_QUANTILE))
    ]
    return 1 + int(np.count_nonzero(np.diff(np.sign(steep)))) if steep.size else 0


def _follow_faint_edges(slopes: FloatArray, edge: int, gap: int, steep: float) -> int:
    """Follow the edges outwards from the first steep one while they slowly become fainter.

    A round lamp covers fewer and fewer rows towards its ends; at a panel's rim the stripes end
    abruptly.
    """
    last_slope = float(slopes[edge : edge + gap + 1].max())
    while True:
        window = slopes[max(0, edge - gap) : edge]
        slope = float(window.max(initial=0.0))
        if slope < max(_LEAST_NEIGHBOUR_RATIO * last_slope, _NOISE_SLOPE * steep):
            return edge
        edge += int(np.flatnonzero(window >= _NOISE_SLOPE * steep)[0]) - len(window)
        last_slope = slope


def _local_range(profile: FloatArray) -> FloatArray:
    """Return the range of values in a few columns around each, which exceeds the noise at edges."""
    kernel = np.ones((1, _SLOPE_COLUMNS), dtype=np.uint8)
    line = profile[None, :]
    return np.asarray((cv2.dilate(line, kernel) - cv2.erode(line, kernel))[0], dtype=np.float64)


def lamp_profile(photo: Photo, lamp: Lamp) -> FloatArray:
    """Average each column of a lamp over the rows in which the lamp covers it.

    A round lamp is thus as bright in its outer columns, which cover few rows, as in its middle.
    """
    region = lamp.region
    rows, columns = photo.samples.shape
    if region.last_row > rows or region.last_column > columns:
        raise ParameterError(
            f"The lamp lies at rows up to {region.last_row - 1} and columns up to "
            f"{region.last_column - 1}; allowed: a lamp of this photo, which has "
            f"{inflect(rows, 'row')} and {inflect(columns, 'column')}."
        )
    sums, counts = np.zeros(region.columns), np.zeros(region.columns)
    spans = lamp.spans[1:-1] if len(lamp.spans) > _LEAST_STRIPS else lamp.spans
    for strips in (spans, lamp.spans):
        # The outermost strips count only in columns that no other strip covers.
        missing = counts == 0
        for first, last, left, right in strips.tolist():
            part = photo.samples[first:last, left:right]
            columns_of_strip = slice(left - region.first_column, right - region.first_column)
            sum_of_rows = cv2.reduce(part, 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)[0]
            sums[columns_of_strip] += np.where(missing[columns_of_strip], sum_of_rows, 0.0)
            counts[columns_of_strip] += np.where(missing[columns_of_strip], last - first, 0)
    return np.asarray(sums / np.maximum(counts, 1) * (WHITE / photo.white))
