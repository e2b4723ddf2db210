"""How a lamp blinks: its period, or the length of a chip of its code, from its edges."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamps.edges import LampEdges
from occ_model.photo.lamps.segments import Segment, segments_of

_LATTICE_TOLERANCE = 0.12  # maximum distance of an edge from a lattice relative to the spacing

_CODE_CHIPS_OFF, _CODE_COLUMNS_OFF = 0.045, 0.12
_PULSE_CHIPS_OFF, _PULSE_COLUMNS_OFF = 0.08, 0.4
"""Maximum root mean square distance of the edges of a code, and of a pulse, from their lattices: in
chips and, besides, in columns."""

_TOLERANCE_FACTOR = 0.5  # factor of the tolerance for the mean edges of many rows
_MOST_RATIO = 0.5  # maximum ratio of the distances from a code's lattices after a rim is left out
_LEAST_DEVIATION = 0.1  # minimum standard deviation of an edge in columns

_SPACING_TOLERANCE, _SHADED_TOLERANCE = 0.003, 0.06
"""Relative difference of the spacings of a lamp and its reflection; the second is divided by
the number of edges: if a lamp is darker at its rim, its outer edges lie farther inside in the
reflection on a lit wall."""

_PART_TOLERANCE = 0.03  # maximum relative difference of the spacings of two parts of a lamp


@dataclass(frozen=True, eq=False, slots=True)
class LampTiming:
    """Lattices of the same spacing that a lamp's rising and falling edges lie on."""

    spacing: float  # columns of a period of a pulse that repeats, or of a chip of a code
    uncertainty: float  # its standard deviation in columns
    rise: float  # rise, fall: column of a rising and of a falling edge, less whole spacings
    fall: float
    is_code: bool
    # Root mean square of the edges' distances from their places, as a fraction of a chip.
    off: float
    edges: LampEdges

    @property
    def chip(self) -> float:
        """Columns of a chip; a pulse that repeats counts as two chips a cycle."""
        return self.spacing if self.is_code else 0.5 * self.spacing

    @property
    def most_off(self) -> float:
        """Largest ``off`` of edges that are those of one lamp."""
        if self.is_code:
            return _CODE_CHIPS_OFF + _CODE_COLUMNS_OFF / self.chip
        return _PULSE_CHIPS_OFF + _PULSE_COLUMNS_OFF / self.chip

    @property
    def longest_stripe(self) -> float:
        """Columns of the widest bright stripe that has both its edges."""
        rises, place = self.edges.rises, self.edges.place
        whole = rises[:-1] & ~rises[1:]
        return float(np.diff(place)[whole].max()) if whole.any() else self.spacing

    def off_lattice(self, edges: LampEdges) -> FloatArray:
        """Return how far edges are from the lattices of their kind, in spacings."""
        turns = (edges.place - np.where(edges.rises, self.rise, self.fall)) / self.spacing
        return np.abs(turns - np.rint(turns))

    def agrees(self, other: "LampTiming") -> bool:
        """Whether another lamp blinks in time with this one: its edges lie on the same lattices.

        Of a code, a part that alternates looks like a repeated pulse of two chips.
        """
        spacing = other.chip if self.is_code else other.spacing
        same = _SPACING_TOLERANCE + _SHADED_TOLERANCE / len(other.edges)
        if other.is_code > self.is_code or abs(self.spacing - spacing) > same * self.spacing:
            return False
        return bool(np.median(self.off_lattice(other.edges)) < _LATTICE_TOLERANCE)


def common_timing(one: LampTiming, other: LampTiming) -> LampTiming | None:
    """Return the timing whose lattices hold the edges of both; None if there is none."""
    if one.is_code or other.is_code:
        agree = one.agrees(other) or other.agrees(one)
        return max(one, other, key=lambda each: len(each.edges)) if agree else None
    if abs(one.spacing - other.spacing) > _PART_TOLERANCE * one.spacing:
        return None
    edges = LampEdges.join([one.edges, other.edges])
    timing = _fit(edges, np.ones(len(edges)), one.spacing, is_code=False)
    return timing if timing is not None and timing.off < 0.5 * timing.most_off else None


