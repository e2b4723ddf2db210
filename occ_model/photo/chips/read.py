"""Read the chips in view of a photo, without knowing what is sent or whether it repeats."""

from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import MatchError, counted, distinct_texts
from occ_model.photo.chips.edges import (
    LEAST_EDGES,
    LEAST_PAIR,
    Edges,
    certainty,
    chips_between,
    coarsest,
    edges_of,
    lattice_at,
    without_rims,
)
from occ_model.photo.reading.load import Corners, Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.lamp import Lamp
from occ_model.results.match import ChipReading

_EXPOSURES = np.array([0.05, 0.2, 0.4, 0.6, 0.8, 1.0])  # in chips, tried to explain the profile

_RIGHT_BELOW, _WRONG_ABOVE = 0.02, 0.08
"""Unexplained fractions of the variance below which nearly all readings are right, and above which
none is; half-way about half of them are (1,300 simulated messages)."""

_LEAST_OF_A_BURST = 8  # minimum number of edges in a burst: fewer lie on some lattice by chance
_LEAST_PAUSE_RATIO = 1.25  # minimum ratio of a pause to the longest bright run

_MOST_INCOHERENCE_RATIO, _LEAST_COHERENCE = 0.5, 0.9
"""Maximum incoherence with a lattice for each burst, relative to that with one lattice for all, and
minimum coherence with the former."""


def read_chips(photo: Photo, region: Corners | Lamp | None = None) -> ChipReading:
    """Read the chips in view of a photo, without knowing what is sent or whether it repeats.

    The edges of the stripes lie on a lattice of chips, the coarsest that explains them; a pause
    between bursts that is not a whole number of chips is counted as the nearest one. Chips whose
    exposure is longer than themselves leave too few edges to be read so.

    Parameters
    ----------
    photo
        The photo.
    region
        First row, row after the last, first column and column after the last of the rectangle in
        which stripes are searched; or a lamp; None for the whole photo.

    Returns
    -------
    ChipReading
        The chips between the first edge and the last one.

    Raises
    ------
    MatchError
        There are no stripes, their edges are too few or too near, or lie on no lattice of chips.
    ParameterError
        ``region`` is not a rectangle of the photo.
    """
    stripes = find_stripes(photo, region)
    seen = edges_of(stripes.flattened)
    edges = in_phase(seen)
    lattice = coarsest(edges)
    if lattice is not None:
        kept = without_rims(edges, lattice)
        edges, seen = kept, _kept_among(seen, edges, kept)
    found = None if lattice is None else chips_between(edges, lattice)
    if lattice is None or found is None:
        raise MatchError(f"No chips can be read: {_why_unread(edges)}")
    chips, first = found
    start = (first + 0.5 * (lattice.rising + lattice.falling)) / lattice.frequency
    unexplained = _unexplained(stripes.flattened, seen, lattice.frequency)
    trust = np.clip((_WRONG_ABOVE - unexplained) / (_WRONG_ABOVE - _RIGHT_BELOW), 0.0, 1.0)
    return ChipReading(
        chips=chips,
        columns_per_chip=1.0 / lattice.frequency,
        confidence=certainty(edges, lattice) * float(trust),
        start=stripes.region.first_column + start,
        region=stripes.region,
    )


def _why_unread(edges: Edges) -> str:
    """Say why edges give no chips: too few of them, too near each other, or none on a lattice."""
    together = edges.shortest_pair
    if edges.count < LEAST_EDGES:
        return (
            f"{counted(edges.count, 'edge')} of stripes are in view; at least {LEAST_EDGES} are "
            "needed; come closer, or raise the frequency."
        )
    if together <= LEAST_PAIR:
        shown, limit = distinct_texts(together, LEAST_PAIR)
        return (
            f"the shortest bright and the shortest dark stripe have {shown} columns together; more "
            f"than {limit} are needed; come closer, or lower the frequency."
        )
    return (
        f"the {edges.count} edges of the stripes lie on no common lattice of chips; a shorter "
        "exposure, or more columns a chip, give clearer edges."
    )


def _kept_among(seen: Edges, moved: Edges, kept: Edges) -> Edges:
    """Return the seen edges whose moved ones are kept."""
    return Edges(
        seen.rising[np.isin(moved.rising, kept.rising)],
        seen.falling[np.isin(moved.falling, kept.falling)],
    )


def _unexplained(flattened: FloatArray, edges: Edges, frequency: float) -> float:
    """Return the variance fraction of a profile that chips leave unexplained at the best exposure.

    Between the first edge and the last; longer bright runs than the chips' are allowed for by the
    edges themselves: each chip is seen where its own edges are.
    """
    columns = np.arange(int(np.ceil(edges.places[0])), int(edges.places[-1]) + 1)
    data = flattened[columns] - flattened[columns].mean()
    power = float(data @ data)
    # Bright between a rising edge and the next falling one, as an integral that is exact between.
    lit = np.concatenate([[0.0], np.cumsum(np.diff(edges.places) * edges.rises[:-1])])
    least = power
    for exposure in _EXPOSURES / frequency:
        ends = (np.interp(columns + side * exposure, edges.places, lit) for side in (0.5, -0.5))
        model = next(ends) - next(ends)
        model -= model.mean()
        energy = float(model @ model)
        if energy > 0.0:
            least = min(least, power - float(model @ data) ** 2 / energy)
    return least / max(power, 1e-12)


def in_phase(edges: Edges) -> Edges:
    """Move bursts by up to half a chip until all lie on one lattice, unless they do already."""
    bursts = _bursts(edges)
    if len(bursts) < 2:
        return edges
    longest = max(bursts, key=lambda one: one.count)
    whole, own = coarsest(edges), coarsest(longest)
    if own is None:
        return edges
    frequency = own.frequency
    turns = [lattice_at(one, frequency) for one in bursts]
    first = 0.5 * (turns[0].rising + turns[0].falling)
    moved = []
    for one, turn in zip(bursts, turns, strict=True):
        off = (0.5 * (turn.rising + turn.falling) - first + 0.5) % 1.0 - 0.5
        moved.append(Edges(one.rising - off / frequency, one.falling - off / frequency))
    joined = Edges.joined(moved)
    lattice = coarsest(joined)
    before = 0.0 if whole is None else whole.coherence
    least = max(_LEAST_COHERENCE, 1.0 - _MOST_INCOHERENCE_RATIO * (1.0 - before))
    return edges if lattice is None or lattice.coherence < least else joined


def _bursts(edges: Edges) -> list[Edges]:
    if min(len(edges.rising), len(edges.falling)) < 2:
        return [edges]
    bright = _gaps(edges.rising, edges.falling)
    dark = _gaps(edges.falling, edges.rising)
    cuts = [
        float(place) for place, gap in zip(edges.falling[: len(dark)], dark, strict=True)
        if gap > _LEAST_PAUSE_RATIO * bright.max()
    ]  # fmt: skip
    bounds = [-np.inf, *cuts, np.inf]
    found: list[Edges] = []
    for first, last in pairwise(bounds):
        part = edges.within(np.nextafter(first, np.inf), last)
        if found and (part.count < _LEAST_OF_A_BURST or found[-1].count < _LEAST_OF_A_BURST):
            part = Edges.joined([found.pop(), part])  # too few edges for a phase
        found.append(part)
    return found


def _gaps(begins: FloatArray, ends: FloatArray) -> FloatArray:
    """Return the distance from each edge of a kind to the next one of the other, where there is."""
    after = np.searchsorted(ends, begins)
    inside = after < len(ends)
    return np.asarray(ends[after[inside]] - begins[inside])
