"""Bursts of chips that are not a whole number of chips apart: each has a phase of its own."""

from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.chips.edges import Edges
from occ_model.photo.chips.lattice import coarsest, lattice_at

_LEAST_EDGES = 8  # minimum number of edges in a burst: fewer lie on some lattice by chance
_LEAST_PAUSE_RATIO = 1.25  # minimum ratio of a pause to the longest bright run

_MOST_INCOHERENCE_RATIO, _LEAST_COHERENCE = 0.5, 0.9
"""Maximum incoherence with a lattice for each burst, relative to that with one lattice for all, and
minimum coherence with the former."""


def in_phase(edges: Edges) -> Edges | None:
    """Move bursts until all lie on one lattice; None where one lattice explains edges as well.

    A pause that is not a whole number of chips is lengthened or shortened by up to half a chip.
    """
    bursts = _bursts(edges)
    if len(bursts) < 2:
        return None
    longest = max(bursts, key=lambda one: one.count)
    whole, own = coarsest(edges), coarsest(longest)
    if own is None:
        return None
    frequency = own.frequency
    turns = [lattice_at(one, frequency) for one in bursts]
    first = 0.5 * (turns[0].rising + turns[0].falling)
    moved = []
    for one, turn in zip(bursts, turns, strict=True):
        off = (0.5 * (turn.rising + turn.falling) - first + 0.5) % 1.0 - 0.5
        moved.append(Edges(one.rising - off / frequency, one.falling - off / frequency))
    joined = Edges(
        np.concatenate([one.rising for one in moved]),
        np.concatenate([one.falling for one in moved]),
    )
    lattice = coarsest(joined)
    before = 0.0 if whole is None else whole.coherence
    if lattice is None or lattice.coherence < max(
        _LEAST_COHERENCE, 1.0 - _MOST_INCOHERENCE_RATIO * (1.0 - before)
    ):
        return None
    return joined


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
        if found and (part.count < _LEAST_EDGES or found[-1].count < _LEAST_EDGES):
            before = found.pop()  # too few edges for a phase
            part = Edges(
                np.concatenate([before.rising, part.rising]),
                np.concatenate([before.falling, part.falling]),
            )
        found.append(part)
    return found


def _gaps(begins: FloatArray, ends: FloatArray) -> FloatArray:
    """Return the distance from each edge of a kind to the next one of the other, where there is."""
    after = np.searchsorted(ends, begins)
    inside = after < len(ends)
    return np.asarray(ends[after[inside]] - begins[inside])
