"""Read the chips from stripes of which only the period is known.

Stripes that repeat after T columns are a sum of harmonics of 1/T. P chips per period have only P
unknown levels; the exposure and the length of a chip multiply the harmonics by those of boxes. For
each P and exposure the chips that explain the harmonics best therefore follow by division. They are
rounded to on and off, and the shortest period whose rounded chips explain the stripes is taken.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.chips.edges import Edges, edges_of
from occ_model.photo.chips.lattice import coherence
from occ_model.photo.stripes.envelope import without_trend

MOST_CHIPS = 128
"""Largest number of chips in a period."""

_LEAST_COLUMNS = 2.0
"""Smallest number of columns per chip."""

_EXPOSURES = (0.1, 0.5, 0.9, 1.15, 1.3, 1.5, 1.7, 1.85, 2.15, 2.3, 2.5, 2.7, 2.85, 3.3)
_PHASES = np.arange(8) / 8.0
"""Exposures and phases, in chips, that are tried."""

_NOISE = 0.01
"""Share of the largest weight below which a harmonic is dominated by noise."""

_MOST_HARMONICS = 160

_COHERENT = 0.93
"""Coherence of the edges with a lattice of chips, as a share of the most coherent lattice's.

Below 1 for the noise of the edges.
"""

_LEAST_COHERENCE = 0.6

_LONGEST_FOR_EDGES = 1.5
"""Exposure in chips above which the edges alone may not show the lattice of the chips."""

_MOST_COUNTS = 12
"""Numbers of chips, on whose lattices the edges lie, that are tried."""

_WELL_EXPLAINED = 0.02
"""Share of the harmonics' power that the right chips may leave unexplained without a doubt."""

_REFINEMENTS = 120

_MOST_LONGER = 0.5
"""Chips by which gamma and saturation can make bright runs longer, or shorter, than they are."""

_AS_GOOD = 1.5
"""Ratio of the unexplained power to the least one up to which fewer chips are preferred."""

_LEAST_CROSSINGS = 4

_UNEXPLAINED = 0.15
"""Largest share of the harmonics' power that the right chips leave unexplained."""

_DIP = 0.5
"""Ratio to neighbouring numbers of chips of the power that the right one leaves unexplained."""

_BESIDE = (-3, -2, -1, 1, 2, 3)


@dataclass(frozen=True, eq=False, slots=True)
class ReadPattern:
    """Chips read from stripes.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period.
    explained
        Correlation of their harmonics with those in the photo.
    exposure, phase
        The exposure, and the place of the first chip, in chips, that explain the harmonics so.
    """

    chips: ByteArray
    explained: float
    exposure: float
    phase: float


Harmonics = NDArray[np.complex128]


def read_patterns(profile: FloatArray, flattened: FloatArray, period: float) -> list[ReadPattern]:
    """Read repeating sequences of chips that explain the stripes, with as few chips as possible.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    flattened : ndarray of float64, shape (columns,)
        The profile without uneven light, from 0 (dark) to 1 (bright).
    period
        Columns after which the profile repeats.

    Returns
    -------
    list of ReadPattern
        In different ways of reading, by edges first; empty where no sequence explains the stripes.

    Notes
    -----
    Chips may be misread, or not be read, where the exposure is shorter than a column's readout: the
    position of an edge within a column is then unknown.
    """
    lines = _harmonics(without_trend(profile), period)
    most = min(MOST_CHIPS, int(period / _LEAST_COLUMNS))
    counts = _counts_by_edges(edges_of(flattened), period, most)
    found = [_fewest(lines, counts)]
    by_edges = found[0]
    if (
        by_edges is None
        or _unexplained(by_edges) > _WELL_EXPLAINED
        or by_edges.exposure > _LONGEST_FOR_EDGES
    ):
        found.append(_chips_by_lines(lines, most))
    read = [replace(one, chips=canonical(one.chips)) for one in found if one is not None]
    return list({one.chips.tobytes(): one for one in read}.values())