def timings_of(edges: LampEdges, weights: FloatArray, codes: bool = True) -> list[LampTiming]:
    """Find the period or the chip of edges that several strips have in common.

    Lamps side by side give several timings. ``weights``: shape (edges,), number of segments that
    show each edge. ``codes``: whether some edges may be those of a code.
    """
    found: list[LampTiming] = []
    waiting = [(edges, weights)]
    while waiting:
        part, shown = waiting.pop()
        for segment in segments_of(part, 0, _TOLERANCE_FACTOR if codes else 1.0, codes=codes):
            timing = _refine_timing(segment, part, shown)
            if timing is not None and timing.off < timing.most_off:
                found.append(timing)
                continue
            # Edges of two lamps side by side lie near some lattice too, but not on it.
            pulses = segments_of(segment.edges, 0, _TOLERANCE_FACTOR, codes=False)
            if not pulses:
                continue
            longest = max(pulses, key=lambda one: len(one.edges))
            timing = _refine_timing(longest, part, shown)
            found += [timing] if timing is not None else []
            before = part.place < longest.edges.place[0]
            after = part.place > longest.edges.place[-1]
            within = (part.place >= segment.edges.place[0]) & (
                part.place <= segment.edges.place[-1]
            )
            waiting += [
                (part.where(side & within), shown[side & within]) for side in (before, after)
            ]
    return found


def _refine_timing(segment: Segment, edges: LampEdges, weights: FloatArray) -> LampTiming | None:
    is_code = segment.period is None
    spacing = segment.chip if segment.period is None else segment.period
    inside = (edges.place >= segment.edges.place[0]) & (edges.place <= segment.edges.place[-1])
    first, last = int(np.argmax(inside)), len(edges) - int(np.argmax(inside[::-1]))
    fit = _fit(edges.part(first, last), weights[first:last], spacing, is_code)
    # The rim of a lamp is an edge too, which lies anywhere.
    for left, right in ((1, 0), (0, 1), (1, 1)) if is_code else ():
        begin, end = first + left, last - right
        inner = _fit(edges.part(begin, end), weights[begin:end], spacing, is_code)
        if fit is not None and inner is not None and inner.off < _MOST_RATIO * fit.off:
            fit = inner
    return fit


def _fit(edges: LampEdges, weights: FloatArray, spacing: float, is_code: bool) -> LampTiming | None:
    """Fit lattices to rising and falling edges; ``spacing``: roughly that of both."""
    steps = np.zeros(len(edges))
    for kind in (True, False):
        same = edges.rises == kind
        if not same.any():
            return None
        # Counted from one edge to the next, so that an error of the spacing does not add up.
        apart = np.rint(np.diff(edges.place[same]) / spacing)
        steps[same] = np.concatenate([[0.0], np.cumsum(apart)])
    if not steps.any():
        return None
    shapes = np.column_stack([steps, edges.rises, ~edges.rises]).astype(np.float64)
    root = np.sqrt(weights)
    weighted = shapes * root[:, None]
    fitted, *_ = np.linalg.lstsq(weighted, edges.place * root, rcond=None)
    residual = edges.place - shapes @ fitted
    freedom = max(len(edges) - 3, 1)
    inverse = np.linalg.pinv(weighted.T @ weighted)
    # Edges are found to a tenth of a column at best, whatever few of them happen to agree.
    variance = max(
        float(weights @ residual**2) / freedom, float(weights.mean()) * _LEAST_DEVIATION**2
    )
    deviation = float(np.sqrt(variance * inverse[0, 0]))
    chip = spacing if is_code else 0.5 * spacing
    off = float(np.sqrt(np.average(residual**2, weights=weights))) / chip
    found, rise, fall = fitted.tolist()
    return LampTiming(found, deviation, rise, fall, is_code, off, edges)
