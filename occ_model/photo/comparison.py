"""Compare a photo's profile with a simulated one, column by column."""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError, ParameterError, counted
from occ_model.photo.stripes.envelope import MEAN_SHAPES, trend_of, weighted_correlation
from occ_model.results.match import Comparison

_LEAST_DEVIATION = 1e-9  # standard deviation below which a profile is constant but for rounding

RIM = 6
"""Columns at either end of a photo's stripes where blur mixes the lamp with what is beside it: in
the two sample photos residuals of up to 140 grey levels end within five."""

_EDGES_PER_SHAPE = 4  # edges in view for each polynomial of uneven light; fewer would be stripes


def compare(
    flattened: FloatArray,
    simulated: FloatArray,
    first_column: float = 0.0,
    scale: float = 1.0,
    swing: FloatArray | None = None,
) -> Comparison:
    """Compare a photo's profile with a simulated one, column by column.

    The photo's profile is scaled to the mean and the standard deviation that the simulation has
    around each column: how bright a photo is, here and there, says nothing about its stripes. Its
    outermost columns, where blur mixes the lamp with what is beside it, are left out.

    Parameters
    ----------
    flattened : ndarray of float64, shape (columns of the photo,)
        The photo's profile without its uneven light, at any levels.
    simulated : ndarray of float64, shape (columns,)
        The simulated profile in grey levels.
    first_column
        The column of the simulation on which the photo's first column lies.
    scale
        Columns of the simulation per column of the photo.
    swing : ndarray of float64, shape (columns of the photo,), or None
        Height of the photo's stripes before they were flattened: faint ones count as much less as
        they were stretched. None: all count equally.

    Returns
    -------
    Comparison

    Raises
    ------
    ParameterError
        A profile has not one value for each column.
    MatchError
        Fewer than two columns of the simulation are covered by the photo.
    """
    if not (np.isfinite(first_column) and np.isfinite(scale) and scale > 0.0):
        raise MatchError(
            f"The photo is to lie at column {first_column:g}, scaled by {scale:g}; allowed: "
            "numbers, and a scale above 0."
        )
    swing = np.ones(len(flattened)) if swing is None else swing
    for name, profile in (("flattened", flattened), ("simulated", simulated), ("swing", swing)):
        if np.ndim(profile) != 1:
            shape = np.shape(profile)
            raise ParameterError(f"{name} has the shape {shape}; allowed: a value for each column.")
    rim = min(RIM, len(flattened) // 4)
    # As numbers of Python: far beside the picture they are infinite without a warning.
    begin, step = float(first_column), float(scale)
    low, high = begin + rim * step, begin + (len(flattened) - 1 - rim) * step
    first = max(0, math.ceil(min(low, len(simulated))))
    last = math.floor(max(min(high, len(simulated) - 1), -1))
    if last <= first:
        raise MatchError(
            f"The photo lies from column {low:.4g} to {high:.4g} of the simulated picture, which "
            f"has {counted(len(simulated), 'column')}: it covers fewer than two; move or scale it."
        )
    place = (np.arange(first, last + 1) - first_column) / scale
    columns = np.arange(len(flattened))
    seen, height = (np.interp(place, columns, of) for of in (flattened, swing))
    height /= np.sqrt(np.mean(height**2))
    under = simulated[first : last + 1]
    of_mean = int(np.clip(_edges(seen) // _EDGES_PER_SHAPE, 1, MEAN_SHAPES))
    (mean, deviation), (own, spread) = (trend_of(one, of_mean) for one in (under, seen))
    evened = (seen - own) / spread
    correlation = 0.0
    if min(seen.std(), under.std()) > _LEAST_DEVIATION:
        correlation = weighted_correlation(evened, (under - mean) / deviation, height**2)
    return Comparison(first, mean + deviation * evened, under, correlation, height)


def _edges(profile: FloatArray) -> int:
    """Count changes of a profile from well above its mean to well below it, and back."""
    about = profile - profile.mean()
    sides = np.sign(about[np.abs(about) > 0.5 * about.std()])
    return int(np.count_nonzero(np.diff(sides)))


def enhance_comparison(comparison: Comparison, enhanced: FloatArray, method: str) -> Comparison:
    """Compare photo and simulation after the receiver's enhancement of both.

    ``enhanced``: shape (columns,), the simulated profile after it. ``method``: the enhancement, by
    the photo's own histogram: see :class:`occ_model.camera.enhancement.Enhancement`.
    """
    first = comparison.first_column
    photo = enhance(comparison.photo, method).astype(np.float64)
    under = enhanced[first : first + len(photo)]
    correlation = weighted_correlation(photo, under, np.ones(len(photo)))
    return Comparison(first, photo, under, correlation)