def _fewest(lines: Harmonics, counts: Sequence[int]) -> ReadPattern | None:
    """Find the fewest chips that explain the harmonics about as well as the best number does."""
    rough = [one for count in counts if (one := _best_chips(lines, count)) is not None]
    read = [_refined(lines, one) for one in rough]
    left = [_unexplained(one) for one in read]
    enough = _enough(left)
    return next((one for one, rest in zip(read, left, strict=True) if rest <= enough), None)


def _enough(left: Sequence[float]) -> float:
    """Give the share of the power that the fewest chips may leave unexplained."""
    return min(_UNEXPLAINED, max(_WELL_EXPLAINED, _AS_GOOD * min(left, default=1.0)))


def _counts_by_edges(edges: Edges, period: float, most: int) -> list[int]:
    """Give the numbers of chips in a period on whose lattices all edges lie, the fewest first."""
    count = np.arange(2, most + 1)
    if edges.count < _LEAST_CROSSINGS or count.size == 0:
        return []
    coherent = coherence(edges, count / period)
    if coherent.max() < _LEAST_COHERENCE:
        return []
    good: list[int] = count[coherent >= _COHERENT * coherent.max()].tolist()
    divisors = [part for part in range(2, good[0]) if good[0] % part == 0]
    # An exposure of nearly a chip shifts edges off the lattice of the chips, onto a finer one.
    return [*divisors, *good[:_MOST_COUNTS]]


def _chips_by_lines(lines: Harmonics, most: int) -> ReadPattern | None:
    """Find the smallest number of chips that explains the harmonics far better than its neighbours.

    This method needs no edges: an exposure of several chips leaves none.
    """
    read = {count: _best_chips(lines, count) for count in range(2, most + 1)}
    left = {count: 1.0 if one is None else _unexplained(one) for count, one in read.items()}
    enough = _enough(list(left.values()))
    for count, one in read.items():
        beside = [left[count + step] for step in _BESIDE if count + step in left]
        stands_out = bool(beside) and left[count] <= _DIP * float(np.median(beside))
        if one is not None and left[count] <= enough and stands_out:
            return _refined(lines, one)
    return None


def _unexplained(read: ReadPattern) -> float:
    return 1.0 - max(read.explained, 0.0) ** 2


def canonical(chips: ByteArray) -> ByteArray:
    """Rotate a sequence so that its longest run of ones comes first, and keep one period of it."""
    text = "".join(map(str, chips.tolist()))
    shortest = (text + text).find(text, 1)
    text = text[:shortest]
    turned = max(text[start:] + text[:start] for start in range(len(text)))
    return np.array(list(turned), dtype=np.uint8)


def _harmonics(even: FloatArray, period: float) -> Harmonics:
    """Give the strength of each harmonic of 1/period, from the first."""
    columns = len(even)
    count = int(np.clip(period / 2.0, 2, _MOST_HARMONICS))
    # Over whole periods, since otherwise the harmonics leak into each other.
    whole = int(int(columns / period) * period) or columns
    turn = np.exp(-2j * np.pi / period * np.outer(np.arange(1, count + 1), np.arange(whole)))
    return np.asarray(turn @ even[:whole] / whole)


def _best_chips(lines: Harmonics, count: int) -> ReadPattern | None:
    """Find the chips, over all exposures and phases, whose harmonics are most like those given."""
    order = np.arange(1, len(lines) + 1)
    exposures, phases = (part.ravel() for part in np.meshgrid(_EXPOSURES, _PHASES))
    boxes = np.sinc(order / count) * np.sinc(np.outer(exposures, order / count)) / count
    turned = np.asarray(boxes * np.exp(-2j * np.pi / count * np.outer(phases, order)), complex)
    chips = _rounded(_levels(lines, turned, count))
    model = np.fft.fft(chips, axis=1)[:, order % count] * turned
    energy = np.sqrt((np.abs(model) ** 2).sum(axis=1) * float((np.abs(lines) ** 2).sum()))
    products = (lines * np.conj(model)).real.sum(axis=1)
    explained = np.where(energy > 0.0, products / np.maximum(energy, 1e-300), -1.0)
    best = int(explained.argmax())
    if chips[best].min() == chips[best].max():
        return None
    found = float(exposures[best]), float(phases[best])
    return ReadPattern(chips[best], float(explained[best]), *found)


