"""Read the chips in view of a photo, without knowing what is sent or whether it repeats."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.errors import MatchError, distinct_texts, inflect
from occ_model.photo.chips.edges import (
    LEAST_EDGES,
    LEAST_PAIR,
    Edges,
    certainty,
    chips_between,
    edges_of,
    find_coarsest,
    lattice_at,
    part_between_rims,
)
from occ_model.photo.reading.load import Corners, Photo
from occ_model.photo.stripes.find import find_stripes
from occ_model.results.chip_reading import ChipReading
from occ_model.results.lamp import Lamp

_EXPOSURES = np.array([0.05, 0.2, 0.4, 0.6, 0.8, 1.0])  # exposures to try, in chips

_RIGHT_BELOW, _WRONG_ABOVE = 0.02, 0.08
"""Unexplained fractions of the variance below which nearly all readings are right, and above which
none is; half-way about half of them are (1,300 simulated messages)."""

_LEAST_BURST_EDGES = 8  # minimum number of edges in a burst; fewer lie on some lattice by chance
_LEAST_PAUSE_RATIO = 1.25  # minimum ratio of a pause to the longest bright run

_MOST_INCOHERENCE_RATIO, _LEAST_COHERENCE = 0.5, 0.9
"""Maximum ratio of the incoherence with a lattice for each burst to that with one lattice for all,
and minimum coherence with the former."""


def read_chips(photo: Photo, region: Corners | Lamp | None = None) -> ChipReading:
    """Read the chips in view of a photo, without knowing what is sent or whether it repeats.

    The edges of the stripes lie on a lattice of chips, the coarsest that explains them; a pause
    between bursts is rounded to a whole number of chips. If the exposure is longer than a chip,
    there are too few edges for this method.

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
        There are no stripes, or their edges are too few, too close, or lie on no lattice of chips.
    ParameterError
        ``region`` is not a rectangle of the photo.
    """
    stripes = find_stripes(photo, region)
    original_edges = edges_of(stripes.flattened)
    edges = align_bursts(original_edges)
    lattice = find_coarsest(edges)
    if lattice is not None:
        panel = part_between_rims(edges, lattice)
        edges, original_edges = edges.where(panel), original_edges.where(panel)
    chips_and_start = None if lattice is None else chips_between(edges, lattice)
    if lattice is None or chips_and_start is None:
        raise MatchError(f"No chips can be read: {_explain_failure(edges)}")
    chips, first = chips_and_start
    start = (first + 0.5 * (lattice.rising + lattice.falling)) / lattice.frequency
    unexplained = _unexplained_fraction(stripes.flattened, original_edges, lattice.frequency)
    trust = np.clip((_WRONG_ABOVE - unexplained) / (_WRONG_ABOVE - _RIGHT_BELOW), 0.0, 1.0)
    return ChipReading(
        chips=chips,
        columns_per_chip=1.0 / lattice.frequency,
        confidence=certainty(edges, lattice) * float(trust),
        start=stripes.region.first_column + start,
        region=stripes.region,
    )


def _explain_failure(edges: Edges) -> str:
    """Explain why edges give no chips: they are too few, too close, or on no lattice."""
    pair = edges.shortest_pair
    if len(edges) < LEAST_EDGES:
        return (
            f"{inflect(len(edges), 'edge')} of stripes are in view; at least {LEAST_EDGES} are "
            "needed; come closer, or raise the frequency."
        )
    if pair <= LEAST_PAIR:
        length, limit = distinct_texts(pair, LEAST_PAIR)
        return (
            f"the shortest bright and the shortest dark stripe have {length} columns together; "
            f"more than {limit} are needed; come closer, or lower the frequency."
        )
    return (
        f"the {len(edges)} edges of the stripes lie on no common lattice of chips; a shorter "
        "exposure, or more columns a chip, give clearer edges."
    )


def _unexplained_fraction(flattened: FloatArray, edges: Edges, frequency: float) -> float:
    """Return the fraction of a profile's variance that chips do not explain at the best exposure.

    Only columns between the first and the last edge count. The model uses the measured edges, so
    that it includes the lengthening of bright runs.
    """
    columns = np.arange(int(np.ceil(edges.place[0])), int(edges.place[-1]) + 1)
    data = flattened[columns] - flattened[columns].mean()
    power = float(data @ data)
    # Integral of the light, which is bright from a rising edge to the next falling one.
    lit = np.concatenate([[0.0], np.cumsum(np.diff(edges.place) * edges.rises[:-1])])
    smallest = power
    for exposure in _EXPOSURES / frequency:
        ends = (np.interp(columns + side * exposure, edges.place, lit) for side in (0.5, -0.5))
        model = next(ends) - next(ends)
        model -= model.mean()
        energy = float(model @ model)
        if energy > 0.0:
            smallest = min(smallest, power - float(model @ data) ** 2 / energy)
    return smallest / max(power, 1e-12)


def align_bursts(edges: Edges) -> Edges:
    """Move bursts by up to half a chip so that all lie on one lattice, unless they do already."""
    bursts = _split_into_bursts(edges)
    if len(bursts) < 2:
        return edges
    longest = max(bursts, key=len)
    common_lattice, burst_lattice = find_coarsest(edges), find_coarsest(longest)
    if burst_lattice is None:
        return edges
    frequency = burst_lattice.frequency
    turns = [lattice_at(burst, frequency) for burst in bursts]
    first = 0.5 * (turns[0].rising + turns[0].falling)
    moved_bursts = []
    for burst, turn in zip(bursts, turns, strict=True):
        shift = (0.5 * (turn.rising + turn.falling) - first + 0.5) % 1.0 - 0.5
        moved_bursts.append(replace(burst, place=burst.place - shift / frequency))
    joined = Edges.join(moved_bursts)
    lattice = find_coarsest(joined)
    common_coherence = 0.0 if common_lattice is None else common_lattice.coherence
    least_coherence = max(
        _LEAST_COHERENCE, 1.0 - _MOST_INCOHERENCE_RATIO * (1.0 - common_coherence)
    )
    return edges if lattice is None or lattice.coherence < least_coherence else joined


def _split_into_bursts(edges: Edges) -> list[Edges]:
    gaps, is_bright = np.diff(edges.place), edges.rises[:-1]
    longest = gaps.max(where=is_bright, initial=0.0)
    pauses = np.flatnonzero(~is_bright & (gaps > _LEAST_PAUSE_RATIO * longest)) + 1
    bursts: list[Edges] = []
    for first, last in pairwise([0, *pauses.tolist(), len(edges)]):
        part = edges.where(slice(first, last))
        if bursts and min(len(part), len(bursts[-1])) < _LEAST_BURST_EDGES:
            part = Edges.join([bursts.pop(), part])  # too few edges for a phase
        bursts.append(part)
    return bursts
