"""Edges of stripes by their kinds."""

import numpy as np
from numpy.typing import ArrayLike

from occ_model.photo.chips.edges import Edges


def edges_at(rising: ArrayLike, falling: ArrayLike) -> Edges:
    """Return the edges that rise and those that fall at some columns."""
    kinds = [(np.asarray(rising, dtype=float), True), (np.asarray(falling, dtype=float), False)]
    return Edges.join([Edges(place, np.full(len(place), rises)) for place, rises in kinds])