def _refined(lines: Harmonics, found: ReadPattern) -> ReadPattern:
    """Refine exposure and phase, and let bright runs be longer or shorter than their chips."""
    # Imported only when a photo is matched: it is slow.
    from scipy.optimize import minimize

    count = len(found.chips)
    turn = -2j * np.pi * np.arange(1, len(lines) + 1) / count
    change = found.chips.astype(np.int64) - np.roll(found.chips, 1)
    order = np.arange(1, len(lines) + 1) % count
    rising, falling = (np.fft.fft(kind)[order] / -turn for kind in (change > 0, change < 0))

    def unlike(values: FloatArray) -> float:
        exposure, phase, longer = values.tolist()
        box = np.sinc(np.arange(1, len(lines) + 1) * exposure / count)
        model = (rising - falling * np.exp(turn * longer)) * box * np.exp(turn * phase)
        return -_likeness(lines, model)

    # A chip's own box is centred half a chip after its rising edge.
    start = [found.exposure, found.phase - 0.5, 0.0]
    steps = np.vstack([start, *(start + 0.1 * np.eye(3))])
    best = minimize(
        unlike,
        start,
        method="Nelder-Mead",
        options={"initial_simplex": steps, "maxfev": _REFINEMENTS, "xatol": 0.01, "fatol": 1e-4},
    )
    exposure, phase, longer = best.x.tolist()
    if abs(longer) > _MOST_LONGER:
        return found
    return ReadPattern(found.chips, -float(best.fun), abs(exposure), phase + 0.5)


def _levels(lines: Harmonics, weights: NDArray[np.complex128], count: int) -> FloatArray:
    """Solve for the chips' levels: harmonics that are equal modulo their number give one.

    Parameters
    ----------
    lines : ndarray of complex128, shape (harmonics,)
        The harmonics given.
    weights : ndarray of complex128, shape (trials, harmonics)
        What multiplies the chips' own harmonics, for each exposure and phase.
    count
        Number of chips.

    Returns
    -------
    ndarray of float64, shape (trials, chips)
    """

    def folded(values: Harmonics) -> Harmonics:
        missing = -(values.shape[1] + 1) % count
        whole = np.pad(values, ((0, 0), (1, missing)))
        return np.asarray(whole.reshape(len(values), -1, count).sum(axis=1))

    power = folded(np.abs(weights) ** 2 + 0j).real
    sums = folded(lines * np.conj(weights))
    spectrum = sums / (power + _NOISE * power.max(axis=1, keepdims=True))
    # The spectrum of real levels is its own mirror image, conjugated.
    spectrum[:, 0] = 0.0
    mirror = -np.arange(count) % count
    both = (power + power[:, mirror]) > 0.0
    own = np.where(power >= power[:, mirror], spectrum, np.conj(spectrum[:, mirror]))
    return np.asarray(np.fft.ifft(np.where(both, own, 0.0), axis=1).real)


def _rounded(levels: FloatArray) -> ByteArray:
    """Round each row of levels to off and on, half-way between the means of either kind."""
    split = 0.5 * (levels.max(axis=1) + levels.min(axis=1))
    for _ in range(8):
        on = levels > split[:, None]
        bright = (levels * on).sum(axis=1) / np.maximum(on.sum(axis=1), 1)
        dark = (levels * ~on).sum(axis=1) / np.maximum((~on).sum(axis=1), 1)
        split = 0.5 * (bright + dark)
    return np.asarray(levels > split[:, None], dtype=np.uint8)


def _likeness(a: Harmonics, b: Harmonics) -> float:
    energy = float(np.sqrt((np.abs(a) ** 2).sum() * (np.abs(b) ** 2).sum()))
    return float((a * np.conj(b)).real.sum()) / energy if energy > 0.0 else 0.0
